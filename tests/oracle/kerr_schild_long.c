#include "kerr_schild.h"

typedef long double real;
#define KS_FINE 1e-18L
#define KS_ACCEPT 1e-16L
#define KS_GROW 1e-17L
#define KS_LAND 1e-17L
#include "kerr_schild_flow.h"

struct ks_path ks_trace_long(struct ks_photon photon, int max_crossings)
{
    state y;
    start(&photon, y);
    return run((struct system) { photon.a, photon.energy, photon.q }, y, true, max_crossings);
}

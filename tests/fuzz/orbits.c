/* Fuzz target: a request for orbits; solves the first of them and takes a few steps along it. */
#include "fuzz.h"

#include "orbit/request.h"
#include "orbit/run.h"

#include <math.h>

enum { SOLVED = 2 };

static void solve(const struct kd_orbit_request *request, size_t index)
{
    struct kd_orbit orbit;
    struct kd_orbit_state start;
    struct kd_error error = { 0 };
    double rounding = NAN;
    const enum kd_status status = kd_orbit_request_solve(request, index, &orbit, &start, &rounding, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else
        CHECK(rounding >= 0 && rounding <= KD_ORBIT_ROUNDING_MAX, "the rounding of an orbit is %g", rounding);
}

int kd_fuzz_orbits(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text text = kd_fuzz_bare(data, size);
    struct kd_orbit_request request;
    struct kd_error error = { 0 };
    kd_orbit_request_init(&request);
    enum kd_status status = kd_orbit_request_json(&request, text.at, text.size, &error);
    if (!status)
        status = kd_orbit_request_check(&request, &error);
    if (status)
        kd_fuzz_refused(status, &error);
    else
        CHECK(request.n >= 1 && request.n <= KD_ORBITS_MAX, "a request that was read has %zu orbits", request.n);
    for (size_t i = 0; !status && i < request.n && i < SOLVED; i++)
        solve(&request, i);
    kd_orbit_request_finish(&request);
    free(text.at);
    return 0;
}

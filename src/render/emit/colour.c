/* Fills the tables of black bodies: their colours and their luminosities. */
#include "render/emit/emitter.h"

#include "physics/disk/colour.h"

#include <math.h>
#include <string.h>

/* Temperature of node i of both tables. */
static double kelvin(int i)
{
    return ldexp(KD_COLOUR_LEAST * (1 + (double)(i % KD_COLOUR_NODES) / KD_COLOUR_NODES), i / KD_COLOUR_NODES);
}

void kd_colour_tables(struct kd_emit_tables *out)
{
    struct kd_colour_rgb c = kd_colour_blackbody_unit(kelvin(0));
    for (int i = 0; i < KD_COLOUR_ROWS; i++) {
        const struct kd_colour_rgb next = kd_colour_blackbody_unit(kelvin(i + 1));
        const float row[] = { (float)c.r, (float)c.b, (float)(next.r - c.r), (float)(next.b - c.b) };
        memcpy(out->colour[i], row, sizeof row);
        c = next;
    }
}

static double luminous(int i) { return log2(fmax(kd_colour_luminous_fraction(kelvin(i)), 1e-300)); }

void kd_luminous_table(struct kd_emit_tables *out)
{
    double from = luminous(0);
    for (int i = 0; i < KD_COLOUR_ROWS; i++) {
        double to = luminous(i + 1);
        out->luminous[i][0] = (float)from;
        out->luminous[i][1] = (float)(to - from);
        from = to;
    }
}

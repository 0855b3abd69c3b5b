#include "render/emit/emitter.h"

#include "physics/colour.h"

#include <math.h>

static uint32_t fraction(double value, double most) { return (uint32_t)lrint(65535 * fmin(fmax(value / most, 0), 1)); }

void kd_colour_tables(struct kd_emit_tables *out)
{
    for (int i = 0; i < KD_COLOUR_TABLE; i++) {
        double t = ldexp(KD_COLOUR_LEAST * (1 + (double)(i % KD_COLOUR_NODES) / KD_COLOUR_NODES), i / KD_COLOUR_NODES);
        const struct kd_colour_rgb c = kd_colour_blackbody_unit(t);
        out->colour[i] = fraction(c.r, KD_COLOUR_RED) | fraction(c.b, KD_COLOUR_BLUE) << 16;
        out->luminous[i] = (float)log2(fmax(kd_colour_luminous_fraction(t), 1e-300));
    }
}

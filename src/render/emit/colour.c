#include "render/emit/emitter.h"

#include "physics/colour.h"

#include <math.h>
#include <string.h>

void kd_colour_tables(struct kd_emit_tables *out)
{
    struct kd_colour_rgb c = { 0 };
    double luminous = 0;
    for (int i = 0; i <= KD_COLOUR_ROWS; i++) {
        double t = ldexp(KD_COLOUR_LEAST * (1 + (double)(i % KD_COLOUR_NODES) / KD_COLOUR_NODES), i / KD_COLOUR_NODES);
        const struct kd_colour_rgb next = kd_colour_blackbody_unit(t);
        double next_luminous = log2(fmax(kd_colour_luminous_fraction(t), 1e-300));
        if (i > 0) {
            const float row[] = { (float)c.r, (float)c.b, (float)(next.r - c.r), (float)(next.b - c.b) };
            memcpy(out->colour[i - 1], row, sizeof row);
            out->luminous[i - 1][0] = (float)luminous;
            out->luminous[i - 1][1] = (float)(next_luminous - luminous);
        }
        c = next;
        luminous = next_luminous;
    }
}

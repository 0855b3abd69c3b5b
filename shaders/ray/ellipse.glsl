/* The ellipse of a ray's footprint, as stored in the lens map (shared/lens.h). */
#ifndef KD_ELLIPSE_GLSL
#define KD_ELLIPSE_GLSL

#include "shared/math.glsl"

/* The larger singular value of J. a, b and c are the elements of J^T J or of J J^T: a and b on the diagonal, c off the
 * diagonal. */
float kd_longest(float a, float b, float c)
{
    float half_ = 0.5 * (a - b), size = sqrt(0.5 * (a + b) + sqrt(half_ * half_ + c * c));
    return kd_is_finite(size) ? min(size, KD_FOOTPRINT_EDGE) : KD_FOOTPRINT_EDGE;
}

/* The size and the shape of a footprint, as the map stores them. */
struct kd_oval { float size, shape; };

const kd_oval KD_NO_OVAL = kd_oval(KD_FOOTPRINT_EDGE, 1.0 + (1023.0 + 2048.0 * 1023.0) / 8388608.0);

/* The ellipse of J J^T from its components. rr, ff: along r and phi. rf: mixed; its sign takes into account that r
 * grows as w decreases. */
kd_oval kd_oval_of(float rr, float ff, float rf)
{
    float size = kd_longest(rr, ff, rf), i = rr / (rr + ff), j = 0.5 - 0.5 * rf * inversesqrt(rr * ff);
    if (!kd_is_finite(i + j))
        return kd_oval(size, KD_NO_OVAL.shape);
    return kd_oval(
        size, 1.0 + (floor(2047.0 * clamp(i, 0.0, 1.0) + 0.5) + 2048.0 * floor(2047.0 * clamp(j, 0.0, 1.0) + 0.5)) /
                        8388608.0);
}

#endif

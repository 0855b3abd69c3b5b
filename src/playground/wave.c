#include "playground/wave.h"

#include "playground/body.h"
#include "playground/hole.h"

#include <math.h>

/* largest ratio of the loss to the attraction; beyond it there is no orbit, and the formula might add energy */
#define MOST 0.1

/* The reaction of a pair. product: m1 m2. m: total mass. */
static bool react(double product, double m, const double x[3], const double v[3], double amplification, double a[3])
{
    const double r = sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    const double v2 = v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
    a[0] = a[1] = a[2] = 0;
    if (!(m > 0) || !(r > 0) || !(product > 0))
        return false;
    const double out = (x[0] * v[0] + x[1] * v[1] + x[2] * v[2]) / r;
    const double strength = 8. / 5 * amplification * product / (r * r * r);
    const double along_n = out * (3 * v2 + 17. / 3 * m / r), along_v = v2 + 3 * m / r;
    double size2 = 0;
    for (int k = 0; k < 3; k++) {
        a[k] = strength * (along_n * x[k] / r - along_v * v[k]);
        size2 += a[k] * a[k];
    }
    const double size = sqrt(size2), most = MOST * m / (r * r);
    if (size <= most)
        return false;
    for (int k = 0; k < 3; k++)
        a[k] = isfinite(size) ? a[k] * (most / size) : 0;
    return true;
}

bool kd_wave_reaction(double m1, double m2, const double x[3], const double v[3], double amplification, double a[3])
{
    return react(m1 * m2, m1 + m2, x, v, amplification, a);
}

bool kd_wave_reaction_hole(double m, const double x[3], const double v[3], double amplification, double a[3])
{
    const double r = kd_playground_radius(x), scale = (r - KD_PLAYGROUND_HORIZON) / r;
    const bool held =
        react(m * (1 + m), 1, x, (const double[3]) { scale * v[0], scale * v[1], scale * v[2] }, amplification, a);
    for (int k = 0; k < 3; k++)
        a[k] *= scale;
    return held;
}

static double distance2(const struct kd_playground_body *a, const struct kd_playground_body *b)
{
    const double d[3] = { a->x[0] - b->x[0], a->x[1] - b->x[1], a->x[2] - b->x[2] };
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

static bool bound(const struct kd_playground_body *a, const struct kd_playground_body *b, double softening2)
{
    const double v[3] = { a->v[0] - b->v[0], a->v[1] - b->v[1], a->v[2] - b->v[2] };
    return 0.5 * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) < (a->mass + b->mass) / sqrt(distance2(a, b) + softening2);
}

void kd_wave_partners(const struct kd_playground_body *bodies, size_t n, double softening, size_t *partners)
{
    const double softening2 = softening * softening;
    for (size_t i = 0; i < n; i++) {
        double most = 0;
        partners[i] = n;
        for (size_t j = 0; j < n; j++) {
            const double pull = j == i ? 0 : bodies[j].mass / (distance2(&bodies[i], &bodies[j]) + softening2);
            if (pull > most) {
                most = pull;
                partners[i] = j;
            }
        }
    }
    /* A pair stays partners only if it is bound. All other bodies end without a partner. A chain (i to j, j to k)
     * ends in a mutual pair, which is checked in the same way */
    for (size_t i = 0; i < n; i++) {
        const size_t j = partners[i];
        if (j < n && i < j && partners[j] == i && !bound(&bodies[i], &bodies[j], softening2))
            partners[i] = partners[j] = n;
    }
    for (size_t i = 0; i < n; i++)
        if (partners[i] < n && partners[partners[i]] != i)
            partners[i] = n;
}

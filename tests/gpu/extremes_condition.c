#include "extremes.h"

#include <math.h>

static void inputs(struct kd_null_ray *ray, double *out[EXTREME_INPUTS])
{
    out[0] = &ray->alpha, out[1] = &ray->beta, out[2] = &ray->hole.a, out[3] = &ray->cos_theta, out[4] = &ray->radius;
}

static struct kd_null_path moved(const struct kd_null_ray *ray, int input, double by)
{
    struct kd_null_ray near = *ray;
    double *x[EXTREME_INPUTS];
    inputs(&near, x);
    *x[input] *= 1 + by;
    near.hole = kd_hole_of(near.hole.a);
    near.cos_theta = fmax(-1, fmin(1, near.cos_theta));
    if (input == 3) /* the inclination is computed from the cosine */
        near.sin_theta = 0;
    return kd_null_trace_fast(&near);
}

void extreme_condition(const struct kd_null_ray *ray, const struct kd_null_path *path, double step,
                       const double weight[EXTREME_INPUTS], double *r, double *phi)
{
    for (int n = 0; n < path->crossings; n++)
        r[n] = phi[n] = 0;
    for (int k = 0; k < EXTREME_INPUTS; k++) {
        double w = weight ? weight[k] : 1;
        /* a smaller difference would be lost in rounding, also for the spin */
        struct kd_null_path near = moved(ray, k, -step);
        for (int n = 0; n < path->crossings; n++) {
            const struct kd_null_crossing *x = &path->crossing[n], *y = &near.crossing[n];
            bool lost = n >= near.crossings;
            r[n] += lost ? INFINITY : w * fabs(y->r / x->r - 1) / step;
            phi[n] += lost ? INFINITY : w * fabs(remainder(y->phi - x->phi, 2 * M_PI)) / step;
        }
    }
}

bool extreme_steady(const struct kd_null_ray *ray, const struct kd_null_path *path, double step,
                    const double weight[EXTREME_INPUTS])
{
    for (int k = 0; k < 2 * EXTREME_INPUTS; k++) {
        double by = step * (weight ? weight[k / 2] : 1);
        if (k / 2 == 2) /* callers that round the spin compute the horizon from the rounded value */
            by = fmin(by, 0.1 * (1 - fabs(ray->hole.a)));
        struct kd_null_path near = moved(ray, k / 2, k % 2 ? by : -by);
        if (near.crossings != path->crossings || near.fate != path->fate || near.status != path->status)
            return false;
    }
    return true;
}

static double fraction(size_t k, double step) { return fmod(0.5 + step * (double)(k + 1), 1); }
double extreme_x(size_t k) { return fraction(k, 0.7548776662466927); }
double extreme_y(size_t k) { return fraction(k, 0.5698402909980532); }

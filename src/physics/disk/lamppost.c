#include "physics/disk/lamppost.h"

#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

#define EXACT 1e-11 /* allowed error of ln r */

/* The square of the source's redshift to infinity, which is Delta/(h^2 + a^2). */
static double source_redshift2(const struct kd_hole *hole, double h)
{
    return kd_hole_delta(hole, h) / (h * h + hole->a * hole->a);
}

static struct kd_null_ray ray_of(const struct kd_hole *hole, double h, double delta)
{
    const double a = hole->a;
    struct kd_null_ray ray = { .hole = *hole, .radius = h, .cos_theta = 1, .orders = 1, .outward = delta > M_PI / 2 };
    ray.alpha = sin(delta) * sqrt((h * h + a * a) / source_redshift2(hole, h));
    return ray;
}

double kd_lamppost_reach(const struct kd_hole *hole, double h, double delta)
{
    const struct kd_null_ray ray = ray_of(hole, h, delta);
    const struct kd_null_path path = kd_null_trace_radii(&ray);
    return path.crossings ? path.crossing[0].r : path.fate == KD_NULL_ESCAPED ? INFINITY : 0;
}

static double mismatch(const struct kd_hole *hole, double h, double delta, double r)
{
    double found = kd_lamppost_reach(hole, h, delta);
    return found > 0 ? log(found / r) : -INFINITY;
}

/* Finds the angle delta at which light that meets the ring leaves the source. It starts from a guess, and uses the
 * secant method within a bracket. */
static bool find(const struct kd_hole *hole, double h, double r, double slope, double *delta)
{
    double low = 0, high = M_PI, x = *delta, before = NAN, f_before = NAN;
    for (int i = 0; i < 200; i++) {
        double f = mismatch(hole, h, x, r);
        if (fabs(f) < EXACT || high - low < 1e-15) {
            *delta = x;
            return fabs(f) < 1e-6;
        }
        *(f < 0 ? &low : &high) = x;
        if (isfinite(f) && isfinite(f_before))
            slope = (f - f_before) / (x - before);
        double next = x - f / slope;
        before = x, f_before = f;
        x = next > low && next < high ? next : 0.5 * (low + high);
    }
    return false;
}

bool kd_lamppost_init(struct kd_lamppost *lamp, const struct kd_hole *hole, double h, double photon_index, double inner,
                      double outer)
{
    double delta = 0.5, slope = 1, source = sqrt(source_redshift2(hole, h));
    lamp->first = log(inner), lamp->step = log(outer / inner) / (KD_LAMPPOST_RINGS - 1);
    for (int k = 0; k < KD_LAMPPOST_RINGS; k++) {
        double r = exp(lamp->first + k * lamp->step), ut = kd_kerr_ut(hole, r);
        if (k)
            delta += fmin(lamp->step / slope, 0.5 * (M_PI - delta));
        if (!find(hole, h, r, slope, &delta))
            return false;
        /* The slope of ln r in delta grows as r/h, so the step is scaled by the inverse of that slope. */
        double near = 1e-4 * fmin(1, 1 / slope) * fmin(delta, M_PI - delta);
        slope = (mismatch(hole, h, delta + near, r) - mismatch(hole, h, delta - near, r)) / (2 * near);
        if (!(slope > 0) || !isfinite(slope))
            return false;
        const struct kd_null_ray ray = ray_of(hole, h, delta);
        lamp->late[k] = kd_null_trace_fast(&ray).crossing[0].delay - r;
        lamp->log_epsilon[k] = log(sin(delta) / (slope * r) / (4 * M_PI * r * ut)) + photon_index * log(ut * source);
    }
    return true;
}

/* Interpolates by the cubic through four neighbouring nodes. */
static double between(const struct kd_lamppost *lamp, const double *nodes, double r)
{
    double at = (log(r) - lamp->first) / lamp->step, sum = 0;
    int first = (int)fmin(fmax(floor(at) - 1, 0), KD_LAMPPOST_RINGS - 4);
    for (int i = 0; i < 4; i++) {
        double weight = 1;
        for (int j = 0; j < 4; j++)
            weight *= j == i ? 1 : (at - first - j) / (i - j);
        sum += weight * nodes[first + i];
    }
    return sum;
}

double kd_lamppost_at(const struct kd_lamppost *lamp, double r) { return exp(between(lamp, lamp->log_epsilon, r)); }

double kd_lamppost_time(const struct kd_lamppost *lamp, double r) { return r + between(lamp, lamp->late, r); }

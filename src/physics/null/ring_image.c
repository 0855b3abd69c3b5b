#include "physics/null/ring_image.h"

#include "physics/null/null_geodesic.h"
#include "physics/spacetime/hole.h"

#include <math.h>

#define STEP (2 * M_PI / 64) /* step of chi between nodes */
#define LEAST_STEP 1e-5
#define TABLE 1e-7 /* allowed error of ln r for the nodes of the table */
#define TURN 1.0   /* largest change of phi between nodes; near pi the direction of the change would be ambiguous */
#define STRETCH \
    0.2 /* maximum change of ln rho between nodes; at a corner of the image phi may turn by 2 pi, which TURN does not \
         * detect */

/* alpha and beta of the point at the distance e^log_rho in the direction chi. chi is such that it advances evenly round
 * a ring seen unlensed from afar, whose image is (cos chi, cos i sin chi). */
static void place(const struct kd_ring_image *ring, double chi, double log_rho, double *alpha, double *beta)
{
    double x = cos(chi), y = ring->flatten * sin(chi), rho = exp(log_rho) / hypot(x, y);
    *alpha = rho * x;
    *beta = rho * y;
}

/* ln(r_n/r), with r_n the radius of crossing n; -INFINITY if the ray is captured before that crossing, INFINITY if it
 * escapes before it. */
static double mismatch(const struct kd_ring_image *ring, double chi, double log_rho, struct kd_null_crossing *crossing)
{
    struct kd_null_ray ray = { .hole = ring->hole,
                               .radius = INFINITY,
                               .cos_theta = ring->cos_theta,
                               .sin_theta = ring->sin_theta,
                               .orders = ring->order + 1 };
    place(ring, chi, log_rho, &ray.alpha, &ray.beta);
    struct kd_null_path path = kd_null_trace_fast(&ray);
    if (path.crossings <= ring->order)
        return path.fate == KD_NULL_CAPTURED ? -INFINITY : INFINITY;
    *crossing = path.crossing[ring->order];
    return log(crossing->r / ring->radius);
}

/* Solves ln r_n = ln r along chi from a guess. It expands a range until the sign changes, bisects until both ends have
 * a crossing, and then uses the Illinois method until |ln r_n/r| is below `bound`. */
static bool approach(const struct kd_ring_image *ring, double chi, double bound, double *log_rho,
                     struct kd_null_crossing *crossing)
{
    double h = INFINITY, step = 0.02, at = *log_rho, f = mismatch(ring, chi, at, crossing), other, g = f;
    for (other = at; (f < 0) == (g < 0) && step < 40; step *= 2) {
        at = other, f = g;
        other += f < 0 ? step : -step;
        g = mismatch(ring, chi, other, crossing);
    }
    for (int i = 0, side = 0; i < 200 && fabs(other - at) > 1e-15 * fabs(at); i++) {
        bool linear = isfinite(f) && isfinite(g);
        double middle = linear ? (at * g - other * f) / (g - f) : 0.5 * (at + other);
        h = mismatch(ring, chi, middle, crossing);
        *log_rho = middle;
        if (fabs(h) < bound)
            return true;
        if ((h < 0) == (f < 0)) {
            at = middle, f = h;
            g *= linear && side == 1 ? 0.5 : 1;
            side = 1;
        } else {
            other = middle, g = h;
            f *= linear && side == 2 ? 0.5 : 1;
            side = 2;
        }
    }
    return fabs(h) < TABLE; /* accepts a small difference, which is due to rounding */
}

/* The angle x reduced to [-pi, pi] by whole turns. */
static double turn(double x) { return remainder(x, 2 * M_PI); }

/* Adds one node, at a distance of at most `step`. Returns false if no node is left or the image is not found. */
static bool add_node(struct kd_ring_image *ring, double *step)
{
    int k = ring->nodes - 1;
    struct kd_null_crossing crossing;
    if (ring->nodes == KD_RING_NODES)
        return false;
    for (;; *step *= 0.5) {
        double chi = ring->chi[k] + *step, log_rho = ring->log_rho[k];
        if (chi > 2 * M_PI - 0.5 * LEAST_STEP)
            chi = 2 * M_PI;
        if (!approach(ring, chi, TABLE, &log_rho, &crossing))
            return false;
        double change = turn(crossing.phi - ring->phi[k]);
        bool coarse = fabs(change) > TURN || fabs(log_rho - ring->log_rho[k]) > STRETCH;
        if (coarse && *step > LEAST_STEP)
            continue;
        ring->chi[k + 1] = chi;
        ring->log_rho[k + 1] = log_rho;
        ring->phi[k + 1] = ring->phi[k] + change;
        ring->nodes++;
        *step = fmin(2 * *step, STEP);
        return true;
    }
}

struct kd_ring_image kd_ring_image_plain(const struct kd_hole *hole, double inclination, double r, int order)
{
    return (struct kd_ring_image) { .hole = *hole,
                                    .cos_theta = cos(inclination),
                                    .sin_theta = sin(inclination),
                                    .flatten = cos(inclination),
                                    .radius = r,
                                    .order = order };
}

/* First guess of ln rho: next to the critical curve, or where the ring would be seen without lensing. */
static double around(const struct kd_ring_image *ring) { return log(ring->order ? 5.2 : ring->radius + 1); }

bool kd_ring_image_init(struct kd_ring_image *ring, const struct kd_hole *hole, double inclination, double r, int order)
{
    *ring = kd_ring_image_plain(hole, inclination, r, order);
    struct kd_null_crossing crossing;
    double step = STEP;
    ring->log_rho[0] = around(ring);
    if (!approach(ring, 0, TABLE, &ring->log_rho[0], &crossing))
        return false;
    ring->phi[0] = crossing.phi;
    ring->nodes = 1;
    while (ring->chi[ring->nodes - 1] < 2 * M_PI)
        if (!add_node(ring, &step))
            return false;
    /* True if the image goes round exactly once. */
    return fabs(ring->phi[ring->nodes - 1] - ring->phi[0] - 2 * M_PI) < 1e-3;
}

/* The azimuth of the image in the direction chi, minus the requested azimuth. *log_rho: on entry a guess, on return the
 * solution. */
static bool azimuth(const struct kd_ring_image *ring, double phi, double chi, double *log_rho, double *miss)
{
    struct kd_null_crossing crossing;
    bool found = approach(ring, chi, TABLE, log_rho, &crossing);
    *miss = found ? turn(crossing.phi - phi) : NAN;
    return found;
}

/* Solves for phi between the nodes k and k + 1, by the Illinois method, to 1e-4. This is close enough for Newton's
 * method. */
static bool bracket(const struct kd_ring_image *ring, double phi, int k, double *chi, double *log_rho)
{
    double low = ring->chi[k], high = ring->chi[k + 1], f = turn(ring->phi[k] - phi),
           g = f + (ring->phi[k + 1] - ring->phi[k]), h;
    for (int i = 0, side = 0; i < 60; i++) {
        double x = f / (f - g), at = low + x * (high - low),
               share = (at - ring->chi[k]) / (ring->chi[k + 1] - ring->chi[k]);
        *chi = at;
        *log_rho = ring->log_rho[k] + share * (ring->log_rho[k + 1] - ring->log_rho[k]);
        if (!azimuth(ring, phi, at, log_rho, &h))
            return false;
        if (fabs(h) < 1e-4)
            return true;
        bool left = (h < 0) == (f < 0);
        *(left ? &low : &high) = at;
        *(left ? &f : &g) = h;
        if (side == (left ? 1 : 2))
            *(left ? &g : &f) *= 0.5;
        side = left ? 1 : 2;
    }
    return false;
}

/* Slope of ln r_n in ln rho. For late orders and large r it is steep, so the step of the difference is adapted. */
static double slope(const struct kd_ring_image *ring, double chi, double log_rho, double f, double *phi_slope,
                    double phi)
{
    struct kd_null_crossing out;
    double h = 1e-6, change;
    do {
        h *= 0.1;
        change = mismatch(ring, chi, log_rho + h, &out) - f;
    } while (!(fabs(change) < 1e-5) && h > 1e-13);
    *phi_slope = turn(out.phi - phi) / h;
    return change / h;
}

/* One step of Newton's method in (chi, ln rho) for (ln r_n, phi) = (ln r, phi). Returns the size of the step, or
 * INFINITY where there is no crossing. */
static double newton(const struct kd_ring_image *ring, double phi, double *chi, double *log_rho,
                     struct kd_null_crossing *here)
{
    const double h = 1e-7;
    struct kd_null_crossing shifted;
    double f = mismatch(ring, *chi, *log_rho, here), g = turn(here->phi - phi), g_rho;
    if (!isfinite(f))
        return INFINITY;
    double f_rho = slope(ring, *chi, *log_rho, f, &g_rho, here->phi);
    /* r_n hardly changes along the ring's image. One of the two difference steps is taken in this direction. */
    double f_chi = mismatch(ring, *chi + h, *log_rho, &shifted) - f, along = isfinite(f_chi) ? f_chi / f_rho : NAN;
    double f_on = (mismatch(ring, *chi + h, *log_rho - along, &shifted) - f) / h,
           g_on = turn(shifted.phi - here->phi) / h;
    double determinant = f_on * g_rho - f_rho * g_on;
    double step = (f_rho * g - g_rho * f) / determinant, rest = (g_on * f - f_on * g) / determinant;
    double d_rho = rest - along / h * step;
    *chi += step;
    *log_rho += d_rho;
    return isfinite(step) && isfinite(d_rho) ? fabs(step) + fabs(d_rho) : INFINITY;
}

bool kd_ring_image_find(const struct kd_ring_image *ring, double phi, struct kd_ring_image_point *point)
{
    struct kd_null_crossing crossing;
    double chi = 0, log_rho = 0, size = 1;
    int first = -1;
    *point = (struct kd_ring_image_point) { 0 };
    for (int k = 0; k + 1 < ring->nodes; k++) {
        double f = turn(ring->phi[k] - phi), g = f + (ring->phi[k + 1] - ring->phi[k]);
        if (f < 0 ? g <= 0 : f > 0 && g >= 0)
            continue;
        point->images++;
        first = first < 0 ? k : first;
    }
    if (first < 0 || !bracket(ring, phi, first, &chi, &log_rho))
        return false;
    for (int i = 0; i < 20 && size > 1e-8; i++)
        size = newton(ring, phi, &chi, &log_rho, &crossing);
    if (!isfinite(size) || !isfinite(mismatch(ring, chi, log_rho, &crossing)))
        return false;
    point->residual = size;
    point->phi = crossing.phi;
    point->delay = crossing.delay;
    point->sense = crossing.sense;
    place(ring, chi, log_rho, &point->alpha, &point->beta);
    return size <= 1e-8;
}

bool kd_ring_image_seen(const struct kd_ring_image *ring, double chi, struct kd_ring_image_point *point)
{
    struct kd_null_crossing crossing;
    double log_rho = around(ring);
    *point = (struct kd_ring_image_point) { 0 };
    if (!approach(ring, chi, 1e-12, &log_rho, &crossing))
        return false;
    point->phi = crossing.phi;
    point->delay = crossing.delay;
    point->sense = crossing.sense;
    point->residual = log(crossing.r / ring->radius);
    place(ring, chi, log_rho, &point->alpha, &point->beta);
    return true;
}

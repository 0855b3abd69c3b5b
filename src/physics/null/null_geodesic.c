#include "physics/null/null_geodesic.h"

#include "physics/null/null_polar.h"
#include "physics/null/null_radial.h"
#include "physics/spacetime/kerr.h"

#include <float.h>
#include <math.h>

/* The motion of one ray, and where its start lies on the radial motion. */
struct motion {
    struct kd_null_polar polar;
    struct kd_null_radial radial;
    struct kd_null_radial_sum start; /* radial integrals from the observer to the radial reference */
    /* After the Mino time tau along the traced ray, the Mino time from the reference is begin + forward * tau. */
    double begin, forward;
    double end; /* Mino time at which the ray is captured, or has escaped */
};

static bool valid(const struct kd_null_ray *ray)
{
    if (!kd_hole_exists(&ray->hole) || !(fabs(ray->cos_theta) <= 1) || !(ray->sin_theta >= 0 && ray->sin_theta <= 1) ||
        !isfinite(ray->alpha) || !isfinite(ray->beta))
        return false;
    if (ray->orders < 0 || ray->orders > KD_NULL_ORDERS || !(ray->radius > ray->hole.outer))
        return false;
    return !(isinf(ray->radius) && ray->outward);
}

static struct kd_null_radial_sum sub(struct kd_null_radial_sum x, struct kd_null_radial_sum y)
{
    return (struct kd_null_radial_sum) { x.tau - y.tau, x.phi - y.phi, x.t - y.t };
}

static struct kd_null_radial_sum add(struct kd_null_radial_sum x, struct kd_null_radial_sum y)
{
    return (struct kd_null_radial_sum) { x.tau + y.tau, x.phi + y.phi, x.t + y.t };
}

/* The radial integrals from the observer to the place at Mino time `tau`. from: the integrals from that place to the
 * reference. */
static struct kd_null_radial_sum travelled(const struct motion *m, struct kd_null_radial_sum from, double tau)
{
    double at = m->begin + m->forward * tau;
    if (m->radial.inner) /* for INNER motion, Mino time counts from r3, which the ray passes at time 0 */
        return at < 0         ? sub((struct kd_null_radial_sum) { -m->begin, m->start.phi, m->start.t }, from)
               : m->begin < 0 ? add(m->start, from)
                              : sub(from, m->start);
    if (m->forward < 0)
        return sub(m->start, from);
    if (m->radial.turns && at > m->radial.turn.tau)
        return sub(sub(add(m->radial.turn, m->radial.turn), from), m->start);
    return sub(from, m->start);
}

static void set_out(struct motion *m, const struct kd_null_ray *ray)
{
    const struct kd_null_radial *q = &m->radial;
    if (isfinite(ray->radius)) {
        struct kd_null_radius at = kd_null_radius_of(q, ray->radius);
        m->start = kd_null_radial_integrals(q, &at);
    }
    m->begin = m->start.tau, m->forward = 1;
    if (q->inner) {
        m->begin = ray->outward ? -m->start.tau : m->start.tau;
        m->end = q->tau_horizon - m->begin;
    } else if (ray->outward) {
        m->forward = -1;
        m->end = m->start.tau;
    } else {
        m->end = (q->turns ? 2 * q->turn.tau : q->tau_horizon) - m->start.tau;
    }
}

/* Adds the errors that follow from rounding of Mino time and of its parts. */
static void disturb(const struct motion *m, double tau, struct kd_null_crossing *x)
{
    struct kd_null_radial_sum rate = kd_null_radial_rates(&m->radial.motion, x->r);
    double speed = sqrt(fmax(kd_null_radial_potential(&m->radial.motion, x->r), 0));
    double passed = DBL_EPSILON * (tau + m->start.tau);
    x->error_r = passed * speed / x->r;
    x->error_phi = passed * fabs(rate.phi);
    x->error_delay = passed * rate.t;
}

/* The place at Mino time `tau` from the observer, without the polar parts of azimuth and time. r is rounded. Its
 * rounding changes phi and t noticeably if dr/dtau is small, as near the photon sphere, or if phi' and t' are large, as
 * at the horizon. The integrals of phi and t belong to the Mino time of the rounded r. This Mino time is known, so the
 * integrals are corrected by its difference from `tau`. */
static bool reach(const struct motion *m, double tau, struct kd_null_crossing *x)
{
    const struct kd_null_radial *q = &m->radial;
    double at = m->begin + m->forward * tau;
    struct kd_null_radius r = kd_null_radius_at(q, at);
    if (!(r.r > q->r_plus) || !isfinite(r.r))
        return false;
    bool returned = !q->inner && q->turns && at > q->turn.tau,
         inwards = q->inner ? at > 0 : m->forward > 0 && !returned;
    *x = (struct kd_null_crossing) { .r = r.r, .phi = NAN, .delay = NAN, .sense = inwards ? 1 : -1 };
    if (q->parts == KD_NULL_TAU)
        return true;
    struct kd_null_radial_sum from = kd_null_radial_integrals(q, &r);
    double counted = returned ? 2 * q->turn.tau - at : fabs(at), late = counted - from.tau;
    struct kd_null_radial_sum rate = kd_null_radial_rates(&q->motion, r.r);
    from.phi += rate.phi * late, from.t += rate.t * late;
    struct kd_null_radial_sum sum = travelled(m, from, tau);
    x->phi = sum.phi, x->delay = sum.t;
    disturb(m, tau, x);
    return true;
}

static void cross(const struct motion *m, const struct kd_null_ray *ray, struct kd_null_path *path)
{
    for (int n = 0; n < ray->orders && m->polar.crosses; n++) {
        struct kd_null_polar_sum p = kd_null_polar_crossing(&m->polar, n);
        struct kd_null_crossing *x = &path->crossing[n];
        if (!(p.tau < m->end) || !reach(m, p.tau, x))
            return;
        x->phi = -(x->phi + p.phi);
        x->delay += ray->hole.a * ray->hole.a * p.u2;
        path->crossings++;
    }
}

static void escape(const struct motion *m, const struct kd_null_motion *k, struct kd_null_path *path)
{
    struct kd_null_radial_sum sum = m->forward < 0 ? m->start : sub(add(m->radial.turn, m->radial.turn), m->start);
    struct kd_null_polar_place sky = kd_null_polar_at(&m->polar, k, m->end);
    path->sky_u = sky.u;
    path->sky_phi = -(sum.phi + sky.phi);
    double sine2 = fmax((1 - sky.u) * (1 + sky.u), DBL_EPSILON);
    path->sky_error = DBL_EPSILON * m->end * (sqrt(fmax(k->eta, 0)) + fabs(k->lambda / sine2));
}

/* Computes the path of a vortical ray without real roots, which neither turns nor crosses the plane. */
static void without_roots(const struct kd_null_ray *ray, const struct kd_null_motion *k,
                          const struct kd_null_roots *roots, struct kd_null_path *path)
{
    if (!ray->outward)
        return;
    struct kd_null_polar polar = kd_null_polar_of(k, KD_NULL_TAU_PHI_T);
    struct kd_null_radial_sum sum = kd_null_radial_complex(k, roots, ray->radius);
    struct kd_null_polar_place sky = kd_null_polar_at(&polar, k, sum.tau);
    path->fate = KD_NULL_ESCAPED;
    path->sky_u = sky.u;
    path->sky_phi = -(sum.phi + sky.phi);
}

/* Computes the path of a ray with R = r^4: a radial ray of Schwarzschild, or the principal ray in the equatorial plane,
 * lambda = a. */
static void principal(const struct kd_null_ray *ray, const struct kd_null_motion *k, struct kd_null_path *path)
{
    if (!ray->outward)
        return;
    double plus = k->hole.outer, gap = plus - k->hole.inner;
    path->fate = KD_NULL_ESCAPED;
    path->sky_u = k->c;
    /* lambda dtau and frame dragging together are a dr/Delta here */
    path->sky_phi = -k->hole.a / gap * log1p(gap / (ray->radius - plus));
}

static struct kd_null_path follow(const struct kd_null_ray *ray, enum kd_null_parts parts)
{
    struct kd_null_path path = { .status = KD_NULL_BAD_INPUT, .fate = KD_NULL_CAPTURED, .sky_u = NAN, .sky_phi = NAN };
    if (!valid(ray))
        return path;
    struct kd_null_motion k = kd_null_motion_of(&ray->hole, ray->cos_theta, ray->sin_theta, ray->alpha, ray->beta);
    struct kd_null_roots roots = kd_null_roots_of(&k);
    enum kd_null_region region = kd_null_region_of(&roots, ray->radius);
    path.status = KD_NULL_NO_RAY;
    if (region == KD_NULL_FORBIDDEN)
        return path;
    path.status = KD_NULL_OK;
    if (ray->cos_theta == 0 && k.eta == 0)
        path.status = KD_NULL_IN_PLANE;
    else if (roots.margin < 16 * DBL_EPSILON && roots.mean > ray->hole.outer)
        path.status = KD_NULL_CRITICAL;
    if (roots.kind == KD_NULL_NO_REAL) {
        without_roots(ray, &k, &roots, &path);
        return path;
    }
    if (roots.mean == 0) {
        principal(ray, &k, &path);
        return path;
    }
    struct motion m = { .polar = kd_null_polar_of(&k, parts),
                        .radial = kd_null_radial_of(&k, &roots, region == KD_NULL_INNER, parts) };
    set_out(&m, ray);
    bool escapes = m.forward < 0 || (m.radial.turns && !m.radial.inner);
    path.fate = escapes ? KD_NULL_ESCAPED : KD_NULL_CAPTURED;
    path.turned = m.radial.inner ? ray->outward : m.radial.turns && m.forward > 0;
    cross(&m, ray, &path);
    if (escapes && parts == KD_NULL_TAU_PHI_T)
        escape(&m, &k, &path);
    return path;
}

struct kd_null_path kd_null_trace_radii(const struct kd_null_ray *ray)
{
    struct kd_null_path path = follow(ray, KD_NULL_TAU);
    path.sky_u = path.sky_phi = NAN;
    return path;
}

struct kd_null_path kd_null_trace_fast(const struct kd_null_ray *ray)
{
    struct kd_null_path path = follow(ray, KD_NULL_TAU_PHI_T);
    path.sky_error = 0;
    for (int n = 0; n < path.crossings; n++)
        path.crossing[n].error_r = path.crossing[n].error_phi = path.crossing[n].error_delay = 0;
    return path;
}

struct slope { double r, phi, delay; };

/* Computes the changes of the results when alpha and beta change by the fractions `step` and `other`, in units of
 * `step`. For a crossing that disappears the change is INFINITY. */
static void add_slopes(const struct kd_null_ray *ray, struct kd_null_path *path, double step, double other,
                       struct slope *slopes, double *sky)
{
    struct kd_null_ray near = *ray;
    near.alpha *= 1 + step, near.beta *= 1 + other;
    struct kd_null_path there = follow(&near, KD_NULL_TAU_PHI_T);
    step = fabs(step);
    path->doubtful |= there.crossings != path->crossings;
    for (int n = 0; n < path->crossings; n++) {
        const struct kd_null_crossing *x = &path->crossing[n], *y = &there.crossing[n];
        bool lost = n >= there.crossings;
        slopes[n].r += lost ? INFINITY : fabs(y->r / x->r - 1) / step;
        slopes[n].phi += lost ? INFINITY : fabs(y->phi - x->phi) / step;
        slopes[n].delay += lost ? INFINITY : fabs(y->delay - x->delay) / step;
    }
    bool lost = there.fate != path->fate || there.status != path->status;
    if (path->fate == KD_NULL_ESCAPED)
        *sky += lost ? INFINITY : (fabs(there.sky_u - path->sky_u) + fabs(there.sky_phi - path->sky_phi)) / step;
}

/* Weight of rounding errors of a chain of operations, in units of the machine epsilon. It was calibrated with some 1e5
 * rays that were repeated with 64-bit significands: the worst error was 2.5 times its estimate, and one in ten thousand
 * exceeded it. Near maximal spin three roots lie close together at the horizon, which amplifies rounding by 1/(r+ -
 * r-). The slopes in alpha and beta do not include this factor, so it is added here. */
static double weight_of(const struct kd_null_ray *ray) { return 8 + 2 / (ray->hole.outer - ray->hole.inner); }

/* Estimates errors. Rounding is taken to disturb the labels, the answer itself, and r where phi and t diverge as ln(r -
 * r+). The difference of the two poles at the horizons loses precision by the factor 1/(r+ - r-). */
static void estimate(const struct kd_null_ray *ray, struct kd_null_crossing *x, const struct slope *d)
{
    double plus = ray->hole.outer, gap = plus - ray->hole.inner, eps = DBL_EPSILON;
    double weight = weight_of(ray), poles = (1 + x->r / (x->r - plus)) / gap * (1 + d->r);
    x->error_r = 4 * x->error_r + eps * (4 + weight * d->r);
    x->error_phi = 4 * x->error_phi + eps * (4 + 2 * fabs(x->phi) + weight * d->phi + 4 * fabs(ray->hole.a) * poles);
    x->error_delay =
        4 * x->error_delay + eps * (8 + 8 * x->r + 4 * fabs(x->delay) + weight * d->delay + 8 * plus * poles);
    if (isfinite(ray->radius))
        x->error_delay += 4 * eps * ray->radius;
}

struct kd_null_path kd_null_trace(const struct kd_null_ray *ray)
{
    struct kd_null_path path = follow(ray, KD_NULL_TAU_PHI_T);
    if (path.status == KD_NULL_NO_RAY || path.status == KD_NULL_BAD_INPUT)
        return path;
    struct kd_null_motion k = kd_null_motion_of(&ray->hole, ray->cos_theta, ray->sin_theta, ray->alpha, ray->beta);
    struct kd_null_roots roots = kd_null_roots_of(&k);
    /* The step is short compared with the distance from the critical curve, and long compared with rounding. It leads
     * away from the curve, so that the displaced ray is on the same side of it. */
    double step = fmin(fmax(1e-2 * roots.margin, 1e-13), 1e-11);
    if (roots.kind != KD_NULL_FOUR_REAL)
        step = -step;
    struct slope slopes[KD_NULL_ORDERS] = { { 0 } };
    double sky = 0;
    add_slopes(ray, &path, step, step, slopes, &sky);
    add_slopes(ray, &path, step, -0.5 * step, slopes, &sky);
    for (int n = 0; n < path.crossings; n++)
        estimate(ray, &path.crossing[n], &slopes[n]);
    double gap = ray->hole.outer - ray->hole.inner;
    if (path.fate == KD_NULL_ESCAPED)
        path.sky_error = 4 * path.sky_error + DBL_EPSILON * (4 + 2 * fabs(path.sky_phi) + weight_of(ray) * sky +
                                                             8 * fabs(ray->hole.a) / gap);
    return path;
}

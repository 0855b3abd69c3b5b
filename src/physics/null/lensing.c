#include "physics/null/lensing.h"

#include "physics/math/root.h"
#include "physics/null/null_polar.h"
#include "physics/null/null_radial.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* Limit of |d|, where d is the relative distance of a ray from the critical curve (lensing.h). Below it, the ray's
 * roots are computed from its displacement from the curve. Above it they are computed from the ray's constants of
 * motion, whose `pair` is then accurate to some 1e-14. */
#define NEAR 0.03

/* Distance d at which the crossings of a ray differ from those of the critical ray by less than rounding. */
#define ON_CURVE 1e-40

/* The largest |d| inside the curve, almost at the curve's centre. At the centre itself beta is 0, and a start in the
 * plane could be counted as the first crossing. */
#define CENTRE (1 - 1e-6)

/* The motion of one ray up to its n-th crossing. */
struct ray {
    struct kd_null_radial radial;
    double crossing; /* Mino time of the crossing; NaN if the ray does not cross */
};

static struct ray ray_at(const struct kd_critical *c, const struct kd_critical_point *p, int n, double d)
{
    const struct kd_hole *hole = &c->observer.hole;
    double u = c->observer.cos_theta;
    double dalpha = d * (p->alpha - c->centre), dbeta = d * p->beta;
    struct kd_null_motion m = kd_null_motion_of(hole, u, c->sine, p->alpha + dalpha, p->beta + dbeta);
    struct kd_null_roots roots;
    if (fabs(d) < NEAR) {
        struct kd_null_motion critical = kd_null_motion_of(hole, u, c->sine, p->alpha, p->beta);
        struct kd_null_displacement by =
            kd_null_displacement_of(&critical, p->orbit.r, kd_shell_bend(&p->orbit), dalpha, dbeta);
        roots = kd_null_roots_beside(&m, &by);
    } else {
        roots = kd_null_roots_of(&m);
    }
    struct ray ray = { .crossing = NAN };
    struct kd_null_polar polar = kd_null_polar_of(&m, KD_NULL_TAU);
    if (!polar.crosses || roots.kind == KD_NULL_NO_REAL || roots.mean == 0)
        return ray;
    ray.crossing = kd_null_polar_crossing(&polar, n).tau;
    ray.radial = kd_null_radial_of(&m, &roots, false, KD_NULL_TAU);
    return ray;
}

static double time_to(const struct ray *ray, double source)
{
    if (source == ray->radial.r_plus && !ray->radial.turns)
        return ray->radial.tau_horizon;
    struct kd_null_radius at = kd_null_radius_of(&ray->radial, source);
    return kd_null_radial_integrals(&ray->radial, &at).tau;
}

/* Parameters of the function whose root is sought in the variable s = ln|d|. */
struct search {
    const struct kd_critical *curve;
    const struct kd_critical_point *point;
    int n;
    double source;
    double side; /* +1 outside the critical curve, -1 inside */
    bool out;    /* true if the ray crosses on its way out */
};

static struct ray ray_of(const struct search *q, double s)
{
    return ray_at(q->curve, q->point, q->n, q->side * exp(s));
}

/* Mino time of the crossing minus that of the ray's arrival at the source's radius. The sign is reversed for an arrival
 * on the way in to a turning point. The function rises from negative values at the critical curve to positive ones. */
static double late(const void *user, double s)
{
    const struct search *q = user;
    struct ray ray = ray_of(q, s);
    double there = time_to(&ray, q->source);
    if (q->side > 0 && !q->out)
        return there - ray.crossing;
    return ray.crossing - (q->out ? 2 * ray.radial.turn.tau - there : there);
}

/* A function whose root is the d at which the ray turns at the source's radius. With growing d the turning point moves
 * outwards. */
static double beyond(const void *user, double s)
{
    const struct search *q = user;
    struct ray ray = ray_of(q, s);
    return (ray.radial.turns ? ray.radial.roots.r4 : 0) - q->source;
}

/* Finds a root of f. It steps in ln|d| from the expected position, which is that of an edge of this order, until f
 * changes its sign, and at most up to `end`. */
static double solve(kd_root_fn f, const struct search *q, double expected, double end)
{
    double low = fmin(expected, end) - 1, high = fmin(low + 2, end);
    for (int i = 0; !(f(q, low) < 0); i++, low -= 4)
        if (i > 150) /* gives up at d = e^-600, where f still has not changed its sign */
            return NAN;
    while (high < end && !(f(q, high) > 0))
        high = fmin(high + 2, end);
    return kd_root(f, q, low, high);
}

double kd_lensing_edge(const struct kd_critical *c, const struct kd_critical_point *p, int n, double source)
{
    if (!(n >= 1 && source >= c->observer.hole.outer))
        return NAN;
    struct search q = { .curve = c, .point = p, .n = n, .source = source };
    struct ray on = ray_at(c, p, n, -ON_CURVE);
    double expected = -n * kd_shell_exponents(&p->orbit).gamma, far = 80;
    if (isnan(on.crossing))
        return NAN;
    bool inside = source <= p->orbit.r || on.crossing < time_to(&on, source);
    q.side = inside ? -1 : 1;
    if (inside)
        return -exp(solve(late, &q, expected, log(CENTRE)));
    if (isfinite(source)) {
        /* Limit of d up to which a ray meets the source's radius twice, on its way in and on its way out. With larger d
         * a ray meets this radius earlier on its way in. */
        far = solve(beyond, &q, 0, far);
        struct ray turn = ray_of(&q, far);
        q.out = !(turn.crossing < turn.radial.turn.tau);
        far -= 1e-13 * (1 + fabs(far)); /* moved slightly inwards, so that the ray still reaches the source */
    } else {
        q.out = true;
    }
    return exp(solve(late, &q, expected, far));
}

double kd_lensing_source(const struct kd_critical *c, const struct kd_critical_point *p, int n, double d)
{
    struct ray ray = ray_at(c, p, n, d);
    if (isnan(ray.crossing))
        return NAN;
    double end = ray.radial.turns ? 2 * ray.radial.turn.tau : ray.radial.tau_horizon;
    if (ray.crossing >= end)
        return ray.radial.turns ? INFINITY : 0;
    return kd_null_radius_at(&ray.radial, ray.crossing).r;
}

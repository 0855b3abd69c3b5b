#include "physics/null/null_bend.h"

#include "physics/math/carlson.h"
#include "physics/math/elliptic.h"
#include "physics/null/null_polar.h"
#include "physics/null/null_radial.h"
#include "physics/spacetime/kerr.h"

#include <math.h>

/* The polar motion in x: x' = sqrt(s (1 - kappa sin^2 x)). */
struct swing {
    double z, n, s, kappa;
    double full; /* L */
    double at;   /* x at the observer, from -pi to pi */
};

/* Positive nodes, and their weights, of Gauss-Legendre quadrature with ten points on [-1/2, 1/2] (A. N. Lowan et al.
 * 1942, Bull. AMS 48, 739). */
static const double roots[] = { 0.07443716949081560544, 0.21669769706462038234, 0.33970478414951225622,
                                0.43253168334449225535, 0.48695326425858586444 };
static const double weights[] = { 0.14776211235737643509, 0.13463335965499817754, 0.10954318125799102200,
                                  0.07472567457529029657, 0.03333567215434406880 };

static bool swing_of(const struct kd_null_motion *m, struct swing *o, struct kd_null_bend *out)
{
    double disc, gap, weight;
    kd_null_polar_gap(m, &disc, &gap, &weight);
    o->s = disc;
    o->z = m->c * m->c + gap;
    o->full = sqrt(weight + m->hole.a * m->hole.a * m->s * m->s);
    const double speed = sqrt(weight);
    if (!(weight > 0) || !(o->full > 0))
        return false;
    out->t_theta = -m->beta / speed;
    out->t_phi = m->alpha / o->full;
    if (!(m->eta > 0) || !(o->z > 0))
        return false;
    o->n = m->eta / o->z;
    o->kappa = m->hole.a * m->hole.a * o->z / o->s;
    o->at = copysign(atan2(sqrt(gap), m->c), -m->beta);
    return true;
}

/* Mino time from 0 to x. */
static double time_to(const struct swing *w, double x)
{
    const double s = sin(x), c = cos(x);
    return s * kd_carlson_rf(c * c, (w->n + w->kappa * w->s * c * c) / w->s, 1) / sqrt(w->s);
}

/* The x of the ray at Mino time tau, not reduced to a period. */
static double swung(const struct swing *w, double tau)
{
    const double half = 2 * time_to(w, 0.5 * M_PI), away = fabs(w->at) > 0.5 * M_PI ? copysign(M_PI, w->at) : 0;
    const double total = time_to(w, w->at - away) + tau + copysign(away != 0 ? half : 0, away),
                 swings = nearbyint(total / half), rest = total - swings * half;
    return swings * M_PI + copysign(kd_jacobi_am(sqrt(w->s) * fabs(rest), w->kappa, w->n / w->s), rest);
}

/* 1/(x' (L + x')) as a function of sin^2 x. */
static double drag_rate(const struct swing *w, double s2)
{
    const double speed = sqrt(w->s * (1 - w->kappa * s2));
    return 1 / (speed * (w->full + speed));
}

/* Values of sin^2 at pi/16, 3 pi/16, 5 pi/16 and 7 pi/16, the nodes of the midpoint rule. Over a whole period this rule
 * converges as fast as Gauss's. kappa^8 is below 1e-8 outside the shadow. */
static const double squares[] = { 0.03806023374435662, 0.30865828381745514, 0.69134171618254486, 0.96193976625564338 };

static double dragged(const struct swing *w, double from, double to)
{
    const double periods = nearbyint((to - from) / M_PI), rest = to - from - periods * M_PI;
    double whole = 0, part = 0;
    for (int k = 0; k < 4; k++)
        whole += 0.25 * M_PI * drag_rate(w, squares[k]);
    for (int k = 0; k < 10; k++) {
        const double s = sin(from + rest * (0.5 + (k < 5 ? roots[k] : -roots[k - 5])));
        part += weights[k % 5] * rest * drag_rate(w, s * s);
    }
    return periods * whole + part;
}

static struct kd_null_motion motion_of(const struct kd_null_ray *ray)
{
    return kd_null_motion_of(&ray->hole, ray->cos_theta, ray->sin_theta, ray->alpha, ray->beta);
}

void kd_null_bend_tangent(const struct kd_null_ray *ray, struct kd_null_bend *out)
{
    const struct kd_null_motion m = motion_of(ray);
    struct swing w;
    *out = (struct kd_null_bend) { 0 };
    swing_of(&m, &w, out);
}

bool kd_null_bend_of(const struct kd_null_ray *ray, struct kd_null_bend *out)
{
    const struct kd_null_motion m = motion_of(ray);
    struct swing w;
    *out = (struct kd_null_bend) { 0 };
    if (!swing_of(&m, &w, out))
        return false;
    const struct kd_null_roots roots_ = kd_null_roots_of(&m);
    if (roots_.kind == KD_NULL_NO_REAL || kd_null_region_of(&roots_, ray->radius) != KD_NULL_OUTER)
        return false;
    const struct kd_null_radial q = kd_null_radial_of(&m, &roots_, false, KD_NULL_TAU_PHI);
    if (!q.turns && !ray->outward)
        return false;
    struct kd_null_radial_sum start = { 0 };
    if (isfinite(ray->radius)) {
        const struct kd_null_radius at = kd_null_radius_of(&q, ray->radius);
        start = kd_null_radial_integrals(&q, &at);
    }
    const double tau = ray->outward ? start.tau : 2 * q.turn.tau - start.tau,
                 phi = ray->outward ? start.phi : 2 * q.turn.phi - start.phi;
    const double to = swung(&w, tau);
    out->turn = to - w.at;
    out->drag = -(phi + m.hole.a * m.hole.a * m.lambda / w.full * dragged(&w, w.at, to));
    return true;
}

void kd_null_bend_sky(const struct kd_null_bend *bend, double c, double s, double out[3])
{
    const double k = cos(bend->turn), l = sin(bend->turn), kz = cos(bend->drag), lz = sin(bend->drag);
    const double x = k * s + l * bend->t_theta * c, y = l * bend->t_phi;
    out[0] = kz * x - lz * y;
    out[1] = lz * x + kz * y;
    out[2] = k * c - l * bend->t_theta * s;
}

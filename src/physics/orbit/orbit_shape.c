#include "physics/orbit/timelike.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* Schmidt's E, L and Q of an orbit with the turning points r1, r2 and z = cos^2(theta_min) = 1 - x^2 (2002,
 * gr-qc/0202090, B.16 to B.21), regrouped. With L = x l, the equation R(r) = 0 is
 *
 *   f E^2 - 2 g a x E l - h l^2 - d = 0        Q = z (a^2 b + l^2)
 *   d = (r^2 + a^2 z) Delta    f = r^4 + a^2 (r (r + 2) - q^2 + z Delta)    g = 2r - q^2    h = Delta - a^2 + a^2 z
 *
 * This form is regular for a polar orbit, x = 0, where Schmidt's h is not. His determinants of the two turning points
 * vanish with e. Here they are divided by r2 - r1, by means of divided differences, so that e = 0 needs no special
 * case. The sign of his root becomes that of ax. */
struct column { double f, g, h, d; };

static struct column values(const struct kd_hole *hole, const double mass[2], double z, double r)
{
    double a2 = hole->a * hole->a, part = kd_hole_delta_sum(hole, r), delta = part + a2;
    return (struct column) { r * r * r * r + a2 * (r * (r + mass[0]) + mass[1] + z * delta), mass[0] * r + mass[1],
                             part + a2 * z, (r * r + a2 * z) * delta };
}

/* The divided differences (F(r2) - F(r1)) / (r2 - r1), for F = f, g, h and d. */
static struct column differences(const struct kd_hole *hole, const double mass[2], double z, double r1, double r2)
{
    double a2 = hole->a * hole->a, one = r1 + r2, two = r1 * r1 + r1 * r2 + r2 * r2, three = one * (r1 * r1 + r2 * r2);
    return (struct column) { three + a2 * (one + mass[0] + z * (one - 2)), mass[0], one - 2,
                             three - 2 * two + kd_hole_horizons(hole) * one + a2 * z * (one - 2) };
}

/* The positive root l of the quadratic equation at r, for given E and b = 1 - E^2. To avoid cancellation it uses f - d
 * = g (r^2 + a^2) and b instead of d and E^2. */
static double root_at(const struct column *v, double ax, double r, double a2, double energy, double binding)
{
    double half = v->g * ax * energy, rest = v->g * (r * r + a2) - v->f * binding;
    double discriminant = sqrt(half * half + v->h * rest);
    return half > 0 ? rest / (half + discriminant) : (discriminant - half) / v->h;
}

/* b from W(w) = 0, with Q = z (a^2 b + l^2) and K = Q + (L - aE)^2. */
static double binding_at(const struct kd_orbit *o, double x, double l, double w)
{
    double a2 = o->hole.a * o->hole.a, z = (1 - x) * (1 + x), l2 = x * l * x * l, q0 = z * l * l,
           rest = x * l - o->hole.a * o->energy, c[5];
    kd_hole_radial(&o->hole, 0, -(l2 + q0), q0, q0 + rest * rest, c);
    double fixed = w * (c[1] + w * (c[2] + w * (c[3] + w * c[4])));
    return fixed / (1 + a2 * w * w * (1 + z * kd_hole_delta_sum_w(&o->hole, w)));
}

/* In wide orbits Schmidt's formula for E loses the digits of b, and so does the formula for l. With E^2 = 1 - b,
 * eliminating l^2 from the two equations gives rho b = chi - 2 a x sigma E l, with chi from f - d instead of d. In this
 * equation E and l occur only in a small term. Next to a parabola this equation loses digits as well. Next to a
 * parabola b follows from W = 0 at the outer turning point, which is almost b = 2w. */
static void energy_and_momentum(struct kd_orbit *o, double x, double r1, double r2, double *l)
{
    double a2 = o->hole.a * o->hole.a, z = (1 - x) * (1 + x), ax = o->hole.a * x, mass[2];
    kd_hole_mass_line(&o->hole, mass);
    struct column v = values(&o->hole, mass, z, r2), s = differences(&o->hole, mass, z, r1, r2);
    double kappa = v.d * s.h - v.h * s.d, epsilon = v.d * s.g - v.g * s.d, rho = v.f * s.h - v.h * s.f;
    double eta = v.f * s.g - v.g * s.f, sigma = v.g * s.h - v.h * s.g;
    /* Next to a parabola the last two terms are equal within rounding. E l keeps enough accuracy for its use below. */
    double inner = ax * ax * sigma * epsilon * epsilon + rho * epsilon * kappa - eta * kappa * kappa;
    double root = sqrt(fmax(sigma * inner, 0));
    double e2 = (kappa * rho + 2 * ax * ax * epsilon * sigma - 2 * ax * root) / (rho * rho + 4 * ax * ax * eta * sigma);
    double less = v.g * (r2 * r2 + a2), less_slope = mass[0] * (r1 * r1 + r1 * r2 + r2 * r2 + a2) + mass[1] * (r1 + r2);
    double chi = less * s.h - v.h * less_slope;
    o->energy = sqrt(e2);
    *l = root_at(&v, ax, r2, a2, o->energy, 1 - e2);
    o->binding = (chi - 2 * ax * sigma * o->energy * *l) / rho;
    for (int i = 0; i < 2; i++) {
        o->energy = sqrt(1 - o->binding);
        *l = root_at(&v, ax, r2, a2, o->energy, o->binding);
        if (i == 0)
            o->binding = binding_at(o, x, *l, 1 / r1);
    }
}

/* The constants of the orbit of a shape, without a check that such an orbit exists. */
static struct kd_orbit of_shape(const struct kd_hole *hole, double p, double e, double x)
{
    double a = hole->a, l, z = (1 - x) * (1 + x);
    struct kd_orbit o = { .hole = *hole,
                          .w_low = (1 - e) / p,
                          .w_high = (1 + e) / p,
                          .turns_out = true,
                          .turns_in = true,
                          .circular = e == 0 };
    energy_and_momentum(&o, x, p / (1 - e), p / (1 + e), &l);
    o.momentum = x * l;
    o.carter = z * (a * a * o.binding + l * l);
    kd_orbit_set_constants(&o);
    return o;
}

/* True if W > 0 between the two turning points and W < 0 just beyond each, that is, if r3 < r2. */
static bool stable(const struct kd_orbit *o)
{
    double g[3], w = o->w_high;
    if (!(o->energy > 0 && o->binding > 0 && o->carter >= 0 && w < 1 / o->hole.outer))
        return false;
    kd_orbit_factor(o, g);
    return g[0] + w * (g[1] + w * g[2]) >= 0;
}

double kd_orbit_separatrix(const struct kd_hole *hole, double e, double x)
{
    if (e == 0 && fabs(x) == 1)
        return kd_kerr_isco(kd_hole_turned(hole, x > 0 ? 1 : -1));
    /* The search ends at 12. The largest separatrix is that of a retrograde parabola about an extremal hole, 2 r_mb =
     * 11.66, and charge moves it inwards. */
    double low = hole->outer, high = 12;
    while (high - low > 2e-16 * high) {
        double p = 0.5 * (low + high);
        if (p <= low || p >= high)
            break;
        struct kd_orbit o = of_shape(hole, p, e, x);
        if (stable(&o))
            high = p;
        else
            low = p;
    }
    return high;
}

static bool exists(const struct kd_orbit *o) { return o->energy > 0 && isfinite(o->energy) && isfinite(o->momentum); }

double kd_orbit_least_circle(const struct kd_hole *hole, double x)
{
    double low = hole->outer, high = kd_orbit_separatrix(hole, 0, x);
    while (high - low > 2e-16 * high) {
        const double r = 0.5 * (low + high);
        if (r <= low || r >= high)
            break;
        const struct kd_orbit o = of_shape(hole, r, 0, x);
        *(exists(&o) ? &high : &low) = r;
    }
    return high;
}

enum kd_status kd_orbit_from_shape(const struct kd_hole *hole, double p, double e, double x, struct kd_orbit *o,
                                   struct kd_error *error)
{
    enum kd_status status = kd_hole_check(hole, error);
    if (status)
        return status;
    if (!(e >= 0 && e < 1))
        return kd_error_field(error, "/e", "e is %.16g; it must be at least 0 and less than 1, as of a bound orbit", e);
    if (!(p > hole->outer) || !isfinite(p))
        return kd_error_field(error, "/p", "p is %.16g; it must be above the horizon at %.9g", p, hole->outer);
    *o = of_shape(hole, p, e, x);
    double least = p < 12.5 ? kd_orbit_separatrix(hole, e, x) : 0;
    if (p < least && (e > 0 || !exists(o)))
        return kd_error_field(
            error, "/p", "p is %.16g; with this hole, e and inclination_deg it must be above the separatrix at %.9g", p,
            least);
    o->fate = p < least ? KD_ORBIT_PLUNGE : KD_ORBIT_BOUND;
    return KD_OK;
}

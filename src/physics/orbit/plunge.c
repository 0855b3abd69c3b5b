#include "physics/orbit/plunge.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* Without charge u^r = -sqrt(2/(3 r0)) (r0/r - 1)^(3/2), r0 the ISCO's radius (Mummery & Balbus 2022). With charge the
 * radial potential is a quartic of w = 1/r, with the triple root w0 = 1/r0. With K = (L - aE)^2, its coefficients of
 * w^4 and w^3 are -q^2 K and 2K, which give the fourth root. The coefficient of w is 2, which gives K:
 *
 *   (u^r)^2 = K (w - w0)^3 (2 - 3 q^2 w0 - q^2 w),   K = r0^2/(3 - 4x),   x = q^2/r0
 *           = 2/(3 r0) g^3 (stretch - bend g),       g = r0/r - 1
 *   stretch = (6 - 12x)/(6 - 8x),   bend = 3x/(6 - 8x).
 *
 * With z^2 = r/(r0 - r) - h, h = bend/stretch, follows
 *   d(tau)/dz = -sqrt(6/(r0 stretch)) r^2,
 * and u^t and u^phi (Carter's equations at theta = pi/2, struct kd_hole_rates) in partial fractions
 *   r^2 u^phi = L + a (2Er - drag)/Delta,     r^2 u^t = E r^2 + 2E r + four E + (near r - nearer - 4 a^2 E)/Delta,
 *   1/(r - r_h) = (1 + r0/((r0 - r_h) (z^2 - p^2)))/(r0 - r_h),     p = z(r_h),     r/r0 = 1 - 1/(z^2 + 1 + h). */
static double place_of(const struct kd_plunge *o, double r) { return sqrt(fmax(r / (o->isco - r) - o->shift, 0)); }

static struct kd_plunge_pole pole_of(const struct kd_plunge *o, const struct kd_hole_rates *rates, double r,
                                     double other)
{
    double gap = o->isco - r, a = o->hole.a, e = o->energy;
    return (struct kd_plunge_pole) {
        .pole = place_of(o, r),
        .t = (rates->near * r - rates->nearer - 4 * a * a * e) / (r - other) / gap,
        .phi = a * (2 * e * r - rates->drag) / (r - other) / gap,
    };
}

struct kd_plunge kd_plunge_of(const struct kd_hole *hole)
{
    struct kd_plunge o = { .hole = *hole, .isco = kd_kerr_isco(hole) };
    const double x = hole->q * hole->q / o.isco;
    o.stretch = (6 - 12 * x) / (6 - 8 * x);
    o.bend = 3 * x / (6 - 8 * x);
    o.shift = o.bend / o.stretch;
    o.energy = 1 - kd_kerr_efficiency(hole);
    o.momentum = kd_kerr_momentum(hole, o.isco);
    const struct kd_hole_rates rates = kd_hole_rates_of(hole, o.energy, o.momentum);
    o.outer = pole_of(&o, &rates, hole->outer, hole->inner);
    o.inner = pole_of(&o, &rates, hole->inner, hole->outer);
    /* r^2 u^t d(tau)/dz at the ISCO, with the u^t of the circular orbit there. */
    double rate = sqrt(6 / (o.isco * o.stretch)) * o.isco * o.isco * kd_kerr_ut(hole, o.isco);
    o.t_rate = -rate;
    o.phi_rate = -rate * kd_kerr_omega(hole, o.isco);
    return o;
}

/* artanh(p/z)/p. For p/z -> 0 it is 1/z: without spin and charge the inner pole is at 0. */
static double artanh_over(double p, double z) { return p > 1e-8 * z ? atanh(p / z) / p : 1 / z; }

struct kd_plunge_event kd_plunge_at(const struct kd_plunge *o, double r)
{
    double r0 = o->isco, z = place_of(o, r), scale = sqrt(6 / (r0 * o->stretch)), one = 1 + o->shift, root = sqrt(one);
    double outer = artanh_over(o->outer.pole, z) * r0 / (r0 - o->hole.outer);
    double inner = artanh_over(o->inner.pole, z) * r0 / (r0 - o->hole.inner);
    /* Integrals over z: of r^2/r0^2 - 1, and of r/r0 - 1. */
    double turn = atan(z / root) / root, square = 0.5 * z / (one + z * z) / one - (2 - 0.5 / one) * turn;
    return (struct kd_plunge_event) {
        .t = o->t_rate * z -
             scale * (o->energy * r0 * (r0 * square - 2 * turn) - o->outer.t * outer - o->inner.t * inner),
        .phi = o->phi_rate * z + scale * (o->outer.phi * outer + o->inner.phi * inner),
    };
}

struct kd_plunge_velocity kd_plunge_velocity(const struct kd_plunge *o, double r)
{
    double a = o->hole.a, gap = fmax(0, o->isco / r - 1), j = o->momentum - a * o->energy;
    double delta = kd_hole_delta(&o->hole, r), u = o->energy * r * r - a * j;
    return (struct kd_plunge_velocity) {
        .ur = -sqrt(2 / (3 * o->isco) * gap * (o->stretch - o->bend * gap)) * gap,
        .ut = ((r * r + a * a) * u / delta + a * j) / (r * r),
        .uphi = (a * u / delta + j) / (r * r),
    };
}

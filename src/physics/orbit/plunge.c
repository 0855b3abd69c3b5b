#include "physics/orbit/plunge.h"

#include "physics/spacetime/kerr.h"

#include <math.h>

/* With y^2 = r/(r0 - r), r0 the ISCO's radius, u^r = -sqrt(2/(3 r0)) (r0/r - 1)^(3/2) (Mummery & Balbus 2022) becomes
 *   d(tau)/dy = -sqrt(6/r0) r^2,
 * and u^t and u^phi (Carter's equations at theta = pi/2) in partial fractions
 *   r^2 u^phi = L + a (2Er - aL)/Delta,     r^2 u^t = E r^2 + 2E r + 4E + (2 (4E - aL) r - 4 a^2 E)/Delta,
 *   1/(r - r_h) = (1 + r0/((r0 - r_h) (y^2 - p^2)))/(r0 - r_h),     p^2 = r_h/(r0 - r_h). */
static struct kd_plunge_pole pole_of(const struct kd_plunge *o, double r, double other)
{
    double gap = o->isco - r, e = o->energy, al = o->hole.a * o->momentum;
    struct kd_plunge_pole p = { .pole = sqrt(r / gap) };
    p.phi = o->hole.a * (2 * e * r - al) / (r - other) / gap;
    p.t = (2 * (4 * e - al) * r - 4 * o->hole.a * o->hole.a * e) / (r - other) / gap;
    return p;
}

struct kd_plunge kd_plunge_of(const struct kd_hole *hole)
{
    struct kd_plunge o = { .hole = *hole, .isco = kd_kerr_isco(hole) };
    o.energy = 1 - kd_kerr_efficiency(hole);
    o.momentum = kd_kerr_momentum(hole, o.isco);
    o.outer = pole_of(&o, hole->outer, hole->inner);
    o.inner = pole_of(&o, hole->inner, hole->outer);
    /* r^2 u^t d(tau)/dy at the ISCO, where it is that of the circular orbit. */
    double rate = sqrt(6 / o.isco) * o.isco * o.isco * kd_kerr_ut(hole, o.isco);
    o.t_rate = -rate;
    o.phi_rate = -rate * kd_kerr_omega(hole, o.isco);
    return o;
}

/* artanh(p/y)/p down to p/y = 0: without spin the inner pole is at 0. */
static double artanh_over(double p, double y) { return p > 1e-8 * y ? atanh(p / y) / p : 1 / y; }

struct kd_plunge_event kd_plunge_at(const struct kd_plunge *o, double r)
{
    double r0 = o->isco, y = sqrt(r / (r0 - r)), scale = sqrt(6 / r0);
    double outer = artanh_over(o->outer.pole, y) * r0 / (r0 - o->hole.outer);
    double inner = artanh_over(o->inner.pole, y) * r0 / (r0 - o->hole.inner);
    /* Integrals of r^2/r0^2 and r/r0 over y, less y. */
    double square = 0.5 * y / (1 + y * y) - 1.5 * atan(y), line = -atan(y);
    return (struct kd_plunge_event) {
        .t = o->t_rate * y -
             scale * (o->energy * r0 * (r0 * square + 2 * line) - o->outer.t * outer - o->inner.t * inner),
        .phi = o->phi_rate * y + scale * (o->outer.phi * outer + o->inner.phi * inner),
    };
}

struct kd_plunge_velocity kd_plunge_velocity(const struct kd_plunge *o, double r)
{
    double a = o->hole.a, gap = fmax(0, o->isco / r - 1), j = o->momentum - a * o->energy;
    double delta = kd_hole_delta(&o->hole, r), u = o->energy * r * r - a * j;
    return (struct kd_plunge_velocity) {
        .ur = -sqrt(2 / (3 * o->isco) * gap) * gap,
        .ut = ((r * r + a * a) * u / delta + a * j) / (r * r),
        .uphi = (a * u / delta + j) / (r * r),
    };
}

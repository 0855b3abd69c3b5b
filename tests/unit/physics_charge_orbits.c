/* Tests of neutral matter and observers about charged holes: circular orbits, the flux of thin disks, photon orbits,
 * the critical curve and frames. They are compared with numbers from the metric alone
 * (tests/oracle/charge_reference.py). */
#include "physics/disk/thin_disk.h"
#include "physics/null/critical.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/infall.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"

#include "charge_reference.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void near(double got, double want, double allowed, const char *what, double a, double q, double at)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("a = %.17g, q = %.17g, at %.17g: %s %.17g, not %.17g: off by %.2g, allowed %.2g", a, q, at, what, got,
                 want, got - want, allowed);
}

/* Near r = 1 the difference r - 1 must be accurate too, and not only r. */
static void places(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++) {
        const struct charge_place_reference *e = &charge_place_reference[i];
        const struct kd_hole hole = kd_hole_charged(e->a, e->q);
        near(kd_kerr_photon_orbit(&hole), e->photon, 8e-16 * e->photon, "photon orbit", e->a, e->q, 0);
        near(kd_kerr_isco(&hole), e->isco, 1e-14 * e->isco, "ISCO", e->a, e->q, 0);
        near(kd_disk_peak_page_thorne(&hole), e->peak, 1e-11 * e->peak, "peak of the flux", e->a, e->q, 0);
    }
}

/* Radii of orbits, and the edge of the shadow in the plane, for 135 holes over the whole half disk up to a^2 + q^2 = 1
 * - 1e-12. */
static void whole_disk(void **state)
{
    (void)state;
    double worst[4] = { 0 };
    for (size_t i = 0; i < COUNT(charge_radius_reference); i++) {
        const struct charge_radius_reference *e = &charge_radius_reference[i];
        const struct kd_critical_observer o = { .hole = kd_hole_charged(e->a, e->q), .radius = INFINITY };
        const struct kd_critical c = kd_critical_of(&o);
        const double off[] = { kd_kerr_photon_orbit(&o.hole) / e->photon - 1, kd_kerr_isco(&o.hole) / e->isco - 1,
                               kd_kerr_critical_impact(&o.hole) / e->impact - 1,
                               kd_critical_at(&c, M_PI).alpha / -e->impact - 1 };
        for (int k = 0; k < 4; k++)
            worst[k] = fmax(worst[k], isnan(off[k]) ? INFINITY : fabs(off[k]));
    }
    print_message("photon orbit %.1e, ISCO %.1e, impact parameter %.1e, edge of the shadow %.1e\n", worst[0], worst[1],
                  worst[2], worst[3]);
    assert_true(worst[0] < 1e-15 && worst[1] < 2e-15 && worst[2] < 2e-15 && worst[3] < 3e-15);
}

/* The allowed error of a number is its change from one double r to the next, because r itself is rounded to a double.
 * */
static void orbits(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_orbit_reference); i++) {
        const struct charge_orbit_reference *e = &charge_orbit_reference[i];
        const struct kd_hole hole = kd_hole_charged(e->a, e->q);
        const double y = e->r - 1, loss = 4e-15 * (1 + 0.1 / y);
        near(kd_kerr_omega(&hole, e->r), e->omega, 2e-15 * e->omega, "Omega", e->a, e->q, e->r);
        near(kd_kerr_energy(&hole, e->r), e->energy, loss * e->energy, "E", e->a, e->q, e->r);
        near(kd_kerr_momentum(&hole, e->r), e->momentum, loss * e->momentum, "L", e->a, e->q, e->r);
        near(kd_kerr_ut(&hole, e->r), e->ut, loss * e->ut, "u^t", e->a, e->q, e->r);
        near(kd_disk_flux_page_thorne(&hole, e->r), e->flux, 1e-11 * e->flux, "flux", e->a, e->q, e->r);
        const double lambda = 0.3;
        near(kd_disk_redshift(&hole, e->r, lambda), 1 / (e->ut * (1 - e->omega * lambda)), loss, "g", e->a, e->q, e->r);
    }
}

/* A small charge changes all numbers by little, because no terms cancel. A charge whose square underflows changes no
 * bit. */
static void small_charges(void **state)
{
    (void)state;
    static const double spins[] = { -(1 - 1e-9), -0.9, -1e-6, 0, 1e-6, 0.3, 0.9, 0.998, 1 - 1e-9 };
    for (size_t i = 0; i < COUNT(spins); i++) {
        const struct kd_hole none = kd_hole_of(spins[i]), least = kd_hole_charged(spins[i], 1e-300),
                             small = kd_hole_charged(spins[i], 1e-9);
        const double isco = kd_kerr_isco(&none), loss = 1e-12 / (1 - fmax(spins[i], 0)) + 1e-12;
        assert_true(kd_kerr_isco(&least) == isco && kd_kerr_photon_orbit(&least) == kd_kerr_photon_orbit(&none));
        near(kd_kerr_isco(&small), isco, fmin(loss, 1e-6), "ISCO", spins[i], 1e-9, 0);
        near(kd_kerr_photon_orbit(&small), kd_kerr_photon_orbit(&none), fmin(loss, 1e-6), "photon orbit", spins[i],
             1e-9, 0);
        for (double r = 1.5 * isco; r < 1e4; r *= 3) {
            assert_true(kd_disk_flux_page_thorne(&least, r) == kd_disk_flux_page_thorne(&none, r));
            const double flux = kd_disk_flux_page_thorne(&none, r);
            near(kd_disk_flux_page_thorne(&small, r), flux, 1e-8 * flux, "flux", spins[i], 1e-9, r);
            near(kd_kerr_energy(&small, r), kd_kerr_energy(&none, r), 1e-12, "E", spins[i], 1e-9, r);
        }
    }
}

/* At the ISCO, plunging gas has the redshift of the circular orbit. Inside the ISCO its velocity satisfies u.u = -1. */
static void plunge(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++) {
        const struct charge_place_reference *e = &charge_place_reference[i];
        const struct kd_hole hole = kd_hole_charged(e->a, e->q);
        if (hole.root < 0.1)
            continue;
        const double r0 = kd_kerr_isco(&hole);
        near(kd_disk_redshift_plunging(&hole, r0, 0.5, 9, true), kd_disk_redshift(&hole, r0, 0.5), 1e-7,
             "g at the ISCO", e->a, e->q, r0);
        /* For the principal photon (lambda = a, eta = 0), g depends only on W = E (1 + a^2 w^2) - a L w^2 and w' =
         * -u^r. */
        for (int k = 1; k < 8; k++) {
            const double r = hole.outer + (r0 - hole.outer) * k / 8, w = 1 / r;
            const double en = kd_kerr_energy(&hole, r0), j = kd_kerr_momentum(&hole, r0) - e->a * en;
            const double all = en - e->a * j * w * w, d = kd_hole_delta_w(&hole, w),
                         ur = sqrt(all * all - d * (1 + j * j * w * w));
            near(1 / kd_disk_redshift_plunging(&hole, r, e->a, 0, true), (all + ur) / d, 1e-7 * (all + ur) / d, "1/g",
                 e->a, e->q, r);
        }
    }
}

static double product(const struct kd_vantage *at, const struct kd_covector *p, const struct kd_covector *k)
{
    const double a = at->hole.a, q = at->hole.q, r = at->r, w = r * r + a * a, sigma = r * r + a * a * at->u * at->u,
                 delta = w - 2 * r + q * q;
    const double pt = w * p->energy - a * p->momentum * at->s, kt = w * k->energy - a * k->momentum * at->s,
                 pf = p->momentum - a * p->energy * at->s, kf = k->momentum - a * k->energy * at->s;
    return (-(pt * kt - p->radial * k->radial) / delta + p->polar * k->polar + pf * kf) / sigma;
}

/* Frames are orthonormal by Carter's inverse metric, and each motion has the property that defines it. */
static void frames(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++)
        for (int o = 0; o < KD_OBSERVER_COUNT; o++)
            for (int k = 0; k < 40; k++) {
                const struct charge_place_reference *e = &charge_place_reference[i];
                const double u = 0.8 * (k % 5) / 4;
                const struct kd_vantage at = { kd_hole_charged(e->a, e->q), 0.55 + 0.25 * k, u, sqrt(1 - u * u) };
                struct kd_observer_motion motion = kd_observer_motion_of((enum kd_observer)o);
                motion.velocity[0] = 0.3, motion.velocity[2] = -0.5;
                double bound;
                if (!kd_observer_exists(motion.observer, &at) || kd_observer_check(&motion, &at, &bound) ||
                    fabs(kd_hole_delta(&at.hole, at.r)) < 1e-3)
                    continue;
                const struct kd_tetrad f = kd_observer_tetrad(&motion, &at);
                const struct kd_covector *legs[] = { &f.t, &f.r, &f.theta, &f.phi };
                const double loss = 1e-13 / fabs(kd_hole_delta(&at.hole, at.r)) + 1e-13;
                for (int m = 0; m < 4; m++)
                    for (int n = 0; n < 4; n++)
                        near(product(&at, legs[m], legs[n]), m == n ? m ? 1 : -1 : 0, loss * 1e2, "product of legs",
                             e->a, e->q, at.r);
                if (o == KD_OBSERVER_INFALL)
                    near(f.t.energy + f.t.momentum, 1, 1e-15 + 1e-15 / at.r, "E and L of rain", e->a, e->q, at.r);
                if (kd_observer_sense(motion.observer) > 0 && u == 0) {
                    near(f.t.energy, kd_kerr_energy(&at.hole, at.r), loss * f.t.energy * 1e2, "E", e->a, e->q, at.r);
                    near(f.t.momentum, kd_kerr_momentum(&at.hole, at.r), loss * fabs(f.t.momentum) * 1e2, "L", e->a,
                         e->q, at.r);
                }
            }
}

/* A static observer has u^phi = 0, by the inverse metric. */
static void at_rest(void **state)
{
    (void)state;
    const struct kd_vantage at = { kd_hole_charged(0.6, 0.5), 4, 0.3, sqrt(1 - 0.09) };
    const struct kd_observer_motion motion = kd_observer_motion_of(KD_OBSERVER_STATIC);
    const struct kd_tetrad f = kd_observer_tetrad(&motion, &at);
    const struct kd_covector turning = { 0, 1 / at.s, 0, 0 }; /* dphi */
    near(product(&at, &f.t, &turning), 0, 1e-15, "u^phi", 0.6, 0.5, 4);
    assert_true(kd_kerr_ergosphere(&at.hole, 0) > at.hole.outer);
    near(kd_kerr_ergosphere(&at.hole, 1), at.hole.outer, 1e-15, "ergosphere on the axis", 0.6, 0.5, 0);
    near(kd_kerr_ergosphere(&at.hole, 0), 1 + sqrt(0.75), 1e-15, "ergosphere", 0.6, 0.5, 0);
}

/* Fall from rest at infinity ("rain") into a hole without spin: r' = -sqrt(2r - q^2)/r, whose integral is elementary.
 * */
static void rain(void **state)
{
    (void)state;
    const double q = 0.8;
    const struct kd_vantage at = { kd_hole_charged(0, q), 30, 0, 1 };
    const struct kd_observer_motion motion = kd_observer_motion_of(KD_OBSERVER_INFALL);
    for (double r = at.hole.inner + 0.1; r < 30; r += 1.7) {
        const double x = sqrt(2 * r - q * q), x0 = sqrt(60 - q * q);
        /* with x^2 = 2r - q^2, r dr/x = (x^2 + q^2)/2 dx */
        const double exact = (x0 * x0 * x0 - x * x * x) / 6 + 0.5 * q * q * (x0 - x);
        near(kd_infall_proper_time(&motion, &at, r), exact, 1e-13 * exact, "proper time", 0, q, r);
    }
}

/* For a charged hole, a ray just inside the critical curve falls in, and a ray just outside it escapes. */
static void curve(void **state)
{
    (void)state;
    static const double radii[] = { INFINITY, 1000, 6 }, cosines[] = { 0, 0.5, 0.95 };
    int seen = 0;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++)
        for (size_t j = 0; j < COUNT(radii) * COUNT(cosines); j++) {
            const struct charge_place_reference *e = &charge_place_reference[i];
            const struct kd_critical_observer o = { .hole = kd_hole_charged(e->a, e->q),
                                                    .radius = radii[j % COUNT(radii)],
                                                    .cos_theta = cosines[j / COUNT(radii)],
                                                    .motion = kd_observer_motion_of(KD_OBSERVER_ZAMO) };
            const struct kd_critical c = kd_critical_of(&o);
            assert_int_equal(c.status, KD_CRITICAL_OK);
            for (int k = 0; k < 24; k++) {
                const struct kd_critical_point p = kd_critical_at(&c, (k + 0.5) * M_PI / 12);
                const double middle = 2 * e->a * sqrt(1 - o.cos_theta * o.cos_theta);
                for (int side = -1; side <= 1; side += 2) {
                    const double by = 1 + 1e-10 * side;
                    const struct kd_null_ray ray = { .hole = o.hole,
                                                     .radius = o.radius,
                                                     .cos_theta = o.cos_theta,
                                                     .alpha = middle + (p.alpha - middle) * by,
                                                     .beta = p.beta * by };
                    const struct kd_null_path path = kd_null_trace(&ray);
                    /* skipped, because both horizons and the orbit coincide within rounding */
                    if (path.status != KD_NULL_OK)
                        continue;
                    if ((path.fate == KD_NULL_ESCAPED) != (side > 0))
                        fail_msg("a = %.17g, q = %.17g, r = %g, u = %g, point %d: %s", e->a, e->q, o.radius,
                                 o.cos_theta, k, side > 0 ? "outside" : "inside");
                    seen++;
                }
                if (!isinf(o.radius)) { /* direction in which light with these labels is seen */
                    const struct kd_vantage at = { o.hole, o.radius, o.cos_theta, c.sine };
                    struct kd_covector photon = { 1, -p.alpha, p.beta, 0 };
                    const double r = o.radius, l = -p.alpha * at.s, a = e->a, q2 = e->q * e->q,
                                 all = r * r + a * a - a * l,
                                 k2 = p.beta * p.beta + (p.alpha + a * at.s) * (p.alpha + a * at.s);
                    photon.radial = copysign(sqrt(fmax(0, all * all - (r * r - 2 * r + a * a + q2) * k2)), 1);
                    const struct kd_look seen_at = kd_tetrad_look(&c.tetrad, &photon);
                    near(fabs(seen_at.inwards), fabs(p.inwards), 1e-7, "direction", e->a, e->q, r);
                    near(seen_at.right, p.right, 1e-9, "direction to the right", e->a, e->q, r);
                }
            }
        }
    assert_true(seen > 5000);
}

/* Without spin the curve is a circle of radius r^2/sqrt(r^2 - 2r + q^2), with r = (3 + sqrt(9 - 8 q^2))/2 (Eiroa et al.
 * 2002). */
static void circles(void **state)
{
    (void)state;
    static const struct { double q, b; } known[] = { { 0.5, 4.96791433 }, { 0.6, 4.85869419 }, { 1 - 1e-12, 4 } };
    for (size_t i = 0; i < COUNT(known); i++)
        for (int k = 0; k < 16; k++) {
            const struct kd_critical_observer o = { .hole = kd_hole_charged(0, known[i].q),
                                                    .radius = INFINITY,
                                                    .cos_theta = 0.1 * (k % 10) };
            const struct kd_critical c = kd_critical_of(&o);
            const struct kd_critical_point p = kd_critical_at(&c, 0.4 * k);
            const double q = known[i].q, r = (3 + sqrt(9 - 8 * q * q)) / 2;
            near(p.rho, known[i].b, 1e-8, "b", 0, q, p.angle);
            near(p.rho, r * r / sqrt(r * r - 2 * r + q * q), 4e-15 * p.rho, "b", 0, q, p.angle);
            near(kd_shell_exponents(&p.orbit).gamma, M_PI * sqrt(6 * (r * r - 2 * r + q * q) / (r * r) - 1), 1e-12,
                 "gamma", 0, q, p.angle);
        }
}

/* Seen from infinity in the plane, the shadow ends on one side at the impact parameter of the photon orbit that turns
 * with the hole. On the other side it ends at the impact parameter for the hole with the opposite spin. */
static void edges_of_the_shadow(void **state)
{
    (void)state;
    int both = 0;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++) {
        const struct charge_place_reference *e = &charge_place_reference[i];
        const struct kd_critical_observer o = { .hole = kd_hole_charged(e->a, e->q), .radius = INFINITY };
        const struct kd_critical c = kd_critical_of(&o);
        near(kd_kerr_critical_impact(&o.hole), e->impact, 2e-15 * e->impact, "impact parameter", e->a, e->q, 0);
        near(kd_critical_at(&c, M_PI).alpha, -e->impact, 1e-14 * e->impact, "left edge", e->a, e->q, 0);
        for (size_t j = 0; j < COUNT(charge_place_reference); j++) {
            const struct charge_place_reference *turned = &charge_place_reference[j];
            if (turned->a != -e->a || turned->q != e->q)
                continue;
            near(kd_critical_at(&c, 0).alpha, turned->impact, 1e-14 * turned->impact, "right edge", e->a, e->q, 0);
            both++;
        }
    }
    assert_true(both >= 7);
}

/* Labels of the photon shell by the usual formula, in extended precision. */
static void shell(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_place_reference); i++) {
        const struct charge_place_reference *e = &charge_place_reference[i];
        const struct kd_hole hole = kd_hole_charged(e->a, e->q);
        if (e->a == 0)
            continue;
        const struct kd_shell s = kd_shell_of(&hole);
        for (int k = 0; k <= 40; k++) {
            const struct kd_shell_orbit o = kd_shell_orbit_at(&s, s.prograde + (s.retrograde - s.prograde) * k / 40);
            const long double a = e->a, q = e->q, y = o.y, n = 1 - a * a - q * q, r = 1 + y, delta = y * y - n,
                              l = a + r / a * (r - 2 * delta / y),
                              big = 4 * r * r * delta / (y * y) - (l - a) * (l - a);
            const double size = (double)(fabsl(r * r / a / y) + fabsl(4 * r * r / (y * y))), loss = 1e-18 / fabs(e->a);
            near(o.lambda, (double)l, (1e-14 + loss) * size + 1e-14 * fabs((double)l), "lambda", e->a, e->q, o.r);
            near(o.eta, (double)big, (4e-14 + loss / fabs(e->a)) * size * (1 + fabs((double)l)), "eta", e->a, e->q,
                 o.r);
        }
        near(kd_shell_orbit_at(&s, s.prograde).eta, 0, 1e-12 / fabs(e->a), "eta of the prograde orbit", e->a, e->q, 0);
        near(kd_shell_orbit_at(&s, s.retrograde).eta, 0, 1e-12, "eta of the retrograde orbit", e->a, e->q, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places),
        cmocka_unit_test(whole_disk),
        cmocka_unit_test(orbits),
        cmocka_unit_test(small_charges),
        cmocka_unit_test(plunge),
        cmocka_unit_test(frames),
        cmocka_unit_test(at_rest),
        cmocka_unit_test(rain),
        cmocka_unit_test(curve),
        cmocka_unit_test(circles),
        cmocka_unit_test(edges_of_the_shadow),
        cmocka_unit_test(shell),
    };
    return cmocka_run_group_tests_name("matter and observers about charged holes", tests, NULL, NULL);
}

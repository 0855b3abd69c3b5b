/* Tests of the critical curve, spherical photon orbits and local frames. They are compared with searches in 60 digits
 * for the ray at the limit between rays that turn and rays that fall in (tests/oracle/critical_reference.py), with
 * published values, and with closed-form rays on both sides of the curve. */
#include "physics/null/critical.h"

#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include "critical_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static const double root27 = 5.196152422706632;

static struct kd_critical curve_of(double spin, double cos_theta, double radius, enum kd_observer frame)
{
    struct kd_critical_observer o = {
        .hole = kd_hole_of(spin), .radius = radius, .cos_theta = cos_theta, .motion = kd_observer_motion_of(frame)
    };
    struct kd_critical c = kd_critical_of(&o);
    if (c.status != KD_CRITICAL_OK)
        fail_msg("a = %.17g, u = %g, r = %g: status %d", spin, cos_theta, radius, c.status);
    return c;
}

static void near(double got, double want, double allowed, const char *what, double spin, double where)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("a = %.17g, at %g: %s %.17g, not %.17g: off by %.2g, allowed %.2g", spin, where, what, got, want,
                 got - want, allowed);
}

static double relative(double bound, double value) { return bound * fabs(value); }

static void against_the_oracle(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(critical_reference); i++) {
        const struct critical_reference *e = &critical_reference[i];
        struct kd_critical c = curve_of(e->spin, e->cos_theta, INFINITY, KD_OBSERVER_STATIC);
        struct kd_critical_point p = kd_critical_at(&c, e->angle * M_PI / 180);
        struct kd_shell_exponents x = kd_shell_exponents(&p.orbit);
        near(c.left, e->left, 4e-15, "left end", e->spin, e->angle);
        near(c.right, e->right, 4e-15, "right end", e->spin, e->angle);
        near(p.rho, e->rho, 4e-15, "rho", e->spin, e->angle);
        near(p.orbit.r, e->r, 4e-15, "r", e->spin, e->angle);
        near(x.mino, e->mino, relative(1e-14, e->mino), "Mino time", e->spin, e->angle);
        near(x.gamma, e->gamma, 1e-14, "gamma", e->spin, e->angle);
        near(x.delta, e->delta, relative(1e-14, e->delta), "delta", e->spin, e->angle);
        near(x.tau, e->tau, relative(1e-14, e->tau), "tau", e->spin, e->angle);
        near(hypot(p.alpha - c.centre, p.beta), p.rho, 4e-15, "distance", e->spin, e->angle);
        near(-p.orbit.lambda, p.alpha * c.sine, 1e-14, "lambda", e->spin, e->angle);
    }
}

static const double spins[] = { 0, 1e-12, 1e-6, 0.1, 0.5, 0.9, 0.998, 0.999999, 1 - 1e-12 };
static const double cosines[] = { 1, 1 - 1e-15, 0.9563, 0.5, 0.1736, 1e-8, 0, -0.5, -1 };

/* Known values. At a = 0: a circle of radius sqrt(27) about the middle, gamma = pi, half an orbit in a time of 3
 * sqrt(3) pi. Seen from the pole: a circle, which at a = 1 has the radius 2 + 2 sqrt(2) and shows the orbits at 1 +
 * sqrt(2) (Gralla & Lupsasca 2020, arXiv:1910.12873). Seen from the equator: the curve extends from -2 to 7 at a = 1,
 * and is 2 sqrt(27) high at any spin. */
static void published_shapes(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(cosines); i++)
        for (int k = -8; k <= 8; k++) {
            struct kd_critical c = curve_of(0, cosines[i], INFINITY, KD_OBSERVER_STATIC);
            struct kd_critical_point p = kd_critical_at(&c, k * M_PI / 8);
            struct kd_shell_exponents x = kd_shell_exponents(&p.orbit);
            near(p.rho, root27, 2e-15, "rho", 0, k);
            near(x.gamma, M_PI, 2e-15, "gamma", 0, k);
            near(fabs(x.delta), M_PI, 2e-15, "delta", 0, k);
            near(x.tau, root27 * M_PI, 1e-14, "tau", 0, k);
        }
    double e = 1e-12; /* e is 1 - a. Seen from the pole, all results depend smoothly on e */
    struct kd_critical pole = curve_of(1 - e, 1, INFINITY, KD_OBSERVER_STATIC);
    struct kd_critical_point p = kd_critical_at(&pole, 1);
    near(p.rho, 2 + 2 * sqrt(2), 2 * e, "rho over the pole", 1, 1);
    near(p.orbit.r, 1 + sqrt(2), 2 * e, "r over the pole", 1, 1);
    struct kd_critical side = curve_of(1 - e, 0, INFINITY, KD_OBSERVER_STATIC);
    near(side.left, -2, 4 * sqrt(e), "left", 1, 0);
    near(side.right, 7, 2 * e, "right", 1, 0);
    for (size_t i = 0; i < COUNT(spins); i++) {
        struct kd_critical c = curve_of(spins[i], 0, INFINITY, KD_OBSERVER_STATIC);
        near(kd_critical_measure(&c).height, 2 * root27, 2e-14, "height", spins[i], 0);
    }
}

/* In the plane an orbit is a circle of angular velocity +-1/(r^(3/2) +- a) (Bardeen, Press & Teukolsky 1972,
 * eq. 2.16). */
static void equatorial_orbits_keep_time(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(spins); i++) {
        double a = spins[i];
        struct kd_shell s = kd_shell_of(kd_hole(a));
        struct kd_shell_orbit pro = kd_shell_orbit_at(&s, s.prograde), retro = kd_shell_orbit_at(&s, s.retrograde);
        struct kd_shell_exponents p = kd_shell_exponents(&pro), q = kd_shell_exponents(&retro);
        near(pro.r, kd_kerr_photon_orbit(kd_hole(a)), 2e-15, "prograde orbit", a, 0);
        near(retro.r, kd_kerr_photon_orbit(kd_hole(-a)), 4e-15, "retrograde orbit", a, 0);
        near(p.delta / p.tau, kd_kerr_omega(kd_hole(a), pro.r), 1e-15, "prograde velocity", a, 0);
        near(q.delta / q.tau, -kd_kerr_omega(kd_hole(-a), retro.r), 1e-15, "retrograde velocity", a, 0);
        near(pro.lambda, 1 / kd_kerr_omega(kd_hole(a), pro.r), 1e-14, "prograde lambda", a, 0);
        near(retro.lambda, -1 / kd_kerr_omega(kd_hole(-a), retro.r), 1e-14, "retrograde lambda", a, 0);
        near(pro.eta, 0, 1e-13, "prograde eta", a, 0);
    }
}

/* Orbits given by their radius or by their place on the curve satisfy R = R' = 0, the textbook conditions of a double
 * root. */
static void orbits_are_double_roots(void **state)
{
    (void)state;
    for (size_t i = 3; i < COUNT(spins) - 1; i++)
        for (int k = 0; k <= 10; k++) {
            double a = spins[i], place;
            struct kd_shell s = kd_shell_of(kd_hole(a));
            place = s.prograde + (s.retrograde - s.prograde) * k / 10;
            struct kd_shell_orbit o = kd_shell_orbit_at(&s, place), same = kd_shell_orbit_of_radius(kd_hole(a), o.r);
            double delta = o.r * o.r - 2 * o.r + a * a, w = o.r * o.r + a * a - a * o.lambda;
            double kappa = o.eta + (o.lambda - a) * (o.lambda - a);
            near(w * w, delta * kappa, 1e-11, "R", a, o.r);
            near(2 * o.r * w, (o.r - 1) * kappa, 1e-11, "R'", a, o.r);
            if (k > 0 && k < 10) {
                near(same.lambda, o.lambda, 1e-9, "lambda of r", a, o.r);
                near(same.eta, o.eta, 1e-8, "eta of r", a, o.r);
            }
        }
    assert_true(isnan(kd_shell_orbit_of_radius(kd_hole(0), 3).lambda));
    assert_true(isnan(kd_shell_orbit_of_radius(kd_hole(0.5), 4.1).lambda));
}

/* The curve is mirrored when the spin or the side of the equator changes sign, and does not jump at a = 0, at the
 * axis or at the equator. */
static void symmetric_and_continuous(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(spins); i++)
        for (size_t j = 0; j < COUNT(cosines); j++)
            for (int k = 0; k <= 12; k++) {
                double a = spins[i], u = cosines[j], angle = k * M_PI / 12;
                struct kd_critical c = curve_of(a, u, INFINITY, KD_OBSERVER_STATIC);
                struct kd_critical m = curve_of(-a, u, INFINITY, KD_OBSERVER_STATIC);
                struct kd_critical_point p = kd_critical_at(&c, angle), down = kd_critical_at(&c, -angle);
                struct kd_critical_point other = kd_critical_at(&m, M_PI - angle);
                near(down.rho, p.rho, 0, "rho below", a, angle);
                near(down.beta, -p.beta, 0, "beta below", a, angle);
                near(other.rho, p.rho, 1e-14, "rho in the mirror", a, angle);
                near(other.alpha, -p.alpha, 1e-14, "alpha in the mirror", a, angle);
                near(other.orbit.lambda, -p.orbit.lambda, 1e-12, "lambda in the mirror", a, angle);
                assert_true(p.rho > 4 && p.rho < 6 && isfinite(p.beta) && p.orbit.r > kd_hole(a)->outer);
            }
    for (int k = 0; k <= 12; k++) {
        double angle = k * M_PI / 12;
        struct kd_critical still = curve_of(0, 0.5, INFINITY, KD_OBSERVER_STATIC);
        struct kd_critical slow = curve_of(1e-13, 0.5, INFINITY, KD_OBSERVER_STATIC);
        near(kd_critical_at(&slow, angle).rho, kd_critical_at(&still, angle).rho, 1e-12, "rho", 1e-13, angle);
        struct kd_critical axis = curve_of(0.9, 1, INFINITY, KD_OBSERVER_STATIC);
        struct kd_critical near_axis = curve_of(0.9, 1 - 1e-15, INFINITY, KD_OBSERVER_STATIC);
        near(kd_critical_at(&near_axis, angle).rho, kd_critical_at(&axis, angle).rho, 1e-6, "rho", 0.9, angle);
    }
}

/* A ray traced in closed form that is 1e-9 outside the curve escapes; one that is 1e-9 inside falls in. */
static void the_edge_of_the_shadow(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(spins); i++)
        for (size_t j = 0; j < COUNT(cosines); j++)
            for (int k = 0; k < 10; k++) {
                double angle = 0.3 + k * 0.6, off = 1e-9;
                struct kd_critical c = curve_of(spins[i], cosines[j], INFINITY, KD_OBSERVER_STATIC);
                struct kd_critical_point p = kd_critical_at(&c, angle);
                struct kd_null_ray ray = { .hole = kd_hole_of(spins[i]), .radius = INFINITY, .cos_theta = cosines[j] };
                for (int side = -1; side <= 1; side += 2) {
                    ray.alpha = p.alpha + side * off * (p.alpha - c.centre);
                    ray.beta = p.beta * (1 + side * off);
                    enum kd_null_fate want = side > 0 ? KD_NULL_ESCAPED : KD_NULL_CAPTURED;
                    if (kd_null_trace_fast(&ray).fate != want)
                        fail_msg("a = %.17g, u = %g, angle %g, side %d", spins[i], cosines[j], angle, side);
                }
            }
}

/* Synge 1966: for an observer at rest at r the hole's disk has the angular radius sin(angle) = sqrt(27 (1 - 2/r))/r,
 * which is more than a right angle inside r = 3. The solid angle is that of a spherical cap. */
static void synges_angle(void **state)
{
    (void)state;
    const double radii[] = { 2.0001, 2.5, 3, 3.5, 10, 1e3, 1e6 };
    for (size_t i = 0; i < COUNT(radii); i++)
        for (int zamo = 0; zamo < 2; zamo++) {
            double r = radii[i], angle = asin(fmin(root27 * sqrt(1 - 2 / r) / r, 1)), half;
            angle = r < 3 ? M_PI - angle : angle;
            half = sin(angle / 2);
            struct kd_critical c = curve_of(0, 0.3, r, zamo ? KD_OBSERVER_ZAMO : KD_OBSERVER_STATIC);
            struct kd_critical_measures m = kd_critical_measure(&c);
            near(m.mean_radius, angle, 3e-8 * (r == 3) + relative(1e-13, angle), "angle", 0, r);
            near(m.area, 4 * M_PI * half * half, 1e-7 * (r == 3) + relative(1e-12, m.area), "solid angle", 0, r);
            near(m.asymmetry, 0, 1e-12, "asymmetry", 0, r);
            near(m.displacement, 0, 1e-14, "displacement", 0, r);
        }
}

/* Light from directions just outside the edge escapes, and light from directions just inside it falls in. This holds
 * for observers at any distance, also where the edge is behind them. */
static void the_edge_from_nearby(void **state)
{
    (void)state;
    const double as[] = { 0, 0.5, 0.9, -0.9, 0.998 }, us[] = { 0.99, 0.5, 0, -0.7 },
                 rs[] = { 1.9, 2.1, 2.9, 5, 30, 1e4 };
    for (int n = 0; n < 5 * 4 * 6 * 2; n++) {
        double a = as[n % 5], u = us[n / 5 % 4], r = rs[n / 20 % 6];
        bool zamo = n / 120;
        if (r <= kd_hole(a)->outer || (!zamo && r <= kd_kerr_ergosphere(kd_hole(a), u)))
            continue;
        struct kd_critical c = curve_of(a, u, r, zamo ? KD_OBSERVER_ZAMO : KD_OBSERVER_STATIC);
        for (int k = 0; k < 16; k++) {
            double angle = 0.2 + k * 0.39;
            struct kd_critical_point p = kd_critical_at(&c, angle);
            near(hypot(hypot(p.right, p.up), p.inwards), 1, 1e-13, "length", a, r);
            for (int side = -1; side <= 1; side += 2) {
                double rho = p.rho * (1 + side * 1e-7), x = sin(rho) * cos(angle), up = sin(rho) * sin(angle);
                double right = x * cos(c.centre) + cos(rho) * sin(c.centre);
                double inwards = cos(rho) * cos(c.centre) - x * sin(c.centre);
                struct kd_covector photon = kd_tetrad_covector(&c.tetrad, (double[]) { 1, inwards, up, -right });
                if (photon.energy <= 0.05) /* skipped, because in the ergosphere the ray may have no alpha and beta */
                    continue;
                struct kd_null_ray ray = { .hole = kd_hole_of(a),
                                           .radius = r,
                                           .cos_theta = u,
                                           .outward = inwards < 0,
                                           .alpha = -photon.momentum / photon.energy,
                                           .beta = photon.polar / photon.energy };
                enum kd_null_fate want = side > 0 ? KD_NULL_ESCAPED : KD_NULL_CAPTURED;
                if (kd_null_trace_fast(&ray).fate != want)
                    fail_msg("a = %g, u = %g, r = %g, zamo %d, angle %g, rho %g, side %d", a, u, r, zamo, angle, p.rho,
                             side);
            }
        }
    }
}

/* Far from the hole the angles become those of the image plane over r. */
static void from_far_away(void **state)
{
    (void)state;
    double r = 1e7;
    struct kd_critical c = curve_of(0.9, 0.5, r, KD_OBSERVER_STATIC);
    struct kd_critical far = curve_of(0.9, 0.5, INFINITY, KD_OBSERVER_STATIC);
    struct kd_critical_measures m = kd_critical_measure(&c), n = kd_critical_measure(&far);
    near(m.mean_radius * r, n.mean_radius, 1e-5, "mean radius", 0.9, r);
    near(m.displacement * r, n.displacement, 1e-5, "displacement", 0.9, r);
    near(m.asymmetry * r, n.asymmetry, 1e-5, "asymmetry", 0.9, r);
    near(m.area * r * r, n.area, 1e-4, "area", 0.9, r);
    near(m.height * r, n.height, 1e-5, "height", 0.9, r);
}

/* Area and mean radius by another rule: polygons with points at equal steps of Bardeen's parameter, extrapolated.
 * Johannsen & Psaltis' asymmetry A of a displaced circle must be 0. */
static double polygon(double a, double u, int n)
{
    double s = sqrt(1 - u * u), low = kd_kerr_photon_orbit(kd_hole(a)), high = kd_kerr_photon_orbit(kd_hole(-a)),
           area = 0;
    double alpha0 = 0, beta0 = 0;
    for (int k = 0; k <= n; k++) { /* i = 90 degrees: all spherical orbits are on the curve */
        double r = 0.5 * (low + high) - 0.5 * (high - low) * cos(M_PI * k / n);
        double lambda = (r * r * (3 - r) - a * a * (r + 1)) / (a * (r - 1));
        double eta = r * r * r * (4 * a * a - r * (r - 3) * (r - 3)) / (a * a * (r - 1) * (r - 1));
        double alpha = -lambda / s, beta = sqrt(fmax(eta, 0));
        if (k)
            area += (alpha - alpha0) * (beta + beta0); /* counts both halves */
        alpha0 = alpha, beta0 = beta;
    }
    return area;
}

static void measures(void **state)
{
    (void)state;
    const double as[] = { 0.3, 0.9, 0.998 };
    for (size_t i = 0; i < COUNT(as); i++) {
        struct kd_critical c = curve_of(as[i], 0, INFINITY, KD_OBSERVER_STATIC);
        double fine = polygon(as[i], 0, 8192), coarse = polygon(as[i], 0, 4096);
        near(kd_critical_measure(&c).area, (4 * fine - coarse) / 3, 1e-9, "area", as[i], 0);
    }
    struct kd_critical round = curve_of(0.9, 1, INFINITY, KD_OBSERVER_STATIC);
    struct kd_critical_measures m = kd_critical_measure(&round);
    near(m.asymmetry, 0, 1e-14, "asymmetry", 0.9, 0);
    near(m.area, M_PI * m.mean_radius * m.mean_radius, 1e-12, "area", 0.9, 0);
    near(m.width, m.height, 1e-13, "width", 0.9, 0);
    /* For slow holes D is 2 a sin(i) (Bardeen 1973; Chan et al. 2013 fit the rest). */
    struct kd_critical slow = curve_of(1e-5, 0.5, INFINITY, KD_OBSERVER_STATIC);
    near(kd_critical_measure(&slow).displacement, 2e-5 * sqrt(0.75), 1e-13, "displacement", 1e-5, 0);
}

static void bad_input(void **state)
{
    (void)state;
    const struct kd_critical_observer good = { kd_hole_of(0.5), 10, 0.5, 0, { .observer = KD_OBSERVER_STATIC } };
    struct kd_critical_observer bad[8];
    for (size_t i = 0; i < COUNT(bad); i++)
        bad[i] = good;
    assert_int_equal(kd_critical_of(&good).status, KD_CRITICAL_OK);
    bad[0].hole = kd_hole_of(1), bad[1].hole = kd_hole_of(NAN), bad[2].radius = 1.5, bad[3].radius = NAN,
    bad[4].cos_theta = 1.1;
    bad[5].cos_theta = NAN, bad[6].sin_theta = -0.1, bad[7].motion.observer = (enum kd_observer)KD_OBSERVER_COUNT;
    for (size_t i = 0; i < COUNT(bad); i++)
        assert_int_equal(kd_critical_of(&bad[i]).status, KD_CRITICAL_BAD_INPUT);
    struct kd_critical_observer held = { kd_hole_of(0.9), 1.99, 0, 0, { .observer = KD_OBSERVER_STATIC } };
    assert_int_equal(kd_critical_of(&held).status, KD_CRITICAL_NO_OBSERVER);
}

/* The curve's points for drawing lie on the curve, and reach from one end to the other. */
static void drawn(void **state)
{
    (void)state;
    static const double radii[] = { INFINITY, 1e4, 30, 2.9 };
    for (size_t i = 0; i < COUNT(spins); i++)
        for (size_t k = 0; k < COUNT(cosines); k++)
            for (size_t n = 0; n < COUNT(radii); n++) {
                struct kd_critical c = curve_of(spins[i], cosines[k], radii[n], KD_OBSERVER_ZAMO);
                double scale = kd_critical_at(&c, 1.5).rho, before = 4;
                for (int j = 0; j <= 32; j++) {
                    struct kd_critical_point q = kd_critical_upper(&c, j / 32.0), p = kd_critical_at(&c, q.angle);
                    near(q.rho, p.rho, relative(3e-7, scale), "rho", spins[i], cosines[k]);
                    near(q.alpha, p.alpha, 3e-6, "alpha", spins[i], cosines[k]);
                    near(q.up, p.up, 1e-6, "up", spins[i], cosines[k]);
                    near(q.inwards, p.inwards, 1e-6, "inwards", spins[i], cosines[k]);
                    if (!(q.angle <= before))
                        fail_msg("a = %.17g, u = %g, r = %g: the angle goes from %g to %g", spins[i], cosines[k],
                                 radii[n], before, q.angle);
                    before = q.angle;
                }
                near(kd_critical_upper(&c, 0).angle, M_PI, 1e-5, "left end", spins[i], cosines[k]);
                near(kd_critical_upper(&c, 1).angle, 0, 1e-5, "right end", spins[i], cosines[k]);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drawn),
        cmocka_unit_test(against_the_oracle),
        cmocka_unit_test(published_shapes),
        cmocka_unit_test(equatorial_orbits_keep_time),
        cmocka_unit_test(orbits_are_double_roots),
        cmocka_unit_test(symmetric_and_continuous),
        cmocka_unit_test(the_edge_of_the_shadow),
        cmocka_unit_test(synges_angle),
        cmocka_unit_test(the_edge_from_nearby),
        cmocka_unit_test(from_far_away),
        cmocka_unit_test(measures),
        cmocka_unit_test(bad_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

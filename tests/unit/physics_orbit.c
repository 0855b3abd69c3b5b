/* Tests of timelike geodesics, compared with quadrature (tests/oracle/orbit_reference.py), with each other, and with
 * known properties. */
#include "physics/orbit/orbit_lanes.h"
#include "physics/spacetime/kerr.h"

#include "orbit_reference.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void close_to(size_t row, const char *what, double got, double want, double bound)
{
    if (!(fabs(got - want) <= bound))
        fail_msg("row %zu: %s is %.17g, not %.17g: off by %.2g, allowed %.2g", row, what, got, want, fabs(got - want),
                 bound);
}

static struct kd_orbit shape(double a, double p, double e, double x)
{
    struct kd_orbit orbit;
    struct kd_error error = { 0 };
    if (kd_orbit_from_shape(kd_hole(a), p, e, x, &orbit, &error))
        fail_msg("a = %g, p = %g, e = %g, x = %g: %s", a, p, e, x, error.message);
    return orbit;
}

static struct kd_orbit_bound bound_of(const struct kd_orbit *orbit)
{
    struct kd_orbit_state start = kd_orbit_start(orbit, NAN, true);
    return kd_orbit_bound_of(orbit, &start);
}

/* An orbit closer to the separatrix than to 0 magnifies the rounding of its constants by this factor. */
static double condition(const struct orbit_reference *e)
{
    return 1 + e->p / (e->p - kd_orbit_separatrix(kd_hole(e->spin), e->e, e->x));
}

static void constants_are_the_roots(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(orbit_reference); i++) {
        const struct orbit_reference *e = &orbit_reference[i];
        struct kd_orbit o = shape(e->spin, e->p, e->e, e->x);
        close_to(i, "E", o.energy, e->energy, 4e-15 * condition(e));
        close_to(i, "1 - E^2", o.binding, e->binding, 1e-14 * condition(e) * e->binding);
        close_to(i, "L", o.momentum, e->momentum, 1e-14 * condition(e) * (fabs(e->momentum) + 1e-3));
        close_to(i, "Q", o.carter, e->carter, 1e-14 * condition(e) * e->carter);
        assert_int_equal(o.fate, KD_ORBIT_BOUND);
    }
}

static void frequencies_are_the_averages(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(orbit_reference); i++) {
        const struct orbit_reference *e = &orbit_reference[i];
        struct kd_orbit o = shape(e->spin, e->p, e->e, e->x);
        struct kd_orbit_bound b = bound_of(&o);
        struct kd_orbit_frequencies f = kd_orbit_frequencies_of(&b);
        double bound = 1e-14 * condition(e);
        if (e->e == 0 && e->p < 6.01) /* so close to the ISCO, Upsilon_r is the square root of a difference of 1e-4 */
            bound = 1e-12;
        close_to(i, "Upsilon_r", f.mino_r, e->mino_r, 2 * bound * e->mino_r);
        close_to(i, "Upsilon_theta", f.mino_theta, e->mino_theta, bound * e->mino_theta);
        close_to(i, "Upsilon_phi", f.mino_phi, e->mino_phi, bound * fabs(e->mino_phi));
        close_to(i, "Gamma", f.mino_t, e->mino_t, bound * e->mino_t);
        close_to(i, "Upsilon_tau", f.mino_proper, e->mino_proper, bound * e->mino_proper);
    }
}

static void check_place(size_t row, struct kd_orbit_place at, const struct orbit_reference *e, double relative)
{
    close_to(row, "r", at.r, e->r, relative * e->r * (1 + e->mino * e->mino_r));
    close_to(row, "u", cos(at.theta), e->u, relative * (1 + e->mino * e->mino_theta));
    close_to(row, "proper time", at.proper, e->proper, relative * e->proper);
    close_to(row, "t", at.t, e->t, relative * e->t);
    close_to(row, "phi", at.phi, e->phi, relative * (1 + fabs(e->phi)));
}

static void places_are_the_quadratures(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(orbit_reference); i++) {
        const struct orbit_reference *e = &orbit_reference[i];
        struct kd_orbit o = shape(e->spin, e->p, e->e, e->x);
        struct kd_orbit_bound b = bound_of(&o);
        check_place(i, kd_orbit_bound_at(&b, e->mino), e, 2e-14 * condition(e));
    }
}

/* Both methods agree with the quadratures. There are so many steps that the only error is rounding, including the
 * rounding of the constants. */
static void paths_are_the_quadratures(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(orbit_reference); i++)
        for (int method = 0; method < 2; method++) {
            const struct orbit_reference *e = &orbit_reference[i];
            struct kd_orbit o = shape(e->spin, e->p, e->e, e->x);
            struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
            struct kd_orbit_path path;
            kd_orbit_path_init(&path, &o, &start, (enum kd_orbit_method)method);
            /* a wider orbit needs more steps, because its peak of 1/w^2 at apastron is sharper */
            int n = (int)ceil(e->mino * e->mino_theta * 160 / sqrt(1 - e->e));
            for (int k = 0; k < n; k++)
                kd_orbit_path_step(&path, e->mino / n);
            check_place(i, kd_orbit_path_place(&path), e, 4e-12 * condition(e));
        }
}

/* Falls through 0.99 of the distance to the horizon, and flights outwards. */
static void falls_are_the_quadratures(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(fall_reference); i++)
        for (int method = 0; method < 2; method++) {
            const struct fall_reference *e = &fall_reference[i];
            struct kd_orbit o;
            struct kd_error error = { 0 };
            struct kd_orbit_path path;
            if (kd_orbit_from_constants(kd_hole(e->spin), e->energy, e->momentum, 0, e->from, &o, &error))
                fail_msg("row %zu: %s", i, error.message);
            struct kd_orbit_state start = kd_orbit_start(&o, e->from, e->to > e->from);
            kd_orbit_path_init(&path, &o, &start, (enum kd_orbit_method)method);
            double h = e->mino / 4000;
            for (int k = 0; k < 3990; k++)
                kd_orbit_path_step(&path, h);
            path = kd_orbit_path_to_radius(&path, 20 * h, 1 / e->to);
            struct kd_orbit_place at = kd_orbit_path_place(&path);
            /* tolerance: the rounding of r to a double causes this error of the time of arrival */
            close_to(i, "Mino time", at.mino, e->mino, 1e-12);
            close_to(i, "r", at.r, e->to, 1e-13 * e->to);
            close_to(i, "proper time", at.proper, e->proper, 2e-11 * e->proper);
            close_to(i, "t", at.t, e->t, 2e-11 * e->t);
            close_to(i, "phi", at.phi, e->phi, 2e-11 * (1 + fabs(e->phi)));
        }
}

/* worst: the largest |drift|; slope: growth of the largest |drift| from orbit to orbit, by least squares. */
struct line { double worst, slope; };

static struct line energy_drift(enum kd_orbit_method method, int steps, int orbits)
{
    struct kd_orbit o = shape(0, 8, 0.5, 1);
    struct kd_orbit_bound b = bound_of(&o);
    struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
    struct kd_orbit_path path;
    struct line line = { 0 };
    double h = 2 * M_PI / kd_orbit_frequencies_of(&b).mino_r / steps, middle = 0.5 * (orbits - 1), squares = 0;
    kd_orbit_path_init(&path, &o, &start, method);
    for (int k = 0; k < orbits; k++) {
        double worst = 0;
        for (int i = 0; i < steps; i++) {
            kd_orbit_path_step(&path, h);
            worst = fmax(worst, fabs(kd_orbit_path_drift(&path).energy));
        }
        line.worst = fmax(line.worst, worst);
        line.slope += (k - middle) * worst;
        squares += (k - middle) * (k - middle);
    }
    line.slope /= squares;
    return line;
}

/* Over a thousand orbits the error of E is at most 1e-13. Steady growth is less than a hundredth of that. */
static void yoshida_does_not_drift(void **state)
{
    (void)state;
    struct line yoshida = energy_drift(KD_ORBIT_YOSHIDA6, 320, 1000), nystroem = energy_drift(KD_ORBIT_RKN6, 160, 1000);
    print_message("E over 1000 orbits of p = 8, e = 0.5: Yoshida, 320 steps an orbit: %.2e at most, slope %.2e an "
                  "orbit; RKN, 160 "
                  "steps: %.2e, slope %.2e\n",
                  yoshida.worst, yoshida.slope, nystroem.worst, nystroem.slope);
    assert_true(yoshida.worst <= 1e-13);
    assert_true(fabs(yoshida.slope) * 1000 <= 1e-15);
    /* shows that the fit finds growth when the drift grows */
    assert_true(nystroem.slope * 1000 > 0.5 * nystroem.worst);
}

/* All first integrals stay constant, also off the plane and across the axis. Halving the step shows the order. */
static void first_integrals_stay(void **state)
{
    (void)state;
    static const double orbits[][4] = { { 0.9, 6, 0.5, 0.75 }, { 0.998, 7, 0.25, 0 }, { -0.7, 10, 0.25, 0.25 } };
    for (size_t i = 0; i < COUNT(orbits); i++) {
        struct kd_orbit o = shape(orbits[i][0], orbits[i][1], orbits[i][2], orbits[i][3]);
        struct kd_orbit_bound b = bound_of(&o);
        struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
        double period = 2 * M_PI / kd_orbit_frequencies_of(&b).mino_r, worst[2] = { 0 };
        for (int fine = 0; fine < 2; fine++) {
            struct kd_orbit_path path;
            int steps = fine ? 128 : 64;
            kd_orbit_path_init(&path, &o, &start, KD_ORBIT_YOSHIDA6);
            for (int k = 0; k < 100 * steps; k++) {
                kd_orbit_path_step(&path, period / steps);
                struct kd_orbit_drift d = kd_orbit_path_drift(&path);
                worst[fine] = fmax(worst[fine], fmax(fmax(fabs(d.energy), fabs(d.carter)), fabs(d.mass)));
            }
        }
        double order = log2(worst[0] / worst[1]);
        if (!(order > 5.7 && order < 6.6) || !(worst[1] < 2e-8))
            fail_msg("orbit %zu: %.2e and %.2e, order %.2f", i, worst[0], worst[1], order);
    }
}

/* Advance of Mercury's perihelion: C. Will 2014, Living Rev. Relativity 17, 4, table 5: 42.98'' per century; elements
 * of Mercury's orbit as given there. */
static void mercury_advances(void **state)
{
    (void)state;
    const double axis_m = 57.909050e9, e = 0.205630, gm_m = 1.32712440018e20 / (299792458. * 299792458.),
                 days = 87.9691;
    double p = axis_m * (1 - e * e) / gm_m;
    struct kd_orbit o = shape(0, p, e, 1);
    struct kd_orbit_bound b = bound_of(&o);
    double century = 36525 / days * 180 / M_PI * 3600, exact = kd_orbit_periastron_advance(&b);
    close_to(0, "closed", exact * century, 42.98, 0.005);
    close_to(0, "weak field", exact / (6 * M_PI / p), 1, 1e-6);
    struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
    struct kd_orbit_path path;
    kd_orbit_path_init(&path, &o, &start, KD_ORBIT_YOSHIDA6);
    double h = 2 * M_PI / kd_orbit_frequencies_of(&b).mino_r / 512;
    struct kd_orbit_path before = path;
    for (int periastra = 0; periastra < 100; kd_orbit_path_step(&path, h)) {
        periastra += before.rate[KD_PATH_W].value > 0 && path.rate[KD_PATH_W].value <= 0;
        if (periastra == 100)
            break;
        before = path;
    }
    path = kd_orbit_path_to_apsis(&before, h);
    double measured = (kd_orbit_path_place(&path).phi - 200 * M_PI) / 100;
    close_to(0, "measured", measured * century, 42.98, 0.005);
    close_to(0, "measured against closed", measured / exact, 1, 1e-6);
}

static void circles_at_the_edge(void **state)
{
    (void)state;
    for (double a = -0.95; a < 1; a += 0.95) {
        double isco = kd_kerr_isco(kd_hole(a));
        struct kd_orbit o = shape(a, isco, 0, 1);
        assert_int_equal(o.fate, KD_ORBIT_BOUND);
        close_to(0, "E", o.energy, kd_kerr_energy(kd_hole(a), isco), 1e-14);
        close_to(0, "L", o.momentum, kd_kerr_momentum(kd_hole(a), isco), 1e-13);
        for (int method = 0; method < 2; method++) {
            struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
            struct kd_orbit_path path;
            kd_orbit_path_init(&path, &o, &start, (enum kd_orbit_method)method);
            for (int k = 0; k < 1000 * 32; k++)
                kd_orbit_path_step(&path, 2 * M_PI / o.momentum / 32);
            assert_true(path.place[KD_PATH_W].value == o.w_high); /* equal to the bit */
        }
        struct kd_orbit inside = shape(a, nextafter(isco, 0), 0, 1);
        assert_int_equal(inside.fate, KD_ORBIT_PLUNGE);
        assert_true(kd_orbit_start(&inside, NAN, true).w > inside.w_high); /* starts inwards */
        /* the plunge starts 2 % inside the ISCO, because it takes longer the nearer its start is to the ISCO */
        struct kd_orbit well_inside = shape(a, 0.98 * isco, 0, 1);
        struct kd_orbit_state start = kd_orbit_start(&well_inside, NAN, true);
        struct kd_orbit_path path;
        double horizon = 1 / kd_hole(a)->outer;
        int k = 0;
        kd_orbit_path_init(&path, &well_inside, &start, KD_ORBIT_YOSHIDA6);
        for (; k < 100 * 64 && path.place[KD_PATH_W].value < horizon; k++)
            kd_orbit_path_step(&path, 2 * M_PI / o.momentum / 64);
        assert_true(path.place[KD_PATH_W].value >= horizon);
        assert_true(k > 64); /* the body stayed near the circle for a while */
    }
}

/* E, L and Q give the turning points again. Just inside them the same constants give another kind of motion. */
static void constants_and_back(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(orbit_reference); i++) {
        const struct orbit_reference *e = &orbit_reference[i];
        struct kd_orbit o = shape(e->spin, e->p, e->e, e->x), back;
        struct kd_error error = { 0 };
        if (kd_orbit_from_constants(kd_hole(e->spin), o.energy, o.momentum, o.carter, NAN, &back, &error))
            fail_msg("row %zu: %s", i, error.message);
        assert_int_equal(back.fate, KD_ORBIT_BOUND);
        /* tolerance: E near 1 has lost digits of 1 - E^2, and if the range of r is narrow, it has lost half of its
         * digits */
        double bound = 1e-14 / o.binding * condition(e) / fmax(e->e, 1e-7);
        close_to(i, "periastron", back.w_high, o.w_high, bound * o.w_high);
        close_to(i, "apastron", back.w_low, o.w_low, bound * o.w_low);
        if (e->e > 0 && e->p < 100) {
            double inner = 0.5 * (1 / o.w_high + kd_hole(e->spin)->outer);
            struct kd_orbit_bound b = bound_of(&o);
            if (inner < b.r[2] &&
                !kd_orbit_from_constants(kd_hole(e->spin), o.energy, o.momentum, o.carter, inner, &back, &error))
                assert_int_equal(back.fate, KD_ORBIT_PLUNGE);
        }
    }
}

/* The velocity that an observer measures, and the norm, agree with contractions with the metric. */
static void states_are_what_is_seen(void **state)
{
    (void)state;
    static const double velocities[][3] = {
        { 0.1, 0.2, 0.3 }, { -0.5, 0, 0.4 }, { 0, -0.3, -0.6 }, { 0, 0, 0 }, { 0.9, 0.1, -0.1 }
    };
    static const double places[][2] = { { 3, 1.2 }, { 8, 0.3 }, { 50, 2.5 }, { 2.5, 1.5 } };
    for (size_t i = 0; i < COUNT(velocities) * COUNT(places) * 2; i++) {
        const double *v = velocities[i / 2 % COUNT(velocities)], *at = places[i / 2 / COUNT(velocities)], a = 0.8;
        bool zamo = i % 2;
        struct kd_orbit o;
        struct kd_orbit_state s;
        struct kd_error error = { 0 };
        if (kd_orbit_from_state(kd_hole(a), at[0], at[1] * (180 / M_PI), zamo ? KD_OBSERVER_ZAMO : KD_OBSERVER_STATIC,
                                v, &o, &s, &error))
            fail_msg("row %zu: %s", i, error.message);
        double r = at[0], sine2 = sin(at[1]) * sin(at[1]), u = cos(at[1]);
        double sigma = r * r + a * a * u * u, delta = r * r - 2 * r + a * a;
        double g_tt = -(1 - 2 * r / sigma), g_tp = -2 * a * r * sine2 / sigma;
        double g_pp = (r * r + a * a + 2 * a * a * r * sine2 / sigma) * sine2, block = g_tt * g_pp - g_tp * g_tp;
        /* the observer's four-velocity, and gamma = -p.u */
        double omega = zamo ? -g_tp / g_pp : 0, ut = 1 / sqrt(-(g_tt + 2 * omega * g_tp + omega * omega * g_pp));
        double gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
        close_to(i, "gamma", ut * (o.energy - omega * o.momentum), gamma, 1e-13 * gamma);
        double p_r = -s.w_rate * r * r / delta;
        double p_theta = -s.u_rate / sin(at[1]);
        close_to(i, "v_r", p_r * sqrt(delta / sigma), gamma * v[0], 1e-13 * gamma);
        close_to(i, "v_theta", p_theta / sqrt(sigma), gamma * v[1], 1e-13 * gamma);
        double inverse =
            (g_pp * o.energy * o.energy + 2 * g_tp * o.energy * o.momentum + g_tt * o.momentum * o.momentum) / block;
        close_to(i, "norm", inverse + p_r * p_r * delta / sigma + p_theta * p_theta / sigma, -1, 1e-12 * gamma * gamma);
        assert_true((o.momentum > 0) == (v[2] > 0) || !zamo);
        struct kd_orbit_path path;
        kd_orbit_path_init(&path, &o, &s, KD_ORBIT_RKN6);
        struct kd_orbit_drift d = kd_orbit_path_drift(&path);
        assert_true(fabs(d.energy) < 1e-13 && fabs(d.carter) < 1e-13 && !(fabs(d.mass) > 1e-12));
    }
}

/* A bound orbit given by a place and a velocity: numerical integration and closed form agree from any phase. */
static void from_any_phase(void **state)
{
    (void)state;
    static const double v[][3] = { { 0.05, 0.1, 0.3 }, { -0.1, -0.15, 0.25 }, { 0, 0.1, 0.32 }, { 0.1, 0.2, -0.3 } };
    for (size_t i = 0; i < COUNT(v); i++) {
        struct kd_orbit o;
        struct kd_orbit_state s;
        struct kd_orbit_path path;
        assert_int_equal(kd_orbit_from_state(kd_hole(0.6), 14, 70, KD_OBSERVER_ZAMO, v[i], &o, &s, NULL), KD_OK);
        assert_int_equal(o.fate, KD_ORBIT_BOUND);
        struct kd_orbit_bound b = kd_orbit_bound_of(&o, &s);
        kd_orbit_path_init(&path, &o, &s, KD_ORBIT_YOSHIDA6);
        for (int k = 0; k < 4000; k++) {
            kd_orbit_path_step(&path, 0.002);
            struct kd_orbit_place got = kd_orbit_path_place(&path), want = kd_orbit_bound_at(&b, path.mino.value);
            close_to(i, "r", got.r, want.r, 1e-10 * want.r);
            close_to(i, "theta", got.theta, want.theta, 1e-11);
            close_to(i, "phi", got.phi, want.phi, 1e-10);
            close_to(i, "t", got.t, want.t, 1e-10 * (want.t + 1));
            close_to(i, "proper time", got.proper, want.proper, 1e-10 * (want.proper + 1));
        }
    }
}

/* The azimuth computed without its pole at the axis equals the plain sum of L/(1 - u^2), also for E > 1 and for motions
 * that stay on one side of the equator. */
static void azimuth_has_no_pole(void **state)
{
    (void)state;
    static const struct {
        double theta, v[3];
        bool vortical;
    } rows[] = { { 1.2, { 0.2, 0.3, 0.4 }, false },   { 0.8, { 0.1, -0.2, -0.3 }, false },
                 { 0.9, { 0.6, 0.01, 0.02 }, true },  { 0.6, { -0.75, -0.03, -0.02 }, true },
                 { 1.5, { 0.7, 0.1, 0.001 }, false }, { 0.5, { 0.1, 0.3, 1e-3 }, false } };
    for (size_t i = 0; i < COUNT(rows); i++)
        for (int method = 0; method < 2; method++) {
            struct kd_orbit o;
            struct kd_orbit_state s;
            struct kd_orbit_path path;
            double sum = 0, drag = 0, h = 1e-4, end = 0.6;
            assert_int_equal(kd_orbit_from_state(kd_hole(0.98), 12, rows[i].theta * (180 / M_PI), KD_OBSERVER_ZAMO,
                                                 rows[i].v, &o, &s, NULL),
                             KD_OK);
            assert_int_equal(o.carter < 0, rows[i].vortical);
            kd_orbit_path_init(&path, &o, &s, (enum kd_orbit_method)method);
            for (int k = 0; k < (int)(end / h); k++) { /* Simpson's rule over pairs of steps */
                double f[3], g[3];
                for (int n = 0; n < 3; n++) {
                    if (n)
                        kd_orbit_path_step(&path, 0.5 * h);
                    struct kd_orbit_place at = kd_orbit_path_place(&path);
                    double delta = at.r * (at.r - 2) + o.hole.a * o.hole.a;
                    f[n] = o.momentum / (sin(at.theta) * sin(at.theta));
                    g[n] = o.hole.a * (2 * o.energy * at.r - o.hole.a * o.momentum) / delta;
                }
                sum += h / 6 * (f[0] + 4 * f[1] + f[2]);
                drag += h / 6 * (g[0] + 4 * g[1] + g[2]);
                if (path.place[KD_PATH_W].value < 0.002 || path.place[KD_PATH_W].value > 0.7)
                    break;
            }
            close_to(i, "phi", kd_orbit_path_place(&path).phi, sum + drag, 1e-9 * (1 + fabs(sum)));
            assert_true(fabs(kd_orbit_path_drift(&path).carter) < 1e-12);
            assert_true(fabs(sum) > 1e-3);
        }
}

struct seen {
    struct kd_orbit_lanes *lanes;
    int periastra[KD_ORBIT_LANES];
    double w[KD_ORBIT_LANES];
};

static void see(void *user, int lane)
{
    struct seen *seen = user;
    seen->periastra[lane]++;
    seen->w[lane] = seen->lanes->path[lane]->place[KD_PATH_W].value;
}

/* The lanes equal single paths to the last bit, although each lane takes its own number of steps of its own length.
 * Each lane reports every periastron. */
static void lanes_are_paths(void **state)
{
    (void)state;
    static const double shapes[KD_ORBIT_LANES][4] = { { 0, 8, 0.5, 1 },          { 0.9, 6, 0.5, 0.75 },
                                                      { -0.5, 30, 0.75, -0.25 }, { 0.998, 5, 0, 0.5 },
                                                      { 0.3, 12, 0.1, -1 },      { 0, 1e7, 0.2, 0.3 },
                                                      { 0.9, 2.9, 0.5, 1 },      { 0.7, 9, 0.3, 0.01 } };
    struct kd_orbit_path path[KD_ORBIT_LANES];
    struct kd_orbit_drift worst[KD_ORBIT_LANES] = { { 0 } };
    struct kd_orbit_lanes lanes = { .periastron = see };
    struct seen seen = { .lanes = &lanes };
    lanes.user = &seen;
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        struct kd_orbit o = shape(shapes[i][0], shapes[i][1], shapes[i][2], shapes[i][3]);
        struct kd_orbit_state start = kd_orbit_start(&o, NAN, true);
        struct kd_orbit_bound b = kd_orbit_bound_of(&o, &start);
        kd_orbit_path_init(&path[i], &o, &start, KD_ORBIT_YOSHIDA6);
        assert_true(kd_orbit_lanes_take(&path[i]));
        lanes.path[i] = &path[i], lanes.worst[i] = &worst[i];
        lanes.h[i] = 2 * M_PI / kd_orbit_frequencies_of(&b).mino_r / (200 + 20 * i);
        lanes.steps[i] = i == 5 ? 0 : 1000 + 300 * (uint64_t)i;
    }
    struct kd_orbit_path alone[KD_ORBIT_LANES];
    memcpy(alone, path, sizeof path);
    kd_orbit_lanes_run(&lanes);
    for (int i = 0; i < KD_ORBIT_LANES; i++) {
        struct kd_orbit_drift d = { 0 };
        int periastra = 0;
        double w = 0;
        for (uint64_t k = 0; k < lanes.steps[i]; k++) {
            double rate = alone[i].rate[KD_PATH_W].value;
            kd_orbit_path_step(&alone[i], lanes.h[i]);
            if (rate > 0 && alone[i].rate[KD_PATH_W].value <= 0)
                periastra++, w = alone[i].place[KD_PATH_W].value;
            struct kd_orbit_drift now = kd_orbit_path_drift(&alone[i]);
            d.energy = fmax(d.energy, fabs(now.energy));
            d.carter = fmax(d.carter, fabs(now.carter));
            d.mass = fmax(d.mass, fabs(now.mass));
        }
        assert_memory_equal(alone[i].place, path[i].place, sizeof path[i].place);
        assert_memory_equal(alone[i].rate, path[i].rate, sizeof path[i].rate);
        assert_memory_equal(&alone[i].mino, &path[i].mino, sizeof path[i].mino);
        assert_int_equal(alone[i].half_turns, path[i].half_turns);
        assert_int_equal(seen.periastra[i], periastra);
        assert_true(seen.w[i] == w);
        close_to((size_t)i, "drift of E", worst[i].energy, d.energy, 0);
        close_to((size_t)i, "drift of Q", worst[i].carter, d.carter, 0);
        close_to((size_t)i, "drift of the mass", worst[i].mass, d.mass, 1e-9 * d.mass);
    }
}

/* The separatrix is p = 6 + 2e for Schwarzschild's hole (C. Cutler, D. Kennefick & E. Poisson 1994, Phys. Rev. D 50,
 * 3816), r_isco for circles, and 2 r_mb for parabolas. */
static void separatrix(void **state)
{
    (void)state;
    for (double e = 0.125; e < 1; e += 0.125)
        close_to(0, "p_s", kd_orbit_separatrix(kd_hole(0), e, 0.5), 6 + 2 * e, 1e-12);
    for (double a = -0.99; a < 1; a += 0.11) {
        close_to(1, "p_s, e = 0", kd_orbit_separatrix(kd_hole(a), 1e-9, 1), kd_kerr_isco(kd_hole(a)), 1e-7);
        close_to(2, "p_s, e = 1", kd_orbit_separatrix(kd_hole(a), 1 - 1e-9, -1),
                 2 * kd_kerr_marginally_bound(kd_hole(-a)), 1e-7);
    }
}

static void refused(const char *pointer, enum kd_status status, const struct kd_error *error)
{
    if (status != KD_EINVAL || strcmp(error->pointer, pointer))
        fail_msg("status %d, pointer %s, not %s: %s", status, error->pointer, pointer, error->message);
}

static void bad_input(void **state)
{
    (void)state;
    struct kd_orbit o;
    struct kd_orbit_state s;
    struct kd_error error = { 0 };
    static const double fast[] = { 0.8, 0.6, 0.1 }, still[3];
    refused("/spin", kd_orbit_from_shape(kd_hole(1), 8, 0.5, 1, &o, &error), &error);
    refused("/e", kd_orbit_from_shape(kd_hole(0), 8, 1, 1, &o, &error), &error);
    refused("/e", kd_orbit_from_shape(kd_hole(0), 8, -0.1, 1, &o, &error), &error);
    refused("/p", kd_orbit_from_shape(kd_hole(0), 6.9, 0.5, 1, &o, &error), &error);
    refused("/p", kd_orbit_from_shape(kd_hole(0), 1.9, 0, 1, &o, &error), &error);
    /* refused, because p is inside the photon orbit */
    refused("/p", kd_orbit_from_shape(kd_hole(0), 2.9, 0, 1, &o, &error), &error);
    refused("/p", kd_orbit_from_shape(kd_hole(0), INFINITY, 0, 1, &o, &error), &error);
    refused("/carter", kd_orbit_from_constants(kd_hole(0), 0.95, 3, -1, NAN, &o, &error), &error);
    refused("/r", kd_orbit_from_constants(kd_hole(0), 0.95, 3, 0, 1.9, &o, &error), &error);
    refused("/r", kd_orbit_from_constants(kd_hole(0), 0.95, 4, 0, 1000, &o, &error), &error);
    refused("/energy", kd_orbit_from_constants(kd_hole(0), -0.95, 4, 0, NAN, &o, &error), &error);
    refused("/position/r", kd_orbit_from_state(kd_hole(0), 2, 57, KD_OBSERVER_ZAMO, still, &o, &s, &error), &error);
    refused("/position/theta_deg", kd_orbit_from_state(kd_hole(0), 5, 181, KD_OBSERVER_ZAMO, still, &o, &s, &error),
            &error);
    refused("/velocity", kd_orbit_from_state(kd_hole(0), 5, 57, KD_OBSERVER_ZAMO, fast, &o, &s, &error), &error);
    refused("/velocity/frame", kd_orbit_from_state(kd_hole(0.9), 1.9, 86, KD_OBSERVER_STATIC, still, &o, &s, &error),
            &error);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constants_are_the_roots),
        cmocka_unit_test(frequencies_are_the_averages),
        cmocka_unit_test(places_are_the_quadratures),
        cmocka_unit_test(paths_are_the_quadratures),
        cmocka_unit_test(falls_are_the_quadratures),
        cmocka_unit_test(yoshida_does_not_drift),
        cmocka_unit_test(first_integrals_stay),
        cmocka_unit_test(mercury_advances),
        cmocka_unit_test(circles_at_the_edge),
        cmocka_unit_test(constants_and_back),
        cmocka_unit_test(states_are_what_is_seen),
        cmocka_unit_test(from_any_phase),
        cmocka_unit_test(azimuth_has_no_pole),
        cmocka_unit_test(lanes_are_paths),
        cmocka_unit_test(separatrix),
        cmocka_unit_test(bad_input),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

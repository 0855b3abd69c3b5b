/* Tests of the sky that observers see, compared with frames and rays in Kerr-Schild coordinates. Tested are the dark
 * directions, the shift of light from all others, its smallest and largest value, and the size of the dark disk. */
#include "kerr_schild.h"
#include "physics/null/sky_view.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define RADIAN (M_PI / 180)
#define HORIZON 1.4358898943540673 /* radius of the horizon at a = 0.9 */
#define FALL .fall_from = INFINITY, .fall_energy = INFINITY

/* energy and momentum of infalling or orbiting observers, by Bardeen, Press & Teukolsky or computed by hand. */
static const struct seer {
    const char *name;
    double spin, inclination, r;
    struct kd_observer_motion motion;
    double energy, momentum;
    double charge;
} seers[] = {
    { "static", 0.9, 60, 8, { .observer = KD_OBSERVER_STATIC }, 0, 0 },
    { "static", 0, 50, 2.2, { .observer = KD_OBSERVER_STATIC }, 0, 0 },
    { "zamo", 0.9, 60, 4, { .observer = KD_OBSERVER_ZAMO }, 0, 0 },
    { "zamo", 0.9, 80, 1.6, { .observer = KD_OBSERVER_ZAMO }, 0, 0 },
    { "velocity", 0.9, 70, 12, { .observer = KD_OBSERVER_VELOCITY, .velocity = { -0.5, 0.3, 0.6 } }, 0, 0 },
    { "velocity", -0.6, 120, 2.5, { .observer = KD_OBSERVER_VELOCITY, .velocity = { 0.2, -0.4, -0.3 } }, 0, 0 },
    { "keplerian",
      0,
      90,
      6,
      { .observer = KD_OBSERVER_KEPLERIAN },
      0.94280904158206336,
      3.4641016151377544 }, /* energy sqrt(8/9), momentum sqrt(12) */
    { "rain", 0, 75, 20, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 110, 2, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, HORIZON, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, 1.2, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 0.3, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "plunge",
      0.9,
      80,
      1.3,
      { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = 0.9, .fall_momentum = 1.2 },
      0.9,
      1.2 },
    { "from 10 M",
      0,
      80,
      5,
      { .observer = KD_OBSERVER_INFALL, .fall_from = 10, .fall_energy = INFINITY },
      0.89442719099991588,
      0 }, /* sqrt(0.8) */
    { "static", 0.4, 60, 4, { .observer = KD_OBSERVER_STATIC }, 0, 0, 0.85 },
    { "zamo", 0.6, 80, 1.8, { .observer = KD_OBSERVER_ZAMO }, 0, 0, 0.7 },
    { "velocity", -0.5, 70, 6, { .observer = KD_OBSERVER_VELOCITY, .velocity = { -0.5, 0.3, 0.6 } }, 0, 0, 0.8 },
    { "rain", 0, 75, 0.8, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0, 0.95 },
    { "rain", 0.4, 110, 1.2, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0, 0.85 },
};
enum { SEERS = sizeof seers / sizeof *seers };

static struct ks_place place_of(const struct seer *s)
{
    return (struct ks_place) { s->spin, s->r, s->inclination * RADIAN, s->charge };
}

static struct ks_frame frame_of(const struct seer *s)
{
    const struct ks_place at = place_of(s);
    const struct ks_frame base = s->motion.observer == KD_OBSERVER_INFALL ? ks_rain(&at) : ks_zamo(&at);
    const double *v = s->motion.velocity, x[4] = { 1, v[0], v[1], v[2] },
                 gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    double u[4] = { 0 };
    if (s->energy > 0)
        ks_inwards(&at, 1, s->energy, s->momentum, 0, u);
    else if (s->motion.observer == KD_OBSERVER_STATIC) { /* this observer's velocity is along d/dt */
        double c = cos(at.theta), f = (2 * s->r - s->charge * s->charge) / (s->r * s->r + s->spin * s->spin * c * c),
               lapse = sqrt(1 - f);
        u[0] = -lapse, u[1] = f / lapse, u[3] = -f * s->spin * sin(at.theta) * sin(at.theta) / lapse;
    } else
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++)
                u[k] += gamma * x[i] * base.e[i][k];
    return ks_boost(&at, &base, u);
}

static struct kd_sky_view view_of(const struct seer *s)
{
    struct kd_sky_view view =
        kd_sky_view_of(&(struct kd_critical_observer) { .hole = kd_hole_charged(s->spin, s->charge),
                                                        .radius = s->r,
                                                        .cos_theta = cos(s->inclination * RADIAN),
                                                        .sin_theta = sin(s->inclination * RADIAN),
                                                        .motion = s->motion });
    assert_int_equal(view.status, KD_CRITICAL_OK);
    return view;
}

/* Returns the energy at infinity of light that is seen with energy 1 in the direction (right, up, inwards). Also finds
 * the light's origin.
 */
static double oracle_energy(const struct seer *s, const struct ks_frame *f, const double k[3], enum ks_fate *fate)
{
    const struct ks_place at = place_of(s);
    double p[4];
    ks_seen(f, (double[]) { -k[2], -k[1], k[0] }, p);
    if (fate)
        *fate = ks_follow(&at, p, 16).fate;
    return -p[0];
}

/* Evenly distributed points on the sphere, each turned about the axis by the golden angle. */
static void direction(int i, int n, double k[3])
{
    double z = (2 * i + 1.0) / n - 1, s = sqrt(1 - z * z), phi = i * M_PI * (3 - sqrt(5));
    k[0] = s * cos(phi), k[1] = s * sin(phi), k[2] = z;
}

static void directions(void **state)
{
    (void)state;
    enum { N = 300 };
    for (int i = 0; i < SEERS; i++) {
        const struct ks_frame f = frame_of(&seers[i]);
        const struct kd_sky_view view = view_of(&seers[i]);
        double worst = 0, least = INFINITY, greatest = 0;
        int seen = 0, wrong = 0;
        for (int n = 0; n < N; n++) {
            enum ks_fate fate;
            double k[3];
            direction(n, N, k);
            double want = 1 / oracle_energy(&seers[i], &f, k, &fate), got = kd_sky_view_shift(&view, k);
            wrong += (fate == KS_ESCAPED) != !isnan(got);
            if (fate != KS_ESCAPED || isnan(got))
                continue;
            worst = fmax(worst, fabs(got / want - 1));
            least = fmin(least, want), greatest = fmax(greatest, want);
            seen++;
        }
        print_message("%s, a = %g, r = %g: %d of %d directions see the sky, g from %.6g to %.6g, off by %.1e\n",
                      seers[i].name, seers[i].spin, seers[i].r, seen, N, least, greatest, worst);
        assert_true(wrong == 0 && worst < 1e-9 && seen > 10);
        assert_true(least >= view.least * (1 - 1e-9) && greatest <= view.greatest * (1 + 1e-9));
    }
}

/* Directions with one value of g form a circle about the axis along which E changes most. If g is 1e-5 beyond an
 * extreme value, the whole circle is dark or does not exist. If g is 1e-5 short of it, a part of the circle is bright.
 */
static bool circle_is_seen(const struct seer *s, const struct ks_frame *f, double g, int directions)
{
    static const double axes[3][3] = { { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 } };
    double mean = 0, slope[3], size = 0, across[3], third[3];
    for (int i = 0; i < 3; i++) {
        double there = oracle_energy(s, f, axes[i], NULL),
               back = oracle_energy(s, f, (double[]) { -axes[i][0], -axes[i][1], -axes[i][2] }, NULL);
        mean = 0.5 * (there + back), slope[i] = 0.5 * (there - back), size += slope[i] * slope[i];
    }
    size = sqrt(size);
    double c = (1 / g - mean) / size, z = sqrt(1 - c * c);
    if (!(fabs(c) <= 1))
        return false;
    int low = fabs(slope[0]) <= fabs(slope[1]) ? 0 : 1;
    low = fabs(slope[2]) < fabs(slope[low]) ? 2 : low;
    double part = slope[low] / size, norm = sqrt(1 - part * part);
    for (int i = 0; i < 3; i++)
        across[i] = ((i == low) - part * slope[i] / size) / norm;
    for (int i = 0; i < 3; i++)
        third[i] = (slope[(i + 1) % 3] * across[(i + 2) % 3] - slope[(i + 2) % 3] * across[(i + 1) % 3]) / size;
    for (int n = 0; n < directions; n++) {
        double x = z * cos(2 * M_PI * n / directions), y = z * sin(2 * M_PI * n / directions), k[3];
        enum ks_fate fate;
        for (int i = 0; i < 3; i++)
            k[i] = c * slope[i] / size + x * across[i] + y * third[i];
        oracle_energy(s, f, k, &fate);
        if (fate == KS_ESCAPED)
            return true;
    }
    return false;
}

static void extremes(void **state)
{
    (void)state;
    for (int i = 0; i < SEERS; i++) {
        const struct ks_frame f = frame_of(&seers[i]);
        const struct kd_sky_view v = view_of(&seers[i]);
        const double step = 1e-5;
        /* a static observer sees the same shift, that of the lapse, in all directions */
        if (seers[i].motion.observer == KD_OBSERVER_STATIC) {
            double want = 1 / oracle_energy(&seers[i], &f, (double[]) { 0, 0, 1 }, NULL);
            assert_true(fabs(v.least / want - 1) < 1e-12 && fabs(v.greatest / want - 1) < 1e-12);
            continue;
        }
        bool low = circle_is_seen(&seers[i], &f, v.least * (1 + step), 800),
             lower = circle_is_seen(&seers[i], &f, v.least * (1 - step), 100);
        bool high = circle_is_seen(&seers[i], &f, v.greatest * (1 - step), 800),
             higher = circle_is_seen(&seers[i], &f, v.greatest * (1 + step), 100);
        if (!low || lower || !high || higher)
            fail_msg("%s, a = %g, r = %g: g from %.9g (%d, not %d) to %.9g (%d, not %d)", seers[i].name, seers[i].spin,
                     seers[i].r, v.least, low, lower, v.greatest, high, higher);
    }
}

/* The angular radius x of the dark disk in Schwarzschild, with b = sqrt(27). For rain r sin x = b (1 - sqrt(2/r) cos
 * x), a quadratic equation for tan(x/2). For an observer at rest sin x = b sqrt(1 - 2/r)/r (Synge 1966). */
static void round_disks(void **state)
{
    (void)state;
    static const double radii[] = { 1e6, 20, 6, 4, 3.1, 3, 2.5, 2.1, 2, 1.9, 1, 0.1, 0.01 };
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++) {
        double r = radii[i], q = sqrt(54 / r), middle = atan2(r, q), half = acos(fmin(1, sqrt(27) / hypot(r, q)));
        double want = r < 3 ? middle + half : middle - half;
        const struct seer rain = { "rain", 0, 40, r, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 };
        const struct seer rest = { "static", 0, 40, r, { .observer = KD_OBSERVER_STATIC }, 0, 0 };
        double got = 2 * asin(sqrt(view_of(&rain).dark / (4 * M_PI)));
        /* Next to the photon orbits the difference of two angles is limited by the rounding of sqrt(27). */
        assert_true(fabs(got / want - 1) < (r == 3 ? 1e-7 : 1e-10) || (r == 1e6 && fabs(got - want) < 1e-15));
        if (r > 2) {
            double sine = asin(fmin(1, sqrt(27 * (1 - 2 / r)) / r));
            got = 2 * asin(sqrt(view_of(&rest).dark / (4 * M_PI))), want = r < 3 ? M_PI - sine : sine;
            assert_true(fabs(got / want - 1) < (r == 3 ? 1e-7 : 1e-10));
        }
    }
}

/* The solid angle is compared with counted directions, and for simple boundaries with the integral of the boundary's
 * distance from a centre. */
static void solid_angles(void **state)
{
    (void)state;
    enum { N = 20000 };
    for (int i = 0; i < SEERS; i++) {
        const struct kd_sky_view v = view_of(&seers[i]);
        int dark = 0;
        for (int n = 0; n < N; n++) {
            double k[3];
            direction(n, N, k);
            dark += isnan(kd_sky_view_shift(&v, k));
        }
        double counted = 4 * M_PI * dark / N, exact = kd_critical_measure(&v.edge).area;
        if (!(fabs(counted - v.dark) < 1e-2) || (!v.edge.is_skew && !(fabs(exact / v.dark - 1) < 1e-9)))
            fail_msg("%s, a = %g, r = %g: the dark disk has %.12g, counted %.6g, integrated %.12g", seers[i].name,
                     seers[i].spin, seers[i].r, v.dark, counted, exact);
    }
}

static void none(void **state)
{
    (void)state;
    assert_int_equal(
        kd_sky_view_of(&(struct kd_critical_observer) { .hole = kd_hole_of(0), .radius = INFINITY, .cos_theta = 1 })
            .status,
        KD_CRITICAL_BAD_INPUT);
    assert_int_equal(
        kd_sky_view_of(&(struct kd_critical_observer) { .hole = kd_hole_of(0), .radius = 1.9, .sin_theta = 1 }).status,
        KD_CRITICAL_BAD_INPUT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(directions),   cmocka_unit_test(extremes), cmocka_unit_test(round_disks),
        cmocka_unit_test(solid_angles), cmocka_unit_test(none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

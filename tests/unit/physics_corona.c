/* Tests of coronae and of their echoes. A corona on the axis is compared with the lamp, and a corona in flat space with
 * closed forms. Other coronae are compared with photons that are spread evenly over the source's sky and integrated in
 * Kerr-Schild coordinates (tests/oracle/kerr_schild.h). */
#include "physics/disk/corona.h"
#include "physics/disk/echo.h"
#include "physics/disk/lamppost.h"
#include "physics/spacetime/kerr.h"

#include "kerr_schild.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))
#define RADIAN (M_PI / 180)

static void within(const char *what, double a, double at, double got, double want, double bound)
{
    if (!(fabs(got - want) <= bound))
        fail_msg("%s at a = %g, %g: %.12g, not %.12g: off by %.2g, allowed %.2g", what, a, at, got, want,
                 fabs(got - want), bound);
}

static struct kd_corona_source source_of(const struct kd_hole *hole, double radius, double height,
                                         enum kd_corona_motion motion)
{
    struct kd_corona_source source;
    assert_true(kd_corona_source_of(hole, radius, height, motion, &source));
    return source;
}

/* A ring of radius 0 equals the lamp. A ring approaches the lamp as its radius goes to 0. */
static void test_axis(void **state)
{
    static const double holes[][2] = { { 0, 0 }, { 0.9, 0 }, { 0.998, 0 }, { -0.7, 0 }, { 0.6, 0.7 } },
                        heights[] = { 3, 10, 100 };
    (void)state;
    for (size_t k = 0; k < COUNT(holes); k++)
        for (size_t n = 0; n < COUNT(heights); n++) {
            const struct kd_hole hole = kd_hole_charged(holes[k][0], holes[k][1]);
            const double isco = kd_kerr_isco(&hole), h = heights[n];
            const struct kd_corona_source lamp = source_of(&hole, 0, h, KD_CORONA_STATIC),
                                          near = source_of(&hole, 1e-3, h, KD_CORONA_ZAMO);
            struct kd_lamppost reference;
            struct kd_corona on, beside;
            assert_true(kd_lamppost_init(&reference, &hole, h, 2.3, isco, 400));
            assert_int_equal(kd_corona_init(&on, &lamp, 2.3, isco, 400), KD_OK);
            assert_int_equal(kd_corona_init(&beside, &near, 2.3, isco, 400), KD_OK);
            assert_int_equal(on.angles, 1);
            for (double r = isco; r < 400; r *= 1.37) {
                within("lamp", hole.a, r, kd_corona_light_at(&on.light, r) / kd_lamppost_at(&reference, r), 1, 2e-5);
                within("beside", hole.a, r, kd_corona_light_at(&beside.light, r) / kd_lamppost_at(&reference, r), 1,
                       2e-4);
            }
            kd_corona_finish(&on);
            kd_corona_finish(&beside);
        }
}

/* Far away, space is flat except for the deflection of light, some 4/b. */
static void test_flat_ring(void **state)
{
    const double radius = 2000, height = 1000;
    const struct kd_corona_source source = source_of(kd_hole(0), radius, height, KD_CORONA_STATIC);
    struct kd_corona corona;
    (void)state;
    assert_int_equal(kd_corona_init(&corona, &source, 2, 500, 9000), KD_OK);
    for (double r = 600; r < 9000; r *= 1.4) {
        double want = 0;
        for (int k = 0; k < 500; k++)
            want += height / (4 * M_PI * 500) *
                    pow(r * r + radius * radius + height * height - 2 * r * radius * cos(2 * M_PI * k / 500), -1.5);
        within("flat ring", 0, r, kd_corona_light_at(&corona.light, r) / want, 1, 0.01);
    }
    kd_corona_finish(&corona);
}

/* Without spin the azimuth of a ray is the integral of b/sqrt(1 - b^2 u^2 (1 - 2u)) over u = 1/r, and its time is the
 * integral of 1/(u^2 (1 - 2u) sqrt(...)). Both are computed by midpoints. */
static void test_direct_time(void **state)
{
    static const double cases[][2] = { { 5, 60 }, { 5, 30 }, { 20, 60 }, { 100, 80 } };
    enum { STEPS = 200000 };
    (void)state;
    for (size_t k = 0; k < COUNT(cases); k++) {
        const double h = cases[k][0], i = cases[k][1] * RADIAN, step = 1 / h / STEPS;
        const struct kd_corona_source source = source_of(kd_hole(0), 0, h, KD_CORONA_STATIC);
        struct kd_corona_direct direct;
        double low = 0, high = h / sqrt(1 - 2 / h), time = 0, flux = 0;
        assert_true(kd_corona_direct_of(&source, 2.5, cos(i), &direct));
        double b = 0, turn[2];
        for (int n = 0; n < 50; n++) {
            double sum = 0;
            b = 0.5 * (low + high);
            for (int j = 0; j < STEPS / 100; j++) {
                const double u = (j + 0.5) * 100 * step;
                sum += 100 * step * b / sqrt(1 - b * b * u * u * (1 - 2 * u));
            }
            *(sum < i ? &low : &high) = b;
        }
        for (int j = 0; j < STEPS; j++) {
            const double u = (j + 0.5) * step;
            time += step * (1 / ((1 - 2 * u) * sqrt(1 - b * b * u * u * (1 - 2 * u))) - 1 - 2 * u) / (u * u);
        }
        within("direct time", 0, h, direct.time, time - h - 2 * log(h), 2e-4);
        within("redshift", 0, h, direct.g, sqrt(1 - 2 / h), 1e-10);
        /* the ring's light is that between neighbouring rays, whose solid angle follows from sin(delta) = b sqrt(1 -
         * 2/h)/h */
        for (int side = 0; side < 2; side++) {
            const double other = b * (side ? 1.001 : 0.999);
            turn[side] = 0;
            for (int j = 0; j < STEPS / 10; j++) {
                const double u = (j + 0.5) * 10 * step;
                turn[side] += 10 * step * other / sqrt(1 - other * other * u * u * (1 - 2 * u));
            }
            flux += (side ? -1 : 1) * sqrt(1 - pow(other * sqrt(1 - 2 / h) / h, 2));
        }
        flux *= pow(1 - 2 / h, 1.25) / (4 * M_PI * (cos(turn[0]) - cos(turn[1])));
        within("direct flux", 0, h, direct.flux / flux, 1, 1e-4);
    }
}

/* A wide corona is the mean of its rings, weighted by their circumferences; the test takes the midpoints of a grid as
 * rings. */
static void test_shapes(void **state)
{
    static const struct kd_corona_shape shapes[] = { { 0, 12, 3, 3, KD_CORONA_ZAMO },
                                                     { 4, 9, 2, 5, KD_CORONA_COROTATING } };
    enum { ACROSS = 16, UP = 8 };
    const double a = 0.7, radii[] = { 3.5, 6, 9.5, 13, 40 }, cos_i = 0.6;
    (void)state;
    for (size_t k = 0; k < COUNT(shapes); k++) {
        const struct kd_corona_shape *s = &shapes[k];
        const int up = s->top > s->height ? UP : 1;
        struct kd_corona_light light;
        struct kd_corona_continuum direct;
        double sum[COUNT(radii)] = { 0 }, all = 0, flux = 0;
        assert_int_equal(kd_corona_light_of(kd_hole(a), s, 2.2, 3.4, 50, &light), KD_OK);
        assert_true(kd_corona_continuum_of(kd_hole(a), s, 2.2, cos_i, &direct));
        for (int i = 0; i < ACROSS * up; i++) {
            const double rho = s->inner + (s->outer - s->inner) * (i / up + 0.5) / ACROSS,
                         z = s->height + (s->top - s->height) * (i % up + 0.5) / up;
            const struct kd_corona_source source = source_of(kd_hole(a), rho, z, s->motion);
            struct kd_corona ring;
            struct kd_corona_direct part;
            assert_int_equal(kd_corona_init(&ring, &source, 2.2, 3.4, 50), KD_OK);
            assert_true(kd_corona_direct_of(&source, 2.2, cos_i, &part));
            for (size_t n = 0; n < COUNT(radii); n++)
                sum[n] += rho * kd_corona_light_at(&ring.light, radii[n]);
            all += rho, flux += rho * part.flux;
            kd_corona_finish(&ring);
        }
        for (size_t n = 0; n < COUNT(radii); n++)
            within("shape", a, radii[n], kd_corona_light_at(&light, radii[n]) / (sum[n] / all), 1, 3e-3);
        within("continuum", a, cos_i, direct.flux / (flux / all), 1, 2e-3);
    }
}

/* A photon of the oracle. r, delay: radius and delay at which it meets the disk. u: cosine of the inclination to which
 * it escapes, or NAN. weight: number of photons that arrive for each emitted photon. */
struct photon { double r, delay, u, weight; };

struct metric { double tt, tp, pp; };

static struct metric metric_at(double a, double r, double u)
{
    const double s2 = 1 - u * u, sigma = r * r + a * a * u * u, f = 2 * r / sigma;
    return (struct metric) { f - 1, -f * a * s2, (r * r + a * a + f * a * a * s2) * s2 };
}

/* u^t of a circular motion with this angular velocity. */
static double ut_of(const struct metric *g, double omega)
{
    return 1 / sqrt(-g->tt - omega * (2 * g->tp + omega * g->pp));
}

/* Sends n photons, evenly distributed over the sphere in the source's frame. */
static void send(double a, double radius, double height, enum kd_corona_motion motion, double photon_index, int n,
                 struct photon *out)
{
    /* a source on the axis is placed beside it, since the oracle has no frame there */
    const double off = fmax(radius, 1e-5 * height), r = hypot(off, height), u = height / r,
                 isco = kd_kerr_isco(kd_hole(a));
    const struct metric g = metric_at(a, r, u);
    const double drag = -g.tp / g.pp, beneath = 1 / (pow(fmax(radius, isco), 1.5) + a),
                 omega = motion == KD_CORONA_STATIC ? 0
                         : motion == KD_CORONA_ZAMO ? drag
                                                    : beneath,
                 lapse = 1 / ut_of(&g, drag), v = radius > 0 ? (omega - drag) * sqrt(g.pp) / lapse : 0,
                 gamma = 1 / sqrt(1 - v * v), ut = gamma / lapse;
    for (int k = 0; k < n; k++) {
        const double z = 1 - 2 * (k + 0.5) / n, turn = k * M_PI * (3 - sqrt(5)), across = sqrt(1 - z * z),
                     m[3] = { z, across * cos(turn), across * sin(turn) }, energy = gamma * (1 + v * m[2]),
                     along = gamma * (m[2] + v) / energy;
        /* The oracle traces light that arrives from a direction. Light that leaves in this direction takes the same
         * path, mirrored in phi. */
        struct ks_photon p =
            ks_from_camera(a, r, atan2(off, height), true, (const double[]) { m[0] / energy, m[1] / energy, -along });
        const struct ks_path path = ks_trace(p, 1);
        out[k] = (struct photon) { .u = NAN, .weight = 1. / n };
        if (path.crossings) {
            const double ring = path.r[0], w = 1 / (pow(ring, 1.5) + a);
            const struct metric gas = metric_at(a, ring, 0);
            const double seen = ring >= isco ? ut_of(&gas, w) * (p.energy - w * p.momentum) * energy : 1;
            out[k].r = ring, out[k].delay = path.delay[0];
            out[k].weight = pow(seen, photon_index - 1) / (n * ut);
        } else if (path.fate == KS_ESCAPED) {
            out[k].u = path.u;
            out[k].weight = pow(p.energy * energy, photon_index - 1) / (n * ut);
        }
    }
}

static const struct {
    double a, radius, height;
    enum kd_corona_motion motion;
} rings[] = { { 0, 10, 5, KD_CORONA_STATIC },
              { 0.9, 6, 3, KD_CORONA_COROTATING },
              { 0.998, 3, 3, KD_CORONA_COROTATING },
              { -0.7, 15, 3, KD_CORONA_ZAMO },
              { 0.9, 0, 4, KD_CORONA_STATIC } };

enum { PHOTONS = 12000 };
static struct photon photons[PHOTONS];

/* Relative error of a count of n photons. For evenly spread points it is smaller than for random points, whose count
 * has the error sqrt(n). */
static double scatter(int n) { return 0.003 + 3 * pow(n, -0.75); }

/* Compares with the oracle the number of photons that arrive between rings of the disk, their mean time, and the number
 * that escapes between two inclinations. */
static void test_photons(void **state)
{
    const double bins[] = { 1, 1.7, 3, 6, 20, 100 }; /* radii of the rings in units of the ISCO */
    (void)state;
    for (size_t k = 0; k < COUNT(rings); k++) {
        const double a = rings[k].a, isco = kd_kerr_isco(kd_hole(a));
        const struct kd_corona_source source = source_of(kd_hole(a), rings[k].radius, rings[k].height, rings[k].motion);
        struct kd_corona corona;
        static double part[KD_CORONA_ANGLES], time[KD_CORONA_ANGLES];
        send(a, rings[k].radius, rings[k].height, rings[k].motion, 2.4, PHOTONS, photons);
        assert_int_equal(kd_corona_init(&corona, &source, 2.4, isco, 110 * isco), KD_OK);
        for (size_t b = 0; b + 1 < COUNT(bins); b++) {
            double want = 0, late = 0, got = 0, got_late = 0;
            int n = 0;
            for (int i = 0; i < PHOTONS; i++)
                if (photons[i].r >= bins[b] * isco && photons[i].r < bins[b + 1] * isco)
                    n++, want += photons[i].weight, late += photons[i].weight * photons[i].delay;
            for (int i = 0; i < 400; i++) {
                const double step = log(bins[b + 1] / bins[b]) / 400, r = isco * bins[b] * exp((i + 0.5) * step);
                kd_corona_parts(&corona, r, part, time);
                for (int j = 0; j < corona.angles; j++) {
                    const double light = part[j] * 2 * M_PI * r * r * step;
                    got += light, got_late += light * time[j];
                }
            }
            /* photons that reach the last bin leave the source within a strip narrower than the spacing of the sampled
             * directions */
            within("photons of a ring", a, bins[b], got / want, 1, b + 2 < COUNT(bins) ? scatter(n) : 2 / sqrt(n));
            within("their mean time", a, bins[b], got_late / got / (late / want), 1,
                   b + 2 < COUNT(bins) ? scatter(n) : 1 / sqrt(n));
        }
        for (double low = 0.3; low < 0.8; low += 0.3) {
            double want = 0, got = 0;
            for (int i = 0; i < PHOTONS; i++)
                want += photons[i].u >= low && photons[i].u < low + 0.3 ? photons[i].weight : 0;
            for (int i = 0; i < 3; i++) {
                const double weight[] = { 5 / 18., 8 / 18., 5 / 18. }, place[] = { 0.1127016654, 0.5, 0.8872983346 };
                struct kd_corona_direct direct;
                assert_true(kd_corona_direct_of(&source, 2.4, low + 0.3 * place[i], &direct));
                got += 2 * M_PI * 0.3 * weight[i] * direct.flux;
            }
            within("direct light", a, low, got / want, 1, 0.008);
        }
        kd_corona_finish(&corona);
    }
}

static struct kd_disk_image image;

/* A lamp at the height h far above a disk that is seen face on. Light from the ring at distance d from the lamp arrives
 * d + h late; h dd/d^2 of the photons hit the disk between d and d + dd. If the gas emits one photon for each, the
 * equivalent width is twice that without a disk. The remaining differences are the deflection of light and its delay of
 * some 4 ln d. */
static void test_flat_echo(void **state)
{
    enum { TIMES = 200 };
    const double h = 1e4, edges[] = { 0.5, 1.5 }, outer = 9e5, inner = 60;
    double share[TIMES], sum = 0;
    const double first = sqrt(h * h + inner * inner), last = hypot(outer, h), all = h / first - h / last;
    struct kd_echo_params params = { inner, outer, 2, KD_LIMB_ISOTROPIC,
                                     source_of(kd_hole(0), 0, h, KD_CORONA_STATIC) };
    struct kd_echo echo;
    struct kd_error error;
    (void)state;
    assert_true(kd_disk_image_init(&image, kd_hole(0), 0));
    assert_int_equal(kd_echo_impulse(&image, &params, edges, 1, 0, 1000, TIMES, share, &echo, &error), KD_OK);
    within("strength", 0, h, echo.strength, 2 * all, 0.01);
    within("direct light", 0, h, 4 * M_PI * echo.direct.flux, 1, 1e-3);
    for (int k = 0; k < TIMES; k++) {
        const double d = fmax((k + 1) * 1000. - h, first);
        sum += share[k];
        within("flat echo", 0, k, sum, (h / first - h / d) / all, 4e-3);
    }
}

/* The echo by rays of the oracle. Light of the image plane is summed as in tests/unit/physics_line.c. Its delay is
 * interpolated from the source's photons that met the disk nearby. */
static int by_radius(const void *x, const void *y)
{
    const struct photon *a = x, *b = y;
    return (a->r > b->r) - (a->r < b->r);
}

static void test_echo(void **state)
{
    enum { BINS = 4, TIMES = 6, ACROSS = 70, AROUND = 60, NEAR = 12 };
    const double edges[BINS + 1] = { 0.2, 0.6, 0.85, 1, 1.5 }, i = 50, outer = 60, step = 12;
    (void)state;
    for (size_t k = 1; k < COUNT(rings); k += 3) { /* the first source is a ring, the second a lamp */
        const double a = rings[k].a, isco = kd_kerr_isco(kd_hole(a)), c = cos(i * RADIAN), s = sin(i * RADIAN);
        const struct kd_echo_params params = { isco, outer, 2.4, KD_LIMB_ISOTROPIC,
                                               source_of(kd_hole(a), rings[k].radius, rings[k].height,
                                                         rings[k].motion) };
        double share[BINS * TIMES], want[BINS * TIMES] = { 0 }, total = 0;
        struct kd_echo echo;
        struct kd_error error;
        struct kd_corona corona;
        assert_true(kd_disk_image_init(&image, kd_hole(a), i * RADIAN));
        assert_int_equal(kd_echo_impulse(&image, &params, edges, BINS, -6, step, TIMES, share, &echo, &error), KD_OK);
        assert_int_equal(kd_corona_init(&corona, &params.source, 2.4, isco, outer), KD_OK);
        send(a, rings[k].radius, rings[k].height, rings[k].motion, 2.4, PHOTONS, photons);
        qsort(photons, PHOTONS, sizeof *photons, by_radius);
        int met = 0;
        while (met < PHOTONS && photons[met].r < isco)
            met++;
        for (int n = 0; n < ACROSS * AROUND; n++) {
            const double width = log(1.3 * outer / 0.8) / ACROSS,
                         rho = 0.8 * exp((n / AROUND + fmod(0.6180339887498949 * (n % AROUND), 1)) * width),
                         chi = 2 * M_PI * (n % AROUND + 0.5) / AROUND, squeeze = c + 0.15, alpha = rho * cos(chi),
                         beta = squeeze * rho * sin(chi);
            const struct ks_path path = ks_trace(ks_from_infinity(a, c, alpha, beta), 1);
            if (!path.crossings || path.r[0] < isco || path.r[0] > outer)
                continue;
            const double r = path.r[0], w = 1 / (pow(r, 1.5) + a);
            const struct metric gas = metric_at(a, r, 0);
            const double g = 1 / (ut_of(&gas, w) * (1 + w * alpha * s)),
                         light = g * g * g * kd_corona_light_at(&corona.light, r) * rho * rho * squeeze;
            int at = met, bin = 0;
            while (at < PHOTONS - NEAR / 2 && photons[at].r < r)
                at++;
            at = at - NEAR / 2 < met ? met : at - NEAR / 2;
            double near = 0;
            for (int j = at; j < at + NEAR; j++)
                near += photons[j].weight;
            while (bin < BINS && g >= edges[bin + 1])
                bin++;
            total += light;
            for (int j = at; j < at + NEAR && bin < BINS; j++) {
                const double time = path.delay[0] + photons[j].delay - echo.direct.time;
                const int late = (int)floor((time + 6) / step);
                if (late >= 0 && late < TIMES)
                    want[bin * TIMES + late] += light * photons[j].weight / near;
            }
        }
        for (int n = 0; n < BINS * TIMES; n++)
            within("echo", a, n, share[n], want[n] / total, 0.006);
        kd_corona_finish(&corona);
    }
}

/* The transform equals the sum over the bins of the impulse response. The bins are short compared with the period. */
static void test_transform(void **state)
{
    enum { BINS = 2, TIMES = 4000 };
    const double edges[BINS + 1] = { 0.2, 0.9, 1.5 }, frequencies[] = { 0, 1e-3, 0.02 };
    static double share[BINS * TIMES], part[BINS * 3 * 2], coarse[BINS * 3 * 2];
    struct kd_echo echo, other;
    struct kd_error error;
    (void)state;
    for (size_t k = 1; k < COUNT(rings); k += 3) {
        const double a = rings[k].a;
        const struct kd_echo_params params = { kd_kerr_isco(kd_hole(a)), 300, 2, KD_LIMB_LAOR,
                                               source_of(kd_hole(a), rings[k].radius, rings[k].height,
                                                         rings[k].motion) };
        assert_true(kd_disk_image_init(&image, kd_hole(a), 35 * RADIAN));
        assert_int_equal(kd_echo_impulse(&image, &params, edges, BINS, -20, 0.25, TIMES, share, &echo, &error), KD_OK);
        assert_int_equal(kd_echo_transform(&image, &params, edges, BINS, frequencies, 3, part, coarse, &other, &error),
                         KD_OK);
        within("strength", a, 0, other.strength / echo.strength, 1, 1e-4);
        for (int bin = 0; bin < BINS; bin++)
            for (int f = 0; f < 3; f++) {
                double re = 0, im = 0;
                for (int t = 0; t < TIMES; t++) {
                    const double phase = 2 * M_PI * frequencies[f] * (-20 + 0.25 * (t + 0.5));
                    re += share[bin * TIMES + t] * cos(phase), im += share[bin * TIMES + t] * sin(phase);
                }
                within("real part", a, frequencies[f], part[2 * (bin * 3 + f)], re, 6e-4);
                within("imaginary part", a, frequencies[f], part[2 * (bin * 3 + f) + 1], im, 6e-4);
                within("told error", a, frequencies[f], coarse[2 * (bin * 3 + f)], re, 3e-3);
            }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_axis),   cmocka_unit_test(test_flat_ring), cmocka_unit_test(test_direct_time),
        cmocka_unit_test(test_shapes), cmocka_unit_test(test_photons),   cmocka_unit_test(test_flat_echo),
        cmocka_unit_test(test_echo),   cmocka_unit_test(test_transform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

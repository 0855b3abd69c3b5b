/* Tests the error that a disk's spectrum states against its true error, over a random sample of spins, radii, limb
 * darkening and frequencies. Inclinations are 80 to 87 degrees, where the image is most curved. At least 999 of 1000
 * must be within the stated error. The true error is found with more rings and directions, and with rays traced
 * individually instead of the table. A repetition with half as many of each gives its uncertainty. Within 3 degrees of
 * edge on, where the spectrum is summed over columns, the true error is found with eight grids of rays, each at a
 * random place of its field.
 *
 *     unit_told_spectra [SPECTRA [SEED [SIDE]]]     a long run: 200 take some ten minutes. With SIDE all are within 3
 *                                                   degrees of edge on, compared with grids of SIDE^2 rays */
#include "base/random.h"
#include "physics/disk/disk_spectrum.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/null/null_geodesic.h"
#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#define RADIAN (M_PI / 180)
#define APART 1e-3
enum { SHORT = 2, SHORT_SIDE = 200, GRIDS = 8, FREQUENCIES = 6, AROUND = 2048, PANELS = 48, GAUSS = 3 };

static int spectra = SHORT, side = SHORT_SIDE;
static uint64_t seed = 1;
static struct kd_disk_image image;

static double between(struct kd_random *random, double low, double high)
{
    return low + (high - low) * kd_random(random);
}

static bool one_in(struct kd_random *random, int n) { return kd_random(random) * n < 1; }

struct asked {
    struct kd_disk_spectrum_params params;
    double spin, inclination_deg, frequencies[FREQUENCIES];
};

static struct asked ask(struct kd_random *random, double least, double most)
{
    struct asked q = { .spin = one_in(random, 4) ? 1 - pow(10, between(random, -6, -2)) : between(random, 0, 0.998),
                       .inclination_deg = between(random, least, most) };
    q.spin = one_in(random, 2) ? -q.spin : q.spin;
    const double isco = kd_kerr_isco(kd_hole(q.spin)),
                 inner = one_in(random, 2) ? isco : isco * exp(between(random, 0, 2));
    q.params = (struct kd_disk_spectrum_params) { inner, inner * exp(between(random, 0.2, 5)), 10, 1e3, 0.2,
                                                  1.6,   (enum kd_limb)(4 * kd_random(random)) };
    for (int f = 0; f < FREQUENCIES; f++)
        q.frequencies[f] = 1e16 * pow(300, f / (FREQUENCIES - 1.));
    return q;
}

static double places[3][2][AROUND];

/* The slope along a ring, by differences of fourth order. */
static double along(const double *x, int j, int n)
{
    return (8 * (x[(j + 1) % n] - x[(j + n - 1) % n]) - (x[(j + 2) % n] - x[(j + n - 2) % n])) / (12 * 2 * M_PI / n);
}

static bool add_ring(const struct asked *q, double r, double weight, int n, double *sum)
{
    const struct kd_disk_spectrum_params *p = &q->params;
    const struct kd_disk_ring gas = kd_disk_image_gas(&image, r);
    const double apart = kd_disk_image_step(&image, r, APART),
                 t = p->colour_correction * kd_disk_temperature(kd_disk_flux_page_thorne(kd_hole(q->spin), r),
                                                                kd_hole(q->spin), p->mass_msun, p->mdot_edd);
    if (!(t > 0))
        return true;
    for (int k = 0; k < 3; k++)
        for (int j = 0; j < n; j++)
            if (!kd_disk_image_place(&image, r * exp((k - 1) * apart), 2 * M_PI * j / n, &places[k][0][j],
                                     &places[k][1][j]))
                return false;
    for (int j = 0; j < n; j++) {
        const double *alpha = places[1][0], *beta = places[1][1];
        const double a_r = (places[2][0][j] - places[0][0][j]) / (2 * apart),
                     b_r = (places[2][1][j] - places[0][1][j]) / (2 * apart),
                     area = fabs(a_r * along(beta, j, n) - b_r * along(alpha, j, n)) * (2 * M_PI / n);
        const struct kd_disk_light light = kd_disk_image_light(&image, &gas, alpha[j], beta[j]);
        for (int f = 0; f < FREQUENCIES; f++)
            sum[f] += weight * area * kd_limb_at(p->limb, light.mu) /
                      expm1(KD_H_J_S * q->frequencies[f] / (KD_K_J_K * t * light.g));
    }
    return true;
}

static bool sum_rings(const struct asked *q, int panels, int n, double *sum)
{
    static const double at[GAUSS] = { -0.7745966692414834, 0, 0.7745966692414834 },
                        share[GAUSS] = { 5. / 18, 8. / 18, 5. / 18 };
    const double span = log(q->params.outer / q->params.inner);
    for (int i = 0; i < panels; i++)
        for (int k = 0; k < GAUSS; k++) {
            const double s = (i + 0.5 + 0.5 * at[k]) / panels;
            if (!add_ring(q, q->params.inner * exp(span * s * s), span * 2 * s * share[k] / panels, n, sum))
                return false;
        }
    return true;
}

/* The sum over one ray in each field of a grid over the image plane, even in asinh(alpha/2) and asinh(beta/0.2). Past
 * the outer edge a ray meets the lower face. */
static void sum_grid(const struct asked *q, struct kd_random *random, double *sum)
{
    const struct kd_disk_spectrum_params *p = &q->params;
    const double u = fabs(cos(q->inclination_deg * RADIAN)), outer = p->outer, wide = asinh((outer + 8) / 2),
                 high = asinh((outer * u + 2 * sqrt(outer) + 10) / 0.2);
    for (int k = 0; k < side * side; k++) {
        const double x = wide * (2 * (k / side + kd_random(random)) / side - 1),
                     y = high * (2 * (k % side + kd_random(random)) / side - 1);
        const struct kd_null_ray ray = { .hole = image.hole,
                                         .radius = INFINITY,
                                         .cos_theta = u,
                                         .alpha = 2 * sinh(x),
                                         .beta = 0.2 * sinh(y),
                                         .orders = 2 };
        const struct kd_null_path path = kd_null_trace_fast(&ray);
        const int at = path.crossings > 1 && path.crossing[0].r > outer;
        const double r = path.crossing[at].r;
        if (!path.crossings || r < p->inner || r > outer)
            continue;
        const struct kd_disk_ring gas = kd_disk_image_gas(&image, r);
        const struct kd_disk_light light = kd_disk_image_light(&image, &gas, ray.alpha, ray.beta);
        const double t = p->colour_correction * kd_disk_temperature(kd_disk_flux_page_thorne(&image.hole, r),
                                                                    &image.hole, p->mass_msun, p->mdot_edd),
                     area = 1.6 * wide * high * cosh(x) * cosh(y) / ((double)side * side);
        for (int f = 0; f < FREQUENCIES && t > 0; f++)
            sum[f] +=
                area * kd_limb_at(p->limb, light.mu) / expm1(KD_H_J_S * q->frequencies[f] / (KD_K_J_K * t * light.g));
    }
}

/* The mean over all grids, and four standard errors of it in units of the mean. */
static void sum_grids(const struct asked *q, struct kd_random *random, double *mean, double *unsure)
{
    double sum[GRIDS][FREQUENCIES] = { 0 };
    for (int k = 0; k < GRIDS; k++)
        sum_grid(q, random, sum[k]);
    for (int f = 0; f < FREQUENCIES; f++) {
        double spread = 0;
        for (int k = 0; k < GRIDS; k++)
            mean[f] += sum[k][f] / GRIDS;
        for (int k = 0; k < GRIDS; k++)
            spread += pow(sum[k][f] / mean[f] - 1, 2);
        unsure[f] = 4 * sqrt(spread / (GRIDS * (GRIDS - 1)));
    }
}

static void compare(double least, double most, int wanted)
{
    struct kd_random random = { seed };
    int beyond = 0, asked = 0;
    while (asked < wanted) {
        const struct asked q = ask(&random, least, most);
        double flux[FREQUENCIES], fine[FREQUENCIES] = { 0 }, rough[FREQUENCIES] = { 0 }, unsure[FREQUENCIES], told,
                                  off = 0, known = 0, out = 0, largest = 0, scale[FREQUENCIES];
        struct kd_error error;
        assert_true(kd_disk_image_init(&image, kd_hole(q.spin), q.inclination_deg * RADIAN));
        if (kd_disk_spectrum(&image, &q.params, q.frequencies, FREQUENCIES, flux, &told, &error))
            continue;
        if (!image.angles)
            sum_grids(&q, &random, fine, unsure);
        else if (!sum_rings(&q, PANELS, AROUND, fine) || !sum_rings(&q, PANELS / 2, AROUND / 2, rough))
            continue;
        const double f2 = q.params.colour_correction * q.params.colour_correction,
                     length = KD_M_SUN_M * q.params.mass_msun / (q.params.distance_pc * KD_PARSEC_M) / f2,
                     limb = q.params.limb == KD_LIMB_LAOR ? 0.5 / (0.5 + 2.06 / 3) : 1;
        for (int f = 0; f < FREQUENCIES; f++) {
            scale[f] = 2 * KD_H_J_S * pow(q.frequencies[f], 3) / (KD_C_M_S * KD_C_M_S) * length * length * limb;
            largest = fmax(largest, flux[f]);
        }
        for (int f = 0; f < FREQUENCIES; f++)
            if (flux[f] > 1e-6 * largest) {
                const double here = fabs(flux[f] / (scale[f] * fine[f]) - 1),
                             doubt = image.angles ? fabs(rough[f] / fine[f] - 1) : unsure[f];
                off = fmax(off, here), known = fmax(known, doubt), out = fmax(out, here - doubt);
            }
        asked++;
        beyond += (image.angles ? off - known : out) > told;
        if (off > 0.7 * told)
            print_message("a = %.17g, i = %.17g, %g to %g M, limb %d: told %.2e, off by %.2e +- %.1e\n", q.spin,
                          q.inclination_deg, q.params.inner, q.params.outer, (int)q.params.limb, told, off, known);
    }
    print_message("%d of %d beyond the stated error\n", beyond, asked);
    assert_true(1000 * beyond <= asked);
}

static void test_spectra(void **state)
{
    (void)state;
    compare(80, 87, spectra);
}

static void test_edge_on(void **state)
{
    (void)state;
    compare(87, 93, spectra);
}

int main(int count, char **words)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_edge_on), cmocka_unit_test(test_spectra) };
    spectra = count > 1 ? atoi(words[1]) : SHORT;
    seed = count > 2 ? strtoull(words[2], NULL, 10) : 1;
    side = count > 3 ? atoi(words[3]) : SHORT_SIDE;
    cmocka_set_test_filter(count > 3 ? "test_edge_on" : NULL);
    return cmocka_run_group_tests(tests, NULL, NULL);
}

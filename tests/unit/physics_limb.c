/* Tests of the laws of limb darkening: the scattering atmosphere is compared with closed integrals in 30 digits
 * (tests/oracle/scattering_reference.py). Also tested: the flux of each law, and the light that a distant ring sends to
 * each inclination. */
#include "physics/disk/disk_spectrum.h"
#include "physics/disk/limb.h"
#include "physics/disk/line_profile.h"
#include "physics/disk/scattering.h"

#include "line_triangles.h"
#include "scattering_reference.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))
#define RADIAN (M_PI / 180)

static struct kd_disk_image image;

static void test_atmosphere(void **state)
{
    double worst[2] = { 0, 0 };
    (void)state;
    for (size_t k = 0; k < COUNT(scattering_reference); k++) {
        const double across = scattering_reference[k].across, along = scattering_reference[k].along;
        struct kd_scattered light;
        kd_scattered_light(&scattering_reference[k].mu, 1, &light);
        worst[0] = fmax(worst[0], fmax(fabs(light.across - across), fabs(light.along - along)));
        worst[1] = fmax(worst[1], fabs(kd_limb_at(KD_LIMB_SCATTERING, scattering_reference[k].mu) - (across + along)));
    }
    printf("scattered light: off by %.1e, by the table %.1e\n", worst[0], worst[1]);
    assert_true(worst[0] < 1e-8 && worst[1] < 2e-8);
}

static void test_table(void **state)
{
    enum { N = 997 };
    double mu[N], worst = 0;
    struct kd_scattered light[N];
    (void)state;
    for (int i = 0; i < N; i++)
        mu[i] = pow((i + 0.3) / N, 4);
    kd_scattered_light(mu, N, light);
    for (int i = 0; i < N; i++)
        worst = fmax(worst, fabs(kd_limb_at(KD_LIMB_SCATTERING, mu[i]) - light[i].across - light[i].along));
    printf("between the table's nodes: off by %.1e\n", worst);
    assert_true(worst < 1e-8);
}

/* A surface of each law radiates as much as an isotropic one: Int f mu dmu = 1/2, by the midpoint rule in the square
 * root of mu. */
static void test_flux(void **state)
{
    enum { N = 20000 };
    (void)state;
    for (int law = KD_LIMB_ISOTROPIC; law <= KD_LIMB_SCATTERING; law++) {
        double sum = 0;
        for (int i = 0; i < N; i++) {
            const double x = (i + 0.5) / N;
            sum += kd_limb_at((enum kd_limb)law, x * x) * x * x * 2 * x / N;
        }
        if (!(fabs(sum * kd_limb_scale((enum kd_limb)law) - 0.5) < 1e-7))
            fail_msg("law %d: the flux is %.9g", law, sum * kd_limb_scale((enum kd_limb)law));
    }
}

static double flux_of(double r, double mu, enum kd_limb law)
{
    const struct kd_disk_spectrum_params params = { r, 1.2 * r, 10, 1e4, 0.1, 1.7, law };
    const double nu = 1e13;
    double flux, off;
    struct kd_error error;
    assert_true(kd_disk_image_init(&image, kd_hole(0.5), acos(mu)));
    assert_int_equal(kd_disk_spectrum(&image, &params, &nu, 1, &flux, &off, &error), KD_OK);
    return flux;
}

/* A ring of 1e5 M is nearly at rest in flat space: it sends f(cos i) times the light of an isotropic one to each
 * inclination. The remaining differences are aberration, v^2 = 1e-5, and the bending of light, 1/r. Over all
 * inclinations, by Gauss's rule, the sums agree: light is conserved. */
static void test_distant_ring(void **state)
{
    static const double at[4] = { 0.0694318442029737, 0.330009478207572, 0.669990521792428, 0.930568155797026 },
                        weight[4] = { 0.173927422568727, 0.326072577431273, 0.326072577431273, 0.173927422568727 };
    (void)state;
    for (int law = KD_LIMB_LAOR; law <= KD_LIMB_SCATTERING; law++) {
        double sum = 0, all = 0, worst = 0;
        for (int k = 0; k < 4; k++) {
            const double even = flux_of(1e5, at[k], KD_LIMB_ISOTROPIC), here = flux_of(1e5, at[k], (enum kd_limb)law),
                         want = kd_limb_at((enum kd_limb)law, at[k]) * kd_limb_scale((enum kd_limb)law);
            worst = fmax(worst, fabs(here / even / want - 1));
            sum += weight[k] * here, all += weight[k] * even;
        }
        printf("law %d: off by %.1e in one direction, by %.1e over all\n", law, worst, fabs(sum / all - 1));
        assert_true(worst < 2e-4 && fabs(sum / all - 1) < (law == KD_LIMB_HAARDT ? 5e-3 : 5e-4));
    }
}

static double scattered_cube(const void *user, double r, double g, double mu)
{
    (void)user;
    return kd_limb_at(KD_LIMB_SCATTERING, mu) * pow(r, -3) * g * g * g;
}

/* Lines of a scattering atmosphere, compared with triangles between rays (tests/oracle/line_triangles.h). They must
 * differ from the line of an isotropic surface by more than the errors of both. */
static void test_lines(void **state)
{
    static const struct { double a, i; } cases[] = { { 0, 30 }, { 0.9, 60 }, { 0.998, 75 }, { -0.9, 45 } };
    enum { BINS = 200 };
    double edges[BINS + 1], want[BINS], share[BINS], even[BINS];
    (void)state;
    for (int e = 0; e <= BINS; e++)
        edges[e] = 1.7 * e / BINS;
    for (size_t k = 0; k < COUNT(cases); k++) {
        assert_true(kd_disk_image_init(&image, kd_hole(cases[k].a), cases[k].i * RADIAN));
        const struct lt_law law = { image.isco, 400, scattered_cube, NULL };
        struct kd_line_params params = { .inner = image.isco, .outer = 400, .index = 3, .limb = KD_LIMB_SCATTERING };
        struct kd_line_profile profile;
        struct kd_error error;
        double sum = 0, worst = 0, moved = 0, before = 0;
        const double apart = lt_profile_of(&image, &law, 400, 1024, edges, BINS, want);
        assert_true(apart >= 0);
        assert_int_equal(kd_line_profile(&image, &params, edges, BINS, share, &profile, &error), KD_OK);
        params.limb = KD_LIMB_ISOTROPIC;
        const double error_told = profile.error;
        assert_int_equal(kd_line_profile(&image, &params, edges, BINS, even, &profile, &error), KD_OK);
        for (int e = 0; e < BINS; e++) {
            sum += share[e], before += even[e];
            worst = fmax(worst, fabs(sum - want[e]));
            moved = fmax(moved, fabs(sum - before));
        }
        printf("line at a = %g, i = %g: off by %.1e, told %.1e, the triangles %.1e; isotropic differs by %.1e\n",
               cases[k].a, cases[k].i, worst, error_told, apart, moved);
        assert_true(worst <= error_told + 0.25 * apart && worst < 1e-3 && moved > 5 * worst);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_atmosphere), cmocka_unit_test(test_table),
                                        cmocka_unit_test(test_flux), cmocka_unit_test(test_distant_ring),
                                        cmocka_unit_test(test_lines) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

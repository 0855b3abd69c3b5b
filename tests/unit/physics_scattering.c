/* Tests of light from an electron-scattering atmosphere, compared with Chandrasekhar's table and with the flux that
 * leaves it. */
#include "physics/disk/scattering.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Table XXIV, I_l + I_r over F and the fraction polarised in per cent, at mu = 0, 0.1, 0.2 ... of Radiative Transfer
 * (1960). */
static const struct {
    double mu, light, per_cent;
} table[] = {
    { 0, 0.41441, 11.713 },  { 0.1, 0.52397, 7.448 }, { 0.2, 0.61439, 5.410 }, { 0.3, 0.70029, 4.041 },
    { 0.4, 0.78398, 3.033 }, { 0.5, 0.86637, 2.252 }, { 0.6, 0.94789, 1.627 }, { 0.7, 1.02882, 1.113 },
    { 0.8, 1.10931, 0.682 }, { 1, 1.26938, 0 },
};

static void as_printed(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        struct kd_scattered light;
        kd_scattered_light(&table[i].mu, 1, &light);
        if (!(fabs(light.across + light.along - table[i].light) < 1.2e-5 &&
              fabs(100 * kd_scattered_fraction(&light) - table[i].per_cent) < 1.2e-3))
            fail_msg("mu = %g: %.6f, %.5f %%", table[i].mu, light.across + light.along,
                     100 * kd_scattered_fraction(&light));
    }
}

/* The flux that leaves is the flux that entered: twice the integral of I mu is F. */
static void flux_comes_out(void **state)
{
    (void)state;
    enum { N = 400 };
    double mu[N], sum = 0;
    struct kd_scattered light[N];
    for (int i = 0; i < N; i++)
        mu[i] = (i + 0.5) / N;
    kd_scattered_light(mu, N, light);
    for (int i = 0; i < N; i++)
        sum += 2 * mu[i] * (light[i].across + light[i].along) / N;
    assert_true(fabs(sum - 1) < 1e-5);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(as_printed), cmocka_unit_test(flux_comes_out) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

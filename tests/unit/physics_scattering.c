/* Tests of light from an electron-scattering atmosphere, compared with Chandrasekhar's table and with the flux that
 * leaves it. */
#include "physics/disk/scattering.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

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

/* Follows photons that fall on the atmosphere at a cosine until they leave. Thomson scattering changes their Stokes
 * parameters, computed from field amplitudes in three dimensions; directions are drawn by rejection. A photon is
 * dropped after CAP scatterings, which happens to a few in a thousand. */
enum { PHOTONS = 60000, CAP = 3000, BINS = 4 };
static uint64_t seed = 1;
static double drawn(void)
{
    seed ^= seed << 13, seed ^= seed >> 7, seed ^= seed << 17;
    return (double)(seed >> 11) / 9007199254740992.;
}

static double dot(const double *a, const double *b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/* Unit vectors of increasing angle from the normal, and of increasing azimuth. */
static void bases(const double n[3], double l[3], double r[3])
{
    const double level = hypot(n[0], n[1]);
    l[0] = n[2] * n[0] / level, l[1] = n[2] * n[1] / level, l[2] = -level;
    r[0] = -n[1] / level, r[1] = n[0] / level, r[2] = 0;
}

/* Scatters light into the direction n, and returns the ratio of the intensity to its maximum. stokes: I_l, I_r and U,
 * with I_l + I_r = 1. */
static double scattered_into(const double from[3], const double stokes[3], const double n[3], double out[3])
{
    double l0[3], r0[3], l[3], r[3];
    bases(from, l0, r0);
    bases(n, l, r);
    const double ll = dot(l, l0), lr = dot(l, r0), rl = dot(r, l0), rr = dot(r, r0);
    out[0] = ll * ll * stokes[0] + lr * lr * stokes[1] + ll * lr * stokes[2];
    out[1] = rl * rl * stokes[0] + rr * rr * stokes[1] + rl * rr * stokes[2];
    out[2] = 2 * ll * rl * stokes[0] + 2 * lr * rr * stokes[1] + (ll * rr + lr * rl) * stokes[2];
    return out[0] + out[1];
}

/* Stokes parameters of light that leaves, summed in bins of its cosine, times 1, cos, sin, cos 2x and sin 2x. */
static void follow(double mu0, const double light[3], double sums[BINS][3][5])
{
    for (int photon = 0; photon < PHOTONS; photon++) {
        double n[3] = { sqrt(1 - mu0 * mu0), 0, -mu0 }, stokes[3] = { light[0], light[1], light[2] }, depth = 0;
        for (int i = 0; i < CAP; i++) {
            depth += n[2] * log(1 - drawn());
            if (depth < 0)
                break;
            double to[3], out[3], strength;
            do {
                const double z = 2 * drawn() - 1, x = 2 * M_PI * drawn(), level = sqrt(1 - z * z);
                to[0] = level * cos(x), to[1] = level * sin(x), to[2] = z;
                strength = scattered_into(n, stokes, to, out);
            } while (drawn() > strength);
            for (int k = 0; k < 3; k++)
                n[k] = to[k], stokes[k] = out[k] / strength;
        }
        if (!(depth < 0))
            continue;
        const double x = atan2(n[1], n[0]), angle[5] = { 1, cos(x), sin(x), cos(2 * x), sin(2 * x) };
        double (*bin)[5] = sums[(int)fmin(BINS * n[2], BINS - 1)];
        for (int k = 0; k < 3; k++)
            for (int m = 0; m < 5; m++)
                bin[k][m] += stokes[k] * angle[m] / PHOTONS;
    }
}

static void light_is_reflected_like_photons(void **state)
{
    (void)state;
    static const struct {
        double mu0, light[3];
    } cases[] = {
        { 0.3, { 0.5, 0.5, 0 } },
        { 0.8, { 1, 0, 0 } },
        { 0.55, { 0.2, 0.8, 0.8 } },
        { 0.1, { 0.5, 0.5, -1 } },
    };
    for (size_t n = 0; n < sizeof cases / sizeof *cases; n++) {
        const double mu0 = cases[n].mu0;
        double sums[BINS][3][5] = { { { 0 } } };
        struct kd_scattering_functions in;
        follow(mu0, cases[n].light, sums);
        kd_scattering_functions(&mu0, 1, &in);
        for (int b = 0; b < BINS; b++) {
            enum { STEPS = 60 };
            double want[3][5] = { { 0 } }, mu[STEPS];
            struct kd_scattering_functions at[STEPS];
            for (int i = 0; i < STEPS; i++)
                mu[i] = (b + (i + 0.5) / STEPS) / BINS;
            kd_scattering_functions(mu, STEPS, at);
            for (int i = 0; i < STEPS; i++) {
                struct kd_reflected_stokes out;
                kd_scattering_reflect(&at[i], mu[i], &in, mu0, cases[n].light, &out);
                const double *const all[3] = { out.l, out.r, out.u };
                for (int k = 0; k < 3; k++)
                    /* weight: a photon counts mu times the intensity; the mean of a squared cosine or sine is 1/2 */
                    for (int m = 0; m < 5; m++)
                        want[k][m] += all[k][m] * (m ? M_PI : 2 * M_PI) * mu[i] / (STEPS * BINS) / mu0;
            }
            const char *const names = "lru";
            for (int k = 0; k < 3; k++)
                for (int m = 0; m < 5; m++)
                    if (!(fabs(sums[b][k][m] - want[k][m]) < 4 * sqrt(0.12 / PHOTONS) + 1e-3))
                        fail_msg("mu0 %g, case %zu, bin %d, %c %d: %.5f, by photons %.5f", mu0, n, b, names[k], m,
                                 want[k][m], sums[b][k][m]);
        }
    }
}

/* All light that enters leaves again: 2 pi times the integral of mu I is mu0. */
static void reflection_loses_nothing(void **state)
{
    (void)state;
    enum { POINTS = 400 };
    double mu[POINTS];
    struct kd_scattering_functions at[POINTS], in;
    for (int i = 0; i < POINTS; i++)
        mu[i] = pow((i + 0.5) / POINTS, 2);
    kd_scattering_functions(mu, POINTS, at);
    for (double mu0 = 0.02; mu0 < 1; mu0 += 0.14) {
        kd_scattering_functions(&mu0, 1, &in);
        for (int across = 0; across < 2; across++) {
            const double light[3] = { !across, across, 0 };
            double sum = 0;
            for (int i = 0; i < POINTS; i++) {
                struct kd_reflected_stokes out;
                kd_scattering_reflect(&at[i], mu[i], &in, mu0, light, &out);
                sum += 2 * M_PI * mu[i] * (out.l[0] + out.r[0]) * 2 * (i + 0.5) / POINTS / POINTS;
            }
            assert_true(fabs(sum / mu0 - 1) < 1e-4);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(as_printed), cmocka_unit_test(light_is_reflected_like_photons),
                                        cmocka_unit_test(reflection_loses_nothing), cmocka_unit_test(flux_comes_out) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

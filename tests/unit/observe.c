/* Tests of observations. chi^2 of a model ring is computed for an observation of M87* (data/eht), from its uvfits and
 * its CSV file, and compared with results of ehtim 1.3.2. Other tests: searches for size, orientation and position; the
 * scattering kernel; damaged files. */
#include "observe/align.h"
#include "observe/scattering.h"
#include "observe/simulate.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define PIXEL (4 * M_PI / 180 / 3.6e9) /* width of a pixel of the ring's picture */
enum { N = 32, MOST = 1 << 18, BLOCK = 2880 };

static uint8_t *read_file(const char *name, size_t *size)
{
    char path[600];
    snprintf(path, sizeof path, KD_DATA "/%s", name);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    uint8_t *data = malloc(MOST);
    *size = fread(data, 1, MOST, file);
    fclose(file);
    return data;
}

static struct kd_observation read_observation(const char *name)
{
    size_t size;
    struct kd_error error = { 0 };
    struct kd_observation o;
    uint8_t *data = read_file(name, &size);
    if (kd_observation_read(data, size, &o, &error))
        fail_msg("%s", error.message);
    free(data);
    return o;
}

/* The visibilities of a ring of 0.8 Jy that is brighter in the south. The picture is interpolated linearly (a
 * triangular pulse for each pixel). The transform is a direct double sum over the pixels. */
static void transform(const struct kd_comparison *c, double (*out)[2])
{
    double light[N][N], sum = 0;
    for (int j = 0; j < N; j++)
        for (int i = 0; i < N; i++) {
            const double x = i - (N - 1) / 2., y = j - (N - 1) / 2., r = hypot(x, y);
            sum += light[j][i] = exp(-((4 * r - 20) / 6) * ((4 * r - 20) / 6)) * (1 + 0.6 * y / fmax(r, 1e-9));
        }
    for (size_t k = 0; k < c->n; k++) {
        const double u = c->at[k].u * PIXEL, v = c->at[k].v * PIXEL;
        out[k][0] = out[k][1] = 0;
        for (int j = 0; j < N; j++)
            for (int i = 0; i < N; i++) {
                const double turns = -u * (i - (N - 1) / 2.) - v * (j - (N - 1) / 2.);
                out[k][0] += light[j][i] * cos(2 * M_PI * turns), out[k][1] += light[j][i] * sin(2 * M_PI * turns);
            }
        for (int part = 0; part < 2; part++)
            out[k][part] *= 0.8 / sum * kd_pulse_at(KD_PULSE_TRIANGLE, u, v);
    }
}

/* ehtim: load_uvfits, avg_coherent, add_fractional_noise, flag_uvdist, chisq of ttype "direct". */
enum { OLD = KD_PRODUCT_VISIBILITY }; /* number of products in this table */
static const struct {
    struct kd_comparison_params params;
    size_t n[OLD];
    double chi2[OLD];
} by_ehtim[] = {
    { { 7, 0, 0, 0, 0, 0, 0, false, false },
      { 1507, 938, 800 },
      { 750.7007417311627, 1.6528202960195866, 1.500937870578423 } },
    { { 7, 120, 0.1, 0.01, 0.02, 2, 3, false, false },
      { 109, 42, 27 },
      { 1229.8575745055314, 6.460620565872508, 2.0503941955436065 } },
    { { 7, 600, 0.1, 0, 0.01, 2, 0, true, false },
      { 46, 19, 18 },
      { 3569.980238767959, 13.137640700778244, 5.293414217705537 } },
    { { 7, 60, 0, 0, 0, 0, 2, false, true },
      { 219, 193, 293 },
      { 4993.146620167559, 2.9167522716544156, 13.862762051503408 } },
    { { 7, 70, 0, 0, 0, 0, 2, false, false },
      { 216, 128, 80 },
      { 5065.686103305162, 3.978760837143336, 11.242809018326296 } },
};

/* UVFITS: the tolerance is 1e-6. The measured difference is 2e-8, because ehtim keeps weights, and means of the
 * parallel hands, in single precision. The CSV has amplitudes to 1e-8 Jy and phases to 1e-4 degrees, so the tolerance
 * is 1e-3 for chi^2. It is 0.2 for log closure amplitudes without a cut: where an amplitude is about as large as its
 * error, sqrt(|V|^2 - sigma^2) consists of rounding error. */
static void test_chi2_is_that_of_ehtim(void **state)
{
    (void)state;
    static const char *const files[] = { "m87-2017-04-05-lo.uvfits", "m87-2017-04-05-lo.csv" };
    for (int f = 0; f < 2; f++) {
        struct kd_observation o = read_observation(files[f]);
        for (size_t i = 0; i < sizeof by_ehtim / sizeof *by_ehtim; i++) {
            struct kd_comparison c;
            struct kd_error error = { 0 };
            double chi2[KD_PRODUCTS];
            assert_int_equal(kd_comparison_make(&o, &by_ehtim[i].params, &c, &error), KD_OK);
            double (*model)[2] = malloc(c.n * sizeof *model);
            transform(&c, model);
            kd_comparison_judge(&c, (const double (*)[2])model, chi2);
            for (int p = 0; p < OLD; p++) {
                const double off = chi2[p] / by_ehtim[i].chi2[p] - 1, bound = !f ? 1e-6 : p < 2 || i ? 1e-3 : 0.2;
                assert_int_equal(c.of[p], by_ehtim[i].n[p]);
                if (!(fabs(off) <= bound))
                    fail_msg("%s, set %zu, product %d: %.10g, not %.10g (%.1e)", files[f], i, p, chi2[p],
                             by_ehtim[i].chi2[p], off);
            }
            free(model);
            kd_comparison_finish(&c);
        }
        kd_observation_finish(&o);
    }
}

/* chi^2 of real and imaginary parts: ehtim's chisq of dtype "vis". */
static void test_chi2_of_visibilities_is_that_of_ehtim(void **state)
{
    (void)state;
    static const struct {
        struct kd_comparison_params params;
        size_t n;
        double chi2;
    } sets[] = {
        { { .products = 1u << KD_PRODUCT_VISIBILITY }, 1507, 6532.976550725411 },
        { { 1u << KD_PRODUCT_VISIBILITY, 120, 0.1, 0.01, 0.02, 2, 3, false, false }, 109, 1409.1587750975264 }
    };
    struct kd_observation o = read_observation("m87-2017-04-05-lo.uvfits");
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        struct kd_comparison c;
        struct kd_error error = { 0 };
        double chi2[KD_PRODUCTS];
        assert_int_equal(kd_comparison_make(&o, &sets[i].params, &c, &error), KD_OK);
        double (*model)[2] = malloc(c.n * sizeof *model);
        transform(&c, model);
        kd_comparison_judge(&c, (const double (*)[2])model, chi2);
        assert_int_equal(c.of[KD_PRODUCT_VISIBILITY], 2 * sets[i].n);
        assert_true(isnan(chi2[KD_PRODUCT_AMPLITUDE]));
        if (!(fabs(chi2[KD_PRODUCT_VISIBILITY] / sets[i].chi2 - 1) <= 1e-6))
            fail_msg("set %zu: %.10g, not %.10g", i, chi2[KD_PRODUCT_VISIBILITY], sets[i].chi2);
        free(model);
        kd_comparison_finish(&c);
    }
    kd_observation_finish(&o);
}

/* The model in closed form: a ring of 30 Gaussians of 4 uas, brighter in one direction. */
#define UAS (M_PI / 180 / 3.6e9)
struct sources { const struct kd_comparison *c; };
static void sources_at(const struct kd_comparison *c, double size, double angle_deg, double (*out)[2])
{
    for (size_t k = 0; k < c->n; k++) {
        const double u = c->at[k].u, v = c->at[k].v, width = 4 * UAS * size;
        out[k][0] = out[k][1] = 0;
        for (int i = 0; i < 30; i++) {
            const double place = 2 * M_PI * i / 30, from_north = place + angle_deg * M_PI / 180,
                         light = (1 + 0.7 * cos(place) + 0.2 * sin(2 * place)) / 30, r = 20 * UAS * size,
                         turns = r * (u * sin(from_north) + v * cos(from_north));
            out[k][0] += light * cos(2 * M_PI * turns), out[k][1] += light * sin(2 * M_PI * turns);
        }
        for (int part = 0; part < 2; part++)
            out[k][part] *= exp(-2 * M_PI * M_PI * width * width * (u * u + v * v));
    }
}
static void sources_model(void *user, double size, double angle_deg, double (*out)[2])
{
    sources_at(((const struct sources *)user)->c, size, angle_deg, out);
}

/* The observation is replaced by a model of known size, angle, position and flux. The search starts from a model of
 * another size and angle, and must find these values: to 1e-4 without noise, from all data and from closures alone. A
 * search whose size lies beyond the bounds must end at the bound and report it. */
static void test_size_angle_and_position_are_found(void **state)
{
    (void)state;
    static const struct {
        double size, angle_deg, east_uas, north_uas, flux;
        unsigned products, solve;
        bool converges;
    } cases[] = {
        { 1.31, 141, 0, 0, 0.6, 7, KD_ALIGN_FLUX | KD_ALIGN_SIZE | KD_ALIGN_ANGLE, true },
        { 0.74, -95, 0, 0, 1, 6, KD_ALIGN_SIZE | KD_ALIGN_ANGLE, true },
        { 1, 33, 0, 0, 1, 2, KD_ALIGN_ANGLE, true },
        { 1.7, 0, 0, 0, 2.5, 1, KD_ALIGN_FLUX | KD_ALIGN_SIZE, true },
        { 1, 0, 23, -31, 0.8, 8, KD_ALIGN_FLUX | KD_ALIGN_SHIFT, true },
        { 0.9, -20, -12, 17, 0.8, 15, KD_ALIGN_FLUX | KD_ALIGN_SIZE | KD_ALIGN_ANGLE | KD_ALIGN_SHIFT, true },
        { 3, 0, 0, 0, 1, 1, KD_ALIGN_SIZE, false },
    };
    struct kd_align_room *room = malloc(sizeof *room);
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_observation o = read_observation("m87-2017-04-05-lo.uvfits");
        struct kd_comparison seen = { .at = o.at, .n = o.n }, c;
        struct kd_error error = { 0 };
        double (*model)[2] = malloc(o.n * sizeof *model);
        o.n = seen.n = 500; /* some hours of the night suffice */
        sources_at(&seen, cases[i].size, cases[i].angle_deg, model);
        kd_align_shift(&seen, cases[i].east_uas * UAS, cases[i].north_uas * UAS, model);
        for (size_t k = 0; k < o.n; k++)
            o.at[k].re = cases[i].flux * model[k][0], o.at[k].im = cases[i].flux * model[k][1];
        assert_int_equal(kd_comparison_make(&o,
                                            &(struct kd_comparison_params) {
                                                .products = cases[i].products, .measured = true, .uv_min_gl = 0.1 },
                                            &c, &error),
                         KD_OK);
        struct sources sources = { &c };
        struct kd_alignment found = KD_ALIGNMENT_NONE;
        kd_align(&c, &(struct kd_align_params) { cases[i].solve, 60 * UAS, sources_model, &sources }, room, model,
                 &found);
        bool converged = true;
        for (int k = 0; k < 4; k++)
            converged &= found.converged[k];
        if (found.evaluations > kd_align_evaluations(cases[i].solve))
            fail_msg("case %zu: %u evaluations", i, found.evaluations);
        assert_int_equal(converged, cases[i].converges);
        if (cases[i].converges &&
            !(fabs(found.size / cases[i].size - 1) < 1e-4 &&
              fabs(remainder(found.angle_deg - cases[i].angle_deg, 360)) < 1e-2 &&
              fabs(found.east / UAS - cases[i].east_uas) < 1e-2 &&
              fabs(found.north / UAS - cases[i].north_uas) < 1e-2 && fabs(found.scale / cases[i].flux - 1) < 1e-4))
            fail_msg("case %zu: size %g, angle %g, shift %g %g, flux %g", i, found.size, found.angle_deg,
                     found.east / UAS, found.north / UAS, found.scale);
        if (!cases[i].converges)
            assert_true(fabs(found.size - KD_ALIGN_MOST_SIZE) < 1e-6);
        free(model);
        kd_comparison_finish(&c);
        kd_observation_finish(&o);
    }
    free(room);
}

static void dark(void *user, double size, double angle_deg, double (*out)[2])
{
    (void)size, (void)angle_deg;
    memset(out, 0, ((const struct sources *)user)->c->n * sizeof *out);
}

/* For a model without light, chi^2 of log closure amplitudes is not finite, and a search with such a model does not
 * converge. */
static void test_a_search_without_light(void **state)
{
    (void)state;
    struct kd_observation o = read_observation("m87-2017-04-05-lo.csv");
    struct kd_comparison c;
    struct kd_error error = { 0 };
    struct kd_alignment found = KD_ALIGNMENT_NONE;
    assert_int_equal(kd_comparison_make(&o, &(struct kd_comparison_params) { .products = 4 }, &c, &error), KD_OK);
    double (*model)[2] = malloc(c.n * sizeof *model);
    struct kd_align_room *room = malloc(sizeof *room);
    struct sources sources = { &c };
    kd_align(&c, &(struct kd_align_params) { KD_ALIGN_SIZE | KD_ALIGN_ANGLE, 1e-9, dark, &sources }, room, model,
             &found);
    assert_false(found.converged[1] || found.converged[2]);
    free(room);
    free(model);
    kd_comparison_finish(&c);
    kd_observation_finish(&o);
}

/* ehtim 1.3.2: exp(-Dphi_exact/2) of ScatteringModel(), at b/(1 + Mag()), with k_zeta minimised to 1e-12. */
static void test_scattering_is_that_of_ehtim(void **state)
{
    (void)state;
    static const double by_ehtim_factor[][4] = {
        { 230e9, 1e9, 0, 0.95678983 },   { 230e9, 3e9, -2e9, 0.72005282 }, { 230e9, 0, 8e9, 0.59382404 },
        { 230e9, 8e9, 1e9, 0.19477568 }, { 230e9, -5e9, 5e9, 0.4549153 },  { 86e9, 0.3e9, 0.1e9, 0.79811206 },
        { 86e9, 1e9, -1e9, 0.13036275 }, { 86e9, 0, 2e9, 0.14215319 },     { 22e9, 1e8, 0, 0.0051714687 },
    };
    struct kd_scattering s;
    for (size_t i = 0; i < sizeof by_ehtim_factor / sizeof *by_ehtim_factor; i++) {
        const double *row = by_ehtim_factor[i];
        kd_scattering_sgra(&s, row[0]);
        assert_true(fabs(kd_scattering_at(&s, row[1], row[2]) / row[3] - 1) < 3e-8);
        assert_true(fabs(kd_scattering_at(&s, -row[1], -row[2]) / kd_scattering_at(&s, row[1], row[2]) - 1) < 1e-12);
    }
    assert_true(kd_scattering_at(&s, 0, 0) == 1);
    kd_scattering_sgra(&s, 86e9);
    assert_true(kd_scattering_at(&s, 1e18, -1e18) == 0);
}

/* FWHM in uas of a Gaussian whose visibility is 1/2 at the same baseline as the kernel's. */
static double kernel_width(double frequency_hz, double position_deg)
{
    struct kd_scattering s;
    const double e = sin(position_deg * M_PI / 180), n = cos(position_deg * M_PI / 180);
    double low = 1e4, high = 1e11;
    kd_scattering_sgra(&s, frequency_hz);
    for (int i = 0; i < 100; i++) {
        const double b = sqrt(low * high);
        *(kd_scattering_at(&s, b * e, b * n) > 0.5 ? &low : &high) = b;
    }
    return 2 * M_LN2 / (M_PI * low) / UAS;
}

/* M. D. Johnson et al. 2018: 1380 x 703 uas (lambda/cm)^2 at position angle 81.9 degrees for long wavelengths. S.
 * Issaoun et al. 2019 (ApJ 871, 30) have 159.9 x 79.5 uas for this model at 86.3 GHz (3.5 mm), by the approximate form
 * of the structure function, which differs from the exact one by 1.4 percent there. At 1.3 mm the exponent 1.38 beyond
 * the inner scale makes the kernel narrower than that Gaussian, which has 23.4 x 11.9 uas. */
static void test_scattering_has_the_published_widths(void **state)
{
    (void)state;
    const double lambda = 29.9792458;
    assert_true(fabs(kernel_width(1e9, 81.9) / (1380 * lambda * lambda) - 1) < 1e-3);
    assert_true(fabs(kernel_width(1e9, 171.9) / (703 * lambda * lambda) - 1) < 1e-3);
    assert_true(fabs(kernel_width(86.3e9, 81.9) / 159.9 - 1) < 0.015);
    assert_true(fabs(kernel_width(86.3e9, 171.9) / 79.5 - 1) < 0.015);
    const double major = kernel_width(230e9, 81.9), minor = kernel_width(230e9, 171.9);
    assert_true(fabs(major - 19.82355) < 1e-4 && fabs(minor - 9.13370) < 1e-4); /* ehtim's Dphi_exact */
    assert_true(major < 23.4 && minor < 11.9);
}

static void test_both_files_say_the_same(void **state)
{
    (void)state;
    struct kd_observation a = read_observation("m87-2017-04-05-lo.uvfits"),
                          b = read_observation("m87-2017-04-05-lo.csv");
    assert_string_equal(a.source, "M87");
    assert_string_equal(b.source, "M87");
    assert_true(a.mjd == 57848 && b.mjd == 57848);
    assert_true(fabs(a.frequency_hz / b.frequency_hz - 1) < 1e-6);
    assert_int_equal(a.n, 1507);
    assert_int_equal(b.n, 1507);
    assert_int_equal(a.flagged + a.duplicate + b.flagged + b.duplicate, 0);
    for (size_t i = 0; i < a.n; i++) {
        const struct kd_measured *x = &a.at[i], *y = &b.at[i];
        for (int k = 0; k < 2; k++)
            assert_string_equal(a.station[x->station[k]], b.station[y->station[k]]);
        assert_true(fabs(x->hour - y->hour) < 2e-8);
        assert_true(hypot(x->u - y->u, x->v - y->v) < 1e-6 * hypot(x->u, x->v));
        assert_true(hypot(x->re - y->re, x->im - y->im) < 2e-6 * hypot(x->re, x->im) + 1e-8);
        assert_true(fabs(x->sigma - y->sigma) < 1e-6 * x->sigma + 1e-8);
    }
    kd_observation_finish(&a);
    kd_observation_finish(&b);
}

/* If the data are the model times a factor, this factor is found and, without debiasing, chi^2 is 0. */
static void test_the_flux_that_fits(void **state)
{
    (void)state;
    struct kd_observation o = read_observation("m87-2017-04-05-lo.csv");
    struct kd_comparison c;
    struct kd_error error = { 0 };
    double chi2[KD_PRODUCTS];
    assert_int_equal(
        kd_comparison_make(&o, &(struct kd_comparison_params) { .products = 7, .measured = true }, &c, &error), KD_OK);
    double (*model)[2] = malloc(c.n * sizeof *model);
    for (size_t i = 0; i < c.n; i++)
        model[i][0] = 0.25 * c.at[i].re, model[i][1] = 0.25 * c.at[i].im;
    const double scale = kd_comparison_scale(&c, (const double (*)[2])model);
    assert_true(fabs(scale - 4) < 1e-12);
    kd_comparison_judge(&c, (const double (*)[2])model, chi2);
    assert_true(chi2[0] > 1 && chi2[1] < 1e-20 && chi2[2] < 1e-20);
    free(model);
    kd_comparison_finish(&c);
    kd_observation_finish(&o);
}

static void refused(const void *data, size_t size, const char *why)
{
    struct kd_error error = { 0 };
    struct kd_observation o;
    assert_int_equal(kd_observation_read(data, size, &o, &error), KD_EINVAL);
    assert_null(o.at);
    if (!strstr(error.message, why))
        fail_msg("\"%s\" does not say \"%s\"", error.message, why);
}

#define HEAD "#SRC:M87,DATE(MJD):57848,FREQ:227.0707GHz\n"
#define COLUMNS "#time(UTC),T1,T2,U(lambda),V(lambda),Iamp(Jy),Iphase(d),Isigma(Jy)\n"
static void test_csv_that_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *text, *why;
    } rows[] = {
        { "", "the file is not an observation" },
        { "#SRC:M87\n", "line 1 must have a date" },
        { "#SRC:,DATE(MJD):57848,FREQ:227GHz\n", "must name its source" },
        { "#SRC:M87,DATE(MJD):nan,FREQ:227GHz\n", "must have a date" },
        { "#SRC:M87,DATE(MJD):57848,FREQ:-1GHz\n", "must have a frequency above 0" },
        { HEAD, "no visibility with a weight above 0" },
        { HEAD "1,AA,AP,1,2,3,4,5\n", "line 2 of the CSV: a line of columns must come before it" },
        { HEAD "#time(UTC),T1,T2,U(lambda),V(lambda),RRamp(Jy)\n", "line 2 of the CSV: the columns are" },
        { HEAD COLUMNS "1,AA,AP,1,2,3,4\n", "line 3 of the CSV: there must be 8 fields" },
        { HEAD COLUMNS "1,AA,AP,1,2,3,4,5,6\n", "there must be 8 fields" },
        { HEAD COLUMNS "1,AA,AP,1,2,x,4,5\n", "its amplitude is \"x\"; it must be a number" },
        { HEAD COLUMNS "nan,AA,AP,1,2,3,4,5\n", "its time is \"nan\"; it must be a number" },
        { HEAD COLUMNS "1,AA,AP,1e300,2,3,4,5\n", "visibility 1: its u is 1e+300; it must be a number up to 1e+18" },
        { HEAD COLUMNS "1,AA,AP,1,2,3,4,0\n", "its error is 0; it must be above 0" },
        { HEAD COLUMNS "1,AA,AA,1,2,3,4,5\n", "both stations are AA" },
        { HEAD COLUMNS "1,A A,AP,1,2,3,4,5\n", "the name of a station has the byte 32" },
        { HEAD COLUMNS "1,,AP,1,2,3,4,5\n", "has 0 letters; it must have 1 to 11" },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++)
        refused(rows[i].text, strlen(rows[i].text), rows[i].why);
}

static uint8_t *card(uint8_t *data, size_t size, const char *key)
{
    for (size_t i = 0; i + 80 <= size; i += 80)
        if (!strncmp((const char *)data + i, key, strlen(key)))
            return data + i;
    fail_msg("no card %s", key);
    return NULL;
}

/* Changes one card in the primary header or in the header of the station table. */
static void test_uvfits_that_is_refused(void **state)
{
    (void)state;
    static const struct {
        const char *key, *card, *why;
    } cards[] = {
        { "GCOUNT  =", "GCOUNT  =        1099511627776",
          "GCOUNT of the uvfits is 1099511627776; it must be 1 to 1048576" },
        { "GCOUNT  =", "GCOUNT  =                  NaN", "GCOUNT of the uvfits is nan" },
        { "GCOUNT  =", "GCOUNT  =                 1900", "must have 168240 bytes, but has 149760" },
        { "PCOUNT  =", "PCOUNT  =        1099511627776", "PCOUNT of the uvfits is 1099511627776; it must be 4 to 32" },
        { "NAXIS   =", "NAXIS   =                  999", "NAXIS of the uvfits is 999; it must be 4 to 7" },
        { "NAXIS3  =", "NAXIS3  =        1099511627776", "NAXIS3 of the uvfits is 1099511627776" },
        { "NAXIS4  =", "NAXIS4  =                   -1", "NAXIS4 of the uvfits is -1" },
        { "NAXIS2  =", "NAXIS2  =                    2",
          "axis 2 of the uvfits is COMPLEX of length 2; it must be COMPLEX of length 3" },
        { "NAXIS6  =", "NAXIS6  =                    2", "NAXIS6 of the uvfits, RA, is 2; it must be 1" },
        { "CRVAL3  =", "CRVAL3  =                 -5.0",
          "CRVAL3 of the uvfits is -5; it must be -1 (RR, LL) or 1 (I)" },
        { "BITPIX  =", "BITPIX  =                   16", "BITPIX of the uvfits must be -32 or -64" },
        { "GROUPS  =", "GROUPS  =                    F", "this FITS file is not uvfits" },
        { "PTYPE4  =", "PTYPE4  = 'SUBARRAY'          ", "BASELINE and DATE" },
        { "PSCAL4  =", "PSCAL4  =                 1e30", "BASELINE of visibility 1 of the uvfits is" },
        { "PSCAL4  =", "PSCAL4  =                    8", "is of station" },
        { "PSCAL5  =", "PSCAL5  =                  NaN", "DATE of visibility 1 of the uvfits is nan" },
        { "PSCAL1  =", "PSCAL1  =                 1e99", "its u is" },
        { "BSCALE  =", "BSCALE  =                  NaN", "BSCALE must be a number other than 0" },
        { "BSCALE  =", "BSCALE  =                  0.0", "BSCALE and BZERO of the uvfits are 0 and 0" },
        { "BZERO   =", "BZERO   =                  inf", "BZERO a number" },
        { "BZERO   =", "BZERO   =                 1e99", "its real part is 1e+99; it must be a number up to 1e+12" },
        { "FREQ    =", "FREQ    =                  0.0", "FREQ of the table AIPS AN is 0" },
        { "TFORM1  =", "TFORM1  = '99999999A'         ", "TFORM1 of the table AIPS AN" },
        { "TFORM4  =", "TFORM4  = '1E      '          ", "must have the columns ANNAME" },
        { "TFIELDS =", "TFIELDS =        1099511627776", "TFIELDS of the uvfits is 1099511627776" },
        { "EXTNAME =", "EXTNAME = 'AIPS XX '          ", "must have a table AIPS AN" },
    };
    size_t size;
    uint8_t *data = read_file("m87-2017-04-05-lo.uvfits", &size), *copy = malloc(size);
    for (size_t i = 0; i < sizeof cards / sizeof *cards; i++) {
        memcpy(copy, data, size);
        memcpy(card(copy, size, cards[i].key), cards[i].card, strlen(cards[i].card));
        refused(copy, size, cards[i].why);
    }
    free(copy);
    free(data);
}

/* The length of a table follows from NAXIS and BITPIX as well, which may contradict the number of rows in NAXIS2. */
static void test_a_table_that_is_shorter_than_its_rows(void **state)
{
    (void)state;
    static const char *const cards[] = { "NAXIS   =                    1", "BITPIX  =                    0" },
                             *const keys[] = { "NAXIS   =", "BITPIX  =" };
    size_t size;
    uint8_t *data = read_file("m87-2017-04-05-lo.uvfits", &size);
    for (size_t i = 0; i < sizeof cards / sizeof *cards; i++) {
        const size_t name = (size_t)(card(data, size, "EXTNAME = 'AIPS AN") - data);
        size_t table = name / BLOCK * BLOCK;
        while (strncmp((const char *)data + table, "XTENSION", 8))
            table -= BLOCK;
        const size_t end = (size_t)(card(data + name, size - name, "END     ") - data) / BLOCK * BLOCK + 2 * BLOCK;
        uint8_t *copy = malloc(end);
        memcpy(copy, data, end);
        memcpy(card(copy + table, end - table, "NAXIS2  ="), "NAXIS2  =                   64", 30);
        memcpy(card(copy + table, end - table, keys[i]), cards[i], 30);
        refused(copy, end, "the table AIPS AN has 64 rows of");
        free(copy);
    }
    free(data);
}

/* A file that is cut anywhere gives an error, except if the missing part is not read. Sanitizers detect a read beyond
 * the end. */
static void test_files_that_are_cut(void **state)
{
    (void)state;
    static const char *const files[] = { "m87-2017-04-05-lo.uvfits", "m87-2017-04-05-lo.csv" };
    for (int f = 0; f < 2; f++) {
        size_t size, good = 0;
        uint8_t *data = read_file(files[f], &size);
        for (size_t cut = 0; cut < size; cut += cut < 20000 ? 97 : 4999) {
            uint8_t *copy = malloc(cut ? cut : 1);
            struct kd_error error = { 0 };
            struct kd_observation o;
            memcpy(copy, data, cut);
            if (!kd_observation_read(copy, cut, &o, &error))
                good++, kd_observation_finish(&o);
            else
                assert_true(*error.message);
            free(copy);
        }
        if (!f)
            assert_true(good <= 4); /* the cut was within the last table, which is not read */
        free(data);
    }
}

/* Replaces all visibilities of a file by 0.1 + 0.2 i, and compares the values that the function reports with the
 * file. */
static void simulate(const struct kd_observation *o, uint8_t *file, size_t size, uint64_t seed, bool exact)
{
    double (*model)[2] = calloc(o->n, sizeof *model), (*out)[2] = calloc(o->n, sizeof *out);
    uint8_t *marks = calloc(1, KD_SIMULATION_MARKS);
    for (size_t i = 0; i < o->n; i++)
        model[i][0] = 0.1, model[i][1] = 0.2;
    kd_simulate(&(struct kd_simulation) { o, file, size, marks, !exact, seed }, (const double (*)[2])model, out);
    for (size_t i = 0; i < o->n && exact; i++)
        assert_true(hypot(out[i][0] - 0.1, out[i][1] - 0.2) < 1e-6);
    free(marks);
    free(model);
    free(out);
}

static void test_files_that_are_damaged(void **state)
{
    (void)state;
    size_t size;
    uint8_t *data = read_file("m87-2017-04-05-lo.uvfits", &size), *copy = malloc(size);
    uint32_t seed = 1;
    for (int i = 0; i < 300; i++) {
        struct kd_error error = { 0 };
        struct kd_observation o;
        memcpy(copy, data, size);
        for (int k = 0; k < 20; k++) {
            seed = seed * 1664525 + 1013904223;
            copy[i % 2 ? seed % size : seed % (3 * BLOCK)] = (uint8_t)(seed >> 24);
        }
        if (!kd_observation_read(copy, size, &o, &error)) {
            simulate(&o, copy, size, 1, false);
            kd_observation_finish(&o);
        }
    }
    free(copy);
    free(data);
}

/* The second group of the file has the time and the baseline of the first, BSCALE 2 and BZERO 0.5. The simulated file
 * has the model. The group without data is flagged. */
static void test_simulated_file(void **state)
{
    (void)state;
    size_t size;
    uint8_t *data = read_file("m87-2017-04-05-lo.uvfits", &size);
    const size_t head = (size_t)(card(data, size, "END     ") - data) / BLOCK * BLOCK + BLOCK;
    const size_t group = (atoi((char *)card(data, size, "PCOUNT  =") + 10) + 3 * 4) * sizeof(float);
    memcpy(data + head + group, data + head, group);
    memcpy(card(data, size, "BSCALE  ="), "BSCALE  =                  2.0", 30);
    memcpy(card(data, size, "BZERO   ="), "BZERO   =                  0.5", 30);
    struct kd_observation o, read;
    assert_int_equal(kd_observation_read(data, size, &o, NULL), KD_OK);
    simulate(&o, data, size, 1, true);
    assert_int_equal(kd_observation_read(data, size, &read, NULL), KD_OK);
    assert_int_equal(read.n, o.n);
    assert_int_equal(o.duplicate, 1);
    assert_int_equal(read.duplicate, 0);
    assert_int_equal(read.flagged, 1);
    for (size_t i = 0; i < o.n; i++) {
        assert_true(read.at[i].hour == o.at[i].hour && read.at[i].u == o.at[i].u);
        assert_true(read.at[i].sigma == o.at[i].sigma);
        assert_true(hypot(read.at[i].re - 0.1, read.at[i].im - 0.2) < 1e-6);
    }
    kd_observation_finish(&read);
    kd_observation_finish(&o);
    free(data);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_chi2_of_visibilities_is_that_of_ehtim),
        cmocka_unit_test(test_size_angle_and_position_are_found),
        cmocka_unit_test(test_scattering_is_that_of_ehtim),
        cmocka_unit_test(test_a_search_without_light),
        cmocka_unit_test(test_simulated_file),
        cmocka_unit_test(test_scattering_has_the_published_widths),
        cmocka_unit_test(test_chi2_is_that_of_ehtim),
        cmocka_unit_test(test_both_files_say_the_same),
        cmocka_unit_test(test_the_flux_that_fits),
        cmocka_unit_test(test_csv_that_is_refused),
        cmocka_unit_test(test_uvfits_that_is_refused),
        cmocka_unit_test(test_files_that_are_cut),
        cmocka_unit_test(test_files_that_are_damaged),
        cmocka_unit_test(test_a_table_that_is_shorter_than_its_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

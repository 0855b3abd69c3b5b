/* Tests of a telescope's beam, and of brightness in false colours. Synthetic light goes through the passes beam,
 * expose, bloom and post. The oracle sums a Gaussian over all pixels of the picture in double precision. */
#include "made_up_light.h"

#include "image/colour_map.h"

#include <math.h>

/* sigma: standard deviation of the beam in pixels; 0: no beam. rows: number of rows of a band; 0: the whole picture.
 * lit: number of rows whose light is complete; 0: all. */
struct look {
    int width, height, rows, lit;
    double sigma, bloom, exposure;
    bool heat, film;
};

static struct kd_scene scene_of(const struct look *look)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = look->width;
    scene.image.height = look->height;
    scene.image.bit_depth = 16;
    scene.style.tone_map = look->film ? KD_TONE_ACES : KD_TONE_SRGB;
    scene.style.exposure = look->exposure;
    scene.style.dither = false;
    scene.style.bloom = look->bloom;
    scene.style.palette = look->heat ? KD_PALETTE_HEAT : KD_PALETTE_COLOUR;
    /* GM/c^2 of a solar mass is 1476.6250385 m, and a parsec is 3.0856775814913673e16 m. At a distance of 1e-3 pc, 100
     * M are 987 uas wide. */
    scene.spacetime.mass_msun = 1;
    scene.spacetime.distance_pc = 1e-3;
    scene.camera.field_m = 100;
    const double width_uas = 100 * 1476.6250385 / 3.0856775814913673e13 * (180 / acos(-1)) * 3600e6;
    scene.style.beam_uas = look->sigma * sqrt(8 * log(2)) * width_uas / look->width;
    return scene;
}

/* Shows the light as pixels of 16 bits. Returns the exposure that was used. */
static double show(const struct look *look, uint16_t *out)
{
    struct kd_scene scene = scene_of(look);
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(&scene, &error));
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_int_equal(plan.picture.beam.cell > 0, look->sigma > 0);
    if (look->rows) {
        plan.picture.band_rows = (uint32_t)look->rows;
        plan.picture.bands = (plan.picture.height + plan.picture.band_rows - 1) / plan.picture.band_rows;
    }
    return show_light(&scene, &plan, look->lit ? (uint32_t)look->lit : plan.picture.height, out);
}

/* Points, thin rings, and a ramp that reaches the edges. A coarse grid represents such light worst. */
static void make_light(int width, int height)
{
    static const double rings[][4] = { { 0.4, 0.5, 0.23, 1 }, { 0.41, 0.52, 0.31, 0.4 }, { 0.97, 0.1, 0.2, 0.7 } };
    for (int i = 0; i < width * height; i++) {
        const double x = (i % width + 0.5) / height, y = (i / width + 0.5) / height;
        double sum = 0.02 * x;
        for (int k = 0; k < 3; k++) {
            const double off = hypot(x - rings[k][0] * width / height, y - rings[k][1]) - rings[k][2];
            sum += rings[k][3] * exp(-off * off / 2e-5) + (k == 0 && off < 0 ? 0.1 : 0);
        }
        light[3 * i] = (float)sum;
        light[3 * i + 1] = (float)(0.7 * sum);
        light[3 * i + 2] = (float)(0.2 * sum + (i % 97 == 0 ? 3 : 0));
    }
}

/* Weights of a Gaussian about one of n pixels, at the centres of all n. They are normalised over all integers. */
static void weights_of(double *out, int n, int about, double sigma)
{
    double sum = 0;
    for (int k = -(int)(12 * sigma) - 2; k <= (int)(12 * sigma) + 2; k++)
        sum += exp(-k * k / (2 * sigma * sigma));
    for (int i = 0; i < n; i++)
        out[i] = exp(-(i - about) * (i - about) / (2 * sigma * sigma)) / sum;
}

/* The beam's light at a pixel, by the oracle's sum over all pixels of the picture. */
static double convolved(const struct look *look, int at, int channel)
{
    static double across[MOST], down[MOST];
    double sum = 0;
    weights_of(across, look->width, at % look->width, look->sigma);
    weights_of(down, look->height, at / look->width, look->sigma);
    for (int i = 0; i < look->width * look->height; i++)
        sum += across[i % look->width] * down[i / look->width] * (double)light[3 * i + channel];
    return sum;
}

/* Tests beams from far below a pixel to wider than the picture, in pictures whose sizes are no multiple of a cell. The
 * error is at most 4e-4 of the largest value: a coarse grid contributes 3e-4 if all light is within a cell, and 16 bits
 * 3e-5. Corners and edges are among the pixels checked. */
static void it_is_a_convolution(void **state)
{
    (void)state;
    static const struct look looks[] = {
        { 157, 90, .sigma = 0.3 },    { 157, 90, .sigma = 0.8 },    { 401, 233, .sigma = 2.5 },
        { 401, 233, .sigma = 7.999 }, { 401, 233, .sigma = 8.001 }, { 400, 233, .sigma = 12.5 },
        { 401, 233, .sigma = 31 },    { 97, 301, .sigma = 20 },     { 97, 61, .sigma = 150 },
        { 600, 3, .sigma = 25 },      { 3, 2, .sigma = 1 },         { 1, 1, .sigma = 4 },
    };
    for (size_t k = 0; k < sizeof looks / sizeof *looks; k++) {
        struct look look = looks[k];
        static double want[500];
        static int places[500];
        const int n = look.width * look.height, count = n < 200 ? n : 200;
        double worst = 0, most = 0;
        make_light(look.width, look.height);
        for (int i = 0; i < count; i++) {
            places[i] = n <= 200 || i == count - 1 ? (i == count - 1 ? n - 1 : i) : i == 0 ? 0 : rand() % n;
            want[i] = convolved(&look, places[i], i % 3);
            most = fmax(most, want[i]);
        }
        look.exposure = floor(-log2(most)) - 1;
        show(&look, pixels);
        for (int i = 0; i < count; i++)
            worst = fmax(worst, fabs(shown(pixels, 3 * places[i] + i % 3) * exp2(-look.exposure) - want[i]));
        printf("beam of %g pixels in %d x %d: off by %.1e of %.3g\n", look.sigma, look.width, look.height, worst / most,
               most);
        assert_true(worst < 4e-4 * most);
    }
}

/* One bright pixel becomes a round Gaussian about its own centre, wherever it lies in its cell. */
static void a_point_stays_where_it_is(void **state)
{
    (void)state;
    for (int shift = 0; shift < 9; shift++) {
        const struct look look = { 256, 200, .sigma = 17, .exposure = 1 };
        const int px = 110 + shift, py = 90 + 2 * shift;
        double sum = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
        memset(light, 0, sizeof light);
        for (int c = 0; c < 3; c++)
            light[3 * (py * look.width + px) + c] = 500;
        show(&look, pixels);
        for (int i = 0; i < look.width * look.height; i++) {
            const double v = shown(pixels, 3 * i), dx = i % look.width - px, dy = i / look.width - py;
            sum += v, x += v * dx, y += v * dy, xx += v * dx * dx, yy += v * dy * dy, xy += v * dx * dy;
        }
        const double variance = look.sigma * look.sigma;
        if (fabs(sum / 1000 - 1) > 1e-3 || hypot(x, y) / sum > 0.02 || fabs(xx / sum / variance - 1) > 3e-3 ||
            fabs(yy / sum / variance - 1) > 3e-3 || fabs(xy / sum / variance) > 1e-3)
            fail_msg("at %d: sum %.6f, at (%.4f, %.4f), variances %.3f %.3f %.3f", shift, sum / 1000, x / sum, y / sum,
                     xx / sum, yy / sum, xy / sum);
    }
}

/* The bytes do not depend on where bands and slices end, or on whether cells are read as texels or as storage. */
static void bands_and_readers(void **state)
{
    (void)state;
    static const struct look looks[] = { { 401, 233, .sigma = 14, .heat = true },
                                         { 157, 90, .sigma = 0.7 },
                                         { 320, 400, .sigma = 30, .bloom = 0.5 },
                                         { 320, 400, .bloom = 0.5, .heat = true } };
    struct kd_vk_info *info = (struct kd_vk_info *)kd_vk_info(renderer->vk);
    const uint64_t texels = info->max_texels;
    for (size_t k = 0; k < sizeof looks / sizeof *looks; k++) {
        struct look look = looks[k];
        const size_t bytes = 6ull * (size_t)look.width * (size_t)look.height;
        make_light(look.width, look.height);
        show(&look, pixels);
        for (look.rows = 1; look.rows < 60; look.rows += 13) {
            show(&look, others);
            assert_memory_equal(pixels, others, bytes);
        }
        look.rows = 0;
        info->max_texels = 4608; /* the device binds just as many texels as the tables need */
        show(&look, others);
        info->max_texels = texels;
        assert_memory_equal(pixels, others, bytes);
    }
}

/* The unfinished part of a picture is dark. Finished rows look as they would if all other rows were dark. The beam does
 * not change the stored light, so the next preview is correct too. */
static void what_is_not_lit_is_dark(void **state)
{
    (void)state;
    for (int coarse = 0; coarse < 2; coarse++) {
        struct look part = { 301, 200, .lit = 77, .sigma = coarse ? 12 : 3 }, whole = part;
        whole.lit = 0;
        make_light(301, 200);
        show(&part, pixels);
        memset(light + 3 * 301 * 77, 0, 12ull * 301 * (200 - 77));
        show(&whole, others);
        assert_memory_equal(pixels, others, 6 * 301 * 77);
        for (int i = 3 * 301 * 77; i < 3 * 301 * 200; i++)
            assert_int_equal(pixels[i], 0);
    }
}

/* NaN and infinity count as no light, and do not affect other pixels. */
static void no_numbers_are_no_light(void **state)
{
    (void)state;
    for (int coarse = 0; coarse < 2; coarse++) {
        const struct look look = { 320, 180, .sigma = coarse ? 12 : 3 };
        const int a = 90 * 320 + 100, b = 20 * 320 + 319;
        make_light(320, 180);
        for (int c = 0; c < 3; c++)
            light[3 * a + c] = light[3 * b + c] = 0;
        show(&look, pixels);
        light[3 * a] = NAN;
        light[3 * b + 1] = INFINITY;
        show(&look, others);
        assert_memory_equal(pixels, others, 6 * 320 * 180);
    }
}

/* With exposure "auto" the brightest place becomes white, to the histogram's resolution of an eighth of a stop. No
 * pixel is clipped. */
static void exposure_is_of_what_the_beam_sees(void **state)
{
    (void)state;
    for (int coarse = 0; coarse < 2; coarse++) {
        const struct look look = { 301, 200, .sigma = coarse ? 12 : 3, .exposure = INFINITY };
        int most = 0;
        /* synthetic light in which less than 0.4 % of the pixels receive most of the light */
        for (int i = 0; i < 3 * 301 * 200; i++)
            light[i] = i / 3 == 90 * 301 + 100 ? 7 : 1e-6f;
        show(&look, pixels);
        for (int i = 0; i < 301 * 200; i++)
            most = pixels[3 * i] > most ? pixels[3 * i] : most;
        assert_true(most < 65535 && decode(most / 65535.0) > exp2(-0.26));
    }
}

/* Each brightness has its colour of the colour map, also after a tone curve. Coloured light is shown by its luminance.
 * The map is linear between the 1024 entries of its table. Above white and below black, the colours at the ends of the
 * map are used. */
static void brightness_has_the_colour_of_the_map(void **state)
{
    (void)state;
    enum { W = 512, H = 8 };
    static const float tints[][3] = { { 1, 1, 1 }, { 4, 0.2f, 0.1f }, { 0.1f, 1.2f, 0.4f }, { 0, 0, 1 } };
    double worst = 0;
    for (int film = 0; film < 2; film++) {
        const struct look look = { W, H, .heat = true, .film = film }, grey = { W, H, .film = film };
        for (int i = 0; i < W * H; i++)
            for (int c = 0; c < 3; c++)
                light[3 * i + c] = (float)(1.1 * i / (W * H)) * (film ? 1 : tints[i % 4][c]);
        show(&look, pixels);
        show(&grey, others);
        for (int i = 0; i < W * H; i++) {
            const double y =
                0.2126 * (double)light[3 * i] + 0.7152 * (double)light[3 * i + 1] + 0.0722 * (double)light[3 * i + 2];
            const struct kd_map_colour want = kd_colour_map_at(KD_MAP_HEAT, film ? shown(others, 3 * i) : y);
            const double w[] = { want.r, want.g, want.b };
            for (int c = 0; c < 3; c++)
                worst = fmax(worst, fabs(pixels[3 * i + c] / 65535.0 - w[c]));
        }
    }
    printf("colours of brightness: off by %.1e at most\n", worst);
    assert_true(worst < 2e-3);
}

/* A picture without a beam needs neither memory nor a pass for it. A map in false colour has no beam. */
static void none_is_nothing(void **state)
{
    (void)state;
    struct kd_capacity c;
    struct kd_plan without, with;
    const struct look none = { 320, 180 }, some = { 320, 180, .sigma = 10 };
    struct kd_scene off = scene_of(&none), on = scene_of(&some);
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&off, &c, &without, &error));
    OK(kd_plan_make(&on, &c, &with, &error));
    assert_true(with.cost.device_bytes > without.cost.device_bytes && with.cost.n_passes == without.cost.n_passes + 1);
    on.image.layers = (struct kd_words) { .count = 1, .at = { { KD_LAYER_g, -1 } } };
    off.image.layers = on.image.layers;
    OK(kd_plan_make(&off, &c, &without, &error));
    OK(kd_plan_make(&on, &c, &with, &error));
    assert_true(with.cost.device_bytes == without.cost.device_bytes && with.cost.n_passes == without.cost.n_passes &&
                !with.picture.beam.cell);
}

/* A beam of some pixels in a large picture needs more cells than a device can bind. */
static void too_many_cells_are_refused(void **state)
{
    (void)state;
    struct kd_capacity c;
    struct kd_plan plan;
    const struct look look = { 640, 360, .sigma = 2 };
    struct kd_scene scene = scene_of(&look);
    kd_renderer_capacity(renderer, &c);
    c.max_binding_bytes = 16ull * 640 * 360 - 16;
    struct kd_error why = { 0 };
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &why), KD_ETOOBIG);
    assert_non_null(strstr(why.message, "style.beam_uas"));
    c.max_binding_bytes += 16;
    OK(kd_plan_make(&scene, &c, &plan, &error));
}

int main(void)
{
    int skip = open_renderer();
    if (skip)
        return skip;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_a_convolution),
        cmocka_unit_test(a_point_stays_where_it_is),
        cmocka_unit_test(bands_and_readers),
        cmocka_unit_test(what_is_not_lit_is_dark),
        cmocka_unit_test(no_numbers_are_no_light),
        cmocka_unit_test(exposure_is_of_what_the_beam_sees),
        cmocka_unit_test(brightness_has_the_colour_of_the_map),
        cmocka_unit_test(none_is_nothing),
        cmocka_unit_test(too_many_cells_are_refused),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

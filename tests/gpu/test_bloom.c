/* Tests of the glare of a lens. Synthetic light goes through the passes bloom and post. The oracle sums Gaussians of
 * the stated widths in double precision, mirrored at the edges. */
#include "made_up_light.h"

#include <math.h>

static bool all_round; /* true if the pictures show all directions */

/* Shows the light as pixels of 16 bits that are proportional to it. rows: number of rows in a band; 0: all rows. */
static void show(int width, int height, double bloom, int rows, uint16_t *out)
{
    struct kd_scene scene;
    struct kd_capacity c;
    struct kd_plan plan;
    kd_scene_smooth(&scene);
    scene.image.width = width;
    scene.image.height = height;
    scene.image.bit_depth = 16;
    scene.style.tone_map = KD_TONE_SRGB;
    scene.style.exposure = 0;
    scene.style.dither = false;
    scene.style.bloom = bloom;
    if (all_round) {
        scene.camera.r = 100;
        scene.camera.projection = KD_PROJECTION_EQUIRECTANGULAR;
    }
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &plan, &error));
    if (rows) {
        c.max_binding_bytes = 4ull * (plan.lens.planes > 3 ? plan.lens.planes : 3) * (uint64_t)(width * rows) + 64;
        OK(kd_plan_make(&scene, &c, &plan, &error));
        assert_true(plan.picture.bands > 1);
    }
    show_light(&scene, &plan, plan.picture.height, out);
}

/* Dim light with bright places up to white, one of them in a corner. */
static void make_light(int width, int height)
{
    static const double places[][4] = {
        { 0.3, 0.4, 0.05, 1 }, { 0.31, 0.6, 0.004, 0.98 }, { 0.98, 0.02, 0.03, 0.95 }, { 0.7, 0.9, 0.02, 0.9 }
    };
    for (int i = 0; i < width * height; i++) {
        double x = (i % width + 0.5) / height, y = (i / width + 0.5) / height, sum = 0;
        for (int k = 0; k < 4; k++) {
            double dx = x - places[k][0] * width / height, dy = y - places[k][1];
            sum += places[k][3] * exp(-(dx * dx + dy * dy) / (2 * places[k][2] * places[k][2]));
        }
        sum = fmin(sum, 1) * 0.97;
        light[3 * i] = (float)sum;
        light[3 * i + 1] = (float)(0.9 * sum + 0.01);
        light[3 * i + 2] = (float)(0.8 * sum + 0.001);
    }
}

/* Spread light leaves its pixel and arrives in others. The sum of each channel is conserved, also at the picture's
 * edges, and for sizes that are not a multiple of a grid cell. Rounding to 16 bits causes an error of 1e-5 on average.
 * */
static void energy(void **state)
{
    (void)state;
    static const int sizes[][2] = { { 640, 360 },  { 401, 333 }, { 157, 90 }, { 97, 640 }, { 600, 17 }, { 200, 1000 },
                                    { 199, 1001 }, { 600, 9 },   { 2000, 3 }, { 9, 900 },  { 3, 2 },    { 1, 1 } };
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int width = sizes[s][0], height = sizes[s][1], n = width * height;
        make_light(width, height);
        show(width, height, 0, 0, others);
        show(width, height, 1, 0, pixels);
        double moved = 0;
        for (int c = 0; c < 3; c++) {
            double before = 0, after = 0;
            for (int i = c; i < 3 * n; i += 3) {
                assert_true(others[i] < 65535 && pixels[i] < 65535); /* no pixel is clipped */
                before += shown(others, i);
                after += shown(pixels, i);
                moved += fabs(shown(pixels, i) - shown(others, i)) / n;
            }
            if (fabs(after / before - 1) > 2e-4)
                fail_msg("%d x %d, channel %d: %.9g became %.9g", width, height, c, before, after);
        }
        assert_true(moved > 2e-4 || height < 10); /* checks that some light is spread */
    }
}

/* The part of the light that is spread, as in docs/physics: luminance y above 0.6 of white. The threshold is smooth,
 * with a knee from y = 0.2 to 1. */
static double taken(double y) { return y <= 0.2 ? 0 : y >= 1 ? y - 0.6 : (y - 0.2) * (y - 0.2) / 1.6; }

/* A Gaussian in one dimension over n pixels, about the pixel `from`. Light beyond the edges is mirrored. */
static double gauss(double from, double at, int n, double sigma)
{
    double sum = 0;
    for (int fold = -2; fold <= 2; fold++)
        for (int side = -1; side <= 1; side += 2) {
            double image = 2.0 * fold * n + side * from;
            sum += exp(-(at - image) * (at - image) / (2 * sigma * sigma));
        }
    return sum / (sigma * sqrt(2 * acos(-1)));
}

/* Convolves with a Gaussian, first in x and then in y. */
static void convolve(const double *in, double *out, int width, int height, double sigma)
{
    static double kernel[512][512], between[MOST];
    assert_true(width <= 512 && height <= 512);
    for (int a = 0; a < width; a++)
        for (int b = 0; b < width; b++)
            kernel[a][b] = gauss(a + 0.5, b + 0.5, width, sigma);
    for (int y = 0; y < height; y++)
        for (int b = 0; b < width; b++) {
            double sum = 0;
            for (int a = 0; a < width; a++)
                sum += kernel[a][b] * in[y * width + a];
            between[y * width + b] = sum;
        }
    for (int a = 0; a < height; a++)
        for (int b = 0; b < height; b++)
            kernel[a][b] = gauss(a + 0.5, b + 0.5, height, sigma);
    for (int x = 0; x < width; x++)
        for (int b = 0; b < height; b++) {
            double sum = 0;
            for (int a = 0; a < height; a++)
                sum += kernel[a][b] * between[a * width + x];
            out[b * width + x] = sum;
        }
}

/* Tests white light on black. For each width, the splines approximate a Gaussian of the same variance. The error is
 * below 4 % of the largest spread brightness. */
static void widths(void **state)
{
    (void)state;
    enum { W = 420, H = 256, LEVELS = 5 };
    static double off[W * H], spread[W * H], one[W * H], want[W * H];
    make_light(W, H);
    for (int i = 0; i < 3 * W * H; i++)
        light[i] = light[i / 3 * 3] < 0.25f ? 0 : light[i / 3 * 3];
    show(W, H, 0, 0, others);
    show(W, H, 0.8, 0, pixels);
    for (int i = 0; i < W * H; i++) {
        off[i] = shown(others, 3 * i);
        spread[i] = 0.8 * taken(off[i]);
        want[i] = off[i] - spread[i];
    }
    for (int k = 0; k < LEVELS; k++) {
        double d = H / 128.0;
        convolve(spread, one, W, H, d * pow(2, k));
        for (int i = 0; i < W * H; i++)
            want[i] += one[i] / LEVELS;
    }
    double worst = 0, most = 0;
    for (int i = 0; i < W * H; i++) {
        worst = fmax(worst, fabs(shown(pixels, 3 * i) - want[i]));
        most = fmax(most, want[i] - off[i] + spread[i]);
    }
    printf("bloom beside Gaussians: worst %.2g, of %.2g that arrive\n", worst, most);
    assert_true(most > 0.1);
    assert_true(worst < 0.04 * most);
}

/* A point of light becomes a disk that falls off from its centre outwards. At equal distances from the centre,
 * brightnesses differ by at most a quarter, even where they fall steeply. The contours are therefore circles to within
 * a few hundredths of the radius. The point is moved within its cell, and to other cells. */
static void a_point(void **state)
{
    (void)state;
    enum { W = 384, H = 256 };
    for (int at = 0; at < 5; at++) {
        const int px = 180 + at, py = 128 + 3 * at;
        memset(light, 0, sizeof light);
        for (int c = 0; c < 3; c++)
            light[3 * (py * W + px) + c] = 60;
        show(W, H, 1, 0, pixels);
        double before = 1;
        for (int r = 4; r < 60; r += 2) {
            double least = 1, most = 0;
            for (int k = 0; k < 24; k++) {
                double a = k * acos(-1) / 12, x = px + r * cos(a), y = py + r * sin(a);
                int ix = (int)floor(x), iy = (int)floor(y);
                double fx = x - ix, fy = y - iy, v = 0;
                for (int q = 0; q < 4; q++)
                    v += shown(pixels, 3 * ((iy + q / 2) * W + ix + q % 2)) * (q % 2 ? fx : 1 - fx) *
                         (q / 2 ? fy : 1 - fy);
                least = fmin(least, v);
                most = fmax(most, v);
            }
            if (most > 1.27 * least || least > before)
                fail_msg("at %d: between %.3g and %.3g at %d pixels, %.3g before", at, least, most, r, before);
            before = least;
        }
    }
}

/* The light of a point is centred on it. Its centroid is displaced by at most 0.5 pixels if the pass first sums pairs
 * of pixels, and by at most 1.5 if it sums groups of four. The widest Gaussian is reflected at the edge of the picture.
 * */
static void a_point_stays(void **state)
{
    (void)state;
    static const struct {
        int width, height;
        double most;
    } sizes[] = { { 384, 256, 0.01 }, { 640, 360, 0.51 }, { 320, 720, 1.6 } };
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++)
        for (int at = 0; at < 5; at++) {
            const int w = sizes[s].width, h = sizes[s].height, px = w / 2 + at, py = h / 2 + 3 * at;
            double sum = 0, x = 0, y = 0;
            memset(light, 0, sizeof light);
            for (int c = 0; c < 3; c++)
                light[3 * (py * w + px) + c] = 60;
            show(w, h, 1, 0, pixels);
            for (int i = 0; i < w * h; i++) {
                /* takes the mirror image nearby, because the point itself is clipped */
                const double v = i == py * w + px ? 0 : shown(pixels, 3 * i);
                sum += v;
                x += v * (i % w - px);
                y += v * (i / w - py);
            }
            if (!(sum > 1 && fabs(x / sum) < sizes[s].most && fabs(y / sum) < sizes[s].most))
                fail_msg("%d x %d: a point is displaced by (%.3g, %.3g)", w, h, x / sum, y / sum);
        }
}

/* The bytes do not depend on where bands end, or on whether cells are read as texels or as storage. */
static void bands_and_readers(void **state)
{
    (void)state;
    static const int sizes[][2] = {
        { 401, 333 }, { 157, 90 }, { 320, 700 }, { 640, 360 }, { 200, 1000 }, { 199, 1001 }
    };
    struct kd_vk_info *info = (struct kd_vk_info *)kd_vk_info(renderer->vk);
    const uint64_t texels = info->max_texels;
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int width = sizes[s][0], height = sizes[s][1];
        const size_t bytes = 6ull * (size_t)width * (size_t)height;
        make_light(width, height);
        show(width, height, 0.5, 0, pixels);
        for (int rows = 1; rows < 60; rows += 13) {
            show(width, height, 0.5, rows, others);
            assert_memory_equal(pixels, others, bytes);
        }
        info->max_texels = 4608; /* a device whose limit is just enough for the tables */
        show(width, height, 0.5, 0, others);
        info->max_texels = texels;
        assert_memory_equal(pixels, others, bytes);
    }
}

/* Light below the threshold is unchanged. NaN and infinity do not affect other pixels. */
static void others_unharmed(void **state)
{
    (void)state;
    enum { W = 320, H = 180, AT = 90 * W + 100 };
    make_light(W, H);
    show(W, H, 1, 0, pixels);
    light[3 * AT] = NAN;
    light[3 * (AT + 900) + 1] = INFINITY;
    show(W, H, 1, 0, others);
    /* tolerance: `others` lacks the light that these two places spread */
    for (int i = 0; i < 3 * W * H; i++)
        assert_true(i / 3 == AT || i / 3 == AT + 900 || abs(pixels[i] - others[i]) <= 40);
    make_light(W, H);
    for (int i = 0; i < 3 * W * H; i++)
        light[i] *= 0.19f;
    show(W, H, 1, 0, pixels);
    show(W, H, 0, 0, others);
    assert_memory_equal(pixels, others, 6 * W * H);
}

/* A picture of half the size looks the same: each pixel is the mean of four pixels of the large picture, to 1 % of
 * white. */
static void any_size(void **state)
{
    (void)state;
    enum { W = 320, H = 180 };
    make_light(2 * W, 2 * H);
    show(2 * W, 2 * H, 1, 0, others);
    for (int i = 0; i < 3 * W * H; i++) { /* each float is read before it is overwritten */
        int at = i / 3 / W * 12 * W + i / 3 % W * 6 + i % 3;
        light[i] = (light[at] + light[at + 3] + light[at + 6 * W] + light[at + 6 * W + 3]) / 4;
    }
    show(W, H, 1, 0, pixels);
    double worst = 0;
    for (int i = 0; i < W * H; i++) {
        int at = 3 * (i / W * 2 * 2 * W + i % W * 2);
        double mean =
            (shown(others, at) + shown(others, at + 3) + shown(others, at + 6 * W) + shown(others, at + 6 * W + 3)) / 4;
        worst = fmax(worst, fabs(mean - shown(pixels, 3 * i)));
    }
    printf("bloom at half the size: worst %.2g of white\n", worst);
    assert_true(worst < 0.02);
}

/* In a panorama light spreads across the seam between left and right. A picture shifted by half a turn therefore gives
 * the same pixels, shifted. */
static void over_the_seam(void **state)
{
    (void)state;
    static const struct {
        int width, height, most;
    } sizes[] = {
        { 384, 192, 2 }, { 640, 320, 2 }, { 638, 360, 100 }, { 250, 300, 100 }
    }; /* in the last two sizes half a turn is not a whole number of coarse cells */
    for (size_t s = 0; s < sizeof sizes / sizeof *sizes; s++) {
        const int w = sizes[s].width, h = sizes[s].height;
        int worst = 0, differ = 0;
        make_light(w, h);
        show(w, h, 1, 0, pixels);
        all_round = true;
        for (int half = 0; half < 2; half++) {
            make_light(w, h);
            for (int y = 0; y < h && half; y++)
                for (int i = 0; i < 3 * w / 2; i++) {
                    float *a = &light[3 * w * y + i], *b = a + 3 * (w / 2), was = *a;
                    *a = *b, *b = was;
                }
            uint16_t *out = half ? others : pixels;
            memcpy(others, pixels, sizeof pixels);
            show(w, h, 1, 0, out);
            for (int i = 0; i < 3 * w * h && !half;
                 i++) /* for comparison: the same picture without light across the seam, in `others` */
                differ = abs(pixels[i] - others[i]) > differ ? abs(pixels[i] - others[i]) : differ;
        }
        all_round = false;
        for (int i = 0; i < 3 * w * h; i++) {
            const int x = i / 3 % w, at = i + (x < w / 2 ? 3 : -3) * (w / 2), off = abs(pixels[i] - others[at]);
            worst = off > worst ? off : worst;
        }
        printf("%d x %d: half a turn on pixels are off by %d of 65535 at most; with edges by %d\n", w, h, worst,
               differ);
        assert_true(worst <= sizes[s].most && differ > 1000);
    }
}

/* In panoramas no spread light is lost. This holds for any bands, and for cells that are read as texels or as storage.
 * */
static void all_round_too(void **state)
{
    all_round = true;
    energy(state);
    bands_and_readers(state);
    all_round = false;
}

int main(void)
{
    int skip = open_renderer();
    if (skip)
        return skip;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(energy),
        cmocka_unit_test(widths),
        cmocka_unit_test(a_point),
        cmocka_unit_test(a_point_stays),
        cmocka_unit_test(bands_and_readers),
        cmocka_unit_test(others_unharmed),
        cmocka_unit_test(any_size),
        cmocka_unit_test(over_the_seam),
        cmocka_unit_test(all_round_too),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

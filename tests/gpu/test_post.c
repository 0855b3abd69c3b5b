/* Tests of the post kernels alone: the sRGB curve at every level of 16 bits, compared with double precision; positions
 * and packing of the samples; and the kernel that reads texels, compared with the one that reads storage. */
#include "render_support.h"

#include "render/device/device_internal.h"
#include "render/view/layout.h"

#include <math.h>

/* Light of an encoded value (IEC 61966-2-1). */

/* Passes radiance through a kernel; out: has room for whole groups of samples. Returns the number of pixels whose light
 * is not a number. */
static uint32_t post_by(bool texels, const uint32_t *constants, size_t n, const float *light, struct kd_post_push push,
                        void *out)
{
    struct kd_vk *vk = renderer->vk;
    const struct kd_vk_pipeline *pipeline;
    struct kd_vk_buffer *in, *words;
    uint64_t bytes = kd_post_bytes(push.pixels, constants[1] ? 16 : 8);
    OK(kd_vk_buffer_create(vk, kd_post_radiance_bytes(push.pixels), KD_VK_UPLOAD, "light", &in, &error));
    OK(kd_vk_buffer_create(vk, bytes + 4, KD_VK_READBACK, "words", &words, &error));
    push.counter = (uint32_t)(bytes / 4);
    memcpy(kd_vk_buffer_map(in), light, 12ull * push.pixels);
    OK(kd_kernels_get(&renderer->kernels, vk, kd_kernel_post(texels, false, false), constants, n, &pipeline, &error));
    const struct kd_vk_dispatch d = { .pass = "post",
                                      .pipeline = pipeline,
                                      .bindings = { { .buffer = in }, { .buffer = words, .write = true } },
                                      .push = &push,
                                      .groups = { kd_post_groups(push.pixels) } };
    OK(kd_vk_fill(vk, "fill", words, 0, bytes, 0xffffffff, &error));
    OK(kd_vk_fill(vk, "fill", words, bytes, 4, 0, &error));
    OK(kd_vk_dispatch(vk, &d, &error));
    OK(kd_vk_submit(vk, NULL, &error));
    OK(kd_vk_wait(vk, 0, &error));
    memcpy(out, kd_vk_buffer_map(words), bytes);
    const uint32_t counted = ((const uint32_t *)kd_vk_buffer_map(words))[bytes / 4];
    kd_vk_buffer_destroy(vk, in);
    kd_vk_buffer_destroy(vk, words);
    return counted;
}

static uint32_t post(bool texels, bool film, bool wide, const float *light, struct kd_post_push push, void *out)
{
    return post_by(texels, (uint32_t[]) { film, wide }, 2, light, push, out);
}

/* Light 0.44 of a step from a level, on either side, is rounded to that level. The rounding threshold is 0.06 of a step
 * further. These 0.06 steps are 9e-7 of the whole range, and are the tolerance of the curve. A twentieth of the
 * tolerance is used by rounding the light, and 65535 times the curve, to floats. */
static void every_level(void **state)
{
    (void)state;
    enum { LEVELS = 65536, SIDES = 3, N = LEVELS * SIDES / 3 };
    static const double background[SIDES] = { -0.44, 0, 0.44 };
    static float light[3 * N];
    static uint16_t found[3 * (N + KD_GROUP_SIZE * KD_POST_PIXELS)];
    for (int k = 0; k < LEVELS; k++)
        for (int side = 0; side < SIDES; side++) /* pixel k has the three sides as its channels */
            light[3 * k + side] = (float)decode(fmin(fmax(k + background[side], 0), LEVELS - 1) / (LEVELS - 1));
    for (int texels = 0; texels < 2; texels++) {
        post(texels, false, true, light, (struct kd_post_push) { .gain = 1, .pixels = N, .pixels_x = N }, found);
        for (int i = 0; i < 3 * N; i++)
            if (found[i] != i / 3)
                fail_msg("light %.9g, level %d%+.2f, came out as %d", (double)light[i], i / 3, background[i % 3],
                         found[i]);
    }
}

/* Interleaved gradient noise (J. Jimenez 2014) in double, from -1/2 to 1/2. The inner fraction is multiplied by 53.
 * This also multiplies the kernel's rounding of sums of up to a few hundred. */
static double noise(double x, double y)
{
    double inner = 0.06711056 * x + 0.00583715 * y, outer = 52.9829189 * (inner - floor(inner));
    return outer - floor(outer) - 0.5;
}

/* In dithered grey, each row, column and channel has its own noise at the right position. Tested for any width of the
 * picture, and from any offset, also far beyond 2^24, where floats do not resolve offsets. After the last pixel, zeros
 * fill a whole group. */
static void places(void **state)
{
    (void)state;
    static const struct {
        uint32_t width, first, pixels;
    } cases[] = {
        { 1, 0, 7 },
        { 2, 0, 9 },
        { 3, 5, 301 },
        { 5, 0, 1023 },
        { 157, 157 * 40, 157 * 7 },
        { 320, 0, 6400 },
        { 32767, 32767u * 32766, 32767 },
        { 32768, 32768u * 32760, 65536 },
    };
    static float light[3 * 65536];
    static uint16_t found[3 * (65536 + KD_GROUP_SIZE * KD_POST_PIXELS)];
    /* dither rounds up or down at the noise threshold of the position */
    const float level[3] = { 1000.5f, 30000.5f, 60000.5f };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        uint32_t n = cases[c].pixels, unsure = 0;
        for (uint32_t i = 0; i < 3 * n; i++)
            light[i] = (float)decode((double)level[i % 3] / 65535) / 2;
        post(true, false, true, light,
             (struct kd_post_push) {
                 .gain = 2, .dither = 1, .pixels = n, .first = cases[c].first, .pixels_x = cases[c].width },
             found);
        for (uint32_t i = 0; i < 3 * n; i++) {
            uint32_t at = cases[c].first + i / 3;
            double d = 0.998 * noise(at % cases[c].width, at / cases[c].width), v = level[i % 3] + 0.5 + d;
            /* May be rounded either way: values that are ties within the errors of curve and noise, and values whose
             * noise wraps round. */
            bool tie = fabs(v - round(v)) < 0.1 || fabs(d) > 0.45;
            unsure += tie;
            assert_true(tie ? abs(found[i] - (int)floor((double)level[i % 3] + 0.5)) <= 1 : found[i] == (int)floor(v));
        }
        assert_true(unsure < 3 * n * 0.35 + 9);
        for (uint64_t i = 3ull * ((n + 3) / 4 * 4); i < kd_post_bytes(n, 16) / 2; i++)
            assert_int_equal(found[i], 0);
    }
}

/* The two kernels give the same bytes. NaN and infinite light do not affect neighbouring pixels. */
static void both_readers(void **state)
{
    (void)state;
    enum { N = 5003 };
    static float light[3 * N];
    static uint8_t storage[6 * (N + KD_GROUP_SIZE * KD_POST_PIXELS)], texels[sizeof storage], mended[sizeof storage];
    const struct kd_post_push push = { .gain = 1.3f, .dither = 1, .pixels = N, .first = 640, .pixels_x = 320 };
    srand(5);
    for (int i = 0; i < 3 * N; i++)
        light[i] = i % 7 ? exp2f(-14 + 16 * (float)rand() / (float)RAND_MAX) : 0;
    for (int k = 0; k < 4; k++) {
        bool film = k & 1, wide = k & 2;
        size_t bytes = (size_t)N * (wide ? 6 : 3), pixel = bytes / N;
        post(false, film, wide, light, push, storage);
        post(true, film, wide, light, push, texels);
        assert_memory_equal(storage, texels, bytes);
        for (int c = 0; c < 3; c++) { /* pixel 1001 begins in the middle of a word */
            float kept = light[3 * 1001 + c];
            light[3 * 1001 + c] = c ? INFINITY : NAN;
            post(true, film, wide, light, push, mended);
            light[3 * 1001 + c] = kept;
            assert_memory_equal(mended, texels, 1001 * pixel);
            assert_memory_equal(mended + 1002 * pixel, texels + 1002 * pixel, bytes - 1002 * pixel);
        }
    }
}

/* The kernel counts pixels (not channels) without valid light, at any of an invocation's four positions. Positions
 * beyond the end do not count. */
static void no_number(void **state)
{
    (void)state;
    static const float none[] = { NAN, INFINITY, -INFINITY, -NAN };
    enum { N = 4 * KD_GROUP_SIZE + 4 };
    static float light[3 * N];
    static uint16_t found[3 * (N + KD_GROUP_SIZE * KD_POST_PIXELS)];
    for (uint32_t n = N - 3; n <= N; n++)
        for (int k = 0; k < 4; k++) {
            uint32_t want = 0;
            for (int i = 0; i < 3 * N; i++)
                light[i] = 1;
            for (uint32_t i = 0; i < n; i += i < 8 ? 1 : 5, want++)
                for (uint32_t c = i % 3; c < 3; c++)
                    light[3 * i + c] = none[(i + (uint32_t)k) % 4];
            for (uint32_t i = 3 * n; i < 3 * N; i++)
                light[i] = NAN;
            const struct kd_post_push push = { .gain = 1, .pixels = n, .pixels_x = n };
            assert_int_equal(post(k & 1, false, k & 2, light, push, found), want);
        }
}

/* White and brighter light stays white: dither neither overflows the last level nor lowers it by more than one of 16
 * bits. Black stays black. */
static void ends(void **state)
{
    (void)state;
    enum { N = 4096 };
    static float light[3 * N];
    static uint16_t found[3 * (N + KD_GROUP_SIZE * KD_POST_PIXELS)];
    for (int k = 0; k < 8; k++) {
        bool film = k & 1, wide = k & 2, black = k & 4;
        for (int i = 0; i < 3 * N; i++)
            light[i] = black ? 0 : i / 3 % 2 || film ? 1e7f : 1;
        post(true, film, wide, light, (struct kd_post_push) { .gain = 1, .dither = 1, .pixels = N, .pixels_x = 64 },
             found);
        for (int i = 0; i < 3 * N; i++) {
            int level = wide ? found[i] : ((uint8_t *)found)[i];
            assert_true(black ? level == 0 : wide ? level >= 65534 : level == 255);
        }
    }
}

/* Khronos PBR Neutral in double precision, as specified (github.com/KhronosGroup/ToneMapping, 2024). */
static void khronos(const double in[3], double out[3])
{
    const double compress = 0.8 - 0.04, desaturate = 0.15, d = 1 - compress;
    double least = fmin(in[0], fmin(in[1], in[2])), offset = least < 0.08 ? least - 6.25 * least * least : 0.04,
           peak = 0;
    for (int c = 0; c < 3; c++)
        peak = fmax(peak, out[c] = in[c] - offset);
    if (peak < compress)
        return;
    double shown = 1 - d * d / (peak + d - compress), g = 1 - 1 / (desaturate * (peak - shown) + 1);
    for (int c = 0; c < 3; c++)
        out[c] = (out[c] * shown / peak) * (1 - g) + shown * g;
}

/* The kernel agrees with khronos() to two steps of 16 bits of encoded value, from black to far beyond white. */
static void neutral(void **state)
{
    (void)state;
    enum { N = 4096 };
    static float light[3 * N];
    static uint16_t found[3 * (N + KD_GROUP_SIZE * KD_POST_PIXELS)];
    srand(7);
    for (int i = 0; i < 3 * N; i++)
        light[i] = i < 30 ? 0 : exp2f(-9 + 15 * (float)rand() / (float)RAND_MAX);
    post_by(true, (uint32_t[]) { false, true, true }, 3, light,
            (struct kd_post_push) { .gain = 1, .pixels = N, .pixels_x = 64 }, found);
    for (int i = 0; i < N; i++) {
        double in[3] = { (double)light[3 * i], (double)light[3 * i + 1], (double)light[3 * i + 2] }, out[3];
        khronos(in, out);
        for (int c = 0; c < 3; c++) {
            double want = decode(found[3 * i + c] / 65535.0),
                   step = want - decode(fmax(found[3 * i + c] - 1, 0) / 65535.0);
            if (fabs(want - fmin(fmax(out[c], 0), 1)) > 2 * fmax(step, 1e-6))
                fail_msg("light %.6g %.6g %.6g, channel %d: %.6g instead of %.6g", in[0], in[1], in[2], c, want,
                         out[c]);
        }
    }
}

int main(void)
{
    int skip = open_renderer();
    if (skip)
        return skip;
    const struct CMUnitTest tests[] = { cmocka_unit_test(every_level),  cmocka_unit_test(places),
                                        cmocka_unit_test(both_readers), cmocka_unit_test(no_number),
                                        cmocka_unit_test(ends),         cmocka_unit_test(neutral) };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

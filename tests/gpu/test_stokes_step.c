/* Tests of a length of matter that emits, absorbs and rotates polarised light. It is compared with matrix exponentials
 * in 40 digits (tests/oracle/stokes_reference.py). Optical and Faraday depths range from 0 to 1e6. In one case both
 * characteristic lengths are 0. */
#include "support.h"

#include "stokes_reference.h"
#include "stokes_spv.h"

#include <math.h>

enum { CASES = sizeof stokes_references / sizeof *stokes_references, IN = 10, OUT = 8 };
struct push {
    uint32_t n;
    float q, u, v;
};

static void go(struct kd_vk *vk, const float *in, uint32_t n, float *out)
{
    const double behind[] = STOKES_BEHIND;
    struct kd_vk_pipeline *pipeline = NULL;
    OK(kd_vk_pipeline_create(vk,
                             &(struct kd_vk_pipeline_params) { .name = "stokes",
                                                               .spirv = stokes_spv,
                                                               .spirv_bytes = sizeof stokes_spv,
                                                               .n_buffers = 2,
                                                               .push_bytes = sizeof(struct push) },
                             &pipeline, &error));
    struct kd_vk_buffer *x = make_buffer(vk, n * IN, KD_VK_UPLOAD, "x"),
                        *y = make_buffer(vk, n * OUT, KD_VK_DEVICE, "y"),
                        *back = make_buffer(vk, n * OUT, KD_VK_READBACK, "back");
    memcpy(words(x), in, (size_t)n * IN * sizeof *in);
    const struct push push = { n, (float)behind[1], (float)behind[2], (float)behind[3] };
    OK(kd_vk_dispatch(vk,
                      &(struct kd_vk_dispatch) { .pass = "stokes",
                                                 .pipeline = pipeline,
                                                 .bindings = { { .buffer = x }, { .buffer = y, .write = true } },
                                                 .push = &push,
                                                 .groups = { (n + 63) / 64 } },
                      &error));
    OK(kd_vk_copy(vk, "readback", back, 0, y, 0, (uint64_t)n * OUT * 4, &error));
    finish(vk);
    memcpy(out, words(back), (size_t)n * OUT * sizeof *out);
    kd_vk_buffer_destroy(vk, x);
    kd_vk_buffer_destroy(vk, y);
    kd_vk_buffer_destroy(vk, back);
    kd_vk_pipeline_destroy(vk, pipeline);
}

static void sound(const float *s, const char *what, size_t i)
{
    const double p = sqrt((double)s[1] * s[1] + (double)s[2] * s[2] + (double)s[3] * s[3]);
    if (!(isfinite(s[0]) && s[0] >= 0 && p <= s[0] * (1 + 3e-6) + 1e-37))
        fail_msg("%s, case %zu: %g %g %g %g", what, i, (double)s[0], (double)s[1], (double)s[2], (double)s[3]);
}

static void test_cases(void **state)
{
    float in[CASES * IN], out[CASES * OUT];
    for (size_t i = 0; i < CASES; i++) {
        const struct stokes_reference *r = &stokes_references[i];
        const double of[IN] = { r->light[0], r->light[1], r->light[2], r->depth,    r->takes[0],
                                r->takes[1], r->takes[2], r->turns[0], r->turns[1], r->turns[2] };
        for (size_t k = 0; k < IN; k++)
            in[i * IN + k] = (float)of[k];
    }
    go(*state, in, CASES, out);
    double worst = 0;
    for (size_t i = 0; i < CASES; i++) {
        const struct stokes_reference *r = &stokes_references[i];
        const float *passes = out + OUT * i, *gives = passes + 4;
        /* An angle of m radians has an absolute error of the last digit of m, by whatever method the angle is reduced.
         * */
        const double turn = hypot(hypot(r->turns[0], r->turns[1]), r->turns[2]), allowed = 4e-6 + 1.2e-7 * turn;
        sound(passes, "light from behind", i);
        sound(gives, "its own light", i);
        for (int k = 0; k < 4; k++) {
            const double off = fabs(passes[k] - r->passes[k]) / fmax(r->passes[0], 1e-30),
                         own = fabs(gives[k] - r->gives[k]) / r->gives[0];
            worst = fmax(worst, fmax(r->passes[0] > 1e-20 ? off / (1 + turn) : 0, own));
            if (!(r->passes[0] < 1e-20 || off <= allowed * (1 + r->depth)) || !(own <= 6e-6))
                fail_msg("case %zu, component %d: depth %g, turns %g: light from behind %.8g, want %.8g, off by %.2g; "
                         "its own %.8g, want %.8g, off by %.2g",
                         i, k, r->depth, turn, (double)passes[k], r->passes[k], off, (double)gives[k], r->gives[k],
                         own);
        }
    }
    printf("%d lengths, off by at most %.2g\n", CASES, worst);
}

/* For all values of floats, the light is finite, and is polarised by at most 100 %. */
static void test_extremes(void **state)
{
    enum { N = 4096 };
    static float in[N * IN], out[N * OUT];
    uint32_t seed = 1;
    for (size_t i = 0; i < N; i++) {
        double of[IN], size[3] = { 0 };
        for (size_t k = 0; k < IN; k++) {
            seed = seed * 1664525u + 1013904223u;
            of[k] = (seed >> 8) / 8388608.0 - 1;
        }
        const double depth = i % 7 ? pow(10, 12.5 * of[3]) : 0, turn = i % 11 ? pow(10, 12.5 * of[0]) : 0;
        for (int k = 0; k < 3; k++)
            for (int l = 0; l < 3; l++)
                size[k] += of[(k == 0 ? 0 : k == 1 ? 4 : 7) + l] * of[(k == 0 ? 0 : k == 1 ? 4 : 7) + l];
        for (int l = 0; l < 3; l++) {
            in[i * IN + (size_t)l] = (float)(of[l] / sqrt(size[0]) * 0.999);
            in[i * IN + 4 + (size_t)l] = (float)(of[4 + l] / sqrt(size[1]) * depth * (i % 3 ? 0.99 : 1));
            in[i * IN + 7 + (size_t)l] = (float)(of[7 + l] / sqrt(size[2]) * turn);
        }
        in[i * IN + 3] = (float)depth;
    }
    go(*state, in, N, out);
    for (size_t i = 0; i < N; i++) {
        sound(out + OUT * i, "light from behind", i);
        sound(out + OUT * i + 4, "its own light", i);
    }
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(test_cases), cmocka_unit_test(test_extremes) };
    return RUN_ON_DEVICE(tests);
}

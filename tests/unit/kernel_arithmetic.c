/* Tests that kernels restrict what a driver may do with their arithmetic. Vulkan 1.2 lets a driver fuse, reorder and
 * expand floating-point operations unless they are decorated NoContraction, and behave as if NaN and infinity did not
 * exist (no kernel uses SignedZeroInfNanPreserve). A driver that does none of this cannot show a missing decoration in
 * a picture. The test therefore inspects the SPIR-V, before and after shaders/compile.py inlines the functions. */
#include <stdint.h>

#define KD_SPIRV_PLAIN
#include "lens_closed.spv.h"
#include "lens_map.spv.h"
#include "photometry.spv.h"
#include "rays.spv.h"
#include "rays_f64.spv.h"
#include "rays_kerr_schild.spv.h"
#include "rays_kerr_schild_f64.spv.h"
#include "transfer.spv.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* SPIR-V 1.5 specification, section 3. */
enum {
    OP_NAME = 5,
    OP_FUNCTION = 54,
    OP_FUNCTION_END = 56,
    OP_DECORATE = 71,
    OP_FADD = 129,
    OP_FSUB = 131,
    OP_FMUL = 133,
    OP_IS_NAN = 156,
    OP_IS_INF = 157,
    NO_CONTRACTION = 42,
};

struct spirv {
    const char *kernel;
    const uint32_t *words;
    size_t n;
    bool motion; /* true if the kernel traces rays step by step */
};
#define PLAIN(name, motion) { #name, kd_spv_##name##_plain, sizeof kd_spv_##name##_plain / 4, motion },
#define FINAL(name, motion) { #name, kd_spv_##name, sizeof kd_spv_##name / 4, motion },
/* clang-format off */
#define KERNELS_OF(X) \
    X(lens_closed, false) X(lens_map, true) X(rays, true) X(rays_f64, true) X(rays_kerr_schild, false) \
    X(rays_kerr_schild_f64, false) X(transfer, false) X(photometry, false)
/* clang-format on */
static const struct spirv kernels[] = { KERNELS_OF(PLAIN) }, as_made[] = { KERNELS_OF(FINAL) };
enum { KERNELS = sizeof kernels / sizeof *kernels };

static const uint32_t *next(const struct spirv *s, size_t *at)
{
    if (*at >= s->n)
        return NULL;
    const uint32_t *op = s->words + *at;
    assert_true(op[0] >> 16);
    *at += op[0] >> 16;
    return op;
}
static uint32_t opcode(const uint32_t *op) { return op[0] & 0xffff; }

static bool asks_for_nan(const struct spirv *s)
{
    size_t at = 5;
    for (const uint32_t *op; (op = next(s, &at));)
        if (opcode(op) == OP_IS_NAN || opcode(op) == OP_IS_INF)
            return true;
    return false;
}

static void no_kernel_asks_for_nan(void **state)
{
    (void)state;
    for (size_t k = 0; k < KERNELS; k++)
        if (asks_for_nan(&kernels[k]) || asks_for_nan(&as_made[k]))
            fail_msg("%s: isnan or isinf, which a driver may replace by false: use kd_is_finite", kernels[k].kernel);
}

static bool is_precise(const struct spirv *s, uint32_t id)
{
    size_t at = 5;
    for (const uint32_t *op; (op = next(s, &at));)
        if (opcode(op) == OP_DECORATE && op[1] == id && op[2] == NO_CONTRACTION)
            return true;
    return false;
}

/* Counts sums, differences and products in functions whose name begins with `name`, and how many of them are
 * precise. */
static void count(const struct spirv *s, const char *name, int *all, int *precise)
{
    uint32_t id = 0;
    size_t at = 5;
    *all = *precise = 0;
    for (const uint32_t *op; (op = next(s, &at));)
        if (opcode(op) == OP_NAME && !strncmp((const char *)(op + 2), name, strlen(name)))
            id = op[1];
    bool inside = false;
    at = 5;
    for (const uint32_t *op; id && (op = next(s, &at));) {
        uint32_t code = opcode(op);
        if (code == OP_FUNCTION || code == OP_FUNCTION_END)
            inside = code == OP_FUNCTION && op[2] == id;
        else if (inside && (code == OP_FADD || code == OP_FSUB || code == OP_FMUL)) {
            ++*all;
            *precise += is_precise(s, op[2]);
        }
    }
}

/* checks that at least ten functions still have these names */
static void what_must_not_be_reordered(void **state)
{
    (void)state;
    static const struct {
        const char *function;
        int least;
    } functions[] = {
        { "kd_delta(", 0 },      { "kd_fall_squared(", 0 }, { "kd_full_step(", 12 },
        { "kd_path_step(", 12 }, { "kd_radial_step(", 12 },
    };
    int found = 0;
    for (size_t k = 0; k < KERNELS; k++)
        for (size_t i = 0; i < sizeof functions / sizeof *functions; i++) {
            int all, precise;
            count(&kernels[k], functions[i].function, &all, &precise);
            if (all && precise < (functions[i].least ? functions[i].least : all))
                fail_msg("%s, %s): %d of %d operations are precise", kernels[k].kernel, functions[i].function, precise,
                         all);
            found += all > 0 && kernels[k].motion;
        }
    assert_true(found >= 10); /* the functions still have these names */
}

/* Counts the precise additions, subtractions and multiplications. */
static int decorated(const struct spirv *s)
{
    size_t at = 5;
    int n = 0;
    for (const uint32_t *op; (op = next(s, &at));)
        n += (opcode(op) == OP_FADD || opcode(op) == OP_FSUB || opcode(op) == OP_FMUL) && is_precise(s, op[2]);
    return n;
}

/* Precise operations stay precise where functions are inlined: a kernel has at least as many of them afterwards. */
static void what_is_precise_stays_so(void **state)
{
    (void)state;
    int all = 0;
    for (size_t k = 0; k < KERNELS; k++) {
        const int before = decorated(&kernels[k]), after = decorated(&as_made[k]);
        if (after < before)
            fail_msg("%s: %d operations are precise, of %d before spirv-opt", kernels[k].kernel, after, before);
        all += before;
    }
    assert_true(all > 100);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(no_kernel_asks_for_nan),
                                        cmocka_unit_test(what_must_not_be_reordered),
                                        cmocka_unit_test(what_is_precise_stays_so) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

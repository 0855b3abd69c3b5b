/* Tests of bindings other than storage: a uniform block, texels of one float and of four, of one word and of two. Also
 * tests refused bindings, and the lifetime of their views. */
#include "support.h"

#include "fake_device.h"
#include "vk/view.h"

enum { MOST = 3000 };

/* The buffers of one dispatch of kinds.comp, filled by a rule with integers, so that sums are exact. */
struct set { struct kd_vk_buffer *block, *singles, *fours, *y, *single_words, *pairs; };

static float single_of(uint32_t i) { return (float)(i * 7 % 1013); }
static float four_of(uint32_t i) { return (float)(i * 5 % 811); } /* i: index of the float */
static float table_of(uint32_t k) { return (float)(100000 * (k + 1)); }
/* Small integers. As floats their bits are denormal numbers. */
static uint32_t word_of(uint32_t i) { return i * 3 % 97; }
static uint32_t pair_of(uint32_t i) { return i * 11 % 89; } /* i: index of the word */
static float expected(uint32_t i, float y, float scale)
{
    float sum = y * scale + table_of(i % 6) + 10 * single_of(i);
    for (uint32_t k = 0; k < 4; k++)
        sum += (float)(k + 1) * four_of(4 * i + k);
    sum += (float)(word_of(i) + 2 * pair_of(2 * i) + 3 * pair_of(2 * i + 1));
    return sum;
}

static struct set make_set(struct kd_vk *vk, uint32_t n, float scale)
{
    struct set set = { make_buffer(vk, 8, KD_VK_UPLOAD, "block"),     make_buffer(vk, n, KD_VK_UPLOAD, "singles"),
                       make_buffer(vk, 4 * n, KD_VK_UPLOAD, "fours"), make_buffer(vk, n, KD_VK_READBACK, "y"),
                       make_buffer(vk, n, KD_VK_UPLOAD, "words"),     make_buffer(vk, 2 * n, KD_VK_UPLOAD, "pairs") };
    struct kinds_block *block = kd_vk_buffer_map(set.block);
    float *singles = kd_vk_buffer_map(set.singles), *fours = kd_vk_buffer_map(set.fours);
    *block = (struct kinds_block) { .n = n, .scale = scale };
    for (uint32_t k = 0; k < 6; k++)
        block->table[k] = table_of(k);
    for (uint32_t i = 0; i < n; i++)
        singles[i] = single_of(i);
    for (uint32_t i = 0; i < 4 * n; i++)
        fours[i] = four_of(i);
    for (uint32_t i = 0; i < n; i++)
        words(set.single_words)[i] = word_of(i);
    for (uint32_t i = 0; i < 2 * n; i++)
        words(set.pairs)[i] = pair_of(i);
    return set;
}

static void drop(struct kd_vk *vk, struct set *set)
{
    kd_vk_buffer_destroy(vk, set->block);
    kd_vk_buffer_destroy(vk, set->singles);
    kd_vk_buffer_destroy(vk, set->fours);
    kd_vk_buffer_destroy(vk, set->y);
    kd_vk_buffer_destroy(vk, set->single_words);
    kd_vk_buffer_destroy(vk, set->pairs);
}

static struct kd_vk_dispatch dispatch_of(const struct kd_vk_pipeline *pipeline, const struct set *set, uint32_t n)
{
    return (struct kd_vk_dispatch) { .pass = "kinds",
                                     .pipeline = pipeline,
                                     .bindings = { { .buffer = set->block },
                                                   { .buffer = set->singles },
                                                   { .buffer = set->fours },
                                                   { .buffer = set->y, .write = true },
                                                   { .buffer = set->single_words },
                                                   { .buffer = set->pairs } },
                                     .groups = { (n + 63) / 64 } };
}

static void values(void **state)
{
    struct kd_vk *vk = *state;
    static const uint32_t counts[] = { 1, 63, 64, 65, MOST };
    struct kd_vk_pipeline *pipeline = make_kinds(vk);
    for (size_t c = 0; c < sizeof counts / sizeof *counts; c++) {
        uint32_t n = counts[c];
        struct set set = make_set(vk, n, 3);
        const struct kd_vk_dispatch d = dispatch_of(pipeline, &set, n);
        OK(kd_vk_fill(vk, "fill", set.y, 0, 4ull * n, 0x40000000, &error)); /* the bits of 2.0 */
        OK(kd_vk_dispatch(vk, &d, &error));
        finish(vk);
        const float *y = kd_vk_buffer_map(set.y);
        for (uint32_t i = 0; i < n; i++)
            assert_true(y[i] == expected(i, 2, 3));
        drop(vk, &set);
    }
    kd_vk_pipeline_destroy(vk, pipeline);
    assert_int_equal(kd_vk_allocated(vk), 0);
}

/* Parts of buffers: texels and members of a block are counted from the beginning of the binding. A buffer that ends
 * within a texel is bound up to that point. */
static void ranges(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 64, at = 256 / 4 };
    struct kd_vk_pipeline *pipeline = make_kinds(vk);
    struct set set = make_set(vk, n, 0);
    struct kd_vk_buffer *block = make_buffer(vk, at + 8, KD_VK_UPLOAD, "block, later"),
                        *singles = make_buffer(vk, 2 * at + n, KD_VK_UPLOAD, "singles, later"),
                        *fours = make_buffer(vk, at + 4 * n + 3, KD_VK_UPLOAD, "fours, later");
    struct kd_vk_dispatch d = dispatch_of(pipeline, &set, n);
    memset(words(block), 0xff, 4 * at);
    memset(words(singles), 0xff, 4 * (2 * at + n));
    memset(words(fours), 0xff, 4 * (at + 4 * n + 3));
    memcpy(words(block) + at, words(set.block), 4 * 8);
    memcpy(words(singles) + 2 * at, words(set.singles), 4 * n);
    memcpy(words(fours) + at, words(set.fours), 16 * n);
    d.bindings[0] = (struct kd_vk_binding) { .buffer = block, .offset = 4 * at, .size = sizeof(struct kinds_block) };
    d.bindings[1] = (struct kd_vk_binding) { .buffer = singles, .offset = 8 * at, .size = 4 * n };
    d.bindings[2] = (struct kd_vk_binding) { .buffer = fours, .offset = 4 * at };
    OK(kd_vk_fill(vk, "fill", set.y, 0, 4 * n, 0, &error));
    OK(kd_vk_dispatch(vk, &d, &error));
    finish(vk);
    const float *y = kd_vk_buffer_map(set.y);
    for (uint32_t i = 0; i < n; i++)
        assert_true(y[i] == expected(i, 0, 0));
    kd_vk_buffer_destroy(vk, block);
    kd_vk_buffer_destroy(vk, singles);
    kd_vk_buffer_destroy(vk, fours);
    drop(vk, &set);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* Buffers are written and read alternately in one submission, each kind in turn. The layer must set the barriers. */
static void order(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = MOST, rounds = 6 };
    struct kd_vk_pipeline *pipeline = make_kinds(vk), *add = make_mix(vk, 0);
    struct set set = make_set(vk, n, 1);
    struct kd_vk_buffer *read[3] = { make_buffer(vk, 8, KD_VK_DEVICE, "block on the device"),
                                     make_buffer(vk, n, KD_VK_DEVICE, "singles on the device"),
                                     make_buffer(vk, 4 * n, KD_VK_DEVICE, "fours on the device") },
                        *from[3] = { set.block, set.singles, set.fours };
    struct kd_vk_dispatch d = dispatch_of(pipeline, &set, n);
    for (int k = 0; k < 3; k++)
        d.bindings[k].buffer = read[k];
    OK(kd_vk_fill(vk, "fill", set.y, 0, 4 * n, 0, &error));
    for (int round = 0; round < rounds; round++)
        for (int k = 0; k < 3; k++) { /* read by a copy, then by a kernel that adds 0 to the same buffer */
            for (int j = 0; j < 3 && (k == 0 || !round); j++)
                OK(kd_vk_copy(vk, NULL, read[j], 0, from[j], 0, kd_vk_buffer_size(from[j]), &error));
            OK(kd_vk_fill(vk, "fill", read[k], 0, kd_vk_buffer_size(read[k]), 0, &error));
            mix(vk, add, from[k], read[k], (uint32_t)(kd_vk_buffer_size(from[k]) / 4), 1);
            OK(kd_vk_dispatch(vk, &d, &error));
        }
    finish(vk);
    const float *y = kd_vk_buffer_map(set.y);
    for (uint32_t i = 0; i < n; i++) {
        float sum = 0;
        for (int j = 0; j < 3 * rounds; j++)
            sum = expected(i, sum, 1);
        assert_true(y[i] == sum);
    }
    for (int k = 0; k < 3; k++)
        kd_vk_buffer_destroy(vk, read[k]);
    drop(vk, &set);
    kd_vk_pipeline_destroy(vk, pipeline);
    kd_vk_pipeline_destroy(vk, add);
}

static void refused(void **state)
{
    struct kd_vk *vk = *state;
    struct kd_vk_pipeline *pipeline = make_kinds(vk), *none;
    struct set set = make_set(vk, 64, 1);
    const struct kd_vk_dispatch good = dispatch_of(pipeline, &set, 64);
    struct kd_vk_dispatch bad;
    for (int k = 0; k < 3; k++) {
        bad = good, bad.bindings[k].write = true;
        FAILS(KD_EINTERNAL, "is not a storage buffer", kd_vk_dispatch(vk, &bad, &error));
    }
    bad = good, bad.bindings[1].size = 7;
    FAILS(KD_EINTERNAL, "whole texels of 4 bytes", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[5].size = 12;
    FAILS(KD_EINTERNAL, "whole texels of 8 bytes", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[2].size = 40;
    FAILS(KD_EINTERNAL, "whole texels of 16 bytes", kd_vk_dispatch(vk, &bad, &error));
    bad = good, bad.bindings[2].offset = 16;
    FAILS(KD_EINTERNAL, "multiple of 256", kd_vk_dispatch(vk, &bad, &error));
    struct kd_vk_buffer *crumb = make_buffer(vk, 3, KD_VK_DEVICE, "crumb");
    bad = good, bad.bindings[2].buffer = crumb;
    FAILS(KD_EINTERNAL, "whole texels of 16 bytes", kd_vk_dispatch(vk, &bad, &error)); /* less than one texel */
    struct kd_vk_pipeline_params params = KINDS_PARAMS;
    params.kinds[1] = (enum kd_vk_kind)7;
    FAILS(KD_EINTERNAL, "binding 1 has the unknown kind 7", kd_vk_pipeline_create(vk, &params, &none, &error));
    kd_vk_buffer_destroy(vk, crumb);
    drop(vk, &set);
    kd_vk_pipeline_destroy(vk, pipeline);
}

/* The maximum that a device binds of each kind, and one more. */
static void limits(void **state)
{
    (void)state;
    enum { texels = 65536, uniform = 16384 }; /* the minimum that Vulkan guarantees */
    fake_device_on(&(struct fake_device) { .texels = texels, .uniform = uniform });
    struct kd_vk *vk = open_device(true);
    assert_int_equal(kd_vk_info(vk)->max_texels, texels);
    assert_int_equal(kd_vk_info(vk)->max_uniform_bytes, uniform);
    struct kd_vk_pipeline *pipeline = make_kinds(vk);
    struct set set = make_set(vk, 64, 1);
    const uint64_t most[] = { uniform, 4 * texels, 16 * texels };
    for (int k = 0; k < 3; k++) {
        struct kd_vk_buffer *large = make_buffer(vk, (uint32_t)(most[k] / 4 + 64), KD_VK_DEVICE, "large");
        struct kd_vk_dispatch d = dispatch_of(pipeline, &set, 64);
        OK(kd_vk_fill(vk, "fill", large, 0, kd_vk_buffer_size(large), 0, &error));
        d.bindings[k].buffer = large;
        FAILS(KD_ETOOBIG, "on this device it must have at most", kd_vk_dispatch(vk, &d, &error));
        d.bindings[k].size = most[k] + 16;
        FAILS(KD_ETOOBIG, "on this device it must have at most", kd_vk_dispatch(vk, &d, &error));
        d.bindings[k].size = most[k];
        OK(kd_vk_dispatch(vk, &d, &error));
        finish(vk);
        kd_vk_buffer_destroy(vk, large);
    }
    drop(vk, &set);
    kd_vk_pipeline_destroy(vk, pipeline);
    assert_int_equal(kd_vk_validation_messages(vk), 0);
    kd_vk_destroy(vk);
    fake_device_off();
}

static unsigned views_of(const struct kd_vk_buffer *buffer)
{
    unsigned n = 0;
    for (const struct kd_vk_view *view = buffer->views.first; view; view = view->next)
        n++;
    return n;
}

/* A repeated binding has only one view. Of many views, those in use and a few more are kept. No view outlives its
 * buffer, which may be destroyed while the device reads through its views. */
static void views(void **state)
{
    struct kd_vk *vk = *state;
    enum { n = 64, parts = 40 };
    struct kd_vk_pipeline *pipeline = make_kinds(vk);
    struct set set = make_set(vk, n * parts, 0);
    struct kd_vk_dispatch d = dispatch_of(pipeline, &set, n);
    OK(kd_vk_fill(vk, "fill", set.y, 0, 4 * n * parts, 0, &error));
    for (int i = 0; i < 100; i++)
        OK(kd_vk_dispatch(vk, &d, &error));
    assert_int_equal(views_of(set.singles), 1);
    assert_int_equal(views_of(set.fours), 1);
    assert_int_equal(views_of(set.block) + views_of(set.y), 0);
    finish(vk);
    ((struct kinds_block *)kd_vk_buffer_map(set.block))->n = n;
    /* all dispatches are in one submission, so only the earlier view is idle, and none of these */
    for (uint32_t i = 0; i < parts; i++) {
        d.bindings[1] = (struct kd_vk_binding) { .buffer = set.singles, .offset = 256 * i, .size = 256 };
        d.bindings[3] = (struct kd_vk_binding) { .buffer = set.y, .offset = 256 * i, .size = 256, .write = true };
        OK(kd_vk_dispatch(vk, &d, &error));
    }
    assert_int_equal(views_of(set.singles), parts);
    finish(vk);
    const float *y = kd_vk_buffer_map(set.y);
    for (uint32_t i = 0; i < n * parts; i++)
        assert_true(y[i] == expected(i % n, 0, 0) + 10 * (single_of(i) - single_of(i % n)));
    d.bindings[1].size = 128;
    OK(kd_vk_dispatch(vk, &d, &error));
    assert_int_equal(views_of(set.singles), KD_VK_VIEWS_KEPT);
    kd_vk_buffer_destroy(vk, set.singles); /* the commands are recorded and not yet submitted */
    OK(kd_vk_submit(vk, NULL, &error));
    kd_vk_buffer_destroy(vk, set.fours);
    OK(kd_vk_wait(vk, 0, &error));
    assert_null(vk->retired);
    kd_vk_buffer_destroy(vk, set.block);
    kd_vk_buffer_destroy(vk, set.y);
    kd_vk_buffer_destroy(vk, set.single_words);
    kd_vk_buffer_destroy(vk, set.pairs);
    kd_vk_pipeline_destroy(vk, pipeline);
    assert_int_equal(kd_vk_allocated(vk), 0);
}

int main(void)
{
    struct CMUnitTest tests[] = { cmocka_unit_test(values),  cmocka_unit_test(ranges), cmocka_unit_test(order),
                                  cmocka_unit_test(refused), cmocka_unit_test(limits), cmocka_unit_test(views) };
    return RUN_ON_DEVICE(tests);
}

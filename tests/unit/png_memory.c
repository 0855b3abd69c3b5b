/* Tests of PNG with failing allocations: each allocation fails in turn. The result must be KD_ENOMEM, the output buffer
 * must be unchanged, and nothing may leak. */
#include "base/parallel.h"
#include "image/png.h"
#include "image/png_live.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <libdeflate.h>

/* The linker redirects the module's calls to these functions (--wrap). libpng allocates through the module. */
void *__real_malloc(size_t size);
void *__real_realloc(void *old, size_t size);
void *__real_calloc(size_t n, size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_calloc(size_t n, size_t size);

static int countdown = -1; /* allocations until the one that fails; negative: none does */

static int fails(void) { return countdown >= 0 && countdown-- == 0; }
void *__wrap_malloc(size_t size) { return fails() ? NULL : __real_malloc(size); }
void *__wrap_realloc(void *old, size_t size) { return fails() ? NULL : __real_realloc(old, size); }
void *__wrap_calloc(size_t n, size_t size) { return fails() ? NULL : __real_calloc(n, size); }

enum { SIDE = 64, TALL = 11264 /* a picture of this height has eight strips */ };

static enum kd_status encode(struct kd_buffer *out, struct kd_error *error)
{
    static uint16_t pixels[3 * SIDE * TALL];
    for (uint32_t i = 0; i < 3 * SIDE * TALL; i++)
        pixels[i] = (uint16_t)(i * 2654435761u >> 16);
    const struct kd_png_text text[] = { { "one", "1" }, { "two", "\xe2\x88\x9e" } };
    const struct kd_png_params params = {
        .width = SIDE,
        .height = TALL,
        .bit_depth = 16,
        .compression = 1,
        .pixels = pixels,
        .text = text,
        .n_text = 2,
    };
    return kd_png_encode(&params, out, error);
}

static void encoding(void **state)
{
    (void)state;
    int n = 0;
    libdeflate_set_memory_allocator(__wrap_malloc, free);
    kd_parallel_threads = 1; /* one thread, so that allocations occur in a fixed order */
    for (;; n++) {
        struct kd_buffer out = { 0 };
        struct kd_error error = { 0 };
        countdown = -1;
        assert_int_equal(kd_buffer_append(&out, "head", 4), KD_OK);
        countdown = n;
        enum kd_status status = encode(&out, &error);
        int reached = countdown < 0;
        countdown = -1;
        if (!reached) {
            assert_int_equal(status, KD_OK);
            kd_buffer_finish(&out);
            break;
        }
        assert_int_equal(status, KD_ENOMEM);
        assert_true(error.message[0]);
        assert_int_equal(out.size, 4);
        assert_memory_equal(out.data, "head", 4);
        kd_buffer_finish(&out);
    }
    print_message("%d allocations\n", n);
    assert_true(n > 5);
}

static void decoding(void **state)
{
    (void)state;
    struct kd_buffer file = { 0 };
    int n = 0;
    assert_int_equal(encode(&file, NULL), KD_OK);
    for (;; n++) {
        struct kd_png png;
        struct kd_error error = { 0 };
        countdown = n;
        enum kd_status status = kd_png_decode(file.data, file.size, &png, &error);
        int reached = countdown < 0;
        countdown = -1;
        if (!reached) {
            assert_int_equal(status, KD_OK);
            kd_png_finish(&png);
            break;
        }
        if (status != KD_ENOMEM)
            fail_msg("allocation %d failed: status %d, \"%s\"", n, status, error.message);
        assert_null(png.pixels);
        assert_null(png.text);
    }
    kd_buffer_finish(&file);
    print_message("%d allocations\n", n);
    assert_true(n > 5);
}

/* One encoder encodes two frames, the second larger than the first. It encodes a third after the last failure. */
static enum kd_status live_frames(enum kd_deflate_engine engine, struct kd_buffer *out, struct kd_error *error)
{
    static uint8_t pixels[3 * 8 * SIDE * SIDE];
    struct kd_png_live *live;
    for (uint32_t i = 0; i < sizeof pixels; i++)
        pixels[i] = (uint8_t)(i * 2654435761u >> 24);
    enum kd_status status = kd_png_live_create(engine, &live, error);
    if (status) {
        assert_null(live);
        return status;
    }
    size_t size = out->size;
    for (uint32_t k = 0; k < 2 && !status; k++) {
        size = out->size;
        status = kd_png_live_encode(live, SIDE, k ? 8 * SIDE : 8, pixels, out, error);
    }
    if (status) {
        struct kd_buffer again = { 0 };
        assert_int_equal(out->size, size);
        countdown = -1;
        assert_int_equal(kd_png_live_encode(live, SIDE, 8 * SIDE, pixels, &again, NULL), KD_OK);
        kd_buffer_finish(&again);
    }
    kd_png_live_destroy(live);
    return status;
}

static void live_encoding(void **state)
{
    (void)state;
    libdeflate_set_memory_allocator(__wrap_malloc, free);
    for (enum kd_deflate_engine engine = 0; engine < KD_DEFLATE_COUNT; engine++) {
        int n = 0;
        if (!kd_deflate_has(engine))
            continue;
        for (enum kd_status status = KD_ENOMEM; status; n++) {
            struct kd_buffer out = { 0 };
            struct kd_error error = { 0 };
            assert_int_equal(kd_buffer_append(&out, "head", 4), KD_OK);
            countdown = n;
            status = live_frames(engine, &out, &error);
            countdown = -1;
            if (status) {
                assert_int_equal(status, KD_ENOMEM);
                assert_true(error.message[0]);
            }
            assert_true(status || n > 5); /* at the end, each allocation has failed once */
            assert_memory_equal(out.data, "head", 4);
            kd_buffer_finish(&out);
        }
        print_message("%s: %d allocations\n", kd_deflate_name(engine), n - 1);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(encoding),
        cmocka_unit_test(decoding),
        cmocka_unit_test(live_encoding),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

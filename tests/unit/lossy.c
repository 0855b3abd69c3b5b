/* Tests of metadata in JPEG and WebP files, and of WebP's pixels. The pictures are decoded by the libraries. */
#include "image/jpeg.h"
#include "image/webp.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <webp/decode.h>

enum { WIDTH = 97, HEIGHT = 61 };
static const char packet[] = "<x:xmpmeta>a packet</x:xmpmeta>";
static uint8_t pixels[3 * WIDTH * HEIGHT];
static struct kd_error error;

static int make(void **state)
{
    (void)state;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        for (int c = 0; c < 3; c++)
            pixels[3 * i + c] = (uint8_t)(127 + 90 * sin(i % WIDTH * 0.11 + c) * cos(i / WIDTH * 0.07));
    return 0;
}

static double off(const uint8_t *a)
{
    double sum = 0;
    for (size_t i = 0; i < sizeof pixels; i++)
        sum += fabs((double)a[i] - pixels[i]);
    return sum / sizeof pixels;
}

static void webp_pixels(void **state)
{
    double before = INFINITY;
    size_t size = 0;
    (void)state;
    for (unsigned quality = 10; quality <= 100; quality += 30) {
        struct kd_buffer file = { 0 };
        int width = 0, height = 0;
        assert_int_equal(kd_webp_encode(WIDTH, HEIGHT, pixels, quality, &file, &error), KD_OK);
        uint8_t *decoded = WebPDecodeRGB(file.data, file.size, &width, &height);
        assert_non_null(decoded);
        assert_int_equal(width, WIDTH);
        assert_int_equal(height, HEIGHT);
        print_message("quality %u: %zu bytes, off by %.2f\n", quality, file.size, off(decoded));
        /* at a higher quality, the pixels are closer to the picture and the file is larger */
        assert_true(off(decoded) < fmin(before, 12));
        assert_true(file.size > size);
        before = off(decoded);
        size = file.size;
        WebPFree(decoded);
        kd_buffer_finish(&file);
    }
    assert_true(before < 1.5);
}

/* While noise is encoded, the peak of memory is below the stated bound, but not far below it. It is measured in a
 * separate process. */
static void webp_memory(void **state)
{
    enum { SIDE = 1200 };
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    skip(); /* not measured, because sanitizers use memory of their own */
#endif
    const pid_t child = fork();
    if (!child) {
        uint8_t *noise = malloc(3 * SIDE * SIDE);
        struct kd_buffer file = { 0 };
        struct rusage before, after;
        for (size_t i = 0; noise && i < 3 * SIDE * SIDE; i++)
            noise[i] = (uint8_t)(rand() >> 8);
        getrusage(RUSAGE_SELF, &before);
        const bool made = noise && !kd_webp_encode(SIDE, SIDE, noise, 100, &file, &error);
        getrusage(RUSAGE_SELF, &after);
        const double share = 1024. * (double)(after.ru_maxrss - before.ru_maxrss) / (double)kd_webp_bytes(SIDE, SIDE);
        print_message("%.2f of the bound\n", share);
        _exit(!(made && share > 0.5 && share <= 1));
    }
    int end;
    assert_int_equal(waitpid(child, &end, 0), child);
    assert_int_equal(end, 0);
    assert_true(kd_webp_bytes(16000, 16000) < 6ull * 16000 * 16000);
}

static void refused(void **state)
{
    struct kd_buffer file = { 0 };
    (void)state;
    assert_int_equal(kd_webp_encode(WIDTH, HEIGHT, pixels, 0, &file, &error), KD_EINVAL);
    assert_int_equal(kd_webp_encode(WIDTH, HEIGHT, pixels, 101, &file, &error), KD_EINVAL);
    assert_int_equal(kd_webp_encode(KD_WEBP_SIDE_MAX + 1, 1, pixels, 90, &file, &error), KD_EINVAL);
    assert_int_equal(kd_webp_encode(1, 0, pixels, 90, &file, &error), KD_EINVAL);
    assert_int_equal(file.size, 0);
    kd_buffer_finish(&file);
}

static const void *find(bool webp, const void *data, size_t size, size_t *length, struct kd_buffer *room)
{
    if (!webp)
        return kd_jpeg_xmp(data, size, length);
    room->size = 0;
    if (kd_webp_xmp(data, size, room, &error))
        return NULL;
    *length = room->size;
    return room->data;
}

/* A file that is cut anywhere is refused, or still has its packet. Each copy has exactly its size, so that a sanitizer
 * notices a read beyond the end. */
static void cut_anywhere(bool webp, const struct kd_buffer *file)
{
    for (size_t size = 0; size <= file->size; size++) {
        uint8_t *copy = malloc(size ? size : 1);
        struct kd_buffer room = { 0 };
        size_t length = 0;
        assert_non_null(copy);
        memcpy(copy, file->data, size);
        const void *found = find(webp, copy, size, &length, &room);
        assert_true(!found || (length == strlen(packet) && !memcmp(found, packet, length)));
        assert_true(found || size < file->size);
        kd_buffer_finish(&room);
        free(copy);
    }
}

static void packets(void **state)
{
    (void)state;
    for (int webp = 0; webp < 2; webp++) {
        struct kd_buffer bare = { 0 }, file = { 0 }, room = { 0 };
        size_t length = 0;
        assert_int_equal((webp ? kd_webp_encode : kd_jpeg_encode)(WIDTH, HEIGHT, pixels, 80, &bare, &error), KD_OK);
        assert_null(find(webp, bare.data, bare.size, &length, &room));
        assert_int_equal(kd_buffer_append(&file, "before", 6), KD_OK);
        assert_int_equal((webp ? kd_webp_add_xmp : kd_jpeg_add_xmp)(&bare, packet, strlen(packet), &file, &error),
                         KD_OK);
        assert_memory_equal(file.data, "before", 6);
        struct kd_buffer whole = { file.data + 6, file.size - 6, file.size - 6 };
        cut_anywhere(webp, &whole);
        kd_buffer_finish(&bare);
        kd_buffer_finish(&file);
        kd_buffer_finish(&room);
    }
}

static void longest_packet(void **state)
{
    struct kd_buffer bare = { 0 }, file = { 0 };
    char *text = malloc(KD_JPEG_XMP_MAX + 1);
    size_t length = 0;
    (void)state;
    assert_non_null(text);
    memset(text, 'a', KD_JPEG_XMP_MAX + 1);
    assert_int_equal(kd_jpeg_encode(WIDTH, HEIGHT, pixels, 80, &bare, &error), KD_OK);
    assert_int_equal(kd_jpeg_add_xmp(&bare, text, KD_JPEG_XMP_MAX + 1, &file, &error), KD_ETOOBIG);
    assert_int_equal(file.size, 0);
    assert_int_equal(kd_jpeg_add_xmp(&bare, text, KD_JPEG_XMP_MAX, &file, &error), KD_OK);
    assert_non_null(kd_jpeg_xmp(file.data, file.size, &length));
    assert_int_equal(length, KD_JPEG_XMP_MAX);
    kd_buffer_finish(&bare);
    kd_buffer_finish(&file);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(webp_pixels), cmocka_unit_test(webp_memory),    cmocka_unit_test(refused),
        cmocka_unit_test(packets),     cmocka_unit_test(longest_packet),
    };
    return cmocka_run_group_tests(tests, make, NULL);
}

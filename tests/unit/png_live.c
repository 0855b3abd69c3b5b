/* Tests of live frames by every engine that was built in: pixels are compared with what libpng decodes, and each chunk
 * and checksum is tested with zlib. */
#include "base/parallel.h"
#include "image/png.h"
#include "image/png_live.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cmocka.h>
#include <zlib.h>

static uint32_t seed = 2024;
static uint32_t random_bits(void) { return (seed = seed * 1664525u + 1013904223u) >> 8; }

enum content { BLACK, FLAT, RANDOM, SMOOTH, DITHERED, CHECKS, SPARSE, CONTENTS };

static uint8_t sample(enum content content, uint32_t x, uint32_t y, uint32_t c)
{
    switch (content) {
    case BLACK: return 0;
    case FLAT: return (uint8_t)(200 - c);
    case RANDOM: return (uint8_t)random_bits();
    case SMOOTH: return (uint8_t)(x * (c + 1) / 3 + y / 2);
    case DITHERED: return (uint8_t)((x * 7 + y * 5 + random_bits() % 16) / 16);
    case CHECKS: return (x ^ y) & 1 ? 255 : 0;
    default: return random_bits() % 997 ? 0 : (uint8_t)random_bits();
    }
}

static uint8_t *picture(enum content content, uint32_t width, uint32_t height)
{
    uint8_t *pixels = malloc((size_t)width * height * 3);
    assert_non_null(pixels);
    for (uint32_t y = 0, i = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            for (uint32_t c = 0; c < 3; c++)
                pixels[i++] = sample(content, x, y, c);
    return pixels;
}

static uint32_t big_endian(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

/* The contents of a file's IDAT chunks, concatenated. */
struct stream {
    uint8_t *data;
    size_t size;
};

static void check_stream(const struct stream *stream, uint32_t width, uint32_t height)
{
    uLong expected = (3 * (uLong)width + 1) * height, used = stream->size;
    uLongf got = expected + 1;
    uint8_t *rows = malloc(got);
    assert_non_null(rows);
    assert_int_equal(uncompress2(rows, &got, stream->data, &used), Z_OK);
    assert_int_equal(got, expected);
    assert_int_equal(used, stream->size);
    free(rows);
}

static void check_header(const uint8_t *data, uint32_t length, uint32_t width, uint32_t height)
{
    static const uint8_t tail[5] = { 8, 2, 0, 0, 0 };
    assert_int_equal(length, 13);
    assert_int_equal(big_endian(data), width);
    assert_int_equal(big_endian(data + 4), height);
    assert_memory_equal(data + 8, tail, 5);
}

/* the engine under test divides a frame with at least this many filtered bytes into strips */
static size_t least_in_strips;

/* The file is IHDR, sRGB, an IDAT for each strip, IEND and nothing else, each with a valid CRC; zlib checks the sum
 * of the stream, and no bytes are left over. A frame below 1 MiB has one IDAT. */
static void check_strictly(const uint8_t *file, size_t size, uint32_t width, uint32_t height)
{
    struct stream stream = { malloc(size), 0 };
    size_t at = 8, chunks = 0, strips = 0;
    assert_non_null(stream.data);
    assert_memory_equal(file, "\x89PNG\r\n\x1a\n", 8);
    for (bool ended = false; !ended; chunks++) {
        assert_true(size - at >= 12);
        const uint32_t length = big_endian(file + at);
        const uint8_t *data = file + at + 8;
        assert_true(length <= size - at - 12);
        assert_int_equal(big_endian(data + length), crc32(0, file + at + 4, length + 4));
        ended = chunks > 2 && !memcmp(file + at + 4, "IEND", 4);
        if (ended)
            assert_int_equal(length, 0);
        else
            assert_memory_equal(file + at + 4, chunks == 0 ? "IHDR" : chunks == 1 ? "sRGB" : "IDAT", 4);
        if (chunks == 0)
            check_header(data, length, width, height);
        if (chunks == 1)
            assert_int_equal(length, 1);
        if (chunks < 2 || ended) {
            at += 12 + length;
            continue;
        }
        memcpy(stream.data + stream.size, data, length);
        stream.size += length;
        strips++;
        at += 12 + length;
    }
    assert_int_equal(at, size);
    assert_int_equal(strips > 1, (3 * (size_t)width + 1) * height >= least_in_strips && height > 1);
    check_stream(&stream, width, height);
    free(stream.data);
}

static void check(struct kd_png_live *live, enum content content, uint32_t width, uint32_t height)
{
    uint8_t *pixels = picture(content, width, height);
    struct kd_buffer file = { 0 };
    struct kd_error error = { 0 };
    struct kd_png png;
    assert_int_equal(kd_png_live_encode(live, width, height, pixels, &file, &error), KD_OK);
    check_strictly(file.data, file.size, width, height);
    if (kd_png_decode(file.data, file.size, &png, &error))
        fail_msg("%u x %u, content %d: %s", width, height, content, error.message);
    assert_int_equal(png.width, width);
    assert_int_equal(png.height, height);
    assert_int_equal(png.bit_depth, 8);
    assert_memory_equal(png.pixels, pixels, (size_t)width * height * 3);
    kd_png_finish(&png);
    kd_buffer_finish(&file);
    free(pixels);
}

static struct kd_png_live *encoder(enum kd_deflate_engine engine)
{
    struct kd_png_live *live;
    struct kd_error error = { 0 };
    assert_int_equal(kd_png_live_create(engine, &live, &error), KD_OK);
    return live;
}

/* One encoder is used for all frames, so that anything left over from a large frame would show in a small one. */
static void pixels_survive(void **state)
{
    (void)state;
    static const uint32_t sides[][2] = { { 640, 360 }, { 1, 1 },      { 1, 97 },    { 97, 1 },
                                         { 3, 2 },     { 641, 37 },   { 2, 1 },     { 32768, 2 },
                                         { 1, 32768 }, { 1280, 720 }, { 1408, 993 } };
    for (enum kd_deflate_engine engine = 0; engine < KD_DEFLATE_COUNT; engine++) {
        if (!kd_deflate_has(engine)) {
            print_message("skipped: %s is not built in\n", kd_deflate_name(engine));
            continue;
        }
        struct kd_png_live *live = encoder(engine);
        least_in_strips = engine == KD_DEFLATE_ISAL ? 1 << 20 : 4 << 20;
        for (size_t i = 0; i < sizeof sides / sizeof *sides; i++)
            for (enum content content = 0; content < CONTENTS; content++)
                check(live, content, sides[i][0], sides[i][1]);
        for (int i = 0; i < 400; i++)
            check(live, random_bits() % CONTENTS, 1 + random_bits() % 90, 1 + random_bits() % 90);
        kd_png_live_destroy(live);
    }
}

/* zlib decompresses the n bytes of the raw stream, with nothing left over. */
static void inflate_all(const struct kd_buffer *stream, const uint8_t *data, size_t n)
{
    uint8_t *back = malloc(n + 1);
    z_stream z = {
        .next_in = stream->data, .avail_in = (uInt)stream->size, .next_out = back, .avail_out = (uInt)n + 1
    };
    assert_non_null(back);
    assert_int_equal(inflateInit2(&z, -15), Z_OK);
    assert_int_equal(inflate(&z, Z_FINISH), Z_STREAM_END);
    assert_int_equal(z.avail_in, 0);
    assert_int_equal(z.total_out, n);
    assert_memory_equal(back, data, n);
    inflateEnd(&z);
    free(back);
}

/* For every engine and level, concatenated pieces form one stream, whatever kind of block each piece ends with. The
 * checksums of the pieces combine to the checksum of the whole. */
static void pieces_are_one_stream(void **state)
{
    (void)state;
    enum { ROOM = 400 * 1000 };
    static uint8_t data[ROOM];
    for (int level = 0; level <= 12; level++)
        for (int kind = 0; kind < 6; kind++) {
            const enum kd_deflate_engine engine = level == 12 ? KD_DEFLATE_COUNT - 1 : KD_DEFLATE_LIBDEFLATE;
            struct kd_deflate *deflate;
            struct kd_buffer out = { 0 };
            uint32_t sum = 1;
            if (kd_deflate_create(engine, level, &deflate, NULL))
                continue; /* skipped, because it is tested above */
            for (uint32_t i = 0; i < ROOM; i++)
                data[i] = (uint8_t)(kind == 0           ? 0
                                    : kind == 1         ? random_bits()
                                    : kind == 2         ? random_bits() % (1 + i / 2000 % 256)
                                    : kind == 3         ? (random_bits() % 900 ? 7 : random_bits())
                                    : kind == 4         ? (i * i >> 9) + random_bits() % 2
                                    : i % 60000 < 30000 ? random_bits()
                                                        : (uint32_t)__builtin_ctz(random_bits() | 4096));
            for (size_t at = 0, n; at < ROOM; at += n) {
                n = 1 + random_bits() % (kind % 2 ? 90000 : 700);
                n = n > ROOM - at ? ROOM - at : n;
                assert_int_equal(kd_deflate_piece(deflate, data + at, n, at + n == ROOM, &out), KD_OK);
                sum = kd_zlib_sum_join(sum, kd_zlib_sum(data + at, n), n);
            }
            assert_int_equal(sum, adler32(1, data, ROOM));
            inflate_all(&out, data, ROOM);
            kd_buffer_finish(&out);
            kd_deflate_destroy(deflate);
        }
}

/* Encodes input of every length that ends at a page without read access. This finds reads past the end in the assembler
 * code, which the sanitizers cannot watch. */
static void streams_of_every_length(void **state)
{
    (void)state;
    enum { ROOM = 128 * 1024, SHORT = 700 };
    size_t page = (size_t)sysconf(_SC_PAGESIZE);
    uint8_t *memory = mmap(NULL, ROOM + 2 * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(memory != MAP_FAILED);
    assert_int_equal(mprotect(memory, page, PROT_NONE), 0);
    assert_int_equal(mprotect(memory + page + ROOM, page, PROT_NONE), 0);
    for (enum kd_deflate_engine engine = 0; engine < KD_DEFLATE_COUNT; engine++) {
        struct kd_deflate *deflate;
        for (uint32_t i = 0; i < ROOM; i++)
            memory[page + i] = (uint8_t)(random_bits() % (i % 5000 < 2500 ? 3 : 256));
        if (kd_deflate_create(engine, 1, &deflate, NULL))
            continue; /* skipped, because it is tested above */
        for (size_t n = 0; n <= ROOM; n += n < SHORT ? 1 : 1 + random_bits() % 9000)
            for (int end = 0; end < 2; end++) {
                const uint8_t *data = memory + page + (end ? ROOM - n : 0);
                struct kd_buffer out = { 0 };
                assert_int_equal(kd_deflate_piece(deflate, data, n, true, &out), KD_OK);
                inflate_all(&out, data, n);
                kd_buffer_finish(&out);
            }
        kd_deflate_destroy(deflate);
    }
    munmap(memory, ROOM + 2 * page);
}

static void appends_the_same_bytes(void **state)
{
    (void)state;
    uint8_t *pixels = picture(DITHERED, 320, 180), *other = picture(RANDOM, 320, 180);
    for (enum kd_deflate_engine engine = 0; engine < KD_DEFLATE_COUNT; engine++) {
        if (!kd_deflate_has(engine))
            continue;
        struct kd_png_live *live = encoder(engine);
        struct kd_buffer a = { 0 }, b = { 0 }, c = { 0 };
        assert_int_equal(kd_png_live_encode(live, 320, 180, pixels, &a, NULL), KD_OK);
        assert_int_equal(kd_png_live_encode(live, 320, 180, other, &c, NULL), KD_OK);
        assert_int_equal(kd_buffer_append(&b, "head", 4), KD_OK);
        assert_int_equal(kd_png_live_encode(live, 320, 180, pixels, &b, NULL), KD_OK);
        assert_int_equal(b.size, a.size + 4);
        assert_memory_equal(b.data, "head", 4);
        assert_memory_equal(b.data + 4, a.data, a.size);
        assert_true(a.size < 320 * 180); /* a dithered ramp takes at most a third of its bytes */
        kd_buffer_finish(&a);
        kd_buffer_finish(&b);
        kd_buffer_finish(&c);
        kd_png_live_destroy(live);
    }
    free(pixels);
    free(other);
}

/* The bytes are the same on any number of threads. */
static void the_same_bytes_on_any_threads(void **state)
{
    (void)state;
    static const unsigned threads[] = { 1, 2, 3, 7, 0 };
    uint8_t *pixels = picture(DITHERED, 1920, 1080);
    for (enum kd_deflate_engine engine = 0; engine < KD_DEFLATE_COUNT; engine++) {
        struct kd_buffer first = { 0 };
        for (size_t i = 0; kd_deflate_has(engine) && i < sizeof threads / sizeof *threads; i++) {
            struct kd_png_live *live = encoder(engine);
            struct kd_buffer file = { 0 };
            kd_parallel_threads = threads[i];
            assert_int_equal(kd_png_live_encode(live, 1920, 1080, pixels, i ? &file : &first, NULL), KD_OK);
            if (i) {
                assert_int_equal(file.size, first.size);
                assert_memory_equal(file.data, first.data, file.size);
            }
            kd_buffer_finish(&file);
            kd_png_live_destroy(live);
        }
        kd_buffer_finish(&first);
    }
    free(pixels);
}

static void bad_sides_are_refused(void **state)
{
    (void)state;
    static const uint8_t pixel[3];
    static const struct {
        uint32_t width, height;
        enum kd_status status;
        const char *word;
    } cases[] = {
        { 0, 2, KD_EINVAL, "0 x 2" },
        { 2, 0, KD_EINVAL, "2 x 0" },
        { 32769, 1, KD_EINVAL, "1 to 32768" },
        { 1, 4294967295u, KD_EINVAL, "4294967295" },
        { 32768, 32768, KD_ETOOBIG, "3.00 GiB" },
        { 32768, 10923, KD_ETOOBIG, "at most 1" },
    };
    struct kd_png_live *live = encoder(kd_deflate_fastest());
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct kd_buffer out = { 0 };
        struct kd_error error = { 0 };
        assert_int_equal(kd_png_live_encode(live, cases[i].width, cases[i].height, pixel, &out, &error),
                         cases[i].status);
        assert_non_null(strstr(error.message, cases[i].word));
        assert_int_equal(out.size, 0);
        kd_buffer_finish(&out);
    }
    kd_png_live_destroy(live);
    kd_png_live_destroy(NULL);
}

static void an_engine_that_is_not_there_is_refused(void **state)
{
    (void)state;
    struct kd_error error = { 0 };
    struct kd_png_live *live;
    assert_int_equal(kd_png_live_create(KD_DEFLATE_COUNT, &live, &error), KD_EINVAL);
    assert_null(live);
    assert_true(error.message[0]);
    assert_true(kd_deflate_has(kd_deflate_fastest()));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pixels_survive),
        cmocka_unit_test(streams_of_every_length),
        cmocka_unit_test(pieces_are_one_stream),
        cmocka_unit_test(the_same_bytes_on_any_threads),
        cmocka_unit_test(appends_the_same_bytes),
        cmocka_unit_test(bad_sides_are_refused),
        cmocka_unit_test(an_engine_that_is_not_there_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

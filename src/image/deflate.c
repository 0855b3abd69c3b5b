#include "image/deflate.h"

#include "image/deflate_walk.h"

#include <libdeflate.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#ifdef KD_HAVE_ISAL
#include <isa-l/igzip_lib.h>
#endif

struct kd_deflate {
    enum kd_deflate_engine engine;
    struct libdeflate_compressor *compressor;
    uint8_t *packed; /* output buffer: libdeflate writes a stream in one call */
    size_t room;
#ifdef KD_HAVE_ISAL
    struct isal_zstream stream;
    uint8_t level_memory[ISAL_DEF_LVL1_DEFAULT];
    uint8_t piece[64 * 1024];
#endif
};

const char *kd_deflate_name(enum kd_deflate_engine engine)
{
    static const char *const names[KD_DEFLATE_COUNT] = { "libdeflate", "isa-l" };
    return engine < KD_DEFLATE_COUNT ? names[engine] : "unknown";
}

bool kd_deflate_has(enum kd_deflate_engine engine)
{
#ifdef KD_HAVE_ISAL
    return engine == KD_DEFLATE_LIBDEFLATE || engine == KD_DEFLATE_ISAL;
#else
    return engine == KD_DEFLATE_LIBDEFLATE;
#endif
}

enum kd_deflate_engine kd_deflate_fastest(void)
{
    return kd_deflate_has(KD_DEFLATE_ISAL) ? KD_DEFLATE_ISAL : KD_DEFLATE_LIBDEFLATE;
}

enum kd_status kd_deflate_create(enum kd_deflate_engine engine, int level, struct kd_deflate **out,
                                 struct kd_error *error)
{
    *out = NULL;
    if (!kd_deflate_has(engine))
        return kd_error_set(error, KD_EINVAL, "this kerrd was built without the deflate engine %s",
                            kd_deflate_name(engine));
    struct kd_deflate *deflate = calloc(1, sizeof *deflate);
    if (deflate && engine == KD_DEFLATE_LIBDEFLATE)
        deflate->compressor = libdeflate_alloc_compressor(level);
    if (!deflate || (engine == KD_DEFLATE_LIBDEFLATE && !deflate->compressor)) {
        kd_deflate_destroy(deflate);
        return kd_error_set(error, KD_ENOMEM, "out of memory for a deflate engine");
    }
    deflate->engine = engine;
    *out = deflate;
    return KD_OK;
}

void kd_deflate_destroy(struct kd_deflate *deflate)
{
    if (!deflate)
        return;
    libdeflate_free_compressor(deflate->compressor);
    free(deflate->packed);
    free(deflate);
}

/* An empty stored block (RFC 1951, 3.2.4). These four bytes follow its three header bits and the padding to a whole
 * byte. */
static const uint8_t empty_block[4] = { 0, 0, 0xff, 0xff };

/* Turns a complete stream into a piece: its last block is no longer marked as the last, and an empty block is
 * appended. The bits after the end of a stream are zeros, as are the three header bits of the empty block. Returns
 * the new size, or 0 if the bytes are not a deflate stream. There must be room for 5 more bytes. */
static size_t make_piece(uint8_t *stream, size_t size)
{
    struct kd_deflate_walk walk;
    if (!kd_deflate_walk(stream, size, &walk))
        return 0;
    stream[walk.last / 8] &= (uint8_t)~(1u << walk.last % 8);
    if (8 * size - walk.end < 3)
        stream[size++] = 0;
    memcpy(stream + size, empty_block, sizeof empty_block);
    return size + sizeof empty_block;
}

static enum kd_status by_libdeflate(struct kd_deflate *deflate, const void *data, size_t size, bool last,
                                    struct kd_buffer *out)
{
    const size_t bound = libdeflate_deflate_compress_bound(deflate->compressor, size) + 1 + sizeof empty_block;
    if (bound > deflate->room) {
        free(deflate->packed);
        deflate->packed = malloc(bound);
        deflate->room = deflate->packed ? bound : 0;
        if (!deflate->packed)
            return KD_ENOMEM;
    }
    size_t packed = libdeflate_deflate_compress(deflate->compressor, data, size, deflate->packed, bound);
    if (!last)
        packed = make_piece(deflate->packed, packed);
    return packed ? kd_buffer_append(out, deflate->packed, packed) : KD_EINTERNAL;
}

#ifdef KD_HAVE_ISAL
/* Compresses by igzip. The output buffer grows step by step, because igzip gives no bound for the size. */
static enum kd_status by_isal(struct kd_deflate *deflate, const void *data, size_t size, bool last,
                              struct kd_buffer *out)
{
    struct isal_zstream *stream = &deflate->stream;
    isal_deflate_init(stream);
    stream->level = 1;
    stream->level_buf = deflate->level_memory;
    stream->level_buf_size = sizeof deflate->level_memory;
    stream->end_of_stream = last;
    stream->flush = last ? NO_FLUSH : SYNC_FLUSH;
    stream->next_in = (uint8_t *)data; /* igzip only reads the data */
    stream->avail_in = (uint32_t)size;
    enum kd_status status = KD_OK;
    do {
        stream->next_out = deflate->piece;
        stream->avail_out = sizeof deflate->piece;
        isal_deflate(stream); /* can fail only because of invalid arguments, which do not occur here */
        status = kd_buffer_append(out, deflate->piece, sizeof deflate->piece - stream->avail_out);
    } while (!status && (last ? stream->internal_state.state != ZSTATE_END : !stream->avail_out));
    return status;
}
#endif

enum kd_status kd_deflate_piece(struct kd_deflate *deflate, const void *data, size_t size, bool last,
                                struct kd_buffer *out)
{
    const size_t start = out->size;
    enum kd_status status = KD_OK;
#ifdef KD_HAVE_ISAL
    if (deflate->engine == KD_DEFLATE_ISAL)
        status = by_isal(deflate, data, size, last, out);
#endif
    if (deflate->engine == KD_DEFLATE_LIBDEFLATE)
        status = by_libdeflate(deflate, data, size, last, out);
    if (status)
        out->size = start;
    return status;
}

/* The two bytes state a window of 32 KiB and the compression level. Together, as a big-endian number, they must be a
 * multiple of 31 (RFC 1950, 2.2). */
void kd_zlib_head(int level, uint8_t to[2])
{
    to[0] = 0x78;
    to[1] = level < 2 ? 0x01 : level < 6 ? 0x5e : level < 8 ? 0x9c : 0xda;
}

uint32_t kd_zlib_sum(const void *data, size_t size) { return libdeflate_adler32(1, data, size); }

/* Adler-32 (RFC 1950, 8.2) has two sums, modulo a prime: a is 1 plus the sum of all bytes, and b is the sum of the
 * values of a after each byte. If other data precede, every a grows by a constant: the value of a after those data,
 * minus the initial 1. b then contains this constant once for each byte. */
uint32_t kd_zlib_sum_join(uint32_t sum, uint32_t other, size_t size)
{
    enum { PRIME = 65521 };
    const uint64_t a = sum & 0xffff, b = sum >> 16, more = (a + PRIME - 1) % PRIME;
    const uint64_t a_all = ((other & 0xffff) + more) % PRIME;
    const uint64_t b_all = (b + (other >> 16) + size % PRIME * more) % PRIME;
    return (uint32_t)(b_all << 16 | a_all);
}

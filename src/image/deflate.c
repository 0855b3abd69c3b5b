#include "image/deflate.h"

#include <libdeflate.h>
#include <stdint.h>
#include <stdlib.h>
#ifdef KD_HAVE_ISAL
#include <isa-l/igzip_lib.h>
#endif

enum { LEVEL = 1 }; /* docs/decisions/0004-live-png.md */

struct kd_deflate {
    enum kd_deflate_engine engine;
    struct libdeflate_compressor *compressor;
    uint8_t *packed; /* libdeflate writes a stream into one piece */
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

enum kd_status kd_deflate_create(enum kd_deflate_engine engine, struct kd_deflate **out, struct kd_error *error)
{
    *out = NULL;
    if (!kd_deflate_has(engine))
        return kd_error_set(error, KD_EINVAL, "this kerrd was built without the deflate engine %s",
                            kd_deflate_name(engine));
    struct kd_deflate *deflate = calloc(1, sizeof *deflate);
    if (deflate && engine == KD_DEFLATE_LIBDEFLATE)
        deflate->compressor = libdeflate_alloc_compressor(LEVEL);
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

static enum kd_status by_libdeflate(struct kd_deflate *deflate, const void *data, size_t size, struct kd_buffer *out)
{
    size_t bound = libdeflate_deflate_compress_bound(deflate->compressor, size);
    if (bound > deflate->room) {
        free(deflate->packed);
        deflate->packed = malloc(bound);
        deflate->room = deflate->packed ? bound : 0;
        if (!deflate->packed)
            return KD_ENOMEM;
    }
    size_t packed = libdeflate_deflate_compress(deflate->compressor, data, size, deflate->packed, bound);
    return kd_buffer_append(out, deflate->packed, packed);
}

#ifdef KD_HAVE_ISAL
/* The output grows piece by piece, since igzip has no bound on the size of what it writes. */
static enum kd_status by_isal(struct kd_deflate *deflate, const void *data, size_t size, struct kd_buffer *out)
{
    struct isal_zstream *stream = &deflate->stream;
    isal_deflate_init(stream);
    stream->level = LEVEL;
    stream->level_buf = deflate->level_memory;
    stream->level_buf_size = sizeof deflate->level_memory;
    stream->end_of_stream = 1;
    stream->next_in = (uint8_t *)data; /* it only reads */
    stream->avail_in = (uint32_t)size;
    enum kd_status status = KD_OK;
    while (!status && stream->internal_state.state != ZSTATE_END) {
        stream->next_out = deflate->piece;
        stream->avail_out = sizeof deflate->piece;
        isal_deflate(stream); /* fails for arguments alone, which are right */
        status = kd_buffer_append(out, deflate->piece, sizeof deflate->piece - stream->avail_out);
    }
    return status;
}
#endif

enum kd_status kd_deflate_append(struct kd_deflate *deflate, const void *data, size_t size, struct kd_buffer *out)
{
    static const uint8_t head[2] = { 0x78, 0x01 }; /* a window of 32 KiB, the fastest level */
    size_t start = out->size;
    enum kd_status status;
    KD_TRY(kd_buffer_append(out, head, sizeof head));
    if (deflate->engine == KD_DEFLATE_LIBDEFLATE)
        KD_TRY(by_libdeflate(deflate, data, size, out));
#ifdef KD_HAVE_ISAL
    else
        KD_TRY(by_isal(deflate, data, size, out));
#endif
    uint32_t sum = libdeflate_adler32(1, data, size);
    const uint8_t tail[4] = { (uint8_t)(sum >> 24), (uint8_t)(sum >> 16), (uint8_t)(sum >> 8), (uint8_t)sum };
    KD_TRY(kd_buffer_append(out, tail, sizeof tail));
done:
    if (status)
        out->size = start;
    return status;
}

#include "image/gzip.h"

#include <libdeflate.h>
#include <stdlib.h>

enum { LEVEL = 6 }; /* makes a table of numbers a seventh smaller than level 1 does */

bool kd_gzip(struct kd_buffer *buffer)
{
    struct libdeflate_compressor *compressor = libdeflate_alloc_compressor(LEVEL);
    void *packed = compressor ? malloc(buffer->size) : NULL;
    size_t size = packed ? libdeflate_gzip_compress(compressor, buffer->data, buffer->size, packed, buffer->size) : 0;
    libdeflate_free_compressor(compressor);
    if (!size) {
        free(packed);
        return false;
    }
    kd_buffer_finish(buffer);
    *buffer = (struct kd_buffer) { .data = packed, .size = size, .capacity = size };
    return true;
}

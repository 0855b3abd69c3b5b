#include "render/device/compiled.h"

#include "base/hash.h"
#include "base/read.h"
#include "base/replace.h"
#include "render/device/device_internal.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 4096 }; /* largest number of entries in the file; the oldest entries are dropped first */

static uint64_t number_of(const struct kd_kernel_request *w, uint64_t folder)
{
    uint64_t hash = kd_hash(KD_HASH_BEGIN, &folder, sizeof folder);
    hash = kd_hash(hash, w->source->spirv, w->source->spirv_bytes);
    return kd_hash(hash, w->constants, w->n * sizeof *w->constants);
}

static char *path_of(const struct kd_renderer *r) { return kd_renderer_cache_file(r, ".compiled"); }

static void read_all(const char *path, struct kd_buffer *out)
{
    if (path && !kd_read_file(AT_FDCWD, path, 0, MOST * sizeof(uint64_t), out))
        kd_buffer_finish(out);
    out->size -= out->size % sizeof(uint64_t);
}

static bool has(const struct kd_buffer *numbers, uint64_t number)
{
    for (size_t at = 0; at < numbers->size; at += sizeof number)
        if (!memcmp(numbers->data + at, &number, sizeof number))
            return true;
    return false;
}

bool kd_compiled_has(const struct kd_renderer *r, const struct kd_kernel_requests *kernels)
{
    const uint64_t folder = kd_vk_compiled_id(r->vk);
    struct kd_buffer numbers = { 0 };
    char *path = path_of(r);
    bool all = folder != 0;
    read_all(path, &numbers);
    for (size_t i = 0; i < kernels->n && all; i++)
        all = has(&numbers, number_of(&kernels->at[i], folder));
    kd_buffer_finish(&numbers);
    free(path);
    return all;
}

void kd_compiled_add(const struct kd_renderer *r, const struct kd_kernel_requests *kernels)
{
    const uint64_t folder = kd_vk_compiled_id(r->vk);
    struct kd_buffer numbers = { 0 };
    char *path = path_of(r);
    enum kd_status status = KD_OK;
    read_all(path, &numbers);
    for (size_t i = 0; i < kernels->n && !status && folder; i++) {
        const uint64_t number = number_of(&kernels->at[i], folder);
        if (!has(&numbers, number))
            status = kd_buffer_append(&numbers, &number, sizeof number);
    }
    const size_t most = MOST * sizeof(uint64_t), skip = numbers.size > most ? numbers.size - most : 0;
    if (path && numbers.size && !status) /* a failure is ignored: without the file only time is lost */
        kd_replace_file(path, numbers.data + skip, numbers.size - skip);
    kd_buffer_finish(&numbers);
    free(path);
}

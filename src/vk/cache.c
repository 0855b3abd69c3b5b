#include "vk/cache.h"

#include "base/buffer.h"
#include "base/hash.h"
#include "base/log.h"
#include "base/read.h"
#include "base/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Header of the file, before the driver's data. Drivers do not check their data sufficiently, so damage is detected
 * here. */
struct envelope {
    char magic[8];
    uint64_t bytes, hash;
};
static const char magic[8] = "kdpipe1";
#define SUFFIX ".pipelines"
#define FILE_MAX ((size_t)256 << 20) /* drivers store some MiB; a larger file is not ours */

/* True if the data belong to this device and driver, by Vulkan's VkPipelineCacheHeaderVersionOne. */
static bool header_fits(const struct kd_vk_core *core, const uint8_t *data, size_t size)
{
    const VkPhysicalDeviceProperties *device = &core->physical.properties;
    uint32_t words[4];
    if (size < sizeof words + VK_UUID_SIZE)
        return false;
    memcpy(words, data, sizeof words);
    return words[0] >= sizeof words + VK_UUID_SIZE && words[0] <= size &&
           words[1] == VK_PIPELINE_CACHE_HEADER_VERSION_ONE && words[2] == device->vendorID &&
           words[3] == device->deviceID && !memcmp(data + sizeof words, device->pipelineCacheUUID, VK_UUID_SIZE);
}

/* Makes the path of the cache file. Returns NULL if no file is wanted, or if there is no folder for it. */
static char *path_of(const struct kd_vk_core *core, const char *dir)
{
    const VkPhysicalDeviceProperties *device = &core->physical.properties;
    const char *xdg = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    char base[2048], uuid[2 * VK_UUID_SIZE + 1], *path = NULL;
    int n;
    if (dir)
        n = snprintf(base, sizeof base, "%s", dir);
    else if (xdg && xdg[0] == '/') /* the XDG specification requires that relative paths are ignored */
        n = snprintf(base, sizeof base, "%s/kerrd", xdg);
    else if (home && home[0])
        n = snprintf(base, sizeof base, "%s/.cache/kerrd", home);
    else
        return NULL;
    if (!n || (size_t)n >= sizeof base)
        return NULL;
    for (unsigned i = 0; i < VK_UUID_SIZE; i++)
        snprintf(uuid + 2 * i, 3, "%02x", device->pipelineCacheUUID[i]);
    if (asprintf(&path, "%s/%04x-%04x-%08x-%s" SUFFIX, base, device->vendorID, device->deviceID, device->driverVersion,
                 uuid) < 0)
        return NULL;
    return path;
}

/* Returns the driver's data in the file, or NULL if the file is damaged. */
static const uint8_t *open_envelope(const struct kd_vk_core *core, const struct kd_buffer *file, size_t *size)
{
    struct envelope envelope;
    if (file->size < sizeof envelope)
        return NULL;
    memcpy(&envelope, file->data, sizeof envelope);
    const uint8_t *data = file->data + sizeof envelope;
    *size = file->size - sizeof envelope;
    if (memcmp(envelope.magic, magic, sizeof magic) || envelope.bytes != *size ||
        envelope.hash != kd_hash(KD_HASH_BEGIN, data, *size) || !header_fits(core, data, *size))
        return NULL;
    return data;
}

enum kd_status kd_vk_cache_init(struct kd_vk_cache *cache, const struct kd_vk_core *core, const char *dir,
                                struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_buffer file = { 0 };
    VkPipelineCacheCreateInfo info = { .sType = VK_STRUCTURE_TYPE_PIPELINE_CACHE_CREATE_INFO };

    cache->path = path_of(core, dir);
    if (cache->path && kd_read_file(AT_FDCWD, cache->path, 0, FILE_MAX, &file)) {
        info.pInitialData = open_envelope(core, &file, &info.initialDataSize);
        if (info.pInitialData)
            cache->hash = kd_hash(KD_HASH_BEGIN, info.pInitialData, info.initialDataSize);
        else
            kd_log(KD_LOG_DEBUG, "%s is damaged or belongs to another driver: a new cache is started", cache->path);
    }
    if (!info.pInitialData)
        info.initialDataSize = 0;
    KD_VK_TRY(&core->fn, CreatePipelineCache, core->device, &info, NULL, &cache->handle);
    kd_vk_name(core, VK_OBJECT_TYPE_PIPELINE_CACHE, KD_VK_HANDLE(cache->handle), "pipeline cache");
done:
    kd_buffer_finish(&file);
    return status;
}

static void save(const struct kd_vk_cache *cache, const struct kd_vk_core *core)
{
    size_t size = 0;
    if (core->fn.GetPipelineCacheData(core->device, cache->handle, &size, NULL) < 0 || !size)
        return;
    uint8_t *file = malloc(sizeof(struct envelope) + size);
    if (file && core->fn.GetPipelineCacheData(core->device, cache->handle, &size, file + sizeof(struct envelope)) ==
                    VK_SUCCESS) {
        struct envelope envelope = { .bytes = size, .hash = kd_hash(KD_HASH_BEGIN, file + sizeof envelope, size) };
        memcpy(envelope.magic, magic, sizeof magic);
        memcpy(file, &envelope, sizeof envelope);
        if (envelope.hash != cache->hash && !kd_replace_file(cache->path, file, sizeof envelope + size))
            kd_log(KD_LOG_DEBUG, "cannot write %s: %s", cache->path, strerror(errno));
    }
    free(file);
}

char *kd_vk_cache_beside(const struct kd_vk_cache *cache, const char *suffix)
{
    const char *path = cache->path;
    char *out = NULL;
    if (!path || asprintf(&out, "%.*s%s", (int)(strlen(path) - strlen(SUFFIX)), path, suffix) < 0)
        return NULL;
    return out;
}

void kd_vk_cache_finish(struct kd_vk_cache *cache, const struct kd_vk_core *core)
{
    if (cache->handle) {
        if (cache->path && cache->grown && !core->lost[0])
            save(cache, core);
        core->fn.DestroyPipelineCache(core->device, cache->handle, NULL);
    }
    free(cache->path);
    memset(cache, 0, sizeof *cache);
}

/* Pipeline cache on disk: one file for each device and driver version. */
#ifndef KD_VK_CACHE_H
#define KD_VK_CACHE_H

#include "vk/core.h"

#include <stdatomic.h>

struct kd_vk_cache {
    VkPipelineCache handle;
    char *path;        /* NULL: the cache is kept in memory only */
    uint64_t hash;     /* hash of the data that were last read or written; 0: none */
    atomic_bool grown; /* true if pipelines have been made since the data were read or written; set by any thread */
};

/* dir: see kd_vk_params.cache_dir. If the file is missing, damaged or of another device, the cache starts empty,
 * without an error. */
enum kd_status kd_vk_cache_init(struct kd_vk_cache *cache, const struct kd_vk_core *core, const char *dir,
                                struct kd_error *error);
/* If the cache has grown, writes it to its file atomically. Frees the cache. A failure to write is logged at debug
 * level only. */
void kd_vk_cache_finish(struct kd_vk_cache *cache, const struct kd_vk_core *core);
/* Path of a file beside the cache's file, with the same name and this suffix; see kd_vk_cache_file. */
char *kd_vk_cache_beside(const struct kd_vk_cache *cache, const char *suffix);

#endif

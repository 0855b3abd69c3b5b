/* Pipeline cache on disk: one file for each device and driver version. */
#ifndef KD_VK_CACHE_H
#define KD_VK_CACHE_H

#include "vk/functions.h"

#include <stdatomic.h>

struct kd_vk;

struct kd_vk_cache {
    VkPipelineCache handle;
    char *path;        /* NULL: kept in memory only */
    uint64_t hash;     /* of the data last read or written; 0: none */
    atomic_bool grown; /* pipelines have been made since then; set by any thread */
};

/* dir as kd_vk_params.cache_dir. A missing, foreign or damaged file is not an error: the cache starts empty. */
enum kd_status kd_vk_cache_init(struct kd_vk *vk, const char *dir, struct kd_error *error);
/* Writes the cache back atomically if it has grown, and frees it. A failure to write is logged at debug level only. */
void kd_vk_cache_finish(struct kd_vk *vk);

#endif

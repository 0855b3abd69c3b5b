/* The pipeline cache is kept on disk: one file a device and driver version. */
#ifndef KD_VK_CACHE_H
#define KD_VK_CACHE_H

#include "vk/functions.h"

#include <stdatomic.h>

struct kd_vk;

struct kd_vk_cache {
    VkPipelineCache handle;
    char *path;        /* NULL: kept in memory only */
    uint64_t hash;     /* of the data last read or written, 0: none */
    atomic_bool grown; /* pipelines were made since; by any thread */
};

/* dir as kd_vk_params.cache_dir. A file that is absent, foreign or damaged is no error: the cache starts
 * empty. */
enum kd_status kd_vk_cache_init(struct kd_vk *vk, const char *dir, struct kd_error *error);
/* Write it back if it has grown, replacing the file in one step, and free it. A directory that cannot be
 * written costs one debug line. */
void kd_vk_cache_finish(struct kd_vk *vk);

#endif

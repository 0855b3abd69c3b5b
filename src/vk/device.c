#include "vk/device.h"

void kd_vk_retire(struct kd_vk *vk, struct kd_vk_retired *object)
{
    if (object->ticket <= vk->done && !vk->core.lost[0])
        object->free(vk, object);
    else
        kd_vk_retired_add(&vk->retired, object);
}

uint64_t kd_vk_allocated(const struct kd_vk *vk) { return kd_vk_heap_bytes(&vk->heap); }
char *kd_vk_cache_file(const struct kd_vk *vk, const char *suffix) { return kd_vk_cache_beside(&vk->cache, suffix); }

bool kd_vk_hangs(const struct kd_vk *vk) { return vk->core.hangs; }

const struct kd_vk_info *kd_vk_info(const struct kd_vk *vk) { return &vk->core.physical.info; }
const char *kd_vk_choice(const struct kd_vk *vk) { return vk->choice; }

uint32_t kd_vk_validation_messages(const struct kd_vk *vk)
{
    return atomic_load(&((struct kd_vk *)vk)->instance.debug.messages); /* C11 atomics do not accept const */
}

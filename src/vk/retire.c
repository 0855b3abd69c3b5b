#include "vk/retire.h"

#include "vk/device.h"

void kd_vk_retire(struct kd_vk *vk, struct kd_vk_retired *object)
{
    if (object->ticket <= vk->done && !vk->lost[0]) {
        object->free(vk, object);
        return;
    }
    object->next = vk->retired;
    vk->retired = object;
}

static void sweep(struct kd_vk *vk, uint64_t done)
{
    struct kd_vk_retired **link = &vk->retired;
    while (*link) {
        struct kd_vk_retired *object = *link;
        if (object->ticket > done) {
            link = &object->next;
            continue;
        }
        *link = object->next;
        object->free(vk, object);
    }
}

void kd_vk_retire_idle(struct kd_vk *vk) { sweep(vk, vk->done); }
void kd_vk_retire_all(struct kd_vk *vk) { sweep(vk, UINT64_MAX); }

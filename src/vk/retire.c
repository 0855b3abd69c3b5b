#include "vk/retire.h"

void kd_vk_retired_add(struct kd_vk_retired **list, struct kd_vk_retired *object)
{
    object->next = *list;
    *list = object;
}

void kd_vk_retired_free(struct kd_vk_retired **list, struct kd_vk *vk, uint64_t done)
{
    while (*list) {
        struct kd_vk_retired *object = *list;
        if (object->ticket > done) {
            list = &object->next;
            continue;
        }
        *list = object->next;
        object->free(vk, object);
    }
}

void kd_vk_retired_discard(struct kd_vk_retired *list, uint64_t submitted)
{
    for (struct kd_vk_retired *object = list; object; object = object->next)
        if (object->ticket > submitted)
            object->ticket = submitted;
}

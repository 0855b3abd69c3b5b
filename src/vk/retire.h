/* Deferred destruction. An object that the device may still use is freed when the last submission that uses it has
 * finished. */
#ifndef KD_VK_RETIRE_H
#define KD_VK_RETIRE_H

#include <stdint.h>

struct kd_vk;

/* The first member of each object that can be retired. */
struct kd_vk_retired {
    uint64_t ticket; /* number of the last submission that uses the object, recorded or submitted; 0: none */
    struct kd_vk_retired *next;
    void (*free)(struct kd_vk *vk, struct kd_vk_retired *object);
};

/* Adds an object to a list. */
void kd_vk_retired_add(struct kd_vk_retired **list, struct kd_vk_retired *object);
/* Frees the objects that only submissions up to `done` use. */
void kd_vk_retired_free(struct kd_vk_retired **list, struct kd_vk *vk, uint64_t done);
/* Called when the submission after number `submitted` was discarded. That submission then uses no objects any more. */
void kd_vk_retired_discard(struct kd_vk_retired *list, uint64_t submitted);

#endif

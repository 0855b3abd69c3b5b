/* Deferred destruction. An object that the device may still use is freed when the last submission that uses it has
 * finished. */
#ifndef KD_VK_RETIRE_H
#define KD_VK_RETIRE_H

#include <stdint.h>

struct kd_vk;

/* The first member of each object that can be retired. */
struct kd_vk_retired {
    uint64_t ticket; /* the last submission that uses the object, recorded or submitted; 0: none */
    struct kd_vk_retired *next;
    void (*free)(struct kd_vk *vk, struct kd_vk_retired *object);
};

/* Frees the object now if it is idle, else later; on a lost device, when the device is closed. */
void kd_vk_retire(struct kd_vk *vk, struct kd_vk_retired *object);
/* Frees the objects that have become idle. */
void kd_vk_retire_idle(struct kd_vk *vk);
/* Frees all objects. The device must be idle. */
void kd_vk_retire_all(struct kd_vk *vk);

#endif

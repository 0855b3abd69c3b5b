/* Objects wait here whose owner has destroyed them while the device may still use them: each waits for the last
 * submission that could and is freed when that is seen finished. */
#ifndef KD_VK_RETIRE_H
#define KD_VK_RETIRE_H

#include <stdint.h>

struct kd_vk;

/* The first member of each object that can be retired. */
struct kd_vk_retired {
    uint64_t ticket; /* last submission that uses it, recorded or under way; 0: none */
    struct kd_vk_retired *next;
    void (*free)(struct kd_vk *vk, struct kd_vk_retired *object);
};

/* Free it now if it is idle, else later. On a lost device: when that is closed. */
void kd_vk_retire(struct kd_vk *vk, struct kd_vk_retired *object);
/* Free those that have become idle. */
void kd_vk_retire_idle(struct kd_vk *vk);
/* Free all: the device is known to be idle. */
void kd_vk_retire_all(struct kd_vk *vk);

#endif

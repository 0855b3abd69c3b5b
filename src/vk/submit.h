/* Submission: a ring of command buffers, and a timeline semaphore whose value counts submissions. */
#ifndef KD_VK_SUBMIT_H
#define KD_VK_SUBMIT_H

#include "base/error.h"

struct kd_vk;
struct kd_vk_slot;

enum kd_status kd_vk_submit_init(struct kd_vk *vk, struct kd_error *error);
void kd_vk_submit_finish(struct kd_vk *vk); /* the device must be idle; accepts a half-built device */

/* Returns the slot for recording. Begins recording if it has not begun. */
enum kd_status kd_vk_submit_slot(struct kd_vk *vk, struct kd_vk_slot **out, struct kd_error *error);

#endif

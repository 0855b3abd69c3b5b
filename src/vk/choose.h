/* Chooses one of the listed devices: a pure function of the list and the user's preference. */
#ifndef KD_VK_CHOOSE_H
#define KD_VK_CHOOSE_H

#include "vk/vk.h"

/* wish: "auto" (or NULL), an index, or part of a name. Where several fit, the highest type is taken, then one with
 * double precision, then the widest subgroup, then the first. On KD_OK *index is an index into infos and `why` one
 * sentence. A wish that matches nothing is KD_EINVAL and lists the devices; an unusable device is KD_EDEVICE and
 * says what it lacks. */
enum kd_status kd_vk_choose(const struct kd_vk_info *infos, size_t count, const char *wish, size_t *index, char *why,
                            size_t why_size, struct kd_error *error);

#endif

/* Chooses a device from a list by the user's wish. Pure. */
#ifndef KD_VK_CHOOSE_H
#define KD_VK_CHOOSE_H

#include "vk/vk.h"

/* Chooses a device. wish: "auto" (or NULL), an index, or part of a name. Among several matches the device of the
 * highest type is chosen. Ties are broken by double precision, then by the widest subgroup, then by the lowest index.
 * On KD_OK *index is an index into infos and `why` one sentence. Returns KD_EINVAL with a list of the devices if
 * nothing matches the wish. Returns KD_EDEVICE with what the device lacks if the chosen device is not usable. */
enum kd_status kd_vk_choose(const struct kd_vk_info *infos, size_t count, const char *wish, size_t *index, char *why,
                            size_t why_size, struct kd_error *error);

#endif

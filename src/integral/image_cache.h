/* Cache of recent disk images: fits ask for the same hole and inclination repeatedly. Any thread. */
#ifndef KD_INTEGRAL_IMAGE_CACHE_H
#define KD_INTEGRAL_IMAGE_CACHE_H

#include "base/error.h"
#include "physics/disk/disk_image.h"
#include "physics/spacetime/hole.h"

/* Gets a copy of the image, and computes the image if it is not cached. The caller frees the copy. */
enum kd_status kd_cached_disk_image(const struct kd_hole *hole, double inclination_deg, struct kd_disk_image **out,
                                    struct kd_error *error);

#endif

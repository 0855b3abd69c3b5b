/* Cache of recent disk images, because fits request the same hole and inclination repeatedly. Any thread. */
#ifndef KD_INTEGRAL_IMAGE_CACHE_H
#define KD_INTEGRAL_IMAGE_CACHE_H

#include "base/error.h"
#include "physics/disk/disk_image.h"
#include "physics/spacetime/hole.h"

/* Makes a copy of a disk's image, which the caller frees. The image is computed if the cache does not have it. */
enum kd_status kd_cached_disk_image(const struct kd_hole *hole, double inclination_deg, struct kd_disk_image **out,
                                    struct kd_error *error);

#endif

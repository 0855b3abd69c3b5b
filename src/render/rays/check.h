/* Checks whether a request for rays is valid. Any thread. */
#ifndef KD_RENDER_RAYS_CHECK_H
#define KD_RENDER_RAYS_CHECK_H

#include "render/rays/rays.h"

#define KD_RAYS_FAR 1e7 /* largest radius and image coordinate, M */

/* KD_EINVAL naming the field, its value and its valid range. Checks each ray of the list. */
enum kd_status kd_rays_check(const struct kd_rays_params *params, const double *alpha_beta, size_t n,
                             struct kd_error *error);

#endif

/* Checks whether a request for rays is valid. Any thread. */
#ifndef KD_RENDER_RAYS_CHECK_H
#define KD_RENDER_RAYS_CHECK_H

#include "render/rays/rays.h"

#define KD_RAYS_FAR 1e7 /* largest radius and image coordinate, M */

/* Checks the request and each ray of the list. Returns KD_EINVAL with a message that names the field, its value and its
 * valid range. */
enum kd_status kd_rays_check(const struct kd_rays_params *params, const double *alpha_beta, size_t n,
                             struct kd_error *error);

#endif

/* Fields of a request for rays, one row each. Parsing, validation, query parameters and schema follow from these
 * rows. Private to src/render/rays and its tests. Constant data and pure functions, any thread. */
#ifndef KD_RENDER_RAYS_FIELDS_H
#define KD_RENDER_RAYS_FIELDS_H

#include "render/rays/request.h"
#include "document/document.h"

extern const struct kd_document kd_rays_document; /* fields of struct kd_rays_request */

/* Checks a value against the bounds of the field of this name; returns KD_EINVAL with the valid range. */
enum kd_status kd_rays_field_check(const char *name, double value, struct kd_error *error);

#endif

/* Formats one ray of an answer as text or bytes. Private to src/render. */
#ifndef KD_RENDER_RAYS_ROWS_H
#define KD_RENDER_RAYS_ROWS_H

#include "render/rays/answer.h"

/* Writes the row of a ray and returns its size, without a NUL. In JSON all rows but the first start with a comma. */
size_t kd_rays_row(const struct kd_rays_answer *answer, enum kd_rays_format format, size_t ray,
                   char out[KD_RAYS_ROW_MAX]);

#endif

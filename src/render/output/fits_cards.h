/* Cards of FITS headers: what a file of one frame says, and a cube of many. Each appends to *cards. Any thread; KD_ENOMEM alone. */
#ifndef KD_RENDER_OUTPUT_FITS_CARDS_H
#define KD_RENDER_OUTPUT_FITS_CARDS_H

#include "base/buffer.h"
#include "render/output/wcs.h"
#include "scene/sweep.h"

/* What a unit of the file says of its own layer. wcs: NULL where its frames have different ones. */
enum kd_status kd_fits_put_layer(struct kd_buffer *cards, const char *name, const char *unit, bool rgb, const struct kd_wcs *wcs);
/* The hole and the observer, for readers that know nothing of scenes; sweep: whose axes are left out; NULL: none. */
enum kd_status kd_fits_put_scene(struct kd_buffer *cards, const struct kd_scene *scene, const struct kd_sweep *sweep);

#endif

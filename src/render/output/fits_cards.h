/* Cards of FITS headers, for a file of one frame and for a cube of many. Each function appends to *cards. Any thread;
 * KD_ENOMEM alone. */
#ifndef KD_RENDER_OUTPUT_FITS_CARDS_H
#define KD_RENDER_OUTPUT_FITS_CARDS_H

#include "base/buffer.h"
#include "render/output/wcs.h"
#include "scene/sweep.h"

#define KD_FITS_FLUX \
    "FLUX_JY" /* the card with a picture's flux, a number; there is none where the picture has no flux */

/* What a unit of the file says of its own layer. wcs: NULL where its frames have different ones. */
enum kd_status kd_fits_put_layer(struct kd_buffer *cards, const char *name, const char *unit, bool rgb,
                                 const struct kd_wcs *wcs);
/* World coordinates of two axes, alternate: "" or one letter. */
enum kd_status kd_fits_put_world_axes(struct kd_buffer *cards, const struct kd_wcs *wcs,
                                      const struct kd_wcs_axis axes[2], const char *alternate);
/* The hole, the observer and the frequency of a volume that is seen at one, for readers that know nothing of scenes;
 * sweep: whose axes are left out; NULL: none. */
enum kd_status kd_fits_put_scene(struct kd_buffer *cards, const struct kd_scene *scene, const struct kd_sweep *sweep);

#endif

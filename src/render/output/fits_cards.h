/* Cards of FITS headers, for a file of one frame and for a cube of many. Each function appends to *cards. Any
 * thread; the only error is KD_ENOMEM. */
#ifndef KD_RENDER_OUTPUT_FITS_CARDS_H
#define KD_RENDER_OUTPUT_FITS_CARDS_H

#include "base/buffer.h"
#include "render/output/wcs.h"
#include "scene/sweep.h"

/* keyword of the card that has a picture's flux, a number; if a picture has no flux, the card is absent */
#define KD_FITS_FLUX "FLUX_JY"

/* The cards of a layer's HDU. wcs: NULL if the frames have different world coordinates. */
enum kd_status kd_fits_put_layer(struct kd_buffer *cards, const char *name, const char *unit, bool rgb,
                                 const struct kd_wcs *wcs);
/* World coordinates of two axes. alternate: "" or one letter. */
enum kd_status kd_fits_put_world_axes(struct kd_buffer *cards, const struct kd_wcs *wcs,
                                      const struct kd_wcs_axis axes[2], const char *alternate);
/* The hole, the observer, and the frequency of a volume at a radio frequency, for readers that do not parse the
 * scene. sweep: fields that the sweep varies are left out; NULL: there is no sweep. */
enum kd_status kd_fits_put_scene(struct kd_buffer *cards, const struct kd_scene *scene, const struct kd_sweep *sweep);

#endif

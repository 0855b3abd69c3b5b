/* Tells the axes of a sweep in a FITS cube: world coordinates in the header of each layer, and a table of each
 * axis' values. Each function appends to a buffer. Any thread; KD_ENOMEM alone. Internal to render/output.
 *
 * An axis of evenly spaced numbers is a linear axis of world coordinates with its field's name; any other is counted
 * from 1. Frequencies are named as the standard names them (Greisen et al. 2006, A&A 446, 747, table 1): FREQ, in
 * Hz. Where they are not evenly spaced they are counted from 1 as well, and a second description of the same axes,
 * F, has them by a table (FREQ-TAB, section 6 there): readers such as astropy refuse a header with such a table
 * unless they are handed the whole file, so that it cannot be the first description. */
#ifndef KD_RENDER_OUTPUT_CUBE_AXES_H
#define KD_RENDER_OUTPUT_CUBE_AXES_H

#include "base/buffer.h"
#include "render/output/wcs.h"
#include "scene/sweep.h"

/* CRPIX, CRVAL and CDELT of an axis, counted from 1 in the file, whose first pixel is at `first`. alternate: "" or
 * one letter. */
enum kd_status kd_cube_put_line(struct kd_buffer *cards, unsigned number, const char *alternate, double first,
                                double step);
/* The cards of an axis of the sweep. wcs: of the pictures; NULL: they have different ones. */
enum kd_status kd_cube_put_axis(struct kd_buffer *cards, const struct kd_sweep_axis *axis, unsigned number,
                                const struct kd_wcs *wcs);
/* A whole unit: the axis' values, a row each. */
enum kd_status kd_cube_put_values(const struct kd_sweep_axis *axis, struct kd_buffer *out);
/* Says whether the axis needs a second table, FREQ, of one row that holds all frequencies, and appends that. */
bool kd_cube_has_frequencies(const struct kd_sweep_axis *axis);
enum kd_status kd_cube_put_frequencies(const struct kd_sweep_axis *axis, struct kd_buffer *out);

#endif

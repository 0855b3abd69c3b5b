/* The axes of a sweep in a FITS cube: world coordinates in the header of each layer, and a table of each axis' values.
 * Each function appends to a buffer. Any thread; the only error is KD_ENOMEM. Internal to render/output.
 *
 * An axis of evenly spaced numbers is a linear world coordinate with its field's name; any other axis is numbered from
 * 1. A frequency has its standard name (Greisen et al. 2006, A&A 446, 747, table 1): FREQ, in Hz. Frequencies that are
 * not evenly spaced are numbered from 1 as well. An alternate description F of the same axes then gives the frequencies
 * by a table (FREQ-TAB, section 6 there). The table is only an alternate description: unless readers such as astropy
 * are given the whole file, they refuse a header with such a table. */
#ifndef KD_RENDER_OUTPUT_CUBE_AXES_H
#define KD_RENDER_OUTPUT_CUBE_AXES_H

#include "base/buffer.h"
#include "render/output/wcs.h"
#include "scene/sweep.h"

/* Writes CRPIX, CRVAL and CDELT of an axis that is numbered from 1 in the file; the value of its first pixel is
 * `first`. alternate: "" or one letter. */
enum kd_status kd_cube_put_line(struct kd_buffer *cards, unsigned number, const char *alternate, double first,
                                double step);
/* Writes the cards of an axis of the sweep. wcs: world coordinates of the pictures; NULL if the pictures have
 * different ones. */
enum kd_status kd_cube_put_axis(struct kd_buffer *cards, const struct kd_sweep_axis *axis, unsigned number,
                                const struct kd_wcs *wcs);
/* Appends a complete HDU with the axis' values, one in each row. */
enum kd_status kd_cube_put_values(const struct kd_sweep_axis *axis, struct kd_buffer *out);
/* kd_cube_has_frequencies: true if the axis needs a second table, FREQ, of one row with all frequencies.
 * kd_cube_put_frequencies appends that table. */
bool kd_cube_has_frequencies(const struct kd_sweep_axis *axis);
enum kd_status kd_cube_put_frequencies(const struct kd_sweep_axis *axis, struct kd_buffer *out);

#endif

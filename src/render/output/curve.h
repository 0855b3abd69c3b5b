/* Light curves and centroid tracks: the light of frame after frame (render/plan/photometry.h). Pure. */
#ifndef KD_RENDER_OUTPUT_CURVE_H
#define KD_RENDER_OUTPUT_CURVE_H

#include "base/buffer.h"
#include "render/frame/frame.h"

/* COLUMN(name); NAN where there is no centroid. Plain numbers: a file may hold rows. */
#define KD_CURVE_COLUMNS_(COLUMN)                                                                                          \
    COLUMN(frame) COLUMN(t) COLUMN(flux) COLUMN(centroid_x) COLUMN(centroid_y) COLUMN(spots_flux) COLUMN(spots_centroid_x) \
    COLUMN(spots_centroid_y) COLUMN(width) COLUMN(height)
#define KD_CURVE_MEMBER(name) double name;
struct kd_curve_row { KD_CURVE_COLUMNS_(KD_CURVE_MEMBER) };
#undef KD_CURVE_MEMBER

/* Of a scene whose light is to be measured, whether it has spots or not. What shows in no figure, auto exposure, is taken from it. */
enum kd_status kd_curve_plan(struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                             struct kd_error *error);
/* The row of a frame that was rendered by such a plan. */
struct kd_curve_row kd_curve_row_of(unsigned number, const struct kd_scene *scene, const struct kd_frame *frame);

/* CSV with a line of names, or {"frames": [{name: value, ...}, ...]}: what is not there is empty, or null. */
enum kd_status kd_curve_text(const struct kd_curve_row *rows, size_t n, bool csv, struct kd_buffer *out);

#endif

/* Light curves and centroid tracks: one row of light for each frame (render/plan/photometry.h). Pure. */
#ifndef KD_RENDER_OUTPUT_CURVE_H
#define KD_RENDER_OUTPUT_CURVE_H

#include "render/output/series.h"

/* The columns, as COLUMN(name). Undefined centroids are NAN. A row is plain data, so rows can be stored in files. */
/* clang-format off */
#define KD_CURVE_COLUMNS_(COLUMN) \
    COLUMN(frame) COLUMN(t) COLUMN(flux) COLUMN(centroid_x) COLUMN(centroid_y) COLUMN(spots_flux) \
    COLUMN(spots_centroid_x) \
    COLUMN(spots_centroid_y) COLUMN(width) COLUMN(height)
/* clang-format on */
/* Columns of polarised light, in three groups: for all light; for all light with circular polarisation; for the spots'
 * light. NAN if undefined. */
#define KD_CURVE_STOKES_(COLUMN) COLUMN(stokes_q) COLUMN(stokes_u) COLUMN(polarization_fraction) COLUMN(evpa)
#define KD_CURVE_CIRCULAR_(COLUMN) COLUMN(stokes_v)
/* clang-format off */
#define KD_CURVE_SPOTS_(COLUMN) \
    COLUMN(spots_stokes_q) COLUMN(spots_stokes_u) COLUMN(spots_polarization_fraction) COLUMN(spots_evpa)
/* clang-format on */
#define KD_CURVE_MEMBER(name) double name;
struct kd_curve_row {
    KD_CURVE_COLUMNS_(KD_CURVE_MEMBER)
    KD_CURVE_STOKES_(KD_CURVE_MEMBER) KD_CURVE_CIRCULAR_(KD_CURVE_MEMBER) KD_CURVE_SPOTS_(KD_CURVE_MEMBER)
};
#undef KD_CURVE_MEMBER

/* The series of light curves. The light of its frames must be measured, whether the scene has spots or not. "csv" has
 * a line of names, "json" is {"frames": [{name: value, ...}, ...]}. Undefined values are empty in CSV and null in
 * JSON. A group of polarisation columns without a number in any row is left out. For a sweep, the values of its axes
 * come after the frame's number. These columns have the names of the axes' fields. */
extern const struct kd_series kd_light_curve;

struct kd_curve_row kd_curve_row_of(unsigned number, const struct kd_scene *scene, const struct kd_frame *frame);

#endif

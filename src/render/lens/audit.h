/* The audit measures the error of a lens map: it traces a sample of its rays again in closed form, in double on the
 * CPU, and compares radii of crossings, and fates. It takes some 3 ms whenever a new map is traced; the result is kept
 * with the map. For a map that was made by the closed form in double, it measures the rounding to 32 bits alone.
 * Render thread. */
#ifndef KD_RENDER_LENS_AUDIT_H
#define KD_RENDER_LENS_AUDIT_H

#include "render/device/internal.h"
#include "render/rays/rays.h"

/* map: complete. Without plan->audit out->sampled is 0. Radii from the ISCO to 1000 M count: closer in the gas is
 * gone, further out it is dark. */
enum kd_status kd_audit(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                        const struct kd_lens_map *map, struct kd_accuracy_report *out, struct kd_error *error);

#endif

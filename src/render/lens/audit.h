/* Audit of a lens map. It traces a sample of the map's rays again in closed form, in double on the CPU, and compares
 * crossing radii and fates. The audit takes about 3 ms for each new map, and its result is kept with the map. If the
 * map was made by the closed form in double, only the rounding to 32 bits is measured. Render thread. */
#ifndef KD_RENDER_LENS_AUDIT_H
#define KD_RENDER_LENS_AUDIT_H

#include "render/device/device_internal.h"
#include "render/rays/rays.h"

/* The map must be complete. If plan->lens.audit is 0, out->sampled becomes 0. Only radii from the ISCO to 1000 M are
 * compared, as in the accuracy table (accuracy/table.h). */
enum kd_status kd_audit(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                        const struct kd_lens_map *map, struct kd_accuracy_report *out, struct kd_error *error);

#endif

/* Steps of kd_comparison_make. Private to this module. */
#ifndef KD_OBSERVE_REDUCE_H
#define KD_OBSERVE_REDUCE_H

#include "observe/comparison.h"

/* average.c: copies the visibilities, averaged if average_s is above 0, to *out, which is malloc'd. They are sorted by
 * time, then by stations. */
enum kd_status kd_average(const struct kd_observation *observation, double seconds, struct kd_measured **out, size_t *n,
                          struct kd_error *error);
/* closures.c: adds the closures of one time. first, n: range of the visibilities at that time. */
enum kd_status kd_closures(struct kd_comparison *c, const struct kd_observation *observation,
                           const struct kd_comparison_params *params, enum kd_product product, size_t first, size_t n,
                           struct kd_error *error);
enum kd_status kd_comparison_add(struct kd_comparison *c, const struct kd_comparison_row *row, struct kd_error *error);

#endif

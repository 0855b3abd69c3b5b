/* Measures the accuracy table of a device. Render thread. Takes minutes, or about ten seconds if `quick` is true. */
#ifndef KD_RENDER_SELFTEST_ACCURACY_MEASURE_H
#define KD_RENDER_SELFTEST_ACCURACY_MEASURE_H

#include "render/accuracy/table.h"
#include "render/device/renderer.h"

struct kd_accuracy_params {
    bool quick; /* true to measure fewer rays for a shorter time */
    /* device time of each speed measurement; it is shorter if a million rays take less time. 0 means 0.5, or 0.02 if
       `quick` is true */
    double seconds;
    const char *command; /* the command that requested it, stored with the table; NULL: none */
};

/* Returns KD_ECANCELLED if progress returns false. Rows that the device cannot compute are left out; out->skipped says
 * why. */
enum kd_status kd_accuracy_measure(struct kd_renderer *renderer, const struct kd_accuracy_params *params,
                                   kd_progress_fn progress, void *user, struct kd_accuracy_table *out,
                                   struct kd_error *error);

/* Sets version, date, machine and device of a table that will be measured. */
void kd_accuracy_head(struct kd_renderer *renderer, const struct kd_accuracy_params *params,
                      struct kd_accuracy_table *out);

#endif

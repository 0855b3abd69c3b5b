/* Measures the accuracy table of a device. Render thread; minutes, or about ten seconds if quick. */
#ifndef KD_RENDER_SELFTEST_ACCURACY_MEASURE_H
#define KD_RENDER_SELFTEST_ACCURACY_MEASURE_H

#include "render/accuracy/table.h"
#include "render/device/renderer.h"

struct kd_accuracy_params {
    bool quick;          /* fewer rays, shorter timing */
    double seconds;      /* the device time for each speed; less where a million rays take less; 0: 0.5, quick 0.02 */
    const char *command; /* the command that asked for it, kept with the table; NULL: none */
};

/* KD_ECANCELLED when progress says so; what the device cannot do is left out and named in out->skipped. */
enum kd_status kd_accuracy_measure(struct kd_renderer *renderer, const struct kd_accuracy_params *params,
                                   kd_progress_fn progress, void *user, struct kd_accuracy_table *out,
                                   struct kd_error *error);

/* Version, date, machine and device of a table about to be measured. */
void kd_accuracy_head(struct kd_renderer *renderer, const struct kd_accuracy_params *params,
                      struct kd_accuracy_table *out);

#endif

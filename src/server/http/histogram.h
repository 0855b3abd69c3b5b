/* Histogram of durations for /metrics. All histograms have the same buckets, from 1 ms to 10 minutes. Lock-free; any
 * thread. */
#ifndef KD_SERVER_HTTP_HISTOGRAM_H
#define KD_SERVER_HTTP_HISTOGRAM_H

#include "base/buffer.h"

#include <stdatomic.h>
#include <stdbool.h>

enum { KD_HISTOGRAM_BOUNDS = 15 };

struct kd_histogram { /* initialise to 0 */
    /* number of durations between the previous bound and this one; the last entry counts durations above all bounds */
    _Atomic uint64_t counts[KD_HISTOGRAM_BOUNDS + 1];
    _Atomic uint64_t sum_us;
};

/* Adds a duration. Negative durations count as 0. */
void kd_histogram_add(struct kd_histogram *histogram, double ms);
bool kd_histogram_is_empty(const struct kd_histogram *histogram);
/* Writes # HELP and # TYPE. Call this once before all histograms of the same name. */
enum kd_status kd_histogram_head(struct kd_buffer *out, const char *name, const char *help);
/* Writes the samples of one histogram. labels: text such as `a="b",c="d"`, already escaped. */
enum kd_status kd_histogram_write(const struct kd_histogram *histogram, struct kd_buffer *out, const char *name,
                                  const char *labels);

#endif

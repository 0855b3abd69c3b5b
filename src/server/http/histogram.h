/* Histogram of durations for /metrics, with the same buckets everywhere: 1 ms to 10 minutes. Lock-free; any thread. */
#ifndef KD_SERVER_HTTP_HISTOGRAM_H
#define KD_SERVER_HTTP_HISTOGRAM_H

#include "base/buffer.h"

#include <stdatomic.h>
#include <stdbool.h>

enum { KD_HISTOGRAM_BOUNDS = 15 };

struct kd_histogram { /* all 0 to begin with */
    _Atomic uint64_t counts[KD_HISTOGRAM_BOUNDS +
                            1]; /* of those up to each bound, and beyond the bound before it; the last: beyond all */
    _Atomic uint64_t sum_us;
};

/* Counts one of so many milliseconds; what is below 0 counts as 0. */
void kd_histogram_add(struct kd_histogram *histogram, double ms);
bool kd_histogram_is_empty(const struct kd_histogram *histogram);
/* # HELP and # TYPE, once before all histograms of one name. */
enum kd_status kd_histogram_head(struct kd_buffer *out, const char *name, const char *help);
/* The series of one: labels are `a="b",c="d"`, as they are written. */
enum kd_status kd_histogram_write(const struct kd_histogram *histogram, struct kd_buffer *out, const char *name,
                                  const char *labels);

#endif

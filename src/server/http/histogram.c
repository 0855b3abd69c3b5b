#include "server/http/histogram.h"

#include <stddef.h>

static const struct {
    double ms;
    const char *seconds;
} bounds[KD_HISTOGRAM_BOUNDS] = {
    { 1, "0.001" },  { 2.5, "0.0025" }, { 5, "0.005" },  { 10, "0.01" },    { 25, "0.025" },
    { 50, "0.05" },  { 100, "0.1" },    { 250, "0.25" }, { 500, "0.5" },    { 1000, "1" },
    { 2500, "2.5" }, { 10000, "10" },   { 30000, "30" }, { 120000, "120" }, { 600000, "600" },
};

void kd_histogram_add(struct kd_histogram *histogram, double ms)
{
    size_t i = 0;
    while (i < KD_HISTOGRAM_BOUNDS && !(ms <= bounds[i].ms))
        i++;
    atomic_fetch_add_explicit(&histogram->counts[i], 1, memory_order_relaxed);
    atomic_fetch_add_explicit(&histogram->sum_us, ms > 0 ? (uint64_t)(ms * 1e3) : 0, memory_order_relaxed);
}

static uint64_t count(const struct kd_histogram *histogram, size_t i)
{
    return atomic_load_explicit(&histogram->counts[i], memory_order_relaxed);
}

bool kd_histogram_is_empty(const struct kd_histogram *histogram)
{
    for (size_t i = 0; i <= KD_HISTOGRAM_BOUNDS; i++)
        if (count(histogram, i))
            return false;
    return true;
}

enum kd_status kd_histogram_head(struct kd_buffer *out, const char *name, const char *help)
{
    return kd_buffer_printf(out, "# HELP %s %s\n# TYPE %s histogram\n", name, help, name);
}

/* The count is computed from the buckets that were read, so that it equals the last bucket even if other threads add
 * durations meanwhile. */
enum kd_status kd_histogram_write(const struct kd_histogram *histogram, struct kd_buffer *out, const char *name,
                                  const char *labels)
{
    enum kd_status status = KD_OK;
    const double sum = 1e-6 * (double)atomic_load_explicit(&histogram->sum_us, memory_order_relaxed);
    unsigned long long all = 0;
    for (size_t i = 0; i <= KD_HISTOGRAM_BOUNDS; i++) {
        all += count(histogram, i);
        KD_TRY(kd_buffer_printf(out, "%s_bucket{%s,le=\"%s\"} %llu\n", name, labels,
                                i < KD_HISTOGRAM_BOUNDS ? bounds[i].seconds : "+Inf", all));
    }
    KD_TRY(kd_buffer_printf(out, "%s_sum{%s} %.6f\n%s_count{%s} %llu\n", name, labels, sum, name, labels, all));
done:
    return status;
}

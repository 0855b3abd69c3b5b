#include "render/accuracy/table.h"

#include <math.h>

const char *const kd_accuracy_quantity_names[KD_ACCURACY_QUANTITIES] = {
    [KD_ACCURACY_R] = "r", [KD_ACCURACY_PHI] = "phi", [KD_ACCURACY_DELAY] = "delay", [KD_ACCURACY_G] = "g"
};

double kd_accuracy_holds(const struct kd_accuracy_row *row)
{
    double out = 0;
    if (!(row->sets[KD_ACCURACY_BULK].rays_per_s > 0))
        return INFINITY;
    for (int k = 0; k < KD_ACCURACY_SETS; k++) {
        const struct kd_accuracy_entry *e = &row->sets[k];
        double median = e->of[KD_ACCURACY_R].median, most = k == KD_ACCURACY_BULK ? e->of[KD_ACCURACY_R].p99 : median;
        if (k == KD_ACCURACY_NEAR_CRITICAL)
            continue;
        if (!e->rays || !e->crossings || !(median >= 0) || !(most >= median) || e->differ > KD_ACCURACY_STRAY * e->rays)
            return INFINITY;
        out = fmax(out, most);
    }
    return out;
}

static enum kd_status refuse(const struct kd_accuracy_table *table, const struct kd_accuracy_row *best,
                             double tolerance, struct kd_error *error)
{
    bool stands_in = table == kd_accuracy_built_in();
    if (!best)
        return kd_error_field(error, "/accuracy/tolerance",
                              "the accuracy table of this device has no reliable row for this request; `kerrd bench "
                              "accuracy` makes a new table");
    /* The printed error is rounded up, so that a request with this number as its tolerance succeeds. */
    return kd_error_field(
        error, "/accuracy/tolerance",
        "tolerance is %.3g; %s reaches %.3g at best (%s %s with %u steps), but the engine \"closed\", with which these "
        "are compared, is more accurate",
        tolerance, stands_in ? "llvmpipe, whose table replaces the missing table of this device," : "this device",
        1.01 * kd_accuracy_holds(best), kd_engine_name(best->engine), kd_precision_name(best->precision), best->steps);
}

static bool within(const struct kd_accuracy_limits *limits, const struct kd_accuracy_row *row)
{
    return !limits || ((limits->engine < 0 || limits->engine == (int)row->engine) &&
                       (limits->precision < 0 || limits->precision == (int)row->precision));
}

enum kd_status kd_accuracy_choose(const struct kd_accuracy_table *table, double tolerance,
                                  const struct kd_accuracy_limits *limits, struct kd_accuracy_choice *out,
                                  struct kd_error *error)
{
    const struct kd_accuracy_row *found = NULL, *best = NULL;
    if (!(tolerance > 0 && tolerance < 1))
        return kd_error_field(error, "/accuracy/tolerance",
                              "tolerance is %.9g; it must be a number above 0 and below 1", tolerance);
    for (uint32_t i = 0; i < table->n; i++) {
        const struct kd_accuracy_row *row = &table->rows[i];
        if (!within(limits, row) || isinf(kd_accuracy_holds(row)))
            continue;
        if (!best || kd_accuracy_holds(row) < kd_accuracy_holds(best))
            best = row;
        if (kd_accuracy_holds(row) <= tolerance &&
            (!found || row->sets[KD_ACCURACY_BULK].rays_per_s > found->sets[KD_ACCURACY_BULK].rays_per_s))
            found = row;
    }
    if (!found)
        return refuse(table, best, tolerance, error);
    *out = (struct kd_accuracy_choice) { found->engine, found->precision, found->steps, kd_accuracy_holds(found),
                                         found->sets[KD_ACCURACY_BULK].rays_per_s };
    return KD_OK;
}

#include "quantity/define.h"

#include "physics/spacetime/kerr.h"
#include "scene/observer_fault.h"
#include "document/number.h"
#include "quantity/quantities.h" /* the list QUANTITIES, which meson.build makes */

#include <stdio.h>
#include <string.h>

#define DECLARE(symbol) extern const struct kd_quantity kd_quantity_##symbol;
QUANTITIES(DECLARE)

#define POINTER(symbol) &kd_quantity_##symbol,
const struct kd_quantity *const kd_quantities[] = { QUANTITIES(POINTER) };
const size_t kd_quantity_count = sizeof kd_quantities / sizeof *kd_quantities;

const struct kd_quantity *kd_quantity_find(const char *name)
{
    for (size_t i = 0; i < kd_quantity_count; i++)
        if (!strcmp(kd_quantities[i]->name, name))
            return kd_quantities[i];
    return NULL;
}

void kd_quantity_names(char *out, size_t size)
{
    size_t used = 0;
    *out = 0;
    for (size_t i = 0; i < kd_quantity_count && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%s", i ? ", " : "", kd_quantities[i]->name);
}

enum kd_status kd_quantity_outside(struct kd_error *error, const char *name, double value, const char *reason, ...)
{
    char pointer[64], number[KD_NUMBER_SIZE], text[200];
    va_list args;
    va_start(args, reason);
    vsnprintf(text, sizeof text, reason, args);
    va_end(args);
    snprintf(pointer, sizeof pointer, "/%s", name);
    kd_number_format(number, value);
    return kd_error_field(error, pointer, "%s is %s%s", name, number, text);
}

enum kd_status kd_quantity_outside_horizon(const struct kd_hole *hole, double r, struct kd_error *error)
{
    double horizon = hole->outer;
    return r >= horizon ? KD_OK
                        : kd_quantity_outside(error, "r", r, "; it must be at least %.9g M, the horizon", horizon);
}

enum kd_status kd_quantity_observer_exists(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                           struct kd_error *error)
{
    static const struct kd_observer_names names = { "", "", "observer_r", "observer" };
    const double horizon = at->hole.outer;
    if (!(at->r > horizon) && kd_observers[motion->observer].outside(&at->hole, at->u) >= horizon)
        return kd_quantity_outside(error, "observer_r", at->r, "; it must be more than %.9g M, the horizon", horizon);
    enum kd_status status = kd_observer_check_place(&names, motion->observer, at, error);
    return status || !isfinite(at->r) ? status : kd_observer_check_numbers(&names, motion, at, error);
}

#include "quantity/define.h"

#include "physics/kerr.h"
#include "scene/number.h"

#include <stdio.h>
#include <string.h>

/* In the order in which they are listed. */
/* clang-format off */
#define QUANTITIES(X) X(kerr) X(shadow) X(deflection) X(potential) X(redshift) X(ring_image) X(photon_rings) \
X(disk_flux) X(blackbody) X(qnm) X(flamm) X(frame_dragging) \
    X(infall) X(sky) X(scale) X(inspiral) X(tidal) X(separatrix)
/* clang-format on */

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
    return kd_error_field(error, pointer, "%s is %s, %s", name, number, text);
}

enum kd_status kd_quantity_outside_horizon(double a, double r, struct kd_error *error)
{
    double horizon = kd_kerr_horizon(a);
    return r >= horizon
               ? KD_OK
               : kd_quantity_outside(error, "r", r, "inside the horizon at %.9g M; allowed is outside", horizon);
}

static enum kd_status numbers_of(const struct kd_observer_motion *m, const struct kd_vantage *at,
                                 struct kd_error *error)
{
    char pointer[40];
    double bound;
    switch (kd_observer_check(m, at, &bound)) {
    case KD_OBSERVER_SOUND: return KD_OK;
    case KD_OBSERVER_TOO_FAST:
        snprintf(pointer, sizeof pointer, "/%s", kd_observer_fastest(m->velocity, &bound));
        return kd_error_field(
            error, pointer,
            "velocity_r, velocity_theta and velocity_phi are %.9g together, allowed is less than 1, the speed of light",
            hypot(hypot(m->velocity[0], m->velocity[1]), m->velocity[2]));
    case KD_OBSERVER_TWO_ENERGIES:
        return kd_quantity_outside(error, "infall_energy", m->fall_energy, "allowed is rest with infall_from %.9g",
                                   m->fall_from);
    case KD_OBSERVER_FROM_INSIDE:
        return kd_quantity_outside(error, "infall_from", m->fall_from, "allowed is at least observer_r, %.9g", bound);
    case KD_OBSERVER_TURNS: break;
    }
    if (isfinite(m->fall_energy))
        return kd_quantity_outside(error, "infall_energy", m->fall_energy,
                                   "allowed is more than %.9g at observer_r with this infall_momentum", bound);
    return kd_quantity_outside(error, "infall_momentum", m->fall_momentum,
                               "with which it turns outside observer_r; allowed are those nearer to 0");
}

enum kd_status kd_quantity_observer_exists(const struct kd_observer_motion *motion, const struct kd_vantage *at,
                                           struct kd_error *error)
{
    const struct kd_observer_row *row = &kd_observers[motion->observer];
    const double horizon = kd_kerr_horizon(at->spin);
    char others[KD_OBSERVER_TEXT];
    if (!(at->r > horizon) && row->outside(at->spin, at->u) >= horizon)
        return kd_quantity_outside(error, "observer_r", at->r, "not outside the horizon at %.9g M", horizon);
    if (kd_observer_exists(motion->observer, at))
        return isfinite(at->r) ? numbers_of(motion, at, error) : KD_OK;
    return kd_quantity_outside(error, "observer_r", at->r, "in %s, where %s; allowed is outside %.9g M, or observer %s",
                               row->edge, row->why, row->outside(at->spin, at->u), kd_observer_others(at, others));
}

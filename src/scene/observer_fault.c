#include "scene/observer_fault.h"

#include "document/number.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>

struct shown { char text[KD_NUMBER_SIZE]; };

static struct shown show(double value)
{
    struct shown s;
    kd_number_format(s.text, value);
    return s;
}

/* Rounds a bound up, so that the number in the message is itself an accepted value. */
static struct shown show_bound(double value) { return show(ceil(value * 1e9) / 1e9); }

static enum kd_status fault(const struct kd_observer_names *names, const char *field, struct kd_error *error,
                            const char *format, ...)
{
    char pointer[60], text[400];
    va_list args;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    snprintf(pointer, sizeof pointer, "%s/%s", names->pointer, field);
    return kd_error_field(error, pointer, "%s%s %s", names->prefix, field, text);
}

enum kd_status kd_observer_check_place(const struct kd_observer_names *names, enum kd_observer kind,
                                       const struct kd_vantage *at, struct kd_error *error)
{
    const struct kd_observer_row *row = &kd_observers[kind];
    char others[KD_OBSERVER_TEXT];
    if (kd_observer_exists(kind, at))
        return KD_OK;
    const struct shown r = show(at->r), least = show_bound(row->outside(&at->hole, at->u));
    if (kind == KD_OBSERVER_INFALL)
        return fault(names, names->r, error,
                     "is %s M; for %s%s \"infall\" it must be more than %s M, the inner horizon, where the model ends",
                     r.text, names->prefix, names->kind, least.text);
    return fault(names, names->r, error,
                 "is %s M; for %s%s \"%s\" at this inclination it must be more than %s M, %s; inside, %s%s must be %s",
                 r.text, names->prefix, names->kind, row->word, least.text, row->edge, names->prefix, names->kind,
                 kd_observer_others(at, others));
}

enum kd_status kd_observer_check_numbers(const struct kd_observer_names *names, const struct kd_observer_motion *m,
                                         const struct kd_vantage *at, struct kd_error *error)
{
    const char *prefix = names->prefix, *r = names->r;
    char pointer[60];
    double bound;
    switch (kd_observer_check(m, at, &bound)) {
    case KD_OBSERVER_SOUND: return KD_OK;
    case KD_OBSERVER_TOO_FAST:
        snprintf(pointer, sizeof pointer, "%s/%s", names->pointer, kd_observer_fastest(m->velocity, &bound));
        return kd_error_field(
            error, pointer,
            "%svelocity_r, velocity_theta and velocity_phi make a speed of %s c; it must be less than 1", prefix,
            show(hypot(hypot(m->velocity[0], m->velocity[1]), m->velocity[2])).text);
    case KD_OBSERVER_TWO_ENERGIES:
        return fault(names, "infall_energy", error, "is %s with %sinfall_from %s M; it must be \"rest\"",
                     show(m->fall_energy).text, prefix, show(m->fall_from).text);
    case KD_OBSERVER_FROM_INSIDE:
        return fault(names, "infall_from", error, "is %s M; it must be at least %s%s, %s M", show(m->fall_from).text,
                     prefix, r, show(bound).text);
    case KD_OBSERVER_TURNS: break;
    }
    if (isfinite(m->fall_energy))
        return fault(names, "infall_energy", error,
                     "is %s; at %s%s %s M with this angular momentum it must be at least %s", show(m->fall_energy).text,
                     prefix, r, show(at->r).text, show_bound(bound).text);
    return fault(names, "infall_momentum", error,
                 "is %s M, with which the observer turns back outside %s%s %s M; it must be closer to 0",
                 show(m->fall_momentum).text, prefix, r, show(at->r).text);
}

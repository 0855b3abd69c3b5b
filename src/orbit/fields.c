#include "orbit/fields.h"

#include "base/decimal.h"
#include "orbit/cases.h"
#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { OPTIONAL, NEEDED };
#define ANY KD_ORBIT_FORMS
#define REAL KD_FIELD_IS_REAL
#define INT KD_FIELD_IS_INT
#define BOOL KD_FIELD_IS_BOOL
#define WORD KD_FIELD_IS_WORD

const struct kd_orbit_field kd_orbit_settings[] = {
#define AT(member) offsetof(struct kd_orbit_params, member)
    { "", "spin", REAL, AT(spin), -1, 1, 0, ANY, 0, KD_OPEN, .help = "spin of the hole, a/M" },
    { "", "samples", INT, AT(samples), 0, KD_ORBIT_SAMPLES_MAX, 0, ANY, 0, .bound = KD_BOUND_NOT_ONE,
      .help = "number of samples of the path, both ends included; 0 for none; at most 20000 if \"seen\" is given" },
    { "", "digits", INT, AT(digits), 1, KD_DECIMAL_DIGITS, 0, ANY, 0,
      .help = "significant digits of the series as text" },
    { "", "steps", INT, AT(steps), 0, 100000000, 0, ANY, 0,
      .help = "steps per radial period, instead of a tolerance; 0: by tolerance" },
    { "", "tolerance", REAL, AT(tolerance), 1e-14, 1e-3, 0, ANY, 0,
      .help = "largest relative error after a period; it determines the step" },
    { "", "method", WORD, AT(way), 0, 0, WAY_WORDS, ANY, 0, .help = "method of integration" },
    { "", "r_max", REAL, AT(r_max), 2, 1e6, 0, ANY, 0, .help = "radius at which an escaping orbit ends [M]" },
    { "", "mass_msun", REAL, AT(mass_msun), 1e-20, 1e20, 0, ANY, 0,
      .help = "mass of the hole [solar masses]; adds frequencies in Hz and the advance per century" },
    { "", "series", BOOL, AT(series), 0, 1, 0, ANY, 0,
      .help = "for a list: whether the answer has the samples of each orbit" },
    { "duration", "periods", REAL, AT(periods), 0, 1e9, 0, ANY, 0,
      .help = "duration in radial periods, or in revolutions if r is constant" },
    { "duration", "time", REAL, AT(time), 0, 1e30, 0, ANY, 0, .help = "coordinate time [M]" },
    { "duration", "or_end", BOOL, AT(or_end), 0, 1, 0, ANY, 0,
      .help = "follow an orbit that plunges or escapes to its end, because it has no periods" },
    { "seen", "observer_r", REAL, AT(seen.r), 0, 1e7, 0, ANY, 0, .bound = KD_BOUND_RADIUS,
      .help = "radius of the observer [M]; default infinity" },
    { "seen", "observer_inclination_deg", REAL, AT(seen.inclination_deg), 0, 180, 0, ANY, 0,
      .help = "polar angle of the observer [deg]" },
    { "seen", "observer_azimuth_deg", REAL, AT(seen.azimuth_deg), -1e6, 1e6, 0, ANY, 0,
      .help = "azimuth of the observer [deg]" },
    { "seen", "observer", WORD, AT(seen.motion), 0, 0, FRAME_WORDS, ANY, 0, .help = "motion of the observer" },
#undef AT
};
_Static_assert(sizeof kd_orbit_settings / sizeof *kd_orbit_settings == KD_ORBIT_N_SETTINGS,
               "as many as the header says");

const struct kd_orbit_field kd_orbit_fields[] = {
#define AT(member) offsetof(struct kd_orbit_spec, member)
    { "", "spin", REAL, AT(spin), -1, 1, 0, ANY, 0, KD_OPEN, .help = "spin of the hole, a/M" },
    { "", "p", REAL, AT(p), 0, 1e20, 0, KD_ORBIT_SHAPE, NEEDED, .bound = KD_BOUND_RADIUS,
      .help = "semi-latus rectum of a bound orbit; its radii are between p/(1+e) and p/(1-e) [M]" },
    { "", "e", REAL, AT(e), 0, 1, 0, KD_ORBIT_SHAPE, NEEDED, KD_OPEN_ABOVE, .help = "eccentricity" },
    { "", "inclination_deg", REAL, AT(inclination_deg), 0, 180, 0, KD_ORBIT_SHAPE, OPTIONAL,
      .help = "inclination; above 90 is retrograde [deg]" },
    { "", "energy", REAL, AT(energy), -1e6, 1e6, 0, KD_ORBIT_CONSTANTS, NEEDED, .help = "energy per rest mass" },
    { "", "angular_momentum", REAL, AT(momentum), -1e20, 1e20, 0, KD_ORBIT_CONSTANTS, NEEDED,
      .help = "angular momentum about the axis, per rest mass [M]" },
    { "", "carter", REAL, AT(carter), -1e30, 1e30, 0, KD_ORBIT_CONSTANTS, OPTIONAL, .bound = KD_BOUND_POSITIVE,
      .help = "Carter's constant, per rest mass [M^2]; 0 in the equatorial plane" },
    { "", "r", REAL, AT(r), 0, 1e20, 0, KD_ORBIT_CONSTANTS, OPTIONAL, .bound = KD_BOUND_RADIUS,
      .help = "radius where the path starts [M]" },
    { "", "outward", BOOL, AT(outward), 0, 1, 0, KD_ORBIT_CONSTANTS, OPTIONAL,
      .help = "whether the path starts outwards" },
    { "position", "r", REAL, AT(place_r), 0, 1e20, 0, KD_ORBIT_STATE, NEEDED, .bound = KD_BOUND_RADIUS,
      .help = "radius [M]" },
    { "position", "theta_deg", REAL, AT(theta_deg), 0, 180, 0, KD_ORBIT_STATE, OPTIONAL, .help = "polar angle [deg]" },
    { "position", "phi_deg", REAL, AT(phi_deg), -360, 360, 0, KD_ORBIT_STATE, OPTIONAL, .help = "azimuth [deg]" },
    { "velocity", "frame", WORD, AT(frame), 0, 0, FRAME_WORDS, KD_ORBIT_STATE, OPTIONAL,
      .help = "observer whose frame the velocity refers to" },
    { "velocity", "v_r", REAL, AT(v), -1, 1, 0, KD_ORBIT_STATE, OPTIONAL, .help = "component along r [c]" },
    { "velocity", "v_theta", REAL, AT(v) + sizeof(double), -1, 1, 0, KD_ORBIT_STATE, OPTIONAL,
      .help = "component along theta [c]" },
    { "velocity", "v_phi", REAL, AT(v) + 2 * sizeof(double), -1, 1, 0, KD_ORBIT_STATE, OPTIONAL,
      .help = "component along phi [c]" },
    { "", "case", WORD, AT(named), 0, 0, CASE_WORDS, KD_ORBIT_CASE, NEEDED, .help = "an orbit by name" },
#undef AT
};
_Static_assert(sizeof kd_orbit_fields / sizeof *kd_orbit_fields == KD_ORBIT_N_FIELDS, "as many as the header says");

const char *kd_orbit_way_name(enum kd_orbit_way way)
{
    static const char *const names[KD_WAYS] = { "yoshida6", "rkn6", "closed" };
    return names[way];
}

const char *kd_orbit_field_word(const struct kd_orbit_field *field, int i)
{
    switch (field->words) {
    case WAY_WORDS: return i < KD_WAYS ? kd_orbit_way_name((enum kd_orbit_way)i) : NULL;
    case FRAME_WORDS: return i < KD_OBSERVER_FRAMES ? kd_observers[i].word : NULL;
    case CASE_WORDS: return i < KD_CASES ? kd_orbit_case_name((enum kd_orbit_case)i) : NULL;
    case NO_WORDS: break;
    }
    return NULL;
}

static void describe_allowed(const struct kd_orbit_field *field, char out[KD_ALLOWED_SIZE])
{
    static const char *const ranges[] = { "%s to %s", "%s up to, not including, %s", "a number above %s and below %s" };
    char low[KD_NUMBER_SIZE], high[KD_NUMBER_SIZE];
    size_t used = 0;
    *out = 0;
    kd_number_format(low, field->least);
    kd_number_format(high, field->most);
    switch (field->kind) {
    case BOOL: snprintf(out, KD_ALLOWED_SIZE, "true or false"); return;
    case INT: snprintf(out, KD_ALLOWED_SIZE, "a whole number from %s to %s", low, high); return;
    case REAL: snprintf(out, KD_ALLOWED_SIZE, ranges[field->open], low, high); return;
    case WORD:
        for (int i = 0; kd_orbit_field_word(field, i) && used < KD_ALLOWED_SIZE; i++)
            used += (size_t)snprintf(
                out + used, KD_ALLOWED_SIZE - used, "%s\"%s\"",
                kd_text_or((size_t)i, kd_orbit_field_word(field, i + 1) ? (size_t)i + 2 : (size_t)i + 1),
                kd_orbit_field_word(field, i));
        return;
    }
}

static bool inside(const struct kd_orbit_field *field, double x)
{
    bool low = field->open == KD_OPEN ? x > field->least : x >= field->least;
    return low && (field->open ? x < field->most : x <= field->most);
}

static bool store(void *to, const struct kd_orbit_field *field, const struct kd_value *value)
{
    void *at = (char *)to + field->offset;
    bool good = value->kind == KD_VALUE_NUMBER && inside(field, value->number);
    switch (field->kind) {
    case REAL:
        if (good)
            *(double *)at = value->number;
        return good;
    case INT:
        if (!good || value->number != floor(value->number))
            return false;
        *(uint32_t *)at = (uint32_t)value->number;
        return true;
    case BOOL:
        if (value->kind != KD_VALUE_BOOL)
            return false;
        *(bool *)at = value->number != 0;
        return true;
    case WORD:
        for (int i = 0; value->kind == KD_VALUE_STRING && kd_orbit_field_word(field, i); i++)
            if (!strcmp(value->text, kd_orbit_field_word(field, i))) {
                memcpy(at, &i, sizeof i); /* every enum here is as wide as int */
                return true;
            }
        return false;
    }
    return false;
}

enum kd_status kd_orbit_field_put(void *to, const struct kd_orbit_field *field, const struct kd_value *value,
                                  const char *pointer, struct kd_error *error)
{
    char given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    if (store(to, field, value))
        return KD_OK;
    kd_value_describe(value, given);
    describe_allowed(field, allowed);
    return kd_error_field(error, pointer, "%s is %s%s; it must be %s", field->name, given,
                          field->kind == REAL || field->kind == INT ? kd_value_unwanted(value) : "", allowed);
}

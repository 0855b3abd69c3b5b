/* A request for orbits has these fields, a row each. Private to src/orbit. */
#ifndef KD_ORBIT_FIELDS_H
#define KD_ORBIT_FIELDS_H

#include "base/error.h"
#include "orbit/asked.h"
#include "scene/value.h"

enum kd_orbit_kind { KD_FIELD_IS_REAL, KD_FIELD_IS_WHOLE, KD_FIELD_IS_TRUTH, KD_FIELD_IS_WORD };
enum kd_orbit_words { NO_WORDS, WAY_WORDS, FRAME_WORDS, CASE_WORDS };
enum kd_orbit_open { KD_CLOSED, KD_OPEN_ABOVE, KD_OPEN };
/* What holds of a number besides its range, whatever else is asked: a schema can say it. Who asks for more is told
 * by what it is that cannot be: the horizon of this spin, say. A horizon is above 1 M: 1 + sqrt(1 - a^2), Bardeen,
 * Press & Teukolsky 1972. */
enum kd_orbit_implied { KD_BOUND_NONE, KD_BOUND_RADIUS, KD_BOUND_POSITIVE, KD_BOUND_NOT_ONE };

struct kd_orbit_field {
    const char *section, *name;
    enum kd_orbit_kind kind;
    size_t offset;
    double least, most; /* of numbers */
    enum kd_orbit_words words;
    enum kd_orbit_form form; /* the form of an orbit that it belongs to; KD_ORBIT_FORMS: any */
    int needed;
    enum kd_orbit_open open; /* which ends of its range are outside it */
    enum kd_orbit_implied bound;
    const char *help; /* for schemas, with the unit in brackets */
};

enum { KD_ORBIT_N_SETTINGS = 16, KD_ORBIT_N_FIELDS = 17 };
extern const struct kd_orbit_field kd_orbit_settings[KD_ORBIT_N_SETTINGS]; /* of struct kd_orbit_params */
extern const struct kd_orbit_field kd_orbit_fields[KD_ORBIT_N_FIELDS];     /* of struct kd_orbit_spec */

/* A field that is a word may be one of these; NULL behind the last. */
const char *kd_orbit_field_word(const struct kd_orbit_field *field, int i);

/* Store a value in its struct, or KD_EINVAL with the pointer, the value and what is allowed. */
enum kd_status kd_orbit_field_put(void *to, const struct kd_orbit_field *field, const struct kd_value *value,
                                  const char *pointer, struct kd_error *error);

#endif

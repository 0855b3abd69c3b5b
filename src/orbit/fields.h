/* Tables of the fields of a request for orbits, one row a field. Private to src/orbit. */
#ifndef KD_ORBIT_FIELDS_H
#define KD_ORBIT_FIELDS_H

#include "base/error.h"
#include "orbit/asked.h"
#include "document/value.h"
#include "scene/table.h"

enum kd_orbit_kind { KD_FIELD_IS_REAL, KD_FIELD_IS_INT, KD_FIELD_IS_BOOL, KD_FIELD_IS_WORD };
enum kd_orbit_words { NO_WORDS, WAY_WORDS, FRAME_WORDS, CASE_WORDS };
enum kd_orbit_open { KD_CLOSED, KD_OPEN_ABOVE, KD_OPEN };
/* Constraints on a number besides its range that hold for every request, so that a schema can express them. Stricter
 * limits, such as the horizon of the given spin, are checked later. A horizon is above 1 M: 1 + sqrt(1 - a^2),
 * Bardeen, Press & Teukolsky 1972. */
enum kd_orbit_implied { KD_BOUND_NONE, KD_BOUND_RADIUS, KD_BOUND_POSITIVE, KD_BOUND_NOT_ONE };

struct kd_orbit_field {
    const char *section, *name;
    enum kd_orbit_kind kind;
    size_t offset;
    double least, most; /* of numbers */
    enum kd_orbit_words words;
    enum kd_orbit_form form; /* form of an orbit that the field belongs to; KD_ORBIT_FORMS: any */
    int needed;
    enum kd_orbit_open open; /* which ends the range excludes */
    enum kd_orbit_implied bound;
    const char *help; /* for schemas, with the unit in brackets */
};

enum { KD_ORBIT_N_SETTINGS = 16, KD_ORBIT_N_FIELDS = 17 };
extern const struct kd_orbit_field kd_orbit_settings[KD_ORBIT_N_SETTINGS]; /* of struct kd_orbit_params */
extern const struct kd_orbit_field kd_orbit_fields[KD_ORBIT_N_FIELDS];     /* of struct kd_orbit_spec */

/* Words of a word field; NULL beyond the last. */
const char *kd_orbit_field_word(const struct kd_orbit_field *field, int i);

/* Stores a value in its struct. KD_EINVAL with the pointer, the value and what is allowed. */
enum kd_status kd_orbit_field_put(void *to, const struct kd_orbit_field *field, const struct kd_value *value,
                                  const char *pointer, struct kd_error *error);

#endif

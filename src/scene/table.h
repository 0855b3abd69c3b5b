/* The rows of scene/fields.h as data: one table that everything about scenes is generated from.
 * Internal to src/scene and its tests. Constant data and pure functions, any thread. */
#ifndef KD_SCENE_TABLE_H
#define KD_SCENE_TABLE_H

#include "scene/scene.h"

enum kd_field_kind { KD_FIELD_REAL, KD_FIELD_WORD, KD_FIELD_INT, KD_FIELD_BOOL, KD_FIELD_ENUM };

struct kd_field {
    const char *section; /* "" for a member of the document itself */
    const char *name;
    enum kd_field_kind kind;
    size_t offset; /* in struct kd_scene: double, int32_t (INT, ENUM) or bool */
    double initial, minimum, maximum;
    const char *unit; /* "1": a pure number; "" for BOOL and ENUM */
    const char *help;
    const char *words; /* WORD: the word for INFINITY; ENUM: "a|b|c"; NULL otherwise */
};

struct kd_section {
    const char *name; /* "" for the document itself: always the last */
    const char *help;
    size_t first, count; /* rows in kd_fields */
};

#define KD_ONE(...) +1
#define KD_COUNT_ROWS(name, LIST, help) LIST(KD_ONE, KD_ONE, KD_ONE, KD_ONE, KD_ONE)
enum {
    KD_FIELD_COUNT = 0 KD_SCENE_SECTIONS(KD_COUNT_ROWS),
    KD_SECTION_COUNT = 0 KD_SCENE_SECTIONS(KD_ONE),
};

extern const struct kd_field kd_fields[KD_FIELD_COUNT];
extern const struct kd_section kd_sections[KD_SECTION_COUNT];

/* NULL when there is none; "" is the document itself. Names are case-sensitive. */
const struct kd_section *kd_section_find(const char *section);
const struct kd_field *kd_field_find(const char *section, const char *name);

/* Any kind as a double: exact for int32_t, 0 or 1 for bool, the index for ENUM. */
double kd_field_get(const struct kd_scene *scene, const struct kd_field *field);
void kd_field_put(struct kd_scene *scene, const struct kd_field *field, double value);

/* True if value may be stored in field: in range, whole where that is asked for, INFINITY for WORD alone. */
bool kd_field_holds(const struct kd_field *field, double value);

/* Words of an ENUM. The text of a word is not NUL-terminated: print it with %.*s. */
struct kd_word {
    const char *text;
    int length;
};
int kd_field_word_count(const struct kd_field *field);
struct kd_word kd_field_word(const struct kd_field *field, int index);
int kd_field_word_index(const struct kd_field *field, const char *text); /* -1: none of them */

/* "camera.r" and "/camera/r"; "time" and "/time". */
enum { KD_PATH_SIZE = 80 };
void kd_field_path(const struct kd_field *field, char out[KD_PATH_SIZE]);
void kd_field_pointer(const struct kd_field *field, char out[KD_PATH_SIZE]);

#endif

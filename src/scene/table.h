/* The rows of scene/fields.h as data, from which everything about scenes is generated. Internal to src/scene and its
 * tests. Constant data and pure functions, any thread. */
#ifndef KD_SCENE_TABLE_H
#define KD_SCENE_TABLE_H

#include "document/document.h"
#include "scene/scene.h"

/* The columns nature, place and group of scene/fields.h. */
enum kd_field_nature { KD_FIELD_PHYSICS, KD_FIELD_MODEL, KD_FIELD_LOOK };
enum kd_field_place { KD_FIELD_FRONT, KD_FIELD_REST };
enum kd_section_group { KD_GROUP_LOOK, KD_GROUP_GAS, KD_GROUP_HOLE, KD_GROUP_CAMERA, KD_GROUP_MORE };
enum { KD_NATURE_COUNT = KD_FIELD_LOOK + 1, KD_GROUP_COUNT = KD_GROUP_MORE + 1 };

struct kd_field_page {
    enum kd_field_nature nature;
    enum kd_field_place place;
};

struct kd_nature { const char *word, *help; };

struct kd_section {
    /* "" for the document itself, which is the last section; "disk.gas" for a section that is nested in another one */
    const char *name;
    const char *help;
    enum kd_section_group group;
    size_t first, count; /* first: index of the section's first row in kd_fields; count: number of rows */
    size_t most;         /* maximum number of elements of a list; 0 if the section is not a list */
};

#define KD_ONE(...) +1
#define KD_COUNT_ROWS(name, ROWS, group, help) ROWS(KD_ONE, KD_ONE, KD_ONE, KD_ONE, KD_ONE, KD_ONE, KD_ONE)
#define KD_COUNT_LIST_ROWS(name, element, ROWS, group, most, help) KD_COUNT_ROWS(name, ROWS, group, help)
enum {
    KD_FIELD_COUNT = 0 KD_SCENE_SECTIONS(KD_COUNT_ROWS, KD_COUNT_LIST_ROWS),
    KD_SECTION_COUNT = 0 KD_SCENE_SECTIONS(KD_ONE, KD_ONE),
    KD_OLD_NAME_COUNT = 0 KD_SCENE_OLD_NAMES(KD_ONE),
    /* number of words in the bit mask of fields that a document contains */
    KD_FIELD_WORDS = (KD_FIELD_COUNT + 63) / 64,
};

/* The rows of a list exist only once for all of its elements, so functions for fields also take the index of the
 * element. For sections that are not lists this index is 0. */
extern const struct kd_nature kd_natures[KD_NATURE_COUNT];
extern const char *const kd_groups[KD_GROUP_COUNT]; /* "look", "gas", ... */
/* The rows of struct kd_scene. Rows of a list are those of its first element. `object` is the name of the section. */
extern const struct kd_row kd_fields[KD_FIELD_COUNT];
extern const struct kd_field_page kd_field_pages[KD_FIELD_COUNT];
extern const struct kd_section kd_sections[KD_SECTION_COUNT];
extern const struct kd_former kd_old_names[KD_OLD_NAME_COUNT];
extern const struct kd_document kd_scene_document; /* the rows as a document that is read into a struct kd_scene */

/* Both functions find an entry by its name, and return NULL if there is none. The section "" is the document itself.
 * Names are case-sensitive. */
const struct kd_section *kd_section_find(const char *section);
/* kd_section_is_part: true if `section` is nested in `whole`. kd_section_member: name of a section within its
 * parent. */
enum { KD_PATH_SIZE = 80 };
bool kd_section_is_part(const struct kd_section *section, const struct kd_section *whole);
const char *kd_section_member(const struct kd_section *section);
const struct kd_row *kd_field_find(const char *section, const char *name);

/* kd_section_size: number of elements of a list; 1 for other sections. kd_section_resize sets the number of
 * elements; all elements that it removes or adds are set to their defaults. */
size_t kd_section_size(const struct kd_scene *scene, const struct kd_section *section);
void kd_section_resize(struct kd_scene *scene, const struct kd_section *section, size_t size);

/* The address to which the offset of a row refers: the scene, shifted to the given element of a list. Functions for
 * rows take this pointer. */
const void *kd_field_in(const struct kd_scene *scene, const struct kd_row *field, size_t index);
/* True if a document contains the field (see kd_document_read). */
static inline bool kd_field_is_given(const uint64_t *given, const struct kd_row *field)
{
    const size_t i = (size_t)(field - kd_fields);
    return given[i / 64] >> i % 64 & 1;
}
/* Like kd_row_get and kd_row_put_number, for a field of a scene. */
double kd_field_get(const struct kd_scene *scene, const struct kd_row *field, size_t index);
void kd_field_put(struct kd_scene *scene, const struct kd_row *field, size_t index, double value);
/* Stores the value. If the field does not accept it, returns KD_EINVAL with the field's pointer, the value and the
 * accepted values, and leaves *scene unchanged. */
enum kd_status kd_field_store(struct kd_scene *scene, const struct kd_row *field, size_t index,
                              const struct kd_value *value, struct kd_error *error);
/* True if the row accepts the value that the scene has. An asset must be named by a hash. */
bool kd_field_is_sound(const struct kd_scene *scene, const struct kd_row *field, size_t index);
/* The text of an ASSET; "" if there is none. */
const char *kd_field_asset(const struct kd_scene *scene, const struct kd_row *field, size_t index);
/* Begins a JSON text whose numbers have the form of the canonical document, for example 1e-5 instead of 0.00001. */
struct kd_json kd_scene_json(struct kd_buffer *out);
/* Checks the member "version", which must be 1. */
enum kd_status kd_scene_version(const struct kd_value *value, struct kd_error *error);

/* Finds a field, and the index of its list element, by a dotted path as for kd_scene_set. The element need not exist
 * yet. Returns KD_EINVAL with a pointer if there is no such field. */
enum kd_status kd_field_at(const char *path, const struct kd_row **out, size_t *index, struct kd_error *error);

/* These functions write a field's path and its JSON pointer. Examples: "camera.r" and "/camera/r"; "time" and
 * "/time"; "spots.3.r" and "/spots/3/r"; "disk.gas.seed" and "/disk/gas/seed". */
void kd_field_path(const struct kd_row *field, size_t index, char out[KD_PATH_SIZE]);
void kd_field_pointer(const struct kd_row *field, size_t index, char out[KD_PATH_SIZE]);

#endif

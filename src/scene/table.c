#include "scene/table.h"

#include <stdio.h>
#include <string.h>

/* Members of "top" stand in the document itself. */
#define SECTION_NAME(s) (offsetof(struct kd_scene, s) == offsetof(struct kd_scene, top) ? "" : #s)
#define AT(s, n) .section = SECTION_NAME(s), .name = #n, .offset = offsetof(struct kd_scene, s.n)
#define RANGE(lo, hi, u) .minimum = lo, .maximum = hi, .unit = u

#define REAL(s, n, d, lo, hi, u, h)                                                                          \
    { AT(s, n), .kind = KD_FIELD_REAL, .initial = d, RANGE(lo, hi, u), .help = h },
#define WORD(s, n, d, lo, hi, u, h, w)                                                                       \
    { AT(s, n), .kind = KD_FIELD_WORD, .initial = d, RANGE(lo, hi, u), .help = h, .words = w },
#define INT(s, n, d, lo, hi, u, h)                                                                           \
    { AT(s, n), .kind = KD_FIELD_INT, .initial = d, RANGE(lo, hi, u), .help = h },
#define BOOL(s, n, d, h) { AT(s, n), .kind = KD_FIELD_BOOL, .initial = d, RANGE(0, 1, ""), .help = h },
#define ENUM(s, n, d, h, w)                                                                                  \
    { AT(s, n), .kind = KD_FIELD_ENUM, .initial = d, RANGE(0, 0, ""), .help = h, .words = w },

#define ROWS(name, LIST, help) LIST(REAL, WORD, INT, BOOL, ENUM)
const struct kd_field kd_fields[KD_FIELD_COUNT] = { KD_SCENE_SECTIONS(ROWS) };

/* Each section's row before the first: an enumerator that counts on from the section above. */
#define EXTENT(name, LIST, help)                                                                             \
    FIRST_##name, LAST_##name = FIRST_##name - 1 + (KD_COUNT_ROWS(name, LIST, help)),
enum { KD_SCENE_SECTIONS(EXTENT) };
#define SECTION(name, LIST, help) { SECTION_NAME(name), help, FIRST_##name, LAST_##name - FIRST_##name + 1 },
const struct kd_section kd_sections[KD_SECTION_COUNT] = { KD_SCENE_SECTIONS(SECTION) };

/* A section that scene.h holds and KD_SCENE_SECTIONS does not, or the reverse, stops the build here. */
#define MIRROR(name, LIST, help)                                                                             \
    struct {                                                                                                 \
        KD_M(LIST)                                                                                           \
    } name;
struct mirror {
    KD_SCENE_SECTIONS(MIRROR)
};
#define SAME_PLACE(name, LIST, help)                                                                         \
    _Static_assert(offsetof(struct mirror, name) == offsetof(struct kd_scene, name), "sections of scene.h");
KD_SCENE_SECTIONS(SAME_PLACE)
_Static_assert(sizeof(struct mirror) == sizeof(struct kd_scene), "sections of scene.h");

const struct kd_section *kd_section_find(const char *section)
{
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (!strcmp(kd_sections[i].name, section))
            return &kd_sections[i];
    return NULL;
}

const struct kd_field *kd_field_find(const char *section, const char *name)
{
    for (size_t i = 0; i < KD_FIELD_COUNT; i++)
        if (!strcmp(kd_fields[i].section, section) && !strcmp(kd_fields[i].name, name))
            return &kd_fields[i];
    return NULL;
}

double kd_field_get(const struct kd_scene *scene, const struct kd_field *field)
{
    const void *at = (const char *)scene + field->offset;
    switch (field->kind) {
    case KD_FIELD_REAL:
    case KD_FIELD_WORD: return *(const double *)at;
    case KD_FIELD_INT:
    case KD_FIELD_ENUM: return *(const int32_t *)at;
    case KD_FIELD_BOOL: return *(const bool *)at;
    }
    return NAN;
}

void kd_field_put(struct kd_scene *scene, const struct kd_field *field, double value)
{
    void *at = (char *)scene + field->offset;
    switch (field->kind) {
    case KD_FIELD_REAL:
    case KD_FIELD_WORD: *(double *)at = value == 0 ? 0 : value; break; /* no -0: equal scenes, equal text */
    case KD_FIELD_INT:
    case KD_FIELD_ENUM: *(int32_t *)at = (int32_t)value; break;
    case KD_FIELD_BOOL: *(bool *)at = value != 0; break;
    }
}

bool kd_field_holds(const struct kd_field *field, double value)
{
    bool in_range = value >= field->minimum && value <= field->maximum;
    switch (field->kind) {
    case KD_FIELD_REAL: return in_range;
    case KD_FIELD_WORD: return in_range || value == INFINITY;
    case KD_FIELD_INT:
    case KD_FIELD_BOOL: return in_range && value == floor(value);
    case KD_FIELD_ENUM: return value >= 0 && value < kd_field_word_count(field) && value == floor(value);
    }
    return false;
}

int kd_field_word_count(const struct kd_field *field)
{
    int count = 1;
    for (const char *c = field->words; *c; c++)
        count += *c == '|';
    return count;
}

struct kd_word kd_field_word(const struct kd_field *field, int index)
{
    const char *text = field->words;
    for (; index > 0; index--)
        text = strchr(text, '|') + 1;
    return (struct kd_word) { text, (int)strcspn(text, "|") };
}

int kd_field_word_index(const struct kd_field *field, const char *text)
{
    for (int i = 0; i < kd_field_word_count(field); i++) {
        struct kd_word word = kd_field_word(field, i);
        if (strlen(text) == (size_t)word.length && !memcmp(text, word.text, (size_t)word.length))
            return i;
    }
    return -1;
}

void kd_field_path(const struct kd_field *field, char out[KD_PATH_SIZE])
{
    snprintf(out, KD_PATH_SIZE, "%s%s%s", field->section, *field->section ? "." : "", field->name);
}

void kd_field_pointer(const struct kd_field *field, char out[KD_PATH_SIZE])
{
    snprintf(out, KD_PATH_SIZE, "%s%s/%s", *field->section ? "/" : "", field->section, field->name);
}

void kd_scene_defaults(struct kd_scene *scene)
{
    /* Padding too, so that equal scenes are equal bytes. */
    memset(scene, 0, sizeof *scene);
    for (size_t i = 0; i < KD_FIELD_COUNT; i++)
        kd_field_put(scene, &kd_fields[i], kd_fields[i].initial);
}

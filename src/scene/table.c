#include "scene/table.h"

#include <stdio.h>
#include <string.h>

/* Names of sections: "" for "top", whose members belong to the document itself, and "disk.gas" for a nested section. */
#define PART_NAME(s, part, whole) offsetof(struct kd_scene, s) == offsetof(struct kd_scene, part) ? #whole "." #part:
#define SECTION_NAME(s) \
    (KD_SCENE_PARTS(PART_NAME, s) offsetof(struct kd_scene, s) == offsetof(struct kd_scene, top) ? "" : #s)

/* These hold, for each section, the type of its rows, their offset in the scene, and the distance from one list element
 * to the next. */
#define PLACE(name, ROWS, group, help) \
    struct rows_of_##name { KD_M_ROWS(ROWS) }; \
    enum { BASE_##name = offsetof(struct kd_scene, name), STRIDE_##name = 0 };
#define LIST_PLACE(name, element, ROWS, group, most, help) \
    struct rows_of_##name { KD_M_ROWS(ROWS) }; \
    enum { BASE_##name = offsetof(struct kd_scene, name.at), STRIDE_##name = sizeof(struct kd_##element) };
KD_SCENE_SECTIONS(PLACE, LIST_PLACE)

const struct kd_nature kd_natures[KD_NATURE_COUNT] = {
    [KD_FIELD_PHYSICS] = { "physics", "an exact consequence of general relativity or radiative transfer, or the "
                                      "accuracy of its computation" },
    [KD_FIELD_MODEL] = { "model", "a chosen model of matter or of a source, or a parameter of one" },
    [KD_FIELD_LOOK] = { "look", "changes the picture, not the physics" },
};
const char *const kd_groups[KD_GROUP_COUNT] = {
    [KD_GROUP_LOOK] = "look",     [KD_GROUP_GAS] = "gas",   [KD_GROUP_HOLE] = "hole",
    [KD_GROUP_CAMERA] = "camera", [KD_GROUP_MORE] = "more",
};

#define AT(s, n, nature_, place_) \
    .section = SECTION_NAME(s), .name = #n, .offset = BASE_##s + offsetof(struct rows_of_##s, n), \
    .stride = STRIDE_##s, .nature = KD_FIELD_##nature_, .place = KD_FIELD_##place_
#define RANGE(lo, hi, u) .minimum = lo, .maximum = hi, .unit = u

#define REAL(s, n, of, at, d, lo, hi, u, h) \
    { AT(s, n, of, at), .kind = KD_FIELD_REAL, .initial = d, RANGE(lo, hi, u), .help = h },
#define WORD(s, n, of, at, d, lo, hi, u, h, w) \
    { AT(s, n, of, at), .kind = KD_FIELD_WORD, .initial = d, RANGE(lo, hi, u), .help = h, .words = w },
#define INT(s, n, of, at, d, lo, hi, u, h, ...) \
    { AT(s, n, of, at), .kind = KD_FIELD_INT, \
      .initial = d,     RANGE(lo, hi, u), \
      .help = h,        __VA_OPT__(.words = __VA_ARGS__) },
#define BOOL(s, n, of, at, d, h) { AT(s, n, of, at), .kind = KD_FIELD_BOOL, .initial = d, RANGE(0, 1, ""), .help = h },
#define ENUM(s, n, of, at, d, h, w) \
    { AT(s, n, of, at), .kind = KD_FIELD_ENUM, .initial = d, RANGE(0, 0, ""), .help = h, .words = w },
#define ASSET(s, n, of, at, h) { AT(s, n, of, at), .kind = KD_FIELD_ASSET, RANGE(0, 1, ""), .help = h },
#define WORDS(s, n, of, at, h, w) { AT(s, n, of, at), .kind = KD_FIELD_WORDS, RANGE(0, 0, ""), .help = h, .words = w },

#define FIELDS(name, ROWS, group, help) ROWS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS)
#define LIST_FIELDS(name, element, ROWS, group, most, help) FIELDS(name, ROWS, group, help)
const struct kd_field kd_fields[KD_FIELD_COUNT] = { KD_SCENE_SECTIONS(FIELDS, LIST_FIELDS) };

/* Enumerators that count rows across sections: FIRST_ is the section's first row. */
#define EXTENT(name, ROWS, group, help) \
    FIRST_##name, LAST_##name = FIRST_##name - 1 + (KD_COUNT_ROWS(name, ROWS, group, help)),
#define LIST_EXTENT(name, element, ROWS, group, most, help) EXTENT(name, ROWS, group, help)
enum { KD_SCENE_SECTIONS(EXTENT, LIST_EXTENT) };
#define SECTION(n, ROWS, g, h) \
    { .name = SECTION_NAME(n), \
      .help = h, \
      .group = KD_GROUP_##g, \
      .first = FIRST_##n, \
      .count = LAST_##n - FIRST_##n + 1 },
#define LIST(n, element, ROWS, g, limit, h) \
    { .name = #n, \
      .help = h, \
      .group = KD_GROUP_##g, \
      .first = FIRST_##n, \
      .count = LAST_##n - FIRST_##n + 1, \
      .most = limit, \
      .size_at = offsetof(struct kd_scene, n.count) },
const struct kd_section kd_sections[KD_SECTION_COUNT] = { KD_SCENE_SECTIONS(SECTION, LIST) };

#define OLD(n, list, i) { .name = #n, .section = #list, .index = i },
const struct kd_old_name kd_old_names[KD_OLD_NAME_COUNT] = { KD_SCENE_OLD_NAMES(OLD) };

const struct kd_section *kd_section_find(const char *section)
{
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (!strcmp(kd_sections[i].name, section))
            return &kd_sections[i];
    return NULL;
}

const struct kd_section *kd_section_part(const struct kd_section *section, const char *name)
{
    char path[KD_PATH_SIZE];
    int length = snprintf(path, sizeof path, "%s.%s", section->name, name);
    return !*section->name || length >= KD_PATH_SIZE ? NULL : kd_section_find(path);
}

bool kd_section_is_part(const struct kd_section *section, const struct kd_section *whole)
{
    size_t length = strlen(whole->name);
    return length && !strncmp(section->name, whole->name, length) && section->name[length] == '.';
}

const char *kd_section_member(const struct kd_section *section)
{
    const char *dot = strrchr(section->name, '.');
    return dot ? dot + 1 : section->name;
}

void kd_section_pointer(const struct kd_section *section, char out[KD_PATH_SIZE])
{
    snprintf(out, KD_PATH_SIZE, "%s%.*s", *section->name ? "/" : "", KD_PATH_SIZE - 2, section->name);
    for (char *c = out; *c; c++)
        *c = *c == '.' ? '/' : *c;
}

const struct kd_field *kd_field_find(const char *section, const char *name)
{
    for (size_t i = 0; i < KD_FIELD_COUNT; i++)
        if (!strcmp(kd_fields[i].section, section) && !strcmp(kd_fields[i].name, name))
            return &kd_fields[i];
    return NULL;
}

const struct kd_old_name *kd_old_name_find(const char *name)
{
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
        if (!strcmp(kd_old_names[i].name, name))
            return &kd_old_names[i];
    return NULL;
}

static size_t *size_of(struct kd_scene *scene, const struct kd_section *section)
{
    return (size_t *)(void *)((char *)scene + section->size_at);
}

size_t kd_section_size(const struct kd_scene *scene, const struct kd_section *section)
{
    return section->most ? *(const size_t *)(const void *)((const char *)scene + section->size_at) : 1;
}

void kd_section_reset(struct kd_scene *scene, const struct kd_section *section, size_t index)
{
    for (size_t i = 0; i < section->count; i++)
        kd_field_put(scene, &kd_fields[section->first + i], index, kd_fields[section->first + i].initial);
}

void kd_section_resize(struct kd_scene *scene, const struct kd_section *section, size_t size)
{
    size_t old = *size_of(scene, section);
    for (size_t i = old < size ? old : size; i < section->most; i++)
        kd_section_reset(scene, section, i);
    *size_of(scene, section) = size;
}

static bool is_initial(const struct kd_scene *scene, const struct kd_section *section, size_t index)
{
    for (size_t i = 0; i < section->count; i++)
        if (kd_field_get(scene, &kd_fields[section->first + i], index) != kd_fields[section->first + i].initial)
            return false;
    return true;
}

void kd_section_trim(struct kd_scene *scene, const struct kd_section *list, size_t least)
{
    size_t size = kd_section_size(scene, list);
    while (size > least && is_initial(scene, list, size - 1))
        size--;
    kd_section_resize(scene, list, size);
}

static double alone(const struct kd_words *words)
{
    return words->count == 1 && words->at[0].number < 0 ? words->at[0].word : NAN;
}

double kd_field_get(const struct kd_scene *scene, const struct kd_field *field, size_t index)
{
    const void *at = (const char *)scene + field->offset + index * field->stride;
    switch (field->kind) {
    case KD_FIELD_REAL:
    case KD_FIELD_WORD: return *(const double *)at;
    case KD_FIELD_INT:
        if (field->words && !*(const int32_t *)at)
            return INFINITY;
        /* fall through */
    case KD_FIELD_ENUM: return *(const int32_t *)at;
    case KD_FIELD_BOOL: return *(const bool *)at;
    case KD_FIELD_ASSET: return *(const char *)at != 0;
    case KD_FIELD_WORDS: return alone(at);
    }
    return NAN;
}

void kd_field_put(struct kd_scene *scene, const struct kd_field *field, size_t index, double value)
{
    void *at = (char *)scene + field->offset + index * field->stride;
    switch (field->kind) {
    case KD_FIELD_REAL:
    case KD_FIELD_WORD: *(double *)at = value == 0 ? 0 : value; break; /* no -0, so that equal scenes give equal text */
    case KD_FIELD_INT:
    case KD_FIELD_ENUM: *(int32_t *)at = isinf(value) ? 0 : (int32_t)value; break;
    case KD_FIELD_BOOL: *(bool *)at = value != 0; break;
    case KD_FIELD_ASSET:
        if (value == 0)
            memset(at, 0, KD_ASSET_NAME);
        break;
    case KD_FIELD_WORDS: *(struct kd_words *)at = (struct kd_words) { 1, { { (int16_t)value, -1 } } }; break;
    }
}

const char *kd_field_asset(const struct kd_scene *scene, const struct kd_field *field, size_t index)
{
    return (const char *)scene + field->offset + index * field->stride;
}

/* All bytes after the name are set to 0, so that equal scenes have equal bytes. */
void kd_field_put_asset(struct kd_scene *scene, const struct kd_field *field, size_t index, const char *text)
{
    char *at = (char *)scene + field->offset + index * field->stride;
    size_t length = strnlen(text, KD_ASSET_NAME - 1);
    memset(at, 0, KD_ASSET_NAME);
    memcpy(at, text, length);
}

const struct kd_words *kd_field_words(const struct kd_scene *scene, const struct kd_field *field, size_t index)
{
    return (const void *)((const char *)scene + field->offset + index * field->stride);
}

void kd_field_put_words(struct kd_scene *scene, const struct kd_field *field, size_t index,
                        const struct kd_words *words)
{
    memcpy((char *)scene + field->offset + index * field->stride, words, sizeof *words);
}

bool kd_field_holds(const struct kd_field *field, double value)
{
    bool in_range = value >= field->minimum && value <= field->maximum;
    switch (field->kind) {
    case KD_FIELD_REAL: return in_range;
    case KD_FIELD_WORD: return in_range || value == INFINITY;
    case KD_FIELD_INT:
        if (field->words && value == INFINITY)
            return true;
        /* fall through */
    case KD_FIELD_BOOL:
    case KD_FIELD_ASSET: return in_range && value == floor(value);
    case KD_FIELD_ENUM:
    case KD_FIELD_WORDS: return value >= 0 && value < kd_field_word_count(field) && value == floor(value);
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

/* Writes a field's section, list index and name, with `mark` between them. */
static void spell(const struct kd_field *field, size_t index, const char *mark, char out[KD_PATH_SIZE])
{
    char element[24] = "";
    if (field->stride)
        snprintf(element, sizeof element, "%s%zu", mark, index);
    snprintf(out, KD_PATH_SIZE, "%s%s%s%s", field->section, element, *field->section ? mark : "", field->name);
}

void kd_field_path(const struct kd_field *field, size_t index, char out[KD_PATH_SIZE])
{
    spell(field, index, ".", out);
}

void kd_field_pointer(const struct kd_field *field, size_t index, char out[KD_PATH_SIZE])
{
    char path[KD_PATH_SIZE];
    spell(field, index, "/", path);
    snprintf(out, KD_PATH_SIZE, "/%.*s", KD_PATH_SIZE - 2, path);
    for (char *c = out; *c; c++)
        *c = *c == '.' ? '/' : *c; /* the separator of nested sections */
}

void kd_scene_defaults(struct kd_scene *scene)
{
    /* This also clears the padding, so that equal scenes have equal bytes. */
    memset(scene, 0, sizeof *scene);
    for (size_t s = 0; s < KD_SECTION_COUNT; s++)
        for (size_t i = 0; i < (kd_sections[s].most ? kd_sections[s].most : 1); i++)
            kd_section_reset(scene, &kd_sections[s], i);
}

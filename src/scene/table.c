#include "scene/table.h"

#include <stdio.h>
#include <string.h>

/* Names of sections: "" for "top", whose members belong to the document itself; "disk.gas" for a nested section. */
#define PART_NAME(s, part, whole) offsetof(struct kd_scene, s) == offsetof(struct kd_scene, part) ? #whole "." #part:
#define SECTION_NAME(s) \
    (KD_SCENE_PARTS(PART_NAME, s) offsetof(struct kd_scene, s) == offsetof(struct kd_scene, top) ? "" : #s)

/* For each section: the type of its rows, and the offset of its struct in the scene. */
#define PLACE(name, ROWS, group, help) \
    struct rows_of_##name { KD_M_ROWS(ROWS) }; \
    enum { BASE_##name = offsetof(struct kd_scene, name) };
#define LIST_PLACE(name, element, ROWS, group, most, help) \
    struct rows_of_##name { KD_M_ROWS(ROWS) }; \
    enum { BASE_##name = offsetof(struct kd_scene, name.at) };
KD_SCENE_SECTIONS(PLACE, LIST_PLACE)

const struct kd_nature kd_natures[KD_NATURE_COUNT] = {
    [KD_FIELD_PHYSICS] = { "physics", "an exact consequence of general relativity or radiative transfer, or the "
                                      "accuracy of its computation" },
    [KD_FIELD_MODEL] = { "model", "a chosen model of matter or of a source, or a parameter of one" },
    [KD_FIELD_LOOK] = { "look", "a choice of presentation, which changes the picture but not the physics" },
};
const char *const kd_groups[KD_GROUP_COUNT] = {
    [KD_GROUP_LOOK] = "look",     [KD_GROUP_GAS] = "gas",   [KD_GROUP_HOLE] = "hole",
    [KD_GROUP_CAMERA] = "camera", [KD_GROUP_MORE] = "more",
};

#define ROW(s, n) .object = SECTION_NAME(s), .name = #n, .offset = BASE_##s + offsetof(struct rows_of_##s, n)
#define RANGE(d, lo, hi, u) .initial = d, .least = lo, .most = hi, .unit = u

#define REAL(s, n, of, at, d, lo, hi, u, h) { ROW(s, n), .kind = KD_KIND_REAL, RANGE(d, lo, hi, u), .help = h },
#define WORD(s, n, of, at, d, lo, hi, u, h, w) \
    { ROW(s, n), .kind = KD_KIND_REAL, RANGE(d, lo, hi, u), .help = h, .words = w, .stands = INFINITY },
#define INT(s, n, of, at, d, lo, hi, u, h, ...) \
    { ROW(s, n), .kind = KD_KIND_INT, RANGE(d, lo, hi, u), .help = h, __VA_OPT__(.words = __VA_ARGS__) },
#define BOOL(s, n, of, at, d, h) { ROW(s, n), .kind = KD_KIND_BOOL, RANGE(d, 0, 1, ""), .help = h },
#define ENUM(s, n, of, at, d, h, w) { ROW(s, n), .kind = KD_KIND_WORD, RANGE(d, 0, 0, ""), .help = h, .words = w },
#define ASSET(s, n, of, at, h) { ROW(s, n), .kind = KD_KIND_ASSET, RANGE(0, 0, 1, ""), .help = h },
#define WORDS(s, n, of, at, h, w) { ROW(s, n), .kind = KD_KIND_SERIES, RANGE(0, 0, 0, ""), .help = h, .words = w },

#define FIELDS(name, ROWS, group, help) ROWS(REAL, WORD, INT, BOOL, ENUM, ASSET, WORDS)
#define LIST_FIELDS(name, element, ROWS, group, most, help) FIELDS(name, ROWS, group, help)
const struct kd_row kd_fields[KD_FIELD_COUNT] = { KD_SCENE_SECTIONS(FIELDS, LIST_FIELDS) };

#define PAGE(s, n, of, at, ...) { KD_FIELD_##of, KD_FIELD_##at },
#define PAGES(name, ROWS, group, help) ROWS(PAGE, PAGE, PAGE, PAGE, PAGE, PAGE, PAGE)
#define LIST_PAGES(name, element, ROWS, group, most, help) PAGES(name, ROWS, group, help)
const struct kd_field_page kd_field_pages[KD_FIELD_COUNT] = { KD_SCENE_SECTIONS(PAGES, LIST_PAGES) };

/* Enumerators that count rows over all sections: FIRST_ is the first row of a section. */
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
      .most = limit },
const struct kd_section kd_sections[KD_SECTION_COUNT] = { KD_SCENE_SECTIONS(SECTION, LIST) };

#define NO_LIST(n, ROWS, g, h)
#define ONE_LIST(n, element, ROWS, g, limit, h) \
    { #n, limit, sizeof(struct kd_##element), offsetof(struct kd_scene, n.count) },
static const struct kd_list lists[] = { KD_SCENE_SECTIONS(NO_LIST, ONE_LIST) { NULL, 0, 0, 0 } };

#define OLD(n, list, i) { .name = #n, .object = #list, .index = i },
const struct kd_former kd_old_names[KD_OLD_NAME_COUNT] = { KD_SCENE_OLD_NAMES(OLD) };

const struct kd_document kd_scene_document = {
    .rows = kd_fields,
    .n = KD_FIELD_COUNT,
    .others = "version",
    .lists = lists,
    .n_lists = sizeof lists / sizeof *lists - 1,
    .formers = kd_old_names,
    .n_formers = KD_OLD_NAME_COUNT,
    .paths = true,
};

const struct kd_section *kd_section_find(const char *section)
{
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (!strcmp(kd_sections[i].name, section))
            return &kd_sections[i];
    return NULL;
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

const struct kd_row *kd_field_find(const char *section, const char *name)
{
    for (size_t i = 0; i < KD_FIELD_COUNT; i++)
        if (!strcmp(kd_fields[i].object, section) && !strcmp(kd_fields[i].name, name))
            return &kd_fields[i];
    return NULL;
}

size_t kd_section_size(const struct kd_scene *scene, const struct kd_section *section)
{
    return section->most ? kd_list_size(kd_document_list(&kd_scene_document, section->name), scene) : 1;
}

void kd_section_resize(struct kd_scene *scene, const struct kd_section *section, size_t size)
{
    kd_list_resize(&kd_scene_document, kd_document_list(&kd_scene_document, section->name), scene, size);
}

static size_t offset_of(const struct kd_row *field, size_t index)
{
    return index ? index * kd_document_list(&kd_scene_document, field->object)->stride : 0;
}

const void *kd_field_in(const struct kd_scene *scene, const struct kd_row *field, size_t index)
{
    return (const char *)scene + offset_of(field, index);
}

double kd_field_get(const struct kd_scene *scene, const struct kd_row *field, size_t index)
{
    return kd_row_get(field, kd_field_in(scene, field, index));
}

void kd_field_put(struct kd_scene *scene, const struct kd_row *field, size_t index, double value)
{
    kd_row_put_number(field, (char *)scene + offset_of(field, index), value);
}

enum kd_status kd_field_store(struct kd_scene *scene, const struct kd_row *field, size_t index,
                              const struct kd_value *value, struct kd_error *error)
{
    char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
    if (kd_row_take(field, (char *)scene + offset_of(field, index), value))
        return KD_OK;
    kd_field_path(field, index, path);
    kd_field_pointer(field, index, pointer);
    return kd_row_refuse(field, value, path, pointer, error);
}

const char *kd_field_asset(const struct kd_scene *scene, const struct kd_row *field, size_t index)
{
    return (const char *)kd_field_in(scene, field, index) + field->offset;
}

bool kd_field_is_sound(const struct kd_scene *scene, const struct kd_row *field, size_t index)
{
    const void *in = kd_field_in(scene, field, index);
    const char *at = (const char *)in + field->offset;
    return field->kind == KD_KIND_SERIES  ? kd_words_hold(field->words, (const void *)at)
           : field->kind == KD_KIND_ASSET ? !*at || kd_asset_is_hash(at)
                                          : kd_row_holds(field, kd_row_get(field, in));
}

enum kd_status kd_scene_version(const struct kd_value *value, struct kd_error *error)
{
    if (value->kind == KD_VALUE_NUMBER && value->number == KD_SCENE_VERSION)
        return KD_OK;
    char given[KD_VALUE_SIZE];
    kd_value_describe(value, given);
    return kd_error_field(error, "/version", "version is %s; it must be %d", given, KD_SCENE_VERSION);
}

/* Writes section, list index and name of a field, with `mark` between them. */
static void spell(const struct kd_row *field, size_t index, const char *mark, char out[KD_PATH_SIZE])
{
    char element[24] = "";
    if (kd_section_find(field->object)->most)
        snprintf(element, sizeof element, "%s%zu", mark, index);
    snprintf(out, KD_PATH_SIZE, "%s%s%s%s", field->object, element, *field->object ? mark : "", field->name);
}

void kd_field_path(const struct kd_row *field, size_t index, char out[KD_PATH_SIZE]) { spell(field, index, ".", out); }

void kd_field_pointer(const struct kd_row *field, size_t index, char out[KD_PATH_SIZE])
{
    char path[KD_PATH_SIZE];
    spell(field, index, "/", path);
    snprintf(out, KD_PATH_SIZE, "/%.*s", KD_PATH_SIZE - 2, path);
    for (char *c = out; *c; c++)
        *c = *c == '.' ? '/' : *c; /* a dot in the name of a nested section becomes a slash */
}

void kd_scene_defaults(struct kd_scene *scene)
{
    /* This also clears the padding, so that equal scenes have equal bytes. */
    memset(scene, 0, sizeof *scene);
    kd_document_defaults(&kd_scene_document, scene);
}

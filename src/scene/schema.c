/* Writes the JSON Schema of the scene document from the table of fields. */
#include "scene/control.h"
#include "scene/rules.h"
#include "scene/style.h"

#include <stdio.h>
#include <string.h>

/* Writes those rules of a field that a schema can express. */
static void add_rules(struct kd_json *json, const struct kd_row *field)
{
    for (size_t i = 0; i < kd_rule_count; i++) {
        const struct kd_rule *rule = &kd_rules[i];
        if (!rule->name || strcmp(rule->section, field->object) || strcmp(rule->name, field->name))
            continue;
        if (rule->multiple)
            kd_json_number(json, "multipleOf", rule->multiple);
        if (rule->above_0 > 0) {
            kd_json_object(json, "not");
            kd_json_number(json, "exclusiveMinimum", 0);
            kd_json_number(json, "exclusiveMaximum", rule->above_0);
            kd_json_end(json);
        }
    }
}

static void add_group(struct kd_json *json, const struct kd_section *section)
{
    kd_json_string(json, "x-group", kd_groups[section->group]);
}

/* Writes, for each style, the fields that it sets, by path. */
static void add_styles(struct kd_json *json, const struct kd_row *names)
{
    kd_json_object(json, "x-sets");
    for (int style = 0; style < KD_STYLES; style++) {
        char word[KD_WORD_ROOM];
        kd_word_at(names->words, style + 1, word);
        kd_json_object(json, word);
        for (size_t i = 0; i < kd_style_row_count; i++) {
            const struct kd_style_row *row = &kd_style_rows[i];
            const struct kd_row *field = kd_field_find(row->section, row->name);
            char path[KD_PATH_SIZE];
            kd_field_path(field, 0, path);
            if (!isnan(row->values[style]))
                kd_row_write_value(json, path, field, row->values[style]);
        }
        kd_json_end(json);
    }
    kd_json_end(json);
}

/* Writes the value of a control's entry, or an array if there are several. */
static void add_with(struct kd_json *json, const struct kd_row *field, const struct kd_control *control)
{
    const struct kd_row *other = kd_field_find(field->object, control->text);
    const bool several = kd_control_next(field, control);
    kd_json_object(json, "x-with");
    if (several)
        kd_json_array(json, control->text);
    for (const struct kd_control *c = control; c; c = kd_control_next(field, c))
        kd_row_write_value(json, several ? NULL : control->text, other, c->a);
    if (several)
        kd_json_end(json);
    kd_json_end(json);
}

static void add_control(struct kd_json *json, const struct kd_row *field, const struct kd_control *control)
{
    char word[KD_WORD_ROOM];
    switch (control->kind) {
    case KD_CONTROL_SPAN:
        kd_json_array(json, "x-span");
        kd_json_number(json, NULL, control->a);
        kd_json_number(json, NULL, control->b);
        kd_json_end(json);
        return;
    case KD_CONTROL_FIRST: kd_row_write_value(json, "x-first", field, control->a); return;
    case KD_CONTROL_SWITCH: kd_json_bool(json, "x-switch", true); return;
    case KD_CONTROL_WITH: add_with(json, field, control); return;
    case KD_CONTROL_VARIES:
        kd_json_array(json, "x-varies");
        for (int i = 0; kd_word_at(control->text, i, word); i++)
            kd_json_string(json, NULL, word);
        kd_json_end(json);
        return;
    case KD_CONTROL_BUTTON:
        kd_json_object(json, "x-button");
        kd_json_string(json, "title", control->text);
        kd_row_write_value(json, "value", field, control->a);
        kd_json_end(json);
        return;
    }
}

static void add_field(struct kd_json *json, const struct kd_row *field)
{
    const struct kd_field_page *page = &kd_field_pages[field - kd_fields];
    kd_json_object(json, field->name);
    kd_row_type_members(json, field);
    add_rules(json, field);
    kd_row_write_value(json, "default", field, field->initial);
    kd_json_string(json, "description", field->help);
    kd_json_string(json, "x-nature", kd_natures[page->nature].word);
    if (field == kd_style_field())
        add_styles(json, field);
    if (page->place == KD_FIELD_FRONT)
        kd_json_bool(json, "x-front", true);
    for (int kind = KD_CONTROL_SPAN; kind <= KD_CONTROL_BUTTON; kind++) {
        const struct kd_control *control = kd_control_find(field, (enum kd_control_kind)kind);
        if (control)
            add_control(json, field, control);
    }
    if (!*field->object)
        add_group(json, kd_section_find(""));
    if (*field->unit && strcmp(field->unit, "1"))
        kd_json_string(json, "x-unit", field->unit);
    kd_json_end(json);
}

static void add_fields(struct kd_json *json, const struct kd_section *section)
{
    for (size_t i = 0; i < section->count; i++)
        add_field(json, &kd_fields[section->first + i]);
}

static void add_section(struct kd_json *json, const struct kd_section *section);

static void add_object(struct kd_json *json, const struct kd_section *section)
{
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    kd_json_object(json, "properties");
    add_fields(json, section);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (kd_section_is_part(&kd_sections[i], section))
            add_section(json, &kd_sections[i]);
    kd_json_end(json);
}

static void add_section(struct kd_json *json, const struct kd_section *section)
{
    kd_json_object(json, kd_section_member(section));
    kd_json_string(json, "description", section->help);
    add_group(json, section);
    if (section->most) {
        kd_json_string(json, "type", "array");
        kd_json_number(json, "maxItems", (double)section->most);
        kd_json_array(json, "default");
        kd_json_end(json);
        kd_json_object(json, "items");
    }
    add_object(json, section);
    if (section->most)
        kd_json_end(json);
    kd_json_end(json);
}

/* Writes the schema of an obsolete name. Its member x-now is the present path. */
static void add_old_name(struct kd_json *json, const struct kd_former *old)
{
    char now[KD_PATH_SIZE], description[KD_PATH_SIZE + 24];
    snprintf(now, sizeof now, "%s.%zu", old->object, old->index);
    snprintf(description, sizeof description, "an old name of %s", now);
    kd_json_object(json, old->name);
    kd_json_string(json, "description", description);
    kd_json_bool(json, "deprecated", true);
    kd_json_string(json, "x-now", now);
    add_object(json, kd_section_find(old->object));
    kd_json_end(json);
}

/* Writes the possible values of x-nature and x-group: the natures with their meanings, and the groups in the order
 * of the page. */
static void add_natures_and_groups(struct kd_json *json)
{
    kd_json_object(json, "x-natures");
    for (size_t i = 0; i < KD_NATURE_COUNT; i++)
        kd_json_string(json, kd_natures[i].word, kd_natures[i].help);
    kd_json_end(json);
    kd_json_array(json, "x-groups");
    for (size_t i = 0; i < KD_GROUP_COUNT; i++)
        kd_json_string(json, NULL, kd_groups[i]);
    kd_json_end(json);
}

/* Forbids documents that contain both an obsolete name and the list to which it refers. */
static void add_exclusions(struct kd_json *json)
{
    kd_json_object(json, "dependentSchemas");
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++) {
        kd_json_object(json, kd_old_names[i].name);
        kd_json_object(json, "not");
        kd_json_array(json, "required");
        kd_json_string(json, NULL, kd_old_names[i].object);
        kd_json_end(json);
        kd_json_end(json);
        kd_json_end(json);
    }
    kd_json_end(json);
}

#define DIGITS_OF(x) #x
#define DIGITS(x) DIGITS_OF(x)

enum kd_status kd_scene_schema(struct kd_buffer *out)
{
    struct kd_json writer = kd_scene_json(out), *json = &writer;
    kd_json_object(json, NULL);
    kd_json_string(json, "$schema", "https://json-schema.org/draft/2020-12/schema");
    kd_json_string(json, "title", "kerrd scene, version " DIGITS(KD_SCENE_VERSION));
    kd_json_string(json, "type", "object");
    kd_json_bool(json, "additionalProperties", false);
    add_natures_and_groups(json);
    kd_json_object(json, "properties");
    /* as "const" and as "enum", because client generators mishandle a number that is given only as "const" */
    kd_json_object(json, "version");
    kd_json_members(json,
                    "\"type\":\"integer\",\"enum\":[" DIGITS(KD_SCENE_VERSION) "],\"const\":" DIGITS(KD_SCENE_VERSION));
    kd_json_string(json, "description", "version of this document format");
    kd_json_end(json);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        if (!*kd_sections[i].name)
            add_fields(json, &kd_sections[i]);
        /* a nested section is skipped, because it is written as part of its parent */
        else if (!strchr(kd_sections[i].name, '.'))
            add_section(json, &kd_sections[i]);
    }
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
        add_old_name(json, &kd_old_names[i]);
    kd_json_end(json);
    add_exclusions(json);
    kd_json_end(json);
    return kd_json_finish(json);
}

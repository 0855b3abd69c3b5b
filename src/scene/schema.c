/* Writes the JSON Schema of the scene document. It is made from the table of fields. */
#include "scene/control.h"
#include "scene/rules.h"
#include "scene/style.h"
#include "scene/words.h"
#include "scene/writer.h"

#include <string.h>

static void write_range(struct kd_writer *w, const char *type, const struct kd_field *field)
{
    kd_write(w, "\"type\":\"%s\",\"minimum\":", type);
    kd_write_number(w, field->minimum);
    kd_write(w, ",\"maximum\":");
    kd_write_number(w, field->maximum);
}

static void write_multiple(struct kd_writer *w, const struct kd_field *field)
{
    for (size_t i = 0; i < kd_rule_count; i++)
        if (kd_rules[i].multiple && !strcmp(kd_rules[i].section, field->section) &&
            !strcmp(kd_rules[i].name, field->name))
            kd_write(w, ",\"multipleOf\":%d", kd_rules[i].multiple);
}

static void write_above_0(struct kd_writer *w, const struct kd_field *field)
{
    for (size_t i = 0; i < kd_rule_count; i++)
        if (kd_rules[i].above_0 > 0 && !strcmp(kd_rules[i].section, field->section) &&
            !strcmp(kd_rules[i].name, field->name)) {
            kd_write(w, ",\"not\":{\"exclusiveMinimum\":0,\"exclusiveMaximum\":");
            kd_write_number(w, kd_rules[i].above_0);
            kd_write(w, "}");
        }
}

static void write_words(struct kd_writer *w, const struct kd_field *field)
{
    kd_write(w, "\"type\":\"string\",\"enum\":[");
    for (int i = 0; i < kd_field_word_count(field); i++) {
        kd_write(w, "%s", i ? "," : "");
        kd_write_value(w, field, i);
    }
    kd_write(w, "]");
}

/* Writes alternatives of a pattern. numbered true: the words that may be followed by a number, as an open group; false:
 * the other words. */
static void write_pattern(struct kd_writer *w, const struct kd_field *field, bool numbered)
{
    const char *before = numbered ? "(" : "";
    for (int i = 0; i < kd_field_word_count(field); i++) {
        bool has;
        int length = kd_words_length(field, i, &has);
        if (has == numbered)
            kd_write(w, "%s%.*s", before, length, kd_field_word(field, i).text);
        before = has == numbered ? "|" : before;
    }
}

static void write_many(struct kd_writer *w, const struct kd_field *field)
{
    bool alone = false, numbered = false;
    for (int i = 0; i < kd_field_word_count(field); i++) {
        bool has;
        kd_words_length(field, i, &has);
        alone |= !has;
        numbered |= has;
    }
    kd_write(w,
             "\"type\":\"array\",\"minItems\":1,\"maxItems\":%d,\"uniqueItems\":true,\"items\":{\"type\":\"string\","
             "\"pattern\":\"^(",
             KD_WORDS_MOST);
    write_pattern(w, field, false);
    kd_write(w, "%s", alone && numbered ? "|" : "");
    if (numbered) {
        write_pattern(w, field, true);
        kd_write(w, ")(_(0|[1-9][0-9]?))?");
    }
    kd_write(w, ")$\"},\"x-words\":[");
    for (int i = 0; i < kd_field_word_count(field); i++)
        kd_write(w, "%s\"%.*s\"", i ? "," : "", kd_field_word(field, i).length, kd_field_word(field, i).text);
    kd_write(w, "]");
}

static void write_type(struct kd_writer *w, const struct kd_field *field)
{
    switch (field->kind) {
    case KD_FIELD_REAL:
        write_range(w, "number", field);
        write_above_0(w, field);
        return;
    case KD_FIELD_INT:
        if (field->words)
            break;
        write_range(w, "integer", field);
        write_multiple(w, field);
        return;
    case KD_FIELD_BOOL: kd_write(w, "\"type\":\"boolean\""); return;
    case KD_FIELD_ENUM: write_words(w, field); return;
    case KD_FIELD_WORD: break;
    case KD_FIELD_ASSET:
        kd_write(w, "\"anyOf\":[{\"type\":\"null\"},{\"type\":\"string\",\"pattern\":\"^(|[A-Za-z][A-Za-z0-9._-]{0,62}|"
                    "[0-9a-f]{64})$\"}]");
        return;
    case KD_FIELD_WORDS: write_many(w, field); return;
    }
    /* The word comes first, because client generators use the first type that fits a default, and "infinity" parses as
     * a number. It is also given as an enumeration. If it were only a const within a union, they would generate code
     * that accepts nothing else. */
    kd_write(w, "\"anyOf\":[{\"type\":\"string\",\"const\":");
    kd_write_string(w, field->words);
    kd_write(w, ",\"enum\":[");
    kd_write_string(w, field->words);
    kd_write(w, "]},{");
    write_range(w, field->kind == KD_FIELD_INT ? "integer" : "number", field);
    kd_write(w, "}]");
}

static void write_group(struct kd_writer *w, const struct kd_section *section)
{
    kd_write(w, ",\"x-group\":\"%s\"", kd_groups[section->group]);
}

/* Writes the fields that each style sets. They are named by path. */
static void write_styles(struct kd_writer *w, const struct kd_field *names)
{
    kd_write(w, ",\"x-sets\":{");
    for (int style = 0; style < KD_STYLES; style++) {
        const struct kd_word word = kd_field_word(names, style + 1);
        kd_write(w, "%s\"%.*s\":{", style ? "," : "", word.length, word.text);
        for (size_t i = 0, n = 0; i < kd_style_row_count; i++) {
            const struct kd_style_row *row = &kd_style_rows[i];
            if (isnan(row->values[style]))
                continue;
            kd_write(w, "%s\"%s.%s\":", n++ ? "," : "", row->section, row->name);
            kd_write_value(w, kd_field_find(row->section, row->name), row->values[style]);
        }
        kd_write(w, "}");
    }
    kd_write(w, "}");
}

/* Writes "a|b" as a JSON array of strings. */
static void write_list(struct kd_writer *w, const char *text)
{
    kd_write(w, "[");
    for (const char *at = text; at;) {
        int length = (int)strcspn(at, "|");
        kd_write(w, "%s\"%.*s\"", at == text ? "" : ",", length, at);
        at = at[length] ? at + length + 1 : NULL;
    }
    kd_write(w, "]");
}

/* Writes the value of a control, or an array if it has several. */
static void write_with(struct kd_writer *w, const struct kd_field *field, const struct kd_control *control)
{
    const struct kd_field *other = kd_field_find(field->section, control->text);
    const bool several = kd_control_next(field, control);
    kd_write(w, "{\"%s\":%s", control->text, several ? "[" : "");
    for (const struct kd_control *c = control; c; c = kd_control_next(field, c)) {
        kd_write(w, "%s", c == control ? "" : ",");
        kd_write_value(w, other, c->a);
    }
    kd_write(w, "%s}", several ? "]" : "");
}

static void write_control(struct kd_writer *w, const struct kd_field *field, const struct kd_control *control)
{
    static const char *const keys[] = {
        [KD_CONTROL_SPAN] = "span", [KD_CONTROL_FIRST] = "first",   [KD_CONTROL_SWITCH] = "switch",
        [KD_CONTROL_WITH] = "with", [KD_CONTROL_VARIES] = "varies", [KD_CONTROL_BUTTON] = "button",
    };
    kd_write(w, ",\"x-%s\":", keys[control->kind]);
    switch (control->kind) {
    case KD_CONTROL_SPAN:
        kd_write(w, "[");
        kd_write_number(w, control->a);
        kd_write(w, ",");
        kd_write_number(w, control->b);
        kd_write(w, "]");
        return;
    case KD_CONTROL_FIRST: kd_write_value(w, field, control->a); return;
    case KD_CONTROL_SWITCH: kd_write(w, "true"); return;
    case KD_CONTROL_WITH: write_with(w, field, control); return;
    case KD_CONTROL_VARIES: write_list(w, control->text); return;
    case KD_CONTROL_BUTTON:
        kd_write(w, "{\"title\":\"%s\",\"value\":", control->text);
        kd_write_value(w, field, control->a);
        kd_write(w, "}");
        return;
    }
}

static void write_controls(struct kd_writer *w, const struct kd_field *field)
{
    for (int kind = KD_CONTROL_SPAN; kind <= KD_CONTROL_BUTTON; kind++) {
        const struct kd_control *control = kd_control_find(field, (enum kd_control_kind)kind);
        if (control)
            write_control(w, field, control);
    }
}

static void write_field(struct kd_writer *w, const struct kd_field *field)
{
    kd_write(w, "\"%s\":{", field->name);
    write_type(w, field);
    kd_write(w, ",\"default\":");
    kd_write_value(w, field, field->initial);
    kd_write(w, ",\"description\":");
    kd_write_string(w, field->help);
    kd_write(w, ",\"x-nature\":\"%s\"", kd_natures[field->nature].word);
    if (field == kd_style_field())
        write_styles(w, field);
    if (field->place == KD_FIELD_FRONT)
        kd_write(w, ",\"x-front\":true");
    write_controls(w, field);
    if (!*field->section)
        write_group(w, kd_section_find(""));
    if (*field->unit && strcmp(field->unit, "1")) {
        kd_write(w, ",\"x-unit\":");
        kd_write_string(w, field->unit);
    }
    kd_write(w, "}");
}

static void write_fields(struct kd_writer *w, const struct kd_section *section)
{
    for (size_t i = 0; i < section->count; i++) {
        kd_write(w, "%s", i ? "," : "");
        write_field(w, &kd_fields[section->first + i]);
    }
}

static void write_section(struct kd_writer *w, const struct kd_section *section);

/* Writes the part of an object's schema that follows the description, and closes it. */
static void write_object(struct kd_writer *w, const struct kd_section *section)
{
    kd_write(w, "\"type\":\"object\",\"additionalProperties\":false,\"properties\":{");
    write_fields(w, section);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (kd_section_is_part(&kd_sections[i], section)) {
            kd_write(w, ",");
            write_section(w, &kd_sections[i]);
        }
    kd_write(w, "}}");
}

static void write_section(struct kd_writer *w, const struct kd_section *section)
{
    kd_write(w, "\"%s\":{\"description\":", kd_section_member(section));
    kd_write_string(w, section->help);
    write_group(w, section);
    kd_write(w, ",");
    if (section->most)
        kd_write(w, "\"type\":\"array\",\"maxItems\":%zu,\"default\":[],\"items\":{", section->most);
    write_object(w, section);
    if (section->most)
        kd_write(w, "}");
}

/* Writes the schema of an old name; x-now is the present path. */
static void write_old_name(struct kd_writer *w, const struct kd_old_name *old)
{
    kd_write(w, ",\"%s\":{\"description\":\"an old name of %s.%zu\",\"deprecated\":true,\"x-now\":\"%s.%zu\",",
             old->name, old->section, old->index, old->section, old->index);
    write_object(w, kd_section_find(old->section));
}

/* Writes the possible values of x-nature and x-group: natures with their meanings, groups in the order of the page. */
static void write_words_of_fields(struct kd_writer *w)
{
    kd_write(w, "\"x-natures\":{");
    for (size_t i = 0; i < KD_NATURE_COUNT; i++) {
        kd_write(w, "%s\"%s\":", i ? "," : "", kd_natures[i].word);
        kd_write_string(w, kd_natures[i].help);
    }
    kd_write(w, "},\"x-groups\":[");
    for (size_t i = 0; i < KD_GROUP_COUNT; i++)
        kd_write(w, "%s\"%s\"", i ? "," : "", kd_groups[i]);
    kd_write(w, "],");
}

enum kd_status kd_scene_schema(struct kd_buffer *out)
{
    struct kd_writer writer = { .out = out }, *w = &writer;
    kd_write(w,
             "{\"$schema\":\"https://json-schema.org/draft/2020-12/schema\",\"title\":\"kerrd scene, version %d\","
             "\"type\":\"object\",\"additionalProperties\":false,",
             KD_SCENE_VERSION);
    write_words_of_fields(w);
    kd_write(w,
             "\"properties\":{"
             "\"version\":{\"type\":\"integer\",\"enum\":[%d],\"const\":%d,\"description\":\"version of this document "
             "format\"}", /* both forms, because client generators mishandle a number that is given only as a const */
             KD_SCENE_VERSION, KD_SCENE_VERSION);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        if (strchr(kd_sections[i].name, '.')) /* a nested section is written with its parent */
            continue;
        kd_write(w, ",");
        if (*kd_sections[i].name)
            write_section(w, &kd_sections[i]);
        else
            write_fields(w, &kd_sections[i]);
    }
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
        write_old_name(w, &kd_old_names[i]);
    kd_write(w, "},\"dependentSchemas\":{");
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
        kd_write(w, "%s\"%s\":{\"not\":{\"required\":[\"%s\"]}}", i ? "," : "", kd_old_names[i].name,
                 kd_old_names[i].section);
    kd_write(w, "}}");
    return writer.status;
}

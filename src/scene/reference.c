/* Writes docs/scene.md from the table of fields. */
#include "scene/presets.h"
#include "scene/rules.h"
#include "scene/style.h"
#include "scene/table.h"
#include "document/writer.h"

#include <string.h>

static const char introduction[] =
    "# The scene document\n\nA scene describes in JSON what is rendered. Every field may be left out: `{}` is the "
    "default "
    "picture. This "
    "page is generated from\n`src/scene/fields.h`; do not edit it.\n\n    {\"version\": 1, \"spacetime\": {\"spin\": "
    "0.9}, \"camera\": {\"inclination_deg\": 70}, \"image\": {\"width\": 640}}\n\nA field also has a path, for the "
    "command line (`--set camera.inclination_deg=70`) and a link\n(`/v1/render?camera.inclination_deg=70`). Lengths "
    "and times are in M = GM/c^2. Ranges include both ends.\n\nA list is an array of objects with the same fields; a "
    "field that an object omits has its default. An array\nreplaces the whole list, both in a document over a preset "
    "and in a merge patch (RFC 7396). An object instead of the\narray changes elements by their index, and keeps the "
    "others:\n\n    {\"spots\": [{\"brightness\": 4}, {\"brightness\": 2, \"r\": 12}]}   two spots\n    {\"spots\": "
    "{\"1\": {\"r\": 14}}}                                the second spot moves\n\nThe index after the last element "
    "appends an element; a larger index is an error. On the command line and in a\nlink an element's field is "
    "`spots.1.r`. In a merge patch `null` resets a field, a section or an element to its\ndefaults, and empties a "
    "list.\n\nAn unknown field, a field given twice, a wrong type, `null` and a value outside its range are errors "
    "that point\nat the field. So are NaN, numbers that overflow, text after the document, nesting deeper than 32 "
    "levels and more\nthan 1 MiB.\n";

static void write_escaped(struct kd_writer *w, const char *text)
{
    for (const char *c = text; *c; c++)
        kd_write(w, *c == '|' ? "\\%c" : "%c", *c);
}

/* Writes a value in the form that it has in a document. */
static void write_value(struct kd_writer *w, const struct kd_row *field, double value)
{
    if (w->status)
        return;
    struct kd_buffer text = { 0 };
    struct kd_json json = kd_scene_json(&text);
    kd_row_write_value(&json, NULL, field, value);
    w->status = kd_json_finish(&json);
    kd_write(w, "%s", (const char *)text.data);
    kd_buffer_finish(&text);
}

static void write_field(struct kd_writer *w, const struct kd_row *field)
{
    static const char *const types[] = { [KD_KIND_REAL] = "number",        [KD_KIND_INT] = "whole number",
                                         [KD_KIND_BOOL] = "true or false", [KD_KIND_WORD] = "word",
                                         [KD_KIND_ASSET] = "asset",        [KD_KIND_SERIES] = "words" };
    const bool or_word = field->words && (field->kind == KD_KIND_REAL || field->kind == KD_KIND_INT);
    char allowed[KD_ALLOWED_SIZE];
    kd_row_allowed(field, allowed);
    kd_write(w, "| `%s%s%s%s` | %s | %s%s | `", field->object, *field->object ? "." : "",
             kd_section_find(field->object)->most ? "N." : "", field->name,
             kd_natures[kd_field_pages[field - kd_fields].nature].word, types[field->kind], or_word ? " or word" : "");
    write_value(w, field, field->initial);
    kd_write(w, "` | ");
    /* this part of the text is left out, because the type column already says "whole number" */
    const char *whole = "a whole number from ";
    write_escaped(w, strncmp(allowed, whole, strlen(whole)) ? allowed : allowed + strlen(whole));
    kd_write(w, " | ");
    write_escaped(w, field->help);
    kd_write(w, " |\n");
}

static void write_list(struct kd_writer *w, const struct kd_section *list)
{
    kd_write(w, "A list of at most %zu elements, by default `[]`; N counts from 0.", list->most);
    size_t names = 0;
    for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
        if (!strcmp(kd_old_names[i].object, list->name))
            kd_write(w, "%s`%s` is `%s.%zu`", names++ ? ", " : " Old names are still read: ", kd_old_names[i].name,
                     list->name, kd_old_names[i].index);
    kd_write(w, "%s\n\n", names ? "." : "");
}

static void write_section(struct kd_writer *w, const struct kd_section *section)
{
    const char *name = *section->name ? section->name : "the document itself";
    kd_write(w, "\n## %s\n\n", name);
    if (*section->name)
        kd_write(w, "%c%s.\n\n", section->help[0] - 'a' + 'A', section->help + 1);
    if (section->most)
        write_list(w, section);
    kd_write(w, "| field | nature | type | default | allowed | meaning |\n|---|---|---|---|---|---|\n");
    if (!*section->name)
        kd_write(w, "| `version` | | whole number | `%d` | %d | version of this document format |\n", KD_SCENE_VERSION,
                 KD_SCENE_VERSION);
    for (size_t i = 0; i < section->count; i++)
        write_field(w, &kd_fields[section->first + i]);
}

static void write_styles(struct kd_writer *w)
{
    const struct kd_row *names = kd_style_field();
    kd_write(w, "\n## Styles\n\nA document with `style.name` sets the fields of that style, except those in the "
                "document; so does a patch or a\nquery. On the command line the order of `--set` counts. The canonical "
                "form has every field, so that nothing else depends on the name.\n\n| field |");
    for (int style = 0; style < KD_STYLES; style++) {
        const struct kd_word word = kd_word(names->words, style + 1);
        kd_write(w, " `%.*s` |", word.length, word.text);
    }
    kd_write(w, "\n|---|");
    for (int style = 0; style < KD_STYLES; style++)
        kd_write(w, "---|");
    for (size_t i = 0; i < kd_style_row_count; i++) {
        const struct kd_style_row *row = &kd_style_rows[i];
        kd_write(w, "\n| `%s.%s` |", row->section, row->name);
        for (int style = 0; style < KD_STYLES; style++) {
            if (!isnan(row->values[style])) {
                kd_write(w, " `");
                write_value(w, kd_field_find(row->section, row->name), row->values[style]);
                kd_write(w, "`");
            }
            kd_write(w, " |");
        }
    }
    kd_write(w, "\n");
}

static void write_natures(struct kd_writer *w)
{
    kd_write(w, "\nEach field has a nature, which states what a change of the field changes:\n\n");
    for (size_t i = 0; i < KD_NATURE_COUNT; i++)
        kd_write(w, "- **%s**: %s.\n", kd_natures[i].word, kd_natures[i].help);
}

enum kd_status kd_scene_reference(struct kd_buffer *out)
{
    struct kd_writer writer = { .out = out }, *w = &writer;
    kd_write(w, "%s", introduction);
    write_natures(w);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        write_section(w, &kd_sections[i]);
    kd_write(w, "\n## Rules across fields\n\n");
    for (size_t i = 0; i < kd_rule_count; i++)
        kd_write(w, "- %s\n", kd_rules[i].text);
    if (kd_style_field())
        write_styles(w);
    kd_write(w, "\n## Presets\n\n");
    for (size_t i = 0; i < kd_preset_count; i++)
        kd_write(w, "- `%s` (%s): %s.\n  `%s`%s\n", kd_presets[i].name, kd_presets[i].label, kd_presets[i].title,
                 kd_presets[i].json, kd_presets[i].smooth ? " over `smooth`" : "");
    kd_write(
        w,
        "\n## Canonical form\n\n"
        "The canonical form has every field in the order of this page, `version` first, without spaces. Each number\n"
        "has the fewest digits that read back as the same double. The SHA-256 of this form is the hash of the "
        "scene.\n");
    return writer.status;
}

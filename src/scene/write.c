/* Writes scene documents as canonical JSON, and computes their hash. */
#include "scene/asset.h"
#include "document/number.h"
#include "scene/sha256.h"
#include "scene/words.h"
#include "scene/writer.h"

#include <stdio.h>
#include <string.h>

void kd_write_string(struct kd_writer *writer, const char *text)
{
    kd_write(writer, "\"");
    for (const char *c = text; *c; c++) {
        if (*c == '"' || *c == '\\')
            kd_write(writer, "\\%c", *c);
        else if ((unsigned char)*c < 0x20)
            kd_write(writer, "\\u%04x", (unsigned)*c);
        else
            kd_write(writer, "%c", *c);
    }
    kd_write(writer, "\"");
}

void kd_write_number(struct kd_writer *writer, double value)
{
    char number[KD_NUMBER_SIZE];
    kd_number_format(number, value == 0 ? 0 : value);
    kd_write(writer, "%s", number);
}

static void write_words(struct kd_writer *writer, const struct kd_field *field, const struct kd_words *words)
{
    if (!kd_words_hold(field, words)) {
        writer->status = writer->status ? writer->status : KD_EINVAL;
        return;
    }
    for (int i = 0; i < words->count; i++) {
        char word[KD_WORD_SIZE];
        kd_words_spell(field, words->at[i], word);
        kd_write(writer, "%s\"%s\"", i ? "," : "[", word);
    }
    kd_write(writer, "]");
}

void kd_write_value(struct kd_writer *writer, const struct kd_field *field, double value)
{
    struct kd_word word;
    if (!kd_field_holds(field, value)) {
        writer->status = writer->status ? writer->status : KD_EINVAL;
        return;
    }
    switch (field->kind) {
    case KD_FIELD_WORD:
    case KD_FIELD_INT:
        if (isinf(value)) {
            kd_write_string(writer, field->words);
            return;
        }
        /* fall through */
    case KD_FIELD_REAL: kd_write_number(writer, value); return;
    case KD_FIELD_BOOL: kd_write(writer, "%s", value != 0 ? "true" : "false"); return;
    case KD_FIELD_ENUM:
        word = kd_field_word(field, (int)value);
        kd_write(writer, "\"%.*s\"", word.length, word.text);
        return;
    case KD_FIELD_ASSET: kd_write(writer, "null"); return; /* an asset cannot be represented by one number */
    case KD_FIELD_WORDS: write_words(writer, field, &(struct kd_words) { 1, { { (int16_t)value, -1 } } }); return;
    }
}

void kd_write_field(struct kd_writer *writer, const struct kd_scene *scene, const struct kd_field *field, size_t index)
{
    if (field->kind == KD_FIELD_WORDS) {
        write_words(writer, field, kd_field_words(scene, field, index));
        return;
    }
    const char *asset = field->kind == KD_FIELD_ASSET ? kd_field_asset(scene, field, index) : "";
    if (!*asset) {
        kd_write_value(writer, field, kd_field_get(scene, field, index));
        return;
    }
    /* a name may stand for other content elsewhere, so it does not identify the content */
    if (!kd_asset_is_hash(asset))
        writer->status = writer->status ? writer->status : KD_EINVAL;
    kd_write_string(writer, asset);
}

static void write_fields(struct kd_writer *writer, const struct kd_section *section, size_t index,
                         const struct kd_scene *scene)
{
    for (size_t i = 0; i < section->count; i++) {
        const struct kd_field *field = &kd_fields[section->first + i];
        kd_write(writer, "%s\"%s\":", i ? "," : "", field->name);
        kd_write_field(writer, scene, field, index);
    }
}

static void write_parts(struct kd_writer *writer, const struct kd_section *section, const struct kd_scene *scene)
{
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        if (!kd_section_is_part(&kd_sections[i], section))
            continue;
        kd_write(writer, ",\"%s\":{", kd_section_member(&kd_sections[i]));
        write_fields(writer, &kd_sections[i], 0, scene);
        kd_write(writer, "}");
    }
}

static void write_section(struct kd_writer *writer, const struct kd_section *section, const struct kd_scene *scene)
{
    size_t size = kd_section_size(scene, section);
    if (section->most && size > section->most)
        writer->status = writer->status ? writer->status : KD_EINVAL;
    kd_write(writer, ",\"%s\":%s", section->name, section->most ? "[" : "");
    for (size_t i = 0; i < size && !writer->status; i++) {
        kd_write(writer, "%s{", i ? "," : "");
        write_fields(writer, section, i, scene);
        write_parts(writer, section, scene);
        kd_write(writer, "}");
    }
    kd_write(writer, "%s", section->most ? "]" : "");
}

enum kd_status kd_scene_to_json(const struct kd_scene *scene, struct kd_buffer *out)
{
    struct kd_writer writer = { .out = out };
    kd_write(&writer, "{\"version\":%d", KD_SCENE_VERSION);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        const struct kd_section *section = &kd_sections[i];
        if (strchr(section->name, '.')) /* a nested section is written with its parent */
            continue;
        if (*section->name) {
            write_section(&writer, section, scene);
            continue;
        }
        kd_write(&writer, ",");
        write_fields(&writer, section, 0, scene);
    }
    kd_write(&writer, "}");
    return writer.status;
}

enum kd_status kd_scene_hash(const struct kd_scene *scene, char hash[65])
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_scene_to_json(scene, &text);
    hash[0] = 0;
    if (!status)
        kd_sha256(text.data, text.size, hash);
    kd_buffer_finish(&text);
    return status;
}

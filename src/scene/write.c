/* Writes scene documents as canonical JSON, and computes their hash. */
#include "document/number.h"
#include "scene/sha256.h"
#include "scene/table.h"

#include <string.h>

struct kd_json kd_scene_json(struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    json.print = kd_number_format;
    return json;
}

static bool is_sound(const struct kd_scene *scene)
{
    bool sound = true;
    for (size_t s = 0; s < KD_SECTION_COUNT; s++) {
        const struct kd_section *section = &kd_sections[s];
        const size_t size = kd_section_size(scene, section);
        sound &= !section->most || size <= section->most;
        for (size_t i = 0; i < size && sound; i++)
            for (size_t f = 0; f < section->count && sound; f++)
                sound = kd_field_is_sound(scene, &kd_fields[section->first + f], i);
    }
    return sound;
}

static void write_object(struct kd_json *json, const struct kd_section *section, size_t index,
                         const struct kd_scene *scene)
{
    for (size_t i = 0; i < section->count; i++) {
        const struct kd_row *field = &kd_fields[section->first + i];
        kd_row_write(json, field, kd_field_in(scene, field, index));
    }
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        if (kd_section_is_part(&kd_sections[i], section)) {
            kd_json_object(json, kd_section_member(&kd_sections[i]));
            write_object(json, &kd_sections[i], 0, scene);
            kd_json_end(json);
        }
}

static void write_section(struct kd_json *json, const struct kd_section *section, const struct kd_scene *scene)
{
    if (section->most)
        kd_json_array(json, section->name);
    for (size_t i = 0; i < kd_section_size(scene, section); i++) {
        kd_json_object(json, section->most ? NULL : section->name);
        write_object(json, section, i, scene);
        kd_json_end(json);
    }
    if (section->most)
        kd_json_end(json);
}

enum kd_status kd_scene_to_json(const struct kd_scene *scene, struct kd_buffer *out)
{
    if (!is_sound(scene))
        return KD_EINVAL;
    struct kd_json json = kd_scene_json(out);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "version", KD_SCENE_VERSION);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++) {
        if (!*kd_sections[i].name)
            write_object(&json, &kd_sections[i], 0, scene);
        else if (!strchr(kd_sections[i].name, '.')) /* a nested section is written with its parent */
            write_section(&json, &kd_sections[i], scene);
    }
    kd_json_end(&json);
    return kd_json_finish(&json);
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

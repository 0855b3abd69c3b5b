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

enum kd_status kd_scene_to_json(const struct kd_scene *scene, struct kd_buffer *out)
{
    if (!is_sound(scene))
        return KD_EINVAL;
    struct kd_json json = kd_scene_json(out);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "version", KD_SCENE_VERSION);
    kd_document_write(&json, &kd_scene_document, scene);
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

/* Validates scenes: the range of every field, and all rules about several fields. */
#include "scene/asset.h"
#include "document/number.h"
#include "scene/rules.h"
#include "scene/table.h"

#include <string.h>

/* Checks that an asset is named by its hash. A name that was not replaced by a hash is an error. */
static enum kd_status asset(const struct kd_scene *scene, const struct kd_row *field, size_t index,
                            struct kd_error *error)
{
    char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
    const char *name = kd_field_asset(scene, field, index);
    if (!*name || kd_asset_is_hash(name))
        return KD_OK;
    kd_field_path(field, index, path);
    kd_field_pointer(field, index, pointer);
    return kd_error_field(error, pointer, "%s is \"%.64s\"; it must be a SHA-256, or the name of a known asset", path,
                          name);
}

/* Checks a field's range. The parser checks it too, but a caller may have filled in the scene without the parser. */
static enum kd_status range(const struct kd_scene *scene, const struct kd_row *field, size_t index,
                            struct kd_error *error)
{
    double value = kd_field_get(scene, field, index);
    if (field->kind == KD_KIND_ASSET)
        return asset(scene, field, index, error);
    if (kd_field_is_sound(scene, field, index))
        return KD_OK;
    char number[KD_NUMBER_SIZE], path[KD_PATH_SIZE], pointer[KD_PATH_SIZE], allowed[KD_ALLOWED_SIZE];
    kd_field_path(field, index, path);
    kd_field_pointer(field, index, pointer);
    kd_row_allowed(field, allowed);
    kd_number_format(number, value);
    return kd_error_field(error, pointer, "%s is %s; it must be %s", path, number, allowed);
}

static enum kd_status ranges(const struct kd_scene *scene, const struct kd_section *section, struct kd_error *error)
{
    size_t size = kd_section_size(scene, section);
    enum kd_status status =
        section->most ? kd_list_check(kd_document_list(&kd_scene_document, section->name), size, error) : KD_OK;
    for (size_t i = 0; i < size && !status; i++)
        for (size_t f = 0; f < section->count && !status; f++)
            status = range(scene, &kd_fields[section->first + f], i, error);
    return status;
}

enum kd_status kd_scene_validate(const struct kd_scene *scene, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < KD_SECTION_COUNT && !status; i++)
        status = ranges(scene, &kd_sections[i], error);
    for (size_t i = 0; i < kd_rule_count && !status; i++)
        status = kd_rules[i].check(scene, error);
    return status;
}

#include "scene/asset.h"

#include "scene/table.h"

#include <string.h>

/* Checks that the asset has the type that the field requires. */
static enum kd_status suits(const struct kd_scene *scene, const char *path, const char *pointer,
                            const struct kd_asset_found *found, struct kd_error *error)
{
    if (!strcmp(path, "volume.grid")) {
        if (!found->grid.nodes[0])
            return kd_error_field(error, pointer,
                                  "%s is a picture of %u x %u pixels; it must be a grid of matter, an NPZ file", path,
                                  found->width, found->height);
        return kd_asset_check_grid(&found->grid, scene, error);
    }
    if (strcmp(path, "sky.image"))
        return KD_OK;
    if (found->grid.nodes[0])
        return kd_error_field(error, pointer,
                              "%s is a grid of matter of %u x %u x %u nodes; it must be a picture of the whole sky",
                              path, found->grid.nodes[0], found->grid.nodes[1], found->grid.nodes[2]);
    if (!kd_asset_is_panorama(found->width, found->height))
        return kd_error_field(error, pointer,
                              "%s is a picture of %u x %u pixels; it must be one of the whole sky: twice as wide as it "
                              "is high, of %d to %d "
                              "rows",
                              path, found->width, found->height, KD_PANORAMA_LEAST, KD_PANORAMA_MOST);
    return KD_OK;
}

static enum kd_status resolve(struct kd_scene *scene, const struct kd_row *field, size_t index,
                              const struct kd_assets *assets, struct kd_error *error)
{
    struct kd_asset_found found = { 0 };
    char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
    const char *name = kd_field_asset(scene, field, index);
    if (!*name)
        return KD_OK;
    kd_field_path(field, index, path);
    kd_field_pointer(field, index, pointer);
    if (!assets->find(assets->user, name, &found) || !kd_asset_is_hash(found.hash))
        return kd_error_field(error, pointer, "%s is \"%s\", which is not a known asset; it must be %s", path, name,
                              assets->allowed);
    enum kd_status status = suits(scene, path, pointer, &found, error);
    const struct kd_value hash = { KD_VALUE_STRING, 0, found.hash };
    if (!status)
        status = kd_field_store(scene, field, index, &hash, error);
    const struct kd_asset_grid *grid = &found.grid;
    if (!status && *grid->nodes)
        scene->matter = (struct kd_scene_matter) {
            .nodes = (uint64_t)grid->frames * grid->nodes[0] * grid->nodes[1] * grid->nodes[2],
            .frames = grid->frames,
            .late = grid->late,
            .first = grid->time[0],
            .last = grid->time[1],
            .outer = grid->outer,
        };
    return status;
}

enum kd_status kd_scene_resolve(struct kd_scene *scene, const struct kd_assets *assets, struct kd_error *error)
{
    struct kd_scene resolved = *scene;
    enum kd_status status = KD_OK;
    resolved.matter = (struct kd_scene_matter) { 0 };
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_section *section = kd_section_find(kd_fields[i].object);
        for (size_t k = 0; kd_fields[i].kind == KD_KIND_ASSET && k < kd_section_size(scene, section); k++)
            KD_TRY(resolve(&resolved, &kd_fields[i], k, assets, error));
    }
    *scene = resolved;
done:
    return status;
}

/* Reads scenes from JSON, and single fields from typed text. */
#include "document/scan.h"
#include "scene/sky_scale.h"
#include "scene/style.h"
#include "scene/tree.h"

#include <string.h>

/* Sets fields that depend on the fields that were given. */
static void settle(struct kd_scene *scene, const uint64_t *given)
{
    if (kd_style_field() && kd_field_is_given(given, kd_style_field()))
        kd_style_apply(scene, given);
    kd_scene_settle(scene, given);
}

enum kd_status kd_scene_from_tree(struct kd_scene *scene, const cJSON *object, bool patch, struct kd_error *error)
{
    struct kd_scene read = *scene;
    uint64_t given[KD_FIELD_WORDS] = { 0 };
    const cJSON *version = cJSON_IsObject(object) ? cJSON_GetObjectItemCaseSensitive(object, "version") : NULL;
    enum kd_status status =
        (patch ? kd_document_patch : kd_document_read)(&kd_scene_document, &read, object, "", given, error);
    const struct kd_value value = version ? kd_tree_value(version) : (struct kd_value) { 0 };
    if (!status && version)
        status = kd_scene_version(&value, error);
    if (status)
        return status;
    settle(&read, given);
    *scene = read;
    return KD_OK;
}

static enum kd_status merge(struct kd_scene *scene, const char *text, size_t length, bool patch, struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status = kd_tree_parse(text, length, KD_SCENE_JSON_MAX, KD_SCAN_FEW, &root, error);
    if (!status)
        status = kd_scene_from_tree(scene, root, patch, error);
    cJSON_Delete(root);
    return status;
}

enum kd_status kd_scene_from_json(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error)
{
    return merge(scene, text, length, false, error);
}

enum kd_status kd_scene_patch(struct kd_scene *scene, const char *text, size_t length, struct kd_error *error)
{
    return merge(scene, text, length, true, error);
}

enum kd_status kd_field_at(const char *path, const struct kd_row **out, size_t *index, struct kd_error *error)
{
    struct kd_typed_place place;
    enum kd_status status = kd_document_place(&kd_scene_document, path, &place, error);
    *out = place.row;
    *index = status ? 0 : place.index;
    return status;
}

bool kd_scene_same_path(const char *a, const char *b)
{
    const struct kd_row *one, *other;
    size_t i, k;
    return !strcmp(a, b) ||
           (!kd_field_at(a, &one, &i, NULL) && !kd_field_at(b, &other, &k, NULL) && one == other && i == k);
}

enum kd_status kd_scene_set(struct kd_scene *scene, const char *path, const char *text, struct kd_error *error)
{
    const struct kd_value value = kd_value_typed(text);
    uint64_t given[KD_FIELD_WORDS] = { 0 };
    struct kd_scene set = *scene;
    if (!strcmp(path, "version"))
        return kd_scene_version(&value, error);
    enum kd_status status = kd_document_set(&kd_scene_document, &set, path, text, given, error);
    if (status)
        return status;
    settle(&set, given);
    *scene = set;
    return KD_OK;
}

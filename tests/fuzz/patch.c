/* Fuzz target: a scene, a line "---" and a merge patch (RFC 7396). Applying a patch twice must give the same scene as
 * applying it once, and as patching the document. A refused patch changes nothing. */
#include "fuzz.h"

#include "scene/table.h"

#include <cjson/cJSON.h>

/* True if a patch has members with a meaning beyond RFC 7396. These are a style, which sets other fields; an object in
 * place of a list, which changes the list's elements; and an old name of an element. */
static bool is_special(const cJSON *patch)
{
    bool special = false;
    for (const cJSON *item = patch->child; item; item = item->next) {
        special |= !strcmp(item->string, "style");
        for (size_t i = 0; i < KD_OLD_NAME_COUNT; i++)
            special |= !strcmp(item->string, kd_old_names[i].name);
        for (size_t i = 0; i < KD_SECTION_COUNT; i++)
            special |= kd_sections[i].most && !strcmp(item->string, kd_section_member(&kd_sections[i]));
        special |= cJSON_IsObject(item) && is_special(item);
    }
    return special;
}

/* Applies a merge patch as in RFC 7396, section 2. */
static void merge(cJSON *target, const cJSON *patch)
{
    for (const cJSON *item = patch->child; item; item = item->next) {
        cJSON *old = cJSON_GetObjectItemCaseSensitive(target, item->string);
        if (cJSON_IsObject(item) && cJSON_IsObject(old))
            merge(old, item);
        else {
            cJSON_DeleteItemFromObjectCaseSensitive(target, item->string);
            cJSON *new = cJSON_IsNull(item)     ? NULL
                         : cJSON_IsObject(item) ? cJSON_AddObjectToObject(target, item->string)
                                                : cJSON_Duplicate(item, true);
            if (cJSON_IsObject(item))
                merge(new, item);
            else if (new)
                cJSON_AddItemToObject(target, item->string, new);
        }
    }
}

static bool has_asset(const struct kd_scene *scene)
{
    bool has = false;
    for (size_t k = 0; k < KD_FIELD_COUNT; k++)
        has |= kd_fields[k].kind == KD_KIND_ASSET && kd_field_get(scene, &kd_fields[k], 0);
    return has;
}

/* A patched scene must equal the scene of the patched document. */
static void check_document(const struct kd_scene *before, const struct kd_scene *after,
                           const struct kd_fuzz_text *patch)
{
    struct kd_buffer text = { 0 };
    struct kd_scene scene;
    struct kd_error error = { 0 };
    cJSON *changes = cJSON_ParseWithLength(patch->at, patch->size);
    CHECK(changes, "a patch that was taken is no JSON");
    if (cJSON_IsObject(changes) && !is_special(changes) && !has_asset(before) && !has_asset(after)) {
        CHECK(!kd_scene_to_json(before, &text), "a scene that was read has no document");
        cJSON *document = cJSON_ParseWithLength((char *)text.data, text.size);
        CHECK(document, "a scene's document is no JSON");
        merge(document, changes);
        char *merged = cJSON_PrintUnformatted(document);
        CHECK(merged, "out of memory");
        kd_scene_defaults(&scene);
        CHECK(!kd_scene_from_json(&scene, merged, strlen(merged), &error), "%s: %s, in the merged document %s",
              error.pointer, error.message, merged);
        CHECK(!memcmp(&scene, after, sizeof scene), "a scene that was patched is another one than %s", merged);
        cJSON_free(merged);
        cJSON_Delete(document);
    }
    cJSON_Delete(changes);
    kd_buffer_finish(&text);
}

int kd_fuzz_patch(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text first = kd_fuzz_part(&data, &size), patch = kd_fuzz_bare(data, size);
    struct kd_scene before, once, twice;
    struct kd_error error = { 0 };
    kd_scene_defaults(&before);
    enum kd_status status = kd_scene_from_json(&before, first.at, first.size, &error);
    once = before;
    if (!status)
        status = kd_scene_patch(&once, patch.at, patch.size, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        CHECK(!memcmp(&once, &before, sizeof once), "a patch that was refused has changed the scene: %s",
              error.message);
    } else {
        twice = once;
        status = kd_scene_patch(&twice, patch.at, patch.size, &error);
        CHECK(!status, "the second time a patch is refused: %s: %s", error.pointer, error.message);
        CHECK(!memcmp(&once, &twice, sizeof once), "a patch that is applied twice gives another scene than once");
        kd_fuzz_sound(&once);
        check_document(&before, &once, &patch);
    }
    free(first.at);
    free(patch.at);
    return 0;
}

/* This reads a scene, a line "---" and a merge patch (RFC 7396) of it. A patch that is applied twice is the same as once, and one that is refused changes nothing. */
#include "fuzz.h"

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
        CHECK(!memcmp(&once, &before, sizeof once), "a patch that was refused has changed the scene: %s", error.message);
    } else {
        twice = once;
        status = kd_scene_patch(&twice, patch.at, patch.size, &error);
        CHECK(!status, "the second time a patch is refused: %s: %s", error.pointer, error.message);
        CHECK(!memcmp(&once, &twice, sizeof once), "a patch that is applied twice gives another scene than once");
        kd_fuzz_sound(&once);
    }
    free(first.at);
    free(patch.at);
    return 0;
}

/* Fuzz target: a scene as JSON, applied over the default scene and over the preset "smooth". A refused document must
 * leave the scene unchanged. An accepted one must read back the same after writing. */
#include "fuzz.h"

static void read_over(const struct kd_scene *before, const struct kd_fuzz_text *text)
{
    struct kd_scene scene = *before;
    struct kd_error error = { 0 };
    const enum kd_status status = kd_scene_from_json(&scene, text->at, text->size, &error);
    if (status) {
        kd_fuzz_refused(status, &error);
        CHECK(!memcmp(&scene, before, sizeof scene), "a scene that was refused has changed: %s", error.message);
    } else
        kd_fuzz_sound(&scene);
}

int kd_fuzz_scene(const uint8_t *data, size_t size)
{
    struct kd_fuzz_text text = kd_fuzz_bare(data, size);
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    read_over(&scene, &text);
    kd_scene_smooth(&scene);
    read_over(&scene, &text);
    free(text.at);
    return 0;
}

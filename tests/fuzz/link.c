/* Fuzz target: the code of a shared scene, as in /s/CODE. The input is such a code, or, after a first byte "=", the
 * text that a code is made of. The code must be refused, or give valid scenes for the sides of the link. The link of
 * each of these scenes must give the same scene again. */
#include "fuzz.h"

#include "image/text_code.h"
#include "scene/link.h"
#include "server/render/shared.h"

static void again(const struct kd_scene *scene)
{
    struct kd_buffer link = { 0 }, code = { 0 };
    struct kd_error error = { 0 };
    struct kd_problem problem;
    struct kd_shared_scenes both;
    struct kd_scene back;
    CHECK(!kd_scene_link(scene, &link, &error), "a shared scene has no link: %s", error.message);
    CHECK(!kd_text_code_write(link.data, link.size, &code, &error), "%s: %s", (char *)link.data, error.message);
    CHECK(kd_shared_read((const char *)code.data, &both, &problem, &error), "%s is refused: %s", (char *)link.data,
          error.message);
    CHECK(!both.measured && !memcmp(&both.left, &both.right, sizeof both.left), "a link of one scene is a pair");
    back = both.left;
    back.image.width = scene->image.width; /* a link does not contain the picture's size */
    back.image.height = scene->image.height;
    back.tile = scene->tile;
    CHECK(!memcmp(scene, &back, sizeof back), "the link \"%s\" is of another scene", (char *)link.data);
    kd_buffer_finish(&link);
    kd_buffer_finish(&code);
}

int kd_fuzz_link(const uint8_t *data, size_t size)
{
    struct kd_error error = { 0 };
    struct kd_problem problem = { 0 };
    struct kd_buffer code = { 0 };
    struct kd_shared_scenes scenes;
    struct kd_fuzz_text text = kd_fuzz_copy(data, size);
    const bool packed = *text.at != '=';
    if (!packed && kd_text_code_write(text.at + 1, text.size - 1, &code, &error))
        kd_fuzz_refused(error.status, &error);
    else if (kd_shared_read(packed ? text.at : (char *)code.data, &scenes, &problem, &error)) {
        for (struct kd_scene *scene = &scenes.left; scene; scene = scene == &scenes.left ? &scenes.right : NULL) {
            kd_fuzz_sound(scene);
            again(scene);
            kd_scene_link_preview(scene, KD_SHARED_WIDTH, KD_SHARED_HEIGHT);
            kd_fuzz_sound(scene);
        }
    } else {
        kd_fuzz_refused(error.status, &error);
        CHECK(problem.detail == error.message && kd_problem_status(problem.type) >= 400, "a refusal is no problem");
    }
    kd_buffer_finish(&code);
    free(text.at);
    return 0;
}

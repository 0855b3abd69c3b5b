#include "render/plan/lens_key.h"

#include "render/emit/emitter.h"
#include "scene/sha256.h"
#include "scene/table.h"

#include <stdlib.h>
#include <string.h>

/* Writes the parts of a camera that the lens map depends on: the tile, and all fields except the azimuth. The azimuth
 * is added to all azimuths when light is computed. */
static enum kd_status write_view(const struct kd_scene *scene, struct kd_buffer *text)
{
    const struct kd_section *camera = kd_section_find("camera");
    enum kd_status status;
    const struct kd_window window = kd_scene_window(scene);
    KD_TRY(kd_buffer_printf(text, "%u x %u at %u %u, spin %a", window.width, window.height, window.left, window.top,
                            scene->spacetime.spin));
#define MORE(x, name, ...) KD_TRY(kd_buffer_printf(text, ", " #name " %a", scene->spacetime.name));
    KD_HOLE_MORE(MORE, )
#undef MORE
    for (size_t i = camera->first; i < camera->first + camera->count; i++)
        if (strcmp(kd_fields[i].name, "azimuth_deg"))
            KD_TRY(kd_buffer_printf(text, ", %s %a", kd_fields[i].name, kd_field_get(scene, &kd_fields[i], 0)));
done:
    return status;
}

/* The key is a hash of the hole, the camera, the rays, how they are traced, and the quantities of the map. */
enum kd_status kd_plan_lens_key(struct kd_plan *plan, const struct kd_scene *scene)
{
    struct kd_buffer text = { 0 };
    const struct kd_setting *by = &plan->lens.setting;
    enum kd_status status;
    KD_TRY(kd_buffer_printf(&text, "lens %u %u, rays %d x %d x %d, %d times and %u at the curve, by %d %d %u %d %a, ",
                            plan->lens.quantities, plan->lens.orders, scene->image.width, scene->image.height,
                            (int)plan->lens.side, scene->image.critical_factor, plan->lens.critical, (int)by->engine,
                            (int)by->precision, by->steps, (int)plan->lens.path, plan->lens.interpolates));
    KD_TRY(write_view(scene, &text));
    kd_sha256(text.data, text.size, plan->lens.key);
done:
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_plan_lens_group(const struct kd_scene *scene, uint64_t *out)
{
    struct kd_buffer text = { 0 };
    const struct kd_section *accuracy = kd_section_find("accuracy");
    char hash[65];
    enum kd_status status;
    /* hashed because these flags determine which pixels at the curve have rays, whatever the map holds */
    const bool marches = kd_emit_along(scene) || kd_emit_met(scene);
    KD_TRY(kd_buffer_printf(&text, "%u, %d x %d x %d, %d %d, ", kd_needs_of(scene).quantities, scene->image.width,
                            scene->image.height, (int)kd_scene_side(scene), scene->image.critical_factor, marches));
    for (size_t i = accuracy->first; i < accuracy->first + accuracy->count; i++)
        KD_TRY(kd_buffer_printf(&text, "%a ", kd_field_get(scene, &kd_fields[i], 0)));
    KD_TRY(write_view(scene, &text));
    kd_sha256(text.data, text.size, hash);
    hash[16] = 0;
    *out = strtoull(hash, NULL, 16);
done:
    kd_buffer_finish(&text);
    return status;
}

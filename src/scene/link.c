#include "scene/link.h"

#include "scene/difference.h"
#include "scene/table.h"

#include <math.h>
#include <string.h>

#define TOLD 4 /* maximum number of changes that the text of a preview mentions */

enum kd_status kd_scene_link_check(const struct kd_scene *scene, struct kd_error *error)
{
    char path[KD_PATH_SIZE], pointer[KD_PATH_SIZE];
    for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
        const struct kd_row *field = &kd_fields[i];
        if (field->kind != KD_KIND_ASSET || !*kd_field_asset(scene, field, 0))
            continue;
        kd_field_path(field, 0, path);
        kd_field_pointer(field, 0, pointer);
        return kd_error_field(error, pointer,
                              "%s names an asset of this server, which a link cannot contain; it must be null", path);
    }
    return KD_OK;
}

/* Gets the preset at index i. After the last preset comes the default scene. */
static enum kd_status base_of(size_t i, struct kd_scene *base, struct kd_buffer *text)
{
    const char *name = kd_scene_preset_name(i);
    kd_scene_defaults(base);
    if (!name)
        return KD_OK;
    enum kd_status status = kd_scene_preset(base, name, NULL);
    return status ? status : kd_buffer_printf(text, "preset=%s", name);
}

static enum kd_status link_over(size_t i, const struct kd_scene *scene, struct kd_buffer *text)
{
    struct kd_scene base, sized = *scene;
    struct kd_buffer fields = { 0 };
    enum kd_status status;
    KD_TRY(base_of(i, &base, text));
    sized.image.width = base.image.width;
    sized.image.height = base.image.height;
    sized.tile = base.tile;
    KD_TRY(kd_scene_difference(&base, &sized, '&', &fields));
    if (fields.size)
        KD_TRY(kd_buffer_printf(text, "%s%s", text->size ? "&" : "", (const char *)fields.data));
done:
    kd_buffer_finish(&fields);
    return status;
}

enum kd_status kd_scene_link(const struct kd_scene *scene, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_buffer best = { 0 }, text = { 0 };
    bool found = false;
    enum kd_status status;
    KD_TRY(kd_scene_link_check(scene, error));
    for (size_t i = 0; i <= kd_scene_preset_count(); i++) {
        text.size = 0;
        status = link_over(i, scene, &text);
        if (status == KD_ENOMEM)
            KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
        if (status || (found && text.size >= best.size))
            continue;
        const struct kd_buffer shorter = text;
        text = best;
        best = shorter;
        found = true;
    }
    if (!found)
        KD_TRY(kd_error_set(error, KD_EINVAL, "this scene does not fit into a link"));
    if (kd_buffer_printf(out, "%.*s", (int)best.size, best.size ? (const char *)best.data : ""))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory"));
done:
    kd_buffer_finish(&best);
    kd_buffer_finish(&text);
    return status;
}

/* Writes name and value of one field. The name is "inclination" for camera.inclination_deg, because the unit follows
 * the value. */
static enum kd_status tell_one(const struct kd_scene_changed *one, struct kd_buffer *out)
{
    static const char degrees[] = "_deg";
    const struct kd_row *field;
    size_t index;
    char name[KD_PATH_SIZE];
    enum kd_status status = kd_field_at(one->path, &field, &index, NULL);
    if (status)
        return status;
    strcpy(name, field->name);
    const size_t n = strlen(name);
    const bool angle = n >= sizeof degrees && !strcmp(name + n + 1 - sizeof degrees, degrees);
    if (angle)
        name[n + 1 - sizeof degrees] = 0;
    for (char *c = name; *c; c++)
        *c = *c == '_' ? ' ' : *c;
    const char *unit = angle || !strcmp(field->unit, "1") ? "" : field->unit;
    return kd_buffer_printf(out, "%s%s%s %s%s%s%s", field->object, *field->object ? " " : "", name, one->value,
                            angle ? "°" : "", *unit ? " " : "", unit);
}

enum kd_status kd_scene_link_tell(const struct kd_scene_changed *changed, size_t n, struct kd_buffer *out)
{
    const size_t told = n > TOLD ? TOLD : n;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < told && !status; i++) {
        if (i)
            status = kd_buffer_printf(out, "%s", n == told && i + 1 == told ? " and " : ", ");
        if (!status)
            status = tell_one(&changed[i], out);
    }
    return status || n == told ? status : kd_buffer_printf(out, " and %zu more", n - told);
}

/* Presets are composed for 16:9. A wider picture gets a wider field of view, so that the vertical field of view
 * stays the same, as in the page (clients/web/picture/fit.js). */
static void fit(struct kd_scene *scene, double by)
{
    static const double widest_deg = 150, widest_m = 1e4, degree = 3.14159265358979323846 / 180;
    if (by <= 1 || !kd_scene_is_flat(scene))
        return;
    const double fov = 2 / degree * atan(by * tan(scene->camera.fov_deg * degree / 2));
    const double width = by * scene->camera.field_m;
    if (fov <= widest_deg)
        scene->camera.fov_deg = fov;
    if (width > widest_m)
        return;
    scene->camera.field_m = width;
    scene->camera.field_uas = INFINITY;
}

void kd_scene_link_preview(struct kd_scene *scene, int32_t width, int32_t height)
{
    *scene = kd_scene_whole(scene);
    scene->camera.stereo = KD_STEREO_NONE;
    scene->image.width = width;
    scene->image.height = height;
    scene->image.samples = 2;
    /* One ray per pixel is enough for a volume: its light varies slowly over the picture, and a ray takes a hundred
     * times as long as without a volume. The profile "draft" changes the pixels of presets with volumes by at most 2
     * of 255. */
    if (scene->volume.model != KD_VOLUME_NONE || scene->jets.brightness > 0) {
        scene->image.samples = 1;
        scene->accuracy.profile = KD_PROFILE_DRAFT;
    }
    scene->image.bit_depth = 8;
    fit(scene, (double)width / height / (16.0 / 9));
}

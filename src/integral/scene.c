/* Reads and checks the scene of a request ("preset" and "scene"), and the fields that determine its pictures. */
#include "integral/integral_internal.h"
#include "integral/request.h"
#include "integral/pictures.h"

#include "physics/math/angle.h"
#include "render/output/wcs.h"
#include "document/members.h"
#include "document/text.h"
#include "scene/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum kd_status kd_integral_make_scene(struct kd_integral_request *r, struct kd_error *error)
{
    if (!r->scene && !(r->scene = calloc(1, sizeof *r->scene)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for a scene");
    kd_scene_defaults(r->scene);
    if (r->what == KD_INTEGRAL_SPECTRUM) {
        r->what = KD_INTEGRAL_VOLUME;
        r->frequencies = kd_integral_given(r, "frequencies") ? r->frequencies : KD_INTEGRAL_USUAL_FREQUENCIES;
    }
    return KD_OK;
}

static enum kd_status read_preset(struct kd_integral_request *r, const cJSON *item, struct kd_error *error)
{
    if (!cJSON_IsString(item))
        return kd_member_refuse(item, "/preset", "the name of a preset", error);
    return kd_member_inside(kd_scene_preset(r->scene, item->valuestring, error), "/preset", error);
}

static enum kd_status read_fields(struct kd_integral_request *r, const cJSON *item, struct kd_error *error)
{
    enum kd_status status = kd_scene_from_tree(r->scene, item, false, error);
    if (!status && r->assets)
        status = kd_scene_resolve(r->scene, r->assets, error);
    if (!status && r->assets)
        status = kd_scene_validate(r->scene, error);
    return kd_member_inside(status, "/scene", error);
}

enum kd_status kd_integral_read_scene(struct kd_integral_request *r, const cJSON *root, struct kd_error *error)
{
    const bool may = kd_integral_is_pictured(r->what) || r->what == KD_INTEGRAL_SPECTRUM;
    const cJSON *preset = may ? cJSON_GetObjectItemCaseSensitive(root, "preset") : NULL,
                *scene = may ? cJSON_GetObjectItemCaseSensitive(root, "scene") : NULL;
    enum kd_status status = KD_OK;
    if (!preset && !scene)
        return KD_OK;
    KD_TRY(kd_integral_make_scene(r, error));
    if (preset)
        KD_TRY(read_preset(r, preset, error));
    if (scene)
        KD_TRY(read_fields(r, scene, error));
done:
    return status;
}

static enum kd_status check_radio(const struct kd_scene *scene, struct kd_error *error)
{
    if (!kd_scene_is_radio(scene) && !kd_scene_has_disk_frequency(scene))
        return kd_error_field(error, "/scene/volume/model",
                              "the scene has no light of one frequency in physical units, which a spectrum needs; "
                              "volume.model must be \"gold\", \"riaf\", \"torus\" or \"grid\", or disk.band must be "
                              "\"frequency\"; without scene and preset the spectrum is that of a thin disk");
    if (!kd_scene_is_radio_alone(scene))
        return kd_error_field(
            error, "/scene",
            "a spectrum needs a scene where only a volume, or only a disk with disk.band "
            "\"frequency\", shines: sky.model must be \"none\", and there must be no jets, spots, flash or "
            "bodies");
    return KD_OK;
}

/* The highest frequency at which the scene can be shown. */
static double most_hz(const struct kd_scene *scene)
{
    return kd_scene_is_radio(scene) ? KD_INTEGRAL_MOST_HZ
                                    : fmin(KD_INTEGRAL_MOST_HZ, kd_scene_disk_most_ghz(scene) * 1e9);
}

enum kd_status kd_integral_check_volume(struct kd_integral_request *r, struct kd_error *error)
{
    const double least = KD_INTEGRAL_LEAST_HZ, most = most_hz(r->scene);
    enum kd_status status = KD_OK;
    KD_TRY(check_radio(r->scene, error));
    if (!kd_scene_is_flat(r->scene))
        return kd_error_field(
            error, "/scene/camera/projection",
            "camera.projection does not preserve areas, as a flux needs; it must be plane or pinhole");
    if (isnan(r->frequency_min_hz))
        r->frequency_min_hz = fmax(kd_scene_frequency_ghz(r->scene) * 1e9 / 30, least);
    if (isnan(r->frequency_max_hz))
        r->frequency_max_hz = fmin(kd_scene_frequency_ghz(r->scene) * 1e9 * 30, most);
    KD_TRY(kd_integral_check_frequencies(r, KD_INTEGRAL_PICTURES, error));
    for (size_t i = 0; i < r->frequencies_hz.n; i++)
        if (r->frequencies_hz.at[i] < least || r->frequencies_hz.at[i] > most) {
            char pointer[60];
            snprintf(pointer, sizeof pointer, "/frequencies_hz/%zu", i);
            return kd_error_field(error, pointer, "a frequency is %.9g; it must be within %s, %.9g to %.9g Hz",
                                  r->frequencies_hz.at[i], kd_scene_frequency_path(r->scene), least, most);
        }
    r->pixels = r->pixels ? r->pixels : 128;
done:
    return status;
}

static enum kd_status fill_lengths(struct kd_integral_request *r, struct kd_error *error)
{
    const struct kd_scene scene = kd_integral_scene(r, 0);
    struct kd_number_list *list;
    if (isnan(r->length_max))
        r->length_max = 0.5 * kd_integral_nyquist_gl(&scene);
    enum kd_status status =
        kd_integral_make_room(r, kd_integral_field_named(r, "lengths"), r->baselines, "/baselines", &list, error);
    for (size_t i = 0; !status && i < r->baselines; i++)
        list->at[i] = r->length_max * (double)i / (r->baselines - 1);
    return status;
}

/* Makes a baseline from each pair of a length and an angle. All lengths of one angle are adjacent. */
static enum kd_status make_baselines(struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_number_list *u, *v, *angles;
    enum kd_status status = KD_OK;
    if (!r->angles_deg.n) {
        KD_TRY(kd_integral_make_room(r, kd_integral_field_named(r, "angles_deg"), 2, "/angles_deg", &angles, error));
        angles->at[0] = 0, angles->at[1] = 90;
    }
    if (!r->lengths.n)
        KD_TRY(fill_lengths(r, error));
    else
        KD_TRY(kd_integral_check_beside(r, "lengths", (const char *const[]) { "length_max", "baselines" }, 2, error));
    const size_t n = r->lengths.n * r->angles_deg.n;
    if (n > KD_INTEGRAL_ROWS)
        return kd_error_field(error, r->lengths.n > r->angles_deg.n ? "/lengths" : "/angles_deg",
                              "%zu lengths at %zu angles make too many baselines (limit %u)", r->lengths.n,
                              r->angles_deg.n, KD_INTEGRAL_ROWS);
    KD_TRY(kd_integral_make_room(r, kd_integral_field_named(r, "u"), n, "/u", &u, error));
    KD_TRY(kd_integral_make_room(r, kd_integral_field_named(r, "v"), n, "/v", &v, error));
    for (size_t i = 0; i < n; i++) {
        const double length = r->lengths.at[i % r->lengths.n], angle = r->angles_deg.at[i / r->lengths.n];
        u->at[i] = length * kd_sin_deg(angle), v->at[i] = length * kd_cos_deg(angle);
    }
done:
    return status;
}

static enum kd_status check_baselines(struct kd_integral_request *r, struct kd_error *error)
{
    static const char *const others[] = { "lengths", "length_max", "baselines", "angles_deg" };
    enum kd_status status = KD_OK;
    if (!r->u.n && !r->v.n)
        KD_TRY(make_baselines(r, error));
    else if (r->u.n != r->v.n)
        KD_TRY(kd_error_field(error, r->u.n > r->v.n ? "/u" : "/v",
                              "u has %zu numbers and v has %zu; both must have the same number", r->u.n, r->v.n));
    else
        KD_TRY(kd_integral_check_beside(r, "u", others, 4, error));
    if (r->u.n * (1 + r->orders) > KD_INTEGRAL_ROWS)
        return kd_error_field(error, r->orders ? "/orders" : "/u",
                              "%zu baselines with %u orders make too many rows (limit %u)", r->u.n, r->orders,
                              KD_INTEGRAL_ROWS);
done:
    return status;
}

static enum kd_status check_orders(const struct kd_integral_request *r, struct kd_error *error)
{
    if (r->orders && r->scene->disk.model == KD_DISK_NONE)
        return kd_error_field(error, "/orders",
                              "orders is %u; without a disk, which alone has separate image orders, it must be 0",
                              r->orders);
    if (r->orders > (uint32_t)r->scene->accuracy.orders)
        return kd_error_field(error, "/orders", "orders is %u; it must be 0 to %d, accuracy.orders of the scene",
                              r->orders, r->scene->accuracy.orders);
    return KD_OK;
}

enum kd_status kd_integral_check_flat(const struct kd_scene *scene, struct kd_error *error)
{
    if (kd_wcs_of(scene).far)
        return KD_OK;
    return kd_error_field(error, "/scene/camera",
                          "visibilities need a flat map seen from infinity: camera.r must be \"infinity\", and "
                          "camera.projection auto or plane");
}

enum kd_status kd_integral_check_map(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (!r->scene)
        KD_TRY(kd_integral_make_scene(r, error));
    KD_TRY(kd_integral_check_flat(r->scene, error));
    r->pixels = r->pixels ? r->pixels : 256;
done:
    return status;
}

enum kd_status kd_integral_check_visibility(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    KD_TRY(kd_integral_check_map(r, error));
    KD_TRY(check_orders(r, error));
    KD_TRY(check_baselines(r, error));
done:
    return status;
}

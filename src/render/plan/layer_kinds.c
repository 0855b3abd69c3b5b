#include "render/plan/layer_kinds.h"

#include "render/emit/emitter.h"

#include "lens.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *const fates[] = { "sky", "hole", "?" };

#define PI 3.14159265358979323846
#define LIGHT_(number, called, what, value) \
    [number] = { .name = #called, .of = KD_OF_LIGHT, .needs = what, SHOWN_##called },
#define CROSSING_(number, called, what, value, met) \
    [number] = { .name = #called, .of = KD_OF_CROSSING, .needs = KD_LENS_W | (what), SHOWN_##called },
#define RAY_(number, called, what, value) \
    [number] = { .name = #called, .of = KD_OF_RAY, .needs = what, SHOWN_##called },

/* Unit and display of each layer in a PNG. */
#define SHOWN_intensity .unit = "", .map = KD_MAP_HEAT, .scale = { 0, NAN, false }
#define SHOWN_brightness_temperature .unit = "K", .map = KD_MAP_HEAT, .scale = { 0, NAN, false }
#define SHOWN_specific_intensity .unit = "Jy/sr", .map = KD_MAP_HEAT, .scale = { 0, NAN, false }
#define SHOWN_jy_per_pixel .unit = "Jy/pixel", .map = KD_MAP_HEAT, .scale = { 0, NAN, false }
#define SHOWN_g .unit = "", .map = KD_MAP_DIVERGING, .scale = { NAN, NAN, true }
#define SHOWN_temperature .unit = "K", .map = KD_MAP_HEAT, .scale = { 0, NAN, false }
#define SHOWN_r .unit = "M", .map = KD_MAP_SEQUENTIAL, .scale = { NAN, NAN, false }
#define SHOWN_phi .unit = "rad", .map = KD_MAP_CYCLIC, .scale = { -PI, PI, false }
#define SHOWN_delay .unit = "M", .map = KD_MAP_SEQUENTIAL, .scale = { NAN, NAN, false }
#define SHOWN_emission_angle .unit = "rad", .map = KD_MAP_SEQUENTIAL, .scale = { 0, PI / 2, false }
#define SHOWN_order .unit = "", .map = KD_MAP_CATEGORICAL, .scale = { 0, 1, false }
#define SHOWN_sky_theta .unit = "rad", .map = KD_MAP_SEQUENTIAL, .scale = { 0, PI, false }
#define SHOWN_sky_phi .unit = "rad", .map = KD_MAP_CYCLIC, .scale = { -PI, PI, false }
#define SHOWN_fate .unit = "", .map = KD_MAP_CATEGORICAL, .scale = { 0, 1, false }, .classes = fates, .n_classes = 3
#define SHOWN_optical_depth .unit = "", .map = KD_MAP_SEQUENTIAL, .scale = { 0, NAN, false }
#define SHOWN_stokes_q .unit = "", .map = KD_MAP_DIVERGING, .scale = { NAN, NAN, false }
#define SHOWN_stokes_u .unit = "", .map = KD_MAP_DIVERGING, .scale = { NAN, NAN, false }
#define SHOWN_stokes_v .unit = "", .map = KD_MAP_DIVERGING, .scale = { NAN, NAN, false }
#define SHOWN_evpa .unit = "rad", .map = KD_MAP_CYCLIC, .scale = { -PI / 2, PI / 2, false }
#define SHOWN_polarization_fraction .unit = "", .map = KD_MAP_SEQUENTIAL, .scale = { 0, NAN, false }
#define SHOWN_footprint .unit = "M", .map = KD_MAP_SEQUENTIAL, .scale = { NAN, NAN, true }
#define SHOWN_sky_footprint .unit = "rad", .map = KD_MAP_SEQUENTIAL, .scale = { NAN, NAN, true }

const struct kd_layer_kind kd_layer_kinds[KD_LAYER_COUNT] = {
    [KD_LAYER_rgb] = { .name = "rgb", .unit = "", .of = KD_OF_PICTURE }, KD_LAYERS(LIGHT_, CROSSING_, RAY_)
};

size_t kd_layers_of(const struct kd_scene *scene, struct kd_plan_layer out[KD_WORDS_MOST], bool *rgb)
{
    const struct kd_words *words = &scene->image.layers;
    size_t n = 0;
    *rgb = false;
    for (int i = 0; i < words->count; i++) {
        if (words->at[i].word == KD_LAYER_rgb)
            *rgb = true;
        else
            out[n++] = (struct kd_plan_layer) { words->at[i].word, words->at[i].number };
    }
    return n;
}

uint32_t kd_layers_needs(const struct kd_scene *scene)
{
    struct kd_plan_layer layers[KD_WORDS_MOST];
    /* for a ring Carter's Q follows only from the slope */
    bool rgb, ring = scene->camera.projection == KD_PROJECTION_RING;
    uint32_t needs = 0;
    for (size_t n = kd_layers_of(scene, layers, &rgb); n; n--) {
        if (kd_layer_is_polarized(layers[n - 1].kind) && scene->polarization.model == KD_POLARIZATION_TRANSFER)
            continue; /* such a layer belongs to the march and has no crossing */
        needs |= kd_layer_kinds[layers[n - 1].kind].needs |
                 (layers[n - 1].kind == KD_LAYER_emission_angle && ring ? KD_LENS_SLOPE : 0);
    }
    return needs;
}

bool kd_layers_have_flux(const struct kd_scene *scene)
{
    return kd_scene_is_radio_alone(scene) && !isfinite(scene->camera.r) &&
           scene->camera.projection != KD_PROJECTION_RING && scene->camera.stereo == KD_STEREO_NONE;
}

static enum kd_status check_one(const struct kd_scene *scene, struct kd_plan_layer layer, struct kd_error *error)
{
    char name[KD_LAYER_NAME];
    kd_layer_name(layer, name);
    if (layer.order >= scene->accuracy.orders)
        return kd_error_field(error, "/image/layers",
                              "image.layers has %s; its image orders must be below accuracy.orders, %d", name,
                              scene->accuracy.orders);
    if ((kd_emit_along(scene) || kd_emit_met(scene)) && kd_layer_kinds[layer.kind].of == KD_OF_LIGHT &&
        layer.order >= 0)
        return kd_error_field(
            error, "/image/layers",
            "image.layers has %s; with volumes or bodies, whose light is between the crossings, it must be %.*s", name,
            (int)strlen(kd_layer_kinds[layer.kind].name), name);
    if (kd_layer_is_polarized(layer.kind) && scene->polarization.model == KD_POLARIZATION_NONE)
        return kd_error_field(
            error, "/image/layers",
            "image.layers has %s, which needs polarised light: polarization.model must not be \"none\"", name);
    if (layer.kind == KD_LAYER_stokes_v && scene->polarization.model != KD_POLARIZATION_TRANSFER)
        return kd_error_field(
            error, "/image/layers",
            "image.layers has stokes_v, which needs circular polarisation: polarization.model must be \"transfer\"");
    if (kd_layer_is_polarized(layer.kind) && scene->camera.projection == KD_PROJECTION_RING)
        return kd_error_field(error, "/image/layers",
                              "image.layers has %s, which camera.projection \"ring\" cannot show, because its picture "
                              "has no upward direction",
                              name);
    if ((layer.kind == KD_LAYER_brightness_temperature || layer.kind == KD_LAYER_specific_intensity ||
         layer.kind == KD_LAYER_jy_per_pixel) &&
        !kd_scene_is_radio_alone(scene))
        return kd_error_field(
            error, "/image/layers",
            "image.layers has %s, which needs light of one frequency alone: of a volume.model \"gold\", \"riaf\", "
            "\"torus\" or \"grid\", or of a disk with disk.band \"frequency\"; sky.model \"none\", no jets, spots, "
            "flash or bodies",
            name);
    if (layer.kind == KD_LAYER_jy_per_pixel && !kd_layers_have_flux(scene))
        return kd_error_field(
            error, "/image/layers",
            "image.layers has %s, which needs pixels of equal solid angle: camera.r must be \"infinity\", without "
            "stereo, and the projection not \"ring\"; specific_intensity works with every camera",
            name);
    if (scene->disk.height > 0 && scene->disk.model != KD_DISK_NONE && kd_layer_kinds[layer.kind].of == KD_OF_CROSSING)
        return kd_error_field(error, "/image/layers",
                              "image.layers has %s, which needs a thin disk: disk.height is %.9g; it must be 0", name,
                              scene->disk.height);
    if (kd_emit_along(scene) && layer.kind == KD_LAYER_optical_depth)
        return kd_error_field(
            error, "/image/layers",
            "image.layers has %s, which belongs to one crossing of the disk: there must be no volumes", name);
    if (layer.kind == KD_LAYER_temperature && scene->disk.model == KD_DISK_NONE && !kd_emit_met(scene))
        return kd_error_field(
            error, "/image/layers",
            "image.layers has %s, which needs matter with a temperature: disk.model must not be \"none\"", name);
    return KD_OK;
}

static enum kd_status check_scale(const struct kd_scene *scene, struct kd_plan_layer layer, struct kd_error *error)
{
    double low = scene->image.layer_min, high = scene->image.layer_max;
    bool one_above_zero = kd_layer_kinds[layer.kind].scale.logarithmic;
    if (isfinite(low) && isfinite(high) && low >= high)
        return kd_error_field(error, "/image/layer_min",
                              "image.layer_min is %.9g; it must be less than image.layer_max, %.9g", low, high);
    if (one_above_zero && isfinite(low) && low <= 0)
        return kd_error_field(error, "/image/layer_min",
                              "image.layer_min is %.9g; it must be more than 0: %s is shown on a logarithmic scale",
                              low, kd_layer_kinds[layer.kind].name);
    if (one_above_zero && isfinite(high) && high <= 0)
        return kd_error_field(error, "/image/layer_max",
                              "image.layer_max is %.9g; it must be more than 0: %s is shown on a logarithmic scale",
                              high, kd_layer_kinds[layer.kind].name);
    return KD_OK;
}

enum kd_status kd_layers_check(const struct kd_scene *scene, struct kd_error *error)
{
    struct kd_plan_layer layers[KD_WORDS_MOST];
    bool rgb;
    size_t n = kd_layers_of(scene, layers, &rgb);
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n && !status; i++)
        status = check_one(scene, layers[i], error);
    return status || !n ? status : check_scale(scene, layers[0], error);
}

void kd_layer_name(struct kd_plan_layer layer, char out[KD_LAYER_NAME])
{
    const char *name = kd_layer_kinds[layer.kind].name;
    if (layer.order < 0)
        snprintf(out, KD_LAYER_NAME, "%s", name);
    else
        snprintf(out, KD_LAYER_NAME, "%s_%d", name, layer.order);
}

/* Table of the layers that a frame may have besides the picture: the C side of shaders/shared/layers.h, with units,
 * colours and names. To add a layer, write its line there, its row in layer_kinds.c, its word in the row image.layers
 * of the field table, and its section in docs/layers.md. Constant data and pure functions of valid scenes, any
 * thread. */
#ifndef KD_RENDER_PLAN_LAYER_KINDS_H
#define KD_RENDER_PLAN_LAYER_KINDS_H

#include "image/colour_map.h"
#include "layers.h"
#include "scene/scene.h"

#include <stddef.h>
#include <stdint.h>

#define KD_LAYER_NUMBER_(number, name, ...) KD_LAYER_##name = number,
#define KD_LAYER_ONE_(...) +1
enum kd_layer_number {
    KD_LAYER_rgb,
    KD_LAYERS(KD_LAYER_NUMBER_, KD_LAYER_NUMBER_, KD_LAYER_NUMBER_) KD_LAYER_COUNT =
        1 KD_LAYERS(KD_LAYER_ONE_, KD_LAYER_ONE_, KD_LAYER_ONE_)
};

struct kd_layer_kind {
    const char *name;
    const char *unit; /* "": dimensionless */
    enum kd_layer_of { KD_OF_PICTURE, KD_OF_LIGHT, KD_OF_CROSSING, KD_OF_RAY } of;
    uint32_t needs; /* KD_LENS_... quantities of the lens map that the layer reads */
    enum kd_colour_map map;
    /* the scale of the layer's colours; an end that is NAN is replaced by the picture's least or largest value */
    struct kd_map_scale scale;
    const char *const *classes; /* for CATEGORICAL: names of the values 0, 1, ...; NULL: their numbers */
    uint32_t n_classes;         /* number of classes; 0: the largest value determines this number */
};
extern const struct kd_layer_kind kd_layer_kinds[KD_LAYER_COUNT];
/* True if the layer is a quantity of polarised light. */
static inline bool kd_layer_is_polarized(int kind)
{
    return kind == KD_LAYER_stokes_q || kind == KD_LAYER_stokes_u || kind == KD_LAYER_evpa ||
           kind == KD_LAYER_polarization_fraction || kind == KD_LAYER_stokes_v;
}

/* A layer of a plan. order: image order of the layer; -1: the order of the first crossing on the disk. */
struct kd_plan_layer { int16_t kind, order; };

/* The layers of image.layers except "rgb", in their order; returns their number. *rgb: true if "rgb" is among the
 * words of image.layers. */
size_t kd_layers_of(const struct kd_scene *scene, struct kd_plan_layer out[KD_WORDS_MOST], bool *rgb);
/* KD_LENS_... quantities that all layers of image.layers need together. */
uint32_t kd_layers_needs(const struct kd_scene *scene);
/* True if jy_per_pixel is defined: all light is of one frequency, and all pixels cover the same part of the sky. */
bool kd_layers_have_flux(const struct kd_scene *scene);
/* Returns KD_EINVAL at a field for an impossible request: a layer of the disk in a scene without a disk, a layer of
 * coordinates that the projection does not have, a layer of an order that is not traced, or invalid ends of a
 * scale. */
enum kd_status kd_layers_check(const struct kd_scene *scene, struct kd_error *error);

/* "g" or "g_1". */
enum { KD_LAYER_NAME = 40 };
void kd_layer_name(struct kd_plan_layer layer, char out[KD_LAYER_NAME]);

#endif

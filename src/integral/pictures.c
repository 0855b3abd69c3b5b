#include "integral/pictures.h"

#include "integral/sets.h"

#include "physics/spacetime/scale.h"
#include "render/output/flux.h"
#include "render/view/camera.h"

#include <math.h>
#include <stdio.h>

#define RADIANS_PER_UAS (M_PI / 180 / 3.6e9)

unsigned kd_integral_pictures(const struct kd_integral_request *r)
{
    if (r->what == KD_INTEGRAL_SETS)
        return r->sets->pictures;
    return kd_integral_is_pictured(r->what)
               ? (r->unchecked ? 1 : 2) * (r->what == KD_INTEGRAL_VOLUME ? r->frequencies : 1)
               : 0;
}

bool kd_integral_is_finer(const struct kd_integral_request *r, unsigned picture)
{
    return !r->unchecked && picture % 2;
}

static struct kd_words layers_of(const struct kd_integral_request *r, const struct kd_scene *scene)
{
    struct kd_words words = {
        1, { { kd_scene_is_radio_alone(scene) ? KD_LAYER_specific_intensity : KD_LAYER_intensity, -1 } }
    };
    for (uint32_t n = 0; n < r->orders; n++)
        words.at[words.count++] = (struct kd_numbered_word) { KD_LAYER_intensity, (int16_t)n };
    return words;
}

struct kd_scene kd_integral_scene(const struct kd_integral_request *r, unsigned picture)
{
    struct kd_scene scene = r->what == KD_INTEGRAL_SETS ? r->sets->at[r->sets->first[picture]].scene : *r->scene;
    const double w = scene.image.width, h = scene.image.height,
                 size = r->pixels * (kd_integral_is_finer(r, picture) ? KD_INTEGRAL_FINER : 1) / fmax(w, h);
    scene.image.width = (int32_t)fmax(1, rint(w * size)), scene.image.height = (int32_t)fmax(1, rint(h * size));
    scene.style.beam_uas = 0; /* without a telescope's beam */
    scene.style.bloom = 0;
    if (kd_integral_is_mapped(r->what)) {
        scene.image.layers = layers_of(r, &scene);
    } else {
        /* Keeps the scene's own frequency as the one at which matter is normalised to the flux, so that the matter is
         * the same at all frequencies. */
        scene.volume.normalise_ghz =
            isfinite(scene.volume.normalise_ghz) ? scene.volume.normalise_ghz : r->scene->volume.frequency_ghz;
        kd_scene_set_frequency(&scene, r->frequencies_hz.at[picture / (r->unchecked ? 1 : 2)] * 1e-9);
    }
    return scene;
}

void kd_integral_name_set(const struct kd_integral_request *r, unsigned picture, enum kd_status status,
                          struct kd_error *error)
{
    if (r->what != KD_INTEGRAL_SETS || status != KD_EINVAL || !error || picture >= r->sets->pictures)
        return;
    const struct kd_error inner = *error;
    const unsigned row = r->sets->at[r->sets->first[picture]].row;
    char pointer[40];
    snprintf(pointer, sizeof pointer, "/sets/%u", row);
    kd_error_field(error, pointer, "set %u: %.400s", row, inner.message);
}

double kd_integral_pixel(const struct kd_scene *scene)
{
    return kd_camera_pixel(scene) * kd_scale_microarcseconds(scene->spacetime.mass_msun, scene->spacetime.distance_pc) *
           RADIANS_PER_UAS;
}

double kd_integral_nyquist_gl(const struct kd_scene *scene) { return 0.5e-9 / kd_integral_pixel(scene); }

static enum kd_status encode_maps(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                                  struct kd_buffer *out, struct kd_error *error)
{
    (void)effort, (void)memory;
    for (size_t i = 0; i < picture->plan->picture.n_layers; i++) {
        char name[KD_LAYER_NAME];
        kd_layer_name(picture->plan->picture.layers[i], name);
        const struct kd_layer *layer = kd_frame_layer(picture->frame, name);
        if (!layer)
            return kd_error_set(error, KD_EINVAL, "the frame has no layer %s", name);
        if (kd_buffer_append(out, layer->data, (size_t)picture->frame->width * picture->frame->height * sizeof(float)))
            return kd_error_set(error, KD_ENOMEM, "out of memory for a map of %u x %u pixels", picture->frame->width,
                                picture->frame->height);
    }
    return KD_OK;
}

static enum kd_status encode_flux(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                                  struct kd_buffer *out, struct kd_error *error)
{
    const double jy = kd_flux_jy(picture->scene, picture->frame);
    (void)effort, (void)memory;
    return kd_buffer_append(out, &jy, sizeof jy) ? kd_error_set(error, KD_ENOMEM, "out of memory for a number") : KD_OK;
}

const struct kd_format *kd_integral_picture_format(enum kd_integral what)
{
    static const struct kd_format maps = { .name = "maps",
                                           .media_type = KD_BYTES_TYPE,
                                           .magic = "",
                                           .carries = KD_CARRIES_LAYERS,
                                           .encode = encode_maps },
                                  flux = { .name = "flux",
                                           .media_type = KD_BYTES_TYPE,
                                           .magic = "",
                                           .carries = KD_CARRIES_LIGHT,
                                           .encode = encode_flux };
    return kd_integral_is_mapped(what) ? &maps : &flux;
}

enum kd_status kd_integral_plan(const struct kd_integral_request *r, struct kd_scene *scene,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    enum kd_status status = kd_format_plan(kd_integral_picture_format(r->what), scene, capacity, out, error);
    out->light.shape.width = (uint32_t)r->scene->image.width,
    out->light.shape.height = (uint32_t)r->scene->image.height;
    return status;
}

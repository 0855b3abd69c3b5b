/* The light of a plan: its emitters, the method by which light is found along rays, and the measurements that are
 * made of the light. Plain data and pure functions; any thread. */
#ifndef KD_RENDER_PLAN_LIGHT_H
#define KD_RENDER_PLAN_LIGHT_H

#include "render/plan/capacity.h"
#include "render/plan/layer_kinds.h"
#include "render/plan/march.h"

#include <stdbool.h>
#include <stdint.h>

/* at least the number of emitters in shaders/shared/emitters.h, which this header does not include */
#define KD_PLAN_EMITTERS 18

struct kd_plan_light {
    uint32_t traits[KD_PLAN_EMITTERS]; /* traits of the emitters; 0 for emitters that the scene does not have */
    bool points;                       /* true if some emitter consists of points of light */
    /* true if only bright images of points are made, and none next to the critical curve */
    bool bright;
    bool apart; /* true if the luminance of some emitter is kept beside the radiance */
    /* numbers stored for a pixel after its radiance. Stokes Q, U and V are stored if polarised light is measured or
     * marched layers need them; Q and U of the separate luminance may follow. 0: none */
    uint32_t stokes_words;
    struct kd_march march; /* the march for volumes and bodies; all 0: the scene has none, and light follows from the
                            * lens map alone */
    bool meets;            /* true if the scene has bodies */
    bool photometry;       /* true if flux and centroid are measured */
    /* for a scene that names the flux of matter: true if a density found from another viewpoint may be reused
     * (frame/normalise.h) */
    bool reuse_normalisation;
    struct {
        uint32_t width, height;
    } shape; /* shape of the picture for which the density of a requested flux is found. 0: this picture's own shape,
                whose aspect ratio is rounded to whole pixels */
};

/* True if the sky has light in every direction, such as that of a grid or of the Milky Way (KD_TRAIT_SPREAD). False if
 * it has only points of light, such as stars. */
bool kd_plan_is_spread(const struct kd_plan_light *light);

/* kd_plan_light_pass: the pass that computes the light of rays. kd_plan_light_ns: the time of that pass for one ray,
 * in ns. */
static inline enum kd_pass_id kd_plan_light_pass(const struct kd_plan_light *light)
{
    return light->march.steps ? KD_PASS_MARCH : KD_PASS_TRANSFER;
}
/* Under a sky of stars the diffuse light is read as well, which takes several times as long as a disk. */
static inline enum kd_figure_id kd_plan_light_figure(const struct kd_plan_light *light)
{
    return light->march.steps ? KD_NS_RAY_MARCH : light->points ? KD_NS_SAMPLE_STARS : KD_NS_SAMPLE_TRANSFER;
}
static inline double kd_plan_light_ns(const struct kd_plan_light *light, const struct kd_capacity *c)
{
    return (light->march.steps ? light->march.weight : 1) * c->ns[kd_plan_light_figure(light)];
}

/* Bytes of a pixel of linear light, including everything stored after the radiance. */
#define KD_PLAN_STOKES 3
static inline uint64_t kd_plan_pixel_bytes(const struct kd_plan_light *light)
{
    return 4ull * ((light->apart ? 4 : 3) + light->stokes_words);
}

/* True if Q and U of the separate luminance are kept. */
static inline bool kd_plan_stokes_apart(const struct kd_plan_light *light)
{
    return light->stokes_words > KD_PLAN_STOKES;
}

/* True if a layer is computed from the numbers that the march stores while it makes the picture. If not, rays are
 * traced for the layer. */
static inline bool kd_plan_gathers(const struct kd_plan_light *light, int kind)
{
    return light->march.steps && kd_layer_kinds[kind].of == KD_OF_LIGHT;
}

#endif

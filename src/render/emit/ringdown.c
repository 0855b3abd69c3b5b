/* Ringdown of a struck hole as a factor of light: shaders/emit/ringdown.glsl. */
#include "physics/spacetime/hole.h"
#include "render/emit/emitter.h"

#include "physics/waves/ringdown.h"

#include <math.h>

/* The least relative change of luminance that counts. sRGB converts a relative change d of luminance to at most 112
 * d steps of 8 bits, so this limit is a tenth of a step. */
#define SEEN (1. / 1024)

static bool present(const struct kd_scene *scene)
{
    return scene->style.ringdown > 0 && (kd_emit_at_crossings(scene) || kd_emit_along(scene));
}

/* Returns KD_DIMS_WITH_TIME while the rings still change with time. Beyond a = 0.99 the fit decays up to a fifth too
 * fast. So a change of a third of an 8-bit step may remain when the result becomes 0. */
static unsigned varies(const struct kd_scene *scene)
{
    double since = scene->top.time - scene->style.ringdown_time;
    if (since < 0 || (scene->accuracy.orders < 2 && !kd_emit_along(scene))) /* a march includes all orders */
        return 0;
    const struct kd_ringdown_fit mode = kd_ringdown_fit(0, kd_hole(fabs(scene->spacetime.spin)));
    return scene->style.ringdown * exp(-mode.omega_re / (2 * mode.quality) * since) > SEEN ? KD_DIMS_WITH_TIME : 0;
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    double wave;
    out->ringdown.factor = (float)(kd_scene_ringdown(scene, &wave) ? 1 + scene->style.ringdown * wave : 1);
}

static bool along(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, kd_emit_along(scene);
}

static const struct kd_sentence sentences[] = {
    { "ringdown.drawn",
      "ringdown: an illustration, which modulates only the light of image orders 1 and up, at the picture's time; the "
      "metric of a ringing hole is not computed",
      NULL },
    { "ringdown.order",
      "ringdown: light of volumes has the image order of the crossing of the plane nearest to it along its ray; orders "
      "change at the turning points of cos(theta)",
      along },
};

const struct kd_emitter kd_emit_ringdown = {
    .name = "ringdown",
    .title = "ringdown",
    .present = present,
    .varies = varies,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(style), KD_SCENE_PART(top) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

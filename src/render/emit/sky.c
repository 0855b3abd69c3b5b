/* The drawn celestial grid: shaders/emit/sky.glsl. */
#include "render/emit/emitter.h"

#include "render/emit/sky_noise.h"

#include <math.h>
#include <stdio.h>

static bool present(const struct kd_scene *scene) { return scene->sky.model != KD_SKY_NONE && scene->sky.brightness > 0; }

static uint32_t needs(const struct kd_scene *scene)
{
    (void)scene;
    return KD_LENS_SKY;
}

static unsigned varies(const struct kd_scene *scene)
{
    (void)scene;
    return KD_MOVES_WITH_AZIMUTH;
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    (void)scene;
    snprintf(out, KD_EMIT_TOLD, "A celestial grid behind.");
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    out->sky = (struct kd_sky_block) {
        .brightness = (float)scene->sky.brightness,
        .spacing = (float)(scene->sky.grid_deg * (M_PI / 180)),
    };
}

static bool noise(const struct kd_scene *scene, const struct kd_setting *rays) { return kd_sky_is_noise(scene, rays->precision); }

static const struct kd_sentence sentences[] = {
    { "sky: a drawn celestial grid; its lensing is exact, its brightness carries no redshift", NULL },
    { "sky: from so near the horizon it is noise: for most pixels that see it the next one, or the last digit of the ray's constants, leads "
      "more than 0.1 rad away", noise },
};

const struct kd_emitter kd_emit_sky = {
    .name = "sky",
    .title = "sky",
    .tell = tell,
    .present = present,
    .needs = needs,
    .varies = varies,
    .fill = fill,
    .depends = { KD_SCENE_PART(sky) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

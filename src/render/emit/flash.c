/* The echo of a flash as an emitter: shaders/emit/flash.glsl. */
#include "render/emit/emitter.h"

#include "render/emit/particles.h"

#include <math.h>
#include <stdio.h>

extern const struct kd_emitter kd_emit_lamp;

static bool present(const struct kd_scene *scene) { return scene->flash.brightness > 0; }

static uint32_t traits(const struct kd_scene *scene)
{
    return kd_orbit_traits(scene) | (scene->disk.slow_light ? KD_TRAIT_SLOW : 0) |
           (scene->disk.atmosphere ? KD_TRAIT_LIMB : 0);
}

static uint32_t needs(const struct kd_scene *scene)
{
    return kd_disk_needs(scene) | (scene->disk.slow_light ? KD_LENS_DELAY : 0);
}

static unsigned varies(const struct kd_scene *scene) { return (void)scene, KD_MOVES_WITH_TIME; }

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_flash *f = &scene->flash;
    const double since = scene->top.time - kd_particle_delay(scene) - f->start;
    out->flash = (struct kd_flash_block) {
        .since = (float)(f->period > 0 ? remainder(since, f->period) : since),
        .sharp = (float)(M_LOG2E / (2 * f->duration * f->duration)),
        .period = (float)f->period,
        .per_period = (float)(f->period > 0 ? 1 / f->period : 0),
        .brightness = (float)f->brightness,
        .power = (float)(3 + f->index),
        .temperature = (float)f->temperature_k,
    };
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    snprintf(out, KD_EMIT_TOLD, "The echo of a flash at %.6g M on the axis.", scene->flash.height);
}

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(isotropic, !scene->disk.atmosphere)
WHEN(without_shift, scene->disk.model == KD_DISK_NONE && (!scene->disk.doppler || !scene->disk.redshift))
WHEN(fast, !scene->disk.slow_light)

static const struct kd_sentence sentences[] = {
    { "flash.drawn",
      "flash: the gas of the thin disk shines without delay, in proportion to the light that it receives from the "
      "lamp; this light has a power-law spectrum and the redshift of the gas, and fades out at the outer edge as the "
      "disk does; its brightness, its colour and the Gaussian course in time are chosen, not computed",
      NULL },
    { "flash.isotropic", "flash: the lit gas shines isotropically, without limb darkening", isotropic },
    { "flash.no-shift", "flash: the Doppler shift or the gravitational redshift of the gas is switched off",
      without_shift },
    { "flash.fast",
      "flash: the echo is shown at one coordinate time, and the delay of its light to the observer is ignored (fast "
      "light)",
      fast },
};

const struct kd_emitter kd_emit_flash = {
    .name = "flash",
    .title = "echo of a flash",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = varies,
    .reach = kd_disk_reach,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(camera), KD_SCENE_PART(disk), KD_SCENE_PART(flash),
                 KD_SCENE_PART(top) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .reads = &kd_emit_lamp,
};

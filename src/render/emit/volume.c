/* A uniform shell of matter as an emitter: shaders/emit/volume.glsl. */
#include "render/emit/emitter.h"

#include <stdio.h>

static bool present(const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    return v->model == KD_VOLUME_UNIFORM && (v->emissivity > 0 || v->opacity > 0);
}

static uint32_t traits(const struct kd_scene *scene) { return scene->volume.redshift ? KD_TRAIT_REDSHIFT : 0; }

static void reach(const struct kd_scene *scene, double radii[2])
{
    radii[0] = kd_scene_volume_inner(scene);
    radii[1] = scene->volume.outer;
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    snprintf(out, KD_EMIT_TOLD, "Matter all round from %.6g M to %.6g M.", kd_scene_volume_inner(scene),
             scene->volume.outer);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    out->volume = (struct kd_volume_block) {
        .inner = (float)kd_scene_volume_inner(scene),
        .outer = (float)v->outer,
        .emissivity = (float)v->emissivity,
        .opacity = (float)v->opacity,
        .temperature = (float)v->temperature_k,
    };
}

static bool unshifted(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, !scene->volume.redshift;
}

static const struct kd_sentence sentences[] = {
    { "volume.made-up",
      "volume: the matter is invented and uniform; it is at rest relative to observers of zero angular momentum and "
      "ends 1 % outside the horizon; it is grey, with the colour of a chosen temperature; its light is bolometric, "
      "whatever disk.band is",
      NULL },
    { "volume.no-shift",
      "volume: the frequency shift of the matter is switched off; lengths are measured by the observer's affine "
      "parameter",
      unshifted },
};

const struct kd_emitter kd_emit_volume = {
    .name = "volume",
    .title = "volume",
    .tell = tell,
    .present = present,
    .traits = traits,
    .reach = reach,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(volume) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

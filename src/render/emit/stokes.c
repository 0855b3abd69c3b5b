/* This is how light of a volume at a radio frequency is polarised, and what becomes of that on its way: shaders/emit/stokes.glsl. It shines nowhere itself. */
#include "render/emit/emitter.h"

#include <math.h>

static bool present(const struct kd_scene *scene) { return scene->polarization.model == KD_POLARIZATION_TRANSFER; }

static uint32_t traits(const struct kd_scene *scene) { return scene->polarization.faraday ? KD_TRAIT_STOKES_FARADAY : 0; }

/* Jones & O'Dell 1977: of electrons gamma^-p, by the share (p - 1)/(gamma_min^(1 - p) - gamma_max^(1 - p)) of them at gamma = 1. */
static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    const double p = v->electrons_index, least = v->gamma_min, most = fmax(v->gamma_max, 1.001 * least);
    const double share = (p - 1) / (pow(least, 1 - p) - pow(most, 1 - p)), slow = fmax(log(least), 1e-30);
    out->stokes.turn = (float)log2(2 * (p + 2) / (p + 1) * share * pow(least, -(p + 1)) * slow);
    out->stokes.convert = (float)log2(share * pow(least, 2 - p));
    out->stokes.gamma2 = (float)(2 * log2(least));
    out->stokes.whole = (float)scene->polarization.order;
}

static bool turns(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, scene->polarization.faraday; }
static bool turns_not(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, !scene->polarization.faraday; }
static bool is_thermal(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, scene->volume.electrons == KD_VOLUME_THERMAL; }
static bool is_power(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, scene->volume.electrons == KD_VOLUME_POWER_LAW; }
static bool is_disordered(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, scene->polarization.order < 1; }

static const struct kd_sentence sentences[] = {
    { "polarization: Stokes I, Q, U and V of the volume together, in coefficients that are the same over each short stretch; I is not that of unpolarised transfer", NULL },
    { "polarization: thermal synchrotron light by the fits of Pandya et al. 2016 and Dexter 2016 (V); where the field lies along the ray, and where electrons are not hot, V is held to what leaves 99 % of I polarised", is_thermal },
    { "polarization: synchrotron light of a power law by the fits of Pandya et al. 2016, held to 99 % of I", is_power },
    { "polarization: Faraday rotation and conversion of those electrons alone (Shcherbakov 2008, Dexter 2016; Jones & O'Dell 1977): none is cold", turns },
    { "polarization: Faraday rotation and conversion are left out", turns_not },
    { "polarization: disorder of the field makes linear polarisation less where it is made, where it is absorbed and where it is converted; Faraday rotation is that of a field in order", is_disordered },
};

const struct kd_emitter kd_emit_stokes = {
    .name = "stokes",
    .title = "Stokes transfer",
    .present = present,
    .traits = traits,
    .fill = fill,
    .depends = { KD_SCENE_PART(polarization), KD_SCENE_PART(volume) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

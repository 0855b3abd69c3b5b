/* Polarisation of light from a volume at a radio frequency, and its transfer along the ray:
 * shaders/emit/stokes.glsl. This emitter adds no light of its own. */
#include "render/emit/emitter.h"

#include "physics/disk/synchrotron.h"

#include <math.h>

static bool present(const struct kd_scene *scene) { return scene->polarization.model == KD_POLARIZATION_TRANSFER; }

static bool has_dexters(const struct kd_scene *scene) { return scene->polarization.rotation == KD_ROTATION_DEXTER; }

static uint32_t traits(const struct kd_scene *scene)
{
    return (scene->polarization.faraday ? KD_TRAIT_STOKES_FARADAY : 0) |
           (has_dexters(scene) ? KD_TRAIT_STOKES_DEXTER : 0);
}

/* least kappa of the fits in Marszewski et al. 2021, which are given in steps of one half up to 5 */
#define KAPPA_FIRST 3.5
#define KAPPA_INTERVALS 3

static void fill_kappa(struct kd_stokes_block *out, double kappa)
{
    const struct kd_synchrotron_kappa_polarised k = kd_synchrotron_kappa_polarised(kappa);
    const double place = fmin(fmax(2 * (kappa - KAPPA_FIRST), 0), KAPPA_INTERVALS),
                 node = fmin(floor(place), KAPPA_INTERVALS - 1);
    out->kappa_light_q = (float)k.light_q_high;
    out->kappa_light_q_sharp = (float)k.light_q_sharp;
    out->kappa_light_v_low = (float)k.light_v_low;
    out->kappa_light_v_high = (float)k.light_v_high;
    out->kappa_depth_q = (float)k.depth_q_high;
    out->kappa_depth_q_sharp = (float)k.depth_q_sharp;
    out->kappa_depth_v_low = (float)k.depth_v_low;
    out->kappa_depth_v_high = (float)k.depth_v_high;
    out->kappa_depth_v_sharp = (float)k.depth_v_sharp;
    out->kappa_node = (uint32_t)node;
    out->kappa_past = (float)(place - node);
}

static void reach(const struct kd_scene *scene, double radii[2]) { (void)scene, radii[0] = INFINITY, radii[1] = 0; }

/* Jones & O'Dell 1977, for electrons whose number falls as gamma^-p. The normalised distribution is gamma^-p times (p -
 * 1)/(gamma_min^(1 - p) - gamma_max^(1 - p)). */
static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    const double p = v->electrons_index, least = v->gamma_min, most = fmax(v->gamma_max, 1.001 * least);
    const double share = (p - 1) / (pow(least, 1 - p) - pow(most, 1 - p)), slow = fmax(log(least), 1e-30);
    out->stokes.turn = (float)log2(2 * (p + 2) / (p + 1) * share * pow(least, -(p + 1)) * slow);
    out->stokes.convert = (float)log2(share * pow(least, 2 - p));
    out->stokes.gamma2 = (float)(2 * log2(least));
    out->stokes.whole = (float)scene->polarization.order;
    fill_kappa(&out->stokes, v->kappa);
}

static bool turns(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->polarization.faraday;
}
static bool turns_not(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, !scene->polarization.faraday;
}
static bool is_thermal(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.electrons == KD_VOLUME_THERMAL;
}
static bool is_power(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.electrons == KD_VOLUME_POWER_LAW;
}
static bool is_kappa(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.electrons == KD_VOLUME_KAPPA;
}
static bool turns_kappa(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return turns(scene, rays) && is_kappa(scene, rays);
}
static bool turns_dexters(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return turns(scene, rays) && is_thermal(scene, rays) && has_dexters(scene);
}
static bool turns_others(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return turns(scene, rays) && !is_kappa(scene, rays) && !turns_dexters(scene, rays);
}
static bool is_disordered(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->polarization.order < 1;
}

static const struct kd_sentence sentences[] = {
    { "stokes.slabs",
      "polarization: Stokes I, Q, U and V of the volume are transferred together, with coefficients that are "
      "constant over each short step; I differs from that of unpolarised transfer",
      NULL },
    { "stokes.thermal",
      "polarization: thermal synchrotron light follows the fits of Pandya et al. 2016, and its V that of Dexter 2016; "
      "if the field is along the ray, or electrons are not hot, V is limited so that at most 99 % of I is polarised",
      is_thermal },
    { "stokes.power",
      "polarization: synchrotron light of a power law follows the fits of Pandya et al. 2016; at most 99 % of I is "
      "polarised",
      is_power },
    { "stokes.kappa",
      "polarization: synchrotron light of a kappa distribution follows the fits of Pandya et al. 2016, whose V is for "
      "hot electrons only; at most 99 % of I is polarised",
      is_kappa },
    { "stokes.faraday",
      "polarization: only the electrons that shine cause Faraday rotation and conversion (Shcherbakov 2008, Dexter "
      "2016; Jones & O'Dell 1977); there are no cold electrons",
      turns_others },
    { "stokes.faraday-dexter",
      "polarization: only the electrons that shine cause Faraday rotation and conversion (Dexter 2016; rotation below "
      "Theta = 1/2 by Shcherbakov 2008); there are no cold electrons",
      turns_dexters },
    { "stokes.faraday-kappa",
      "polarization: Faraday rotation and conversion of a kappa distribution follow only the fits of Marszewski et al. "
      "2021, which are for frequencies above 100 gyrofrequencies and above 0.1 (kappa w)^2 sin(theta) gyrofrequencies; "
      "between kappa 3.5, 4, 4.5 and 5 the fits are interpolated",
      turns_kappa },
    { "stokes.no-faraday", "polarization: Faraday rotation and conversion are left out", turns_not },
    { "stokes.disorder",
      "polarization: disorder of the field reduces linear polarisation in emission, absorption and conversion; "
      "Faraday rotation is that of an ordered field",
      is_disordered },
};

const struct kd_emitter kd_emit_stokes = {
    .name = "stokes",
    .title = "Stokes transfer",
    .present = present,
    .traits = traits,
    .reach = reach,
    .fill = fill,
    .depends = { KD_SCENE_PART(polarization), KD_SCENE_PART(volume) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

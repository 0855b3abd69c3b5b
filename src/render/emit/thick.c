/* The smooth disk's gas with a height as an emitter: shaders/emit/thick.glsl. */
#include "render/emit/emitter.h"

#include <math.h>

extern const struct kd_emitter kd_emit_gas;

static bool present(const struct kd_scene *scene)
{
    int model = scene->disk.model;
    return (model == KD_DISK_NOVIKOV_THORNE || model == KD_DISK_SHAKURA_SUNYAEV) && scene->disk.height > 0;
}

static bool stirs(const struct kd_scene *scene) { return scene->gas.amplitude > 0; }

static uint32_t traits(const struct kd_scene *scene)
{
    return kd_disk_traits(scene) | (scene->disk.emission_opacity > 0 ? KD_TRAIT_GAS_DEEP : 0) |
           (stirs(scene) ? KD_TRAIT_AZIMUTH | (scene->disk.slow_light ? KD_TRAIT_SLOW : 0) |
                               (uint32_t)scene->gas.octaves << KD_TRAIT_GAS_SHIFT
                         : 0);
}

/* Crossings are searched even for smooth gas, whose light the march makes. Its images at the critical curve are thin,
 * and refinement needs a lens map (kd_plan_adapt). */
static uint32_t needs(const struct kd_scene *scene)
{
    return KD_LENS_W | (stirs(scene) ? KD_LENS_PHI | KD_LENS_SHAPE : 0);
}

static unsigned varies(const struct kd_scene *scene) { return stirs(scene) ? kd_orbit_varies(scene) : 0; }

/* H/R is monotone in R, so it is largest at one of the edges. */
static double height(const struct kd_scene *scene)
{
    double radii[2], most = 0;
    kd_disk_reach(scene, radii);
    for (int i = 0; i < 2; i++)
        most = fmax(most, KD_THICK_REACH * scene->disk.height * pow(radii[i] / 10, scene->disk.flare));
    return most / sqrt(1 + most * most);
}

/* The radius at which the outer fade begins. Inside this radius an opaque disk transmits e^-depth. Outside it the
 * disk transmits the faded fraction, so the optical depth varies as a logarithm of that fraction. */
static double knot(const struct kd_scene *scene)
{
    const double r = scene->disk.outer * (1 - scene->disk.taper);
    return scene->disk.taper > 0 && r > kd_disk_inner(scene) ? r : 0;
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    kd_disk_tell(scene, stirs(scene) ? "thick disk of turbulent gas" : "thick disk", out);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    out->thick = (struct kd_thick_block) {
        .height = (float)scene->disk.height,
        .flare = (float)scene->disk.flare,
        .inner = (float)kd_disk_inner(scene),
        .outer = (float)scene->disk.outer,
    };
}

static bool by_profile(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, stirs(scene) && !isfinite(scene->accuracy.tolerance);
}

static const struct kd_sentence sentences[] = {
    { "thick.height",
      "thick disk: it has a Gaussian profile of a chosen height, and the thin disk's temperature, flux and optical "
      "depth at each distance from the axis; it is not a torus in equilibrium, and it ends at 4.5 heights",
      NULL },
    { "thick.rotation",
      "thick disk: at any height its gas has the angular velocity of the circular orbit in the plane at its "
      "distance from the axis",
      NULL },
    { "thick.black-body",
      "thick disk: emission and absorption are integrated along each ray, without scattering; at any height the source "
      "is a black body of the thin disk's temperature",
      NULL },
    { "thick.tolerance",
      "thick disk: light through its turbulence has an error of 2e-2, 1e-2, 1e-3, 1e-4 or 5e-5 for accuracy.profile "
      "from draft to reference, larger than through smooth volumes",
      by_profile },
};

const struct kd_emitter kd_emit_thick = {
    .name = "thick",
    .title = "thick disk",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = varies,
    .reach = kd_disk_reach,
    .height = height,
    .knot = knot,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(disk) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
    .kind = &kd_emit_gas,
    .reads = &kd_emit_gas,
};

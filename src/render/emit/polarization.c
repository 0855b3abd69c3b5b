/* Polarisation of light from the plane: shaders/emit/polarization.glsl. This emitter adds no light of its own. */
#include "render/emit/emitter.h"

#include "physics/disk/scattering.h"

#include <math.h>

static bool present(const struct kd_scene *scene)
{
    return scene->polarization.model != KD_POLARIZATION_NONE && scene->polarization.model != KD_POLARIZATION_TRANSFER &&
           kd_emit_at_crossings(scene);
}

static bool scatters(const struct kd_scene *scene) { return scene->polarization.model == KD_POLARIZATION_SCATTERING; }

static uint32_t traits(const struct kd_scene *scene)
{
    if (scatters(scene))
        return KD_TRAIT_SCATTERED;
    return scene->polarization.field == KD_FIELD_RADIAL     ? KD_TRAIT_RADIAL
           : scene->polarization.field == KD_FIELD_VERTICAL ? KD_TRAIT_VERTICAL
                                                            : 0;
}

static uint32_t needs(const struct kd_scene *scene) { return (void)scene, KD_LENS_W | KD_LENS_SLOPE; }

static void reach(const struct kd_scene *scene, double radii[2]) { (void)scene, radii[0] = INFINITY, radii[1] = 0; }

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const double p = scene->polarization.electron_index,
                 whole = scatters(scene) ? 1 : (p + 1) / (p + 7. / 3); /* Rybicki & Lightman 1979, equation 6.38b */
    out->polarization.fraction = (float)(scene->polarization.order * whole);
}

/* The argument of the table is the square root of the cosine, because the degree of polarisation is a smooth function
   of that root. */
static void tables(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    double mu[KD_SCATTERING_ROWS + 1];
    struct kd_scattered light[KD_SCATTERING_ROWS + 1];
    (void)scene;
    for (int i = 0; i <= KD_SCATTERING_ROWS; i++)
        mu[i] = (double)i * i / (KD_SCATTERING_ROWS * KD_SCATTERING_ROWS);
    kd_scattered_light(mu, KD_SCATTERING_ROWS + 1, light);
    for (int i = 0; i < KD_SCATTERING_ROWS; i++)
        for (int k = 0; k < 2; k++)
            out->scattering[i][k] = (float)kd_scattered_fraction(&light[i + k]);
}

static bool by_field(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, !scatters(scene);
}
static bool is_darkened(const struct kd_scene *scene) { return scene->disk.atmosphere == KD_ATMOSPHERE_SCATTERING; }
static bool by_electrons(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scatters(scene) && !is_darkened(scene);
}
static bool by_atmosphere(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scatters(scene) && is_darkened(scene);
}
static bool beside(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, kd_emit_along(scene) || kd_emit_met(scene) || kd_emit_at_ends(scene);
}

static const struct kd_sentence sentences[] = {
    { "polarization.plane",
      "polarization: all light from the plane is polarised by the field in the frame of the gas; Faraday rotation on "
      "its way is ignored",
      NULL },
    { "polarization.field",
      "polarization: the field determines only the direction and the fraction of synchrotron polarisation; brightness "
      "and colour are those of the disk, whatever the angle to the field",
      by_field },
    { "polarization.scatter",
      "polarization: the fraction of scattered light is that of a deep, plane atmosphere of electrons (Chandrasekhar "
      "1960); its limb darkening, and the polarisation of light that returned to the disk, are ignored",
      by_electrons },
    { "polarization.darkened",
      "polarization: brightness and fraction of scattered light are those of a deep, plane atmosphere of electrons "
      "(Chandrasekhar 1960); light that returned to the disk is polarised like the disk's own light",
      by_atmosphere },
    { "polarization.none", "polarization: light of volumes, bodies and the sky is unpolarised", beside },
};

const struct kd_emitter kd_emit_polarization = {
    .name = "polarization",
    .title = "polarisation",
    .present = present,
    .traits = traits,
    .needs = needs,
    .reach = reach,
    .fill = fill,
    .tables = tables,
    .depends = { KD_SCENE_PART(polarization) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

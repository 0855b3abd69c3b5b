/* The smooth disk as an emitter: shaders/emit/disk.glsl. */
#include "render/emit/emitter.h"

#include "physics/disk/colour.h"
#include "physics/disk/limb.h"
#include "physics/disk/returning.h"
#include "physics/disk/thin_disk.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>

static bool present(const struct kd_scene *scene)
{
    return scene->disk.model != KD_DISK_NONE && scene->disk.model != KD_DISK_PARTICLES && scene->disk.height == 0;
}

uint32_t kd_disk_needs(const struct kd_scene *scene)
{
    return KD_LENS_W | (scene->disk.atmosphere && scene->camera.projection == KD_PROJECTION_RING ? KD_LENS_SLOPE : 0);
}

static bool reflects(const struct kd_scene *scene)
{
    return scene->disk.returning == KD_RETURNS_REFLECTED && scene->disk.albedo > 0;
}

uint32_t kd_disk_traits(const struct kd_scene *scene)
{
    return kd_orbit_traits(scene) | (scene->disk.band == KD_BAND_VISIBLE ? KD_TRAIT_VISIBLE : 0) |
           (scene->disk.band == KD_BAND_FREQUENCY ? KD_TRAIT_FREQUENCY : 0) |
           (scene->disk.atmosphere ? KD_TRAIT_LIMB : 0) | (reflects(scene) ? KD_TRAIT_REFLECTED : 0);
}

/* The law of limb darkening of a scene's disk. */
static enum kd_limb limb_of(const struct kd_scene *scene)
{
    return scene->disk.atmosphere == KD_ATMOSPHERE_LAOR         ? KD_LIMB_LAOR
           : scene->disk.atmosphere == KD_ATMOSPHERE_SCATTERING ? KD_LIMB_SCATTERING
                                                                : KD_LIMB_ISOTROPIC;
}

/* The flux of a scene's disk, divided by Mdot. If light returns to the disk, the flux comes from a table. */
struct profile {
    struct kd_hole hole;
    kd_disk_flux_fn own;
    double largest;
    bool returns;
    struct kd_returning returning;
};

static struct profile profile_of(const struct kd_scene *scene)
{
    const bool newton = scene->disk.model == KD_DISK_SHAKURA_SUNYAEV;
    struct profile p = { .hole = *kd_scene_hole(scene),
                         .own = newton ? kd_disk_flux_shakura_sunyaev : kd_disk_flux_page_thorne,
                         .returns = scene->disk.returning };
    if (p.returns)
        kd_returning_init(&p.returning, &p.hole, limb_of(scene));
    p.largest =
        p.returns ? p.returning.largest
                  : p.own(&p.hole, newton ? kd_disk_peak_shakura_sunyaev(&p.hole) : kd_disk_peak_page_thorne(&p.hole));
    return p;
}

static double flux_at(const struct profile *p, double r)
{
    return p->returns ? kd_returning_flux(&p->returning, r) : p->own(&p->hole, r);
}

double kd_disk_peak_temperature(const struct kd_scene *scene)
{
    if (scene->disk.colour == KD_COLOUR_PEAK)
        return scene->disk.peak_temperature_k;
    const struct kd_hole *hole = kd_scene_hole(scene);
    const double flux = scene->disk.returning ? kd_returning_largest(hole, limb_of(scene)) : profile_of(scene).largest;
    return kd_disk_temperature(flux, hole, scene->spacetime.mass_msun, scene->disk.mdot_edd);
}

void kd_disk_heats(const struct kd_scene *scene, size_t n, const double r[], double out[])
{
    const struct profile p = profile_of(scene);
    const double isco = kd_kerr_isco(&p.hole), wide = fmax(scene->disk.outer * scene->disk.taper, 1e-6);
    for (size_t i = 0; i < n; i++) {
        const double f = fmin(fmax((scene->disk.outer - r[i]) / wide, 0), 1), fade = f * f * (3 - 2 * f);
        out[i] = r[i] > isco ? pow(scene->disk.opacity * fade * flux_at(&p, r[i]) / p.largest, 0.25) : 0;
    }
}

double kd_disk_inner(const struct kd_scene *scene)
{
    return isinf(scene->disk.inner) ? kd_kerr_isco(kd_scene_hole(scene)) : scene->disk.inner;
}

void kd_disk_reach(const struct kd_scene *scene, double radii[2])
{
    radii[0] = kd_disk_inner(scene);
    radii[1] = scene->disk.outer;
}

void kd_disk_tell(const struct kd_scene *scene, const char *noun, char out[KD_EMIT_TOLD])
{
    if (isinf(scene->disk.inner))
        snprintf(out, KD_EMIT_TOLD, "A %s from the ISCO to %.6g M.", noun, scene->disk.outer);
    else
        snprintf(out, KD_EMIT_TOLD, "A %s from %.6g M to %.6g M.", noun, scene->disk.inner, scene->disk.outer);
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD]) { kd_disk_tell(scene, "thin disk", out); }

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_disk *d = &scene->disk;
    double peak = kd_disk_peak_temperature(scene) * d->hardening;
    const double quanta = KD_H_J_S * d->frequency_ghz * 1e9 / (KD_K_J_K * peak);
    out->disk = (struct kd_disk_block) {
        .r_in = (float)kd_disk_inner(scene),
        .r_out = (float)d->outer,
        .fade = (float)(1 / fmax(d->outer * d->taper, 1e-6)),
        .opacity = (float)d->opacity,
        .peak = (float)peak,
        .luminous = (float)log2(fmax(kd_colour_luminous_fraction(peak), 1e-300)),
        .quanta = (float)quanta,
        .quanta_mean = (float)(-expm1(-quanta) / quanta),
    };
}

/* Computes the cubic through four values of a cell: at its ends, and at one and two thirds of its length. */
static void put_cubic(float out[4], const double f[4])
{
    out[0] = (float)f[0];
    out[1] = (float)(-5.5 * f[0] + 9 * f[1] - 4.5 * f[2] + f[3]);
    out[2] = (float)(9 * f[0] - 22.5 * f[1] + 18 * f[2] - 4.5 * f[3]);
    out[3] = (float)(-4.5 * f[0] + 13.5 * f[1] - 13.5 * f[2] + 4.5 * f[3]);
}

static void atmosphere_table(struct kd_emit_tables *out, enum kd_limb law)
{
    for (int i = 0; i < KD_ATMOSPHERE_ROWS; i++) {
        double f[4];
        for (int k = 0; k < 4; k++) {
            const double s = (i + k / 3.) / KD_ATMOSPHERE_ROWS;
            f[k] = kd_limb_at(law, s * s) * kd_limb_scale(law);
        }
        put_cubic(out->atmosphere[i], f);
    }
}

static void reflected_table(struct kd_emit_tables *out, const struct profile *p, int i, double r,
                            const struct kd_reflected *light)
{
    out->disk[i][2] = (float)(light->warm * pow(p->largest, -0.25));
    out->disk[i][3] = (float)(light->flux * pow(r, 3) / pow(light->warm, 4));
}

/* Tables over y = sqrt(1 - r_isco/r). As a function of y, T r^(3/4) is smooth and bounded. It is linear at the ISCO,
 * where the flux has a double zero. It is finite at infinity, where T falls as r^(-3/4). */
static void tables(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    const struct profile p = profile_of(scene);
    const double isco = kd_kerr_isco(&p.hole);
    struct kd_reflection reflection;
    if (reflects(scene))
        kd_reflection_init(&reflection, &p.returning, scene->disk.albedo);
    for (int i = 0; i < KD_DISK_TABLE; i++) {
        double y = fmin((double)i / (KD_DISK_TABLE - 1), 1 - 1e-6), r = isco / (1 - y * y), flux;
        if (reflects(scene)) {
            const struct kd_reflected light = kd_reflection_at(&reflection, &p.returning, r);
            reflected_table(out, &p, i, r, &light);
            flux = light.absorbed;
        } else {
            flux = flux_at(&p, r);
        }
        out->disk[i][0] = (float)(pow(flux / p.largest, 0.25) * pow(r, 0.75));
        if (i > 0)
            out->disk[i - 1][1] = out->disk[i][0] - out->disk[i - 1][0];
    }
    atmosphere_table(out, limb_of(scene));
}

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(thin, scene->disk.height == 0)
WHEN(isotropic, !scene->disk.atmosphere)
WHEN(darkened, scene->disk.atmosphere)
WHEN(without_returning, !scene->disk.returning)
WHEN(with_returning, scene->disk.returning)
WHEN(reflected, reflects(scene))
WHEN(newtonian, scene->disk.model == KD_DISK_SHAKURA_SUNYAEV)
WHEN(chosen_peak, scene->disk.colour == KD_COLOUR_PEAK)
WHEN(bolometric, scene->disk.band == KD_BAND_BOLOMETRIC)
WHEN(at_frequency, scene->disk.band == KD_BAND_FREQUENCY)
WHEN(beside, scene->disk.band == KD_BAND_FREQUENCY && !kd_scene_is_radio_alone(scene))
WHEN(without_doppler, !scene->disk.doppler)
WHEN(without_redshift, !scene->disk.redshift)
WHEN(fades, scene->disk.taper > 0)
WHEN(seen_through, scene->disk.opacity < 1)

static const struct kd_sentence sentences[] = {
    { "disk.thin",
      "disk: it is geometrically thin and lies in the equatorial plane; its gas moves on circular Kerr orbits and ends "
      "at the inner edge",
      thin },
    { "disk.isotropic", "disk: each element shines as an isotropic black body, without limb darkening", isotropic },
    { "disk.atmosphere",
      "disk: the limb darkening is that of a deep, plane atmosphere, and the same at all wavelengths; each element has "
      "the spectrum of a black body",
      darkened },
    { "disk.no-returning", "disk: light that the hole bends back to the disk is ignored", without_returning },
    { "disk.returning",
      "disk: returning light is computed for a smooth, opaque disk from the ISCO to infinity; it is absorbed with its "
      "angular momentum where it arrives, and radiated again",
      with_returning },
    { "disk.reflected",
      "disk: reflected light has the angular distribution and the angular momentum of the disk's own light; its "
      "spectrum is that of a dilute black body, whose temperature is the mean of the sources' temperatures as the gas "
      "sees them",
      reflected },
    { "disk.newtonian",
      "disk: its flux is that of the Newtonian thin disk, cut at the ISCO, instead of the Page-Thorne integral",
      newtonian },
    { "disk.temperature",
      "disk: the peak temperature is chosen for visibility, not computed from a mass and an accretion rate",
      chosen_peak },
    { "disk.bolometric", "disk: brightness is bolometric (g^4), colour is that of the visible part of the spectrum",
      bolometric },
    { "disk.frequency",
      "disk: brightness is the specific intensity at disk.frequency_ghz of a black body of the colour temperature, "
      "over the fourth power of disk.hardening; the hottest place has brightness 1 without a shift; the light is grey",
      at_frequency },
    { "disk.no-flux",
      "disk: light of one frequency is shown beside light of other kinds, on different scales of brightness; the "
      "picture has no flux",
      beside },
    { "disk.no-doppler", "disk: Doppler shift and beaming of the gas are switched off", without_doppler },
    { "disk.no-redshift", "disk: gravitational redshift and time dilation of the gas are switched off",
      without_redshift },
    { "disk.edge", "disk: the outer edge fades out over a chosen range", fades },
    { "disk.opacity", "disk: the opacity of a crossing is a chosen number, not computed from the gas", seen_through },
};

const struct kd_emitter kd_emit_disk = {
    .name = "disk",
    .title = "thin disk",
    .tell = tell,
    .present = present,
    .traits = kd_disk_traits,
    .needs = kd_disk_needs,
    .reach = kd_disk_reach,
    .fill = fill,
    .tables = tables,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(disk) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

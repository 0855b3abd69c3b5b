/* Matter at one radio frequency as an emitter: shaders/emit/plasma.glsl. */
#include "render/emit/emitter.h"

#include "physics/disk/synchrotron.h"
#include "physics/disk/torus.h"
#include "physics/math/constants.h"
#include "physics/spacetime/kerr.h"
#include "render/emit/matter_grid.h"
#include "render/emit/radio.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>

#define NEVER -1e6 /* log2 of zero */
#define GHZ 1e9
#define GOLD_GHZ 230 /* frequency to which the numbers of the analytic model refer */
#define ERG_CM3 0.1  /* one erg/(s cm^3), in W m^-3 */
#define PER_CM 100   /* one 1/cm, in 1/m */
#define CM3 1e6
#define GAUSS 1e-4 /* tesla */
#define EPSILON_0 KD_EPSILON_0

static bool present(const struct kd_scene *scene) { return kd_scene_is_radio(scene); }

static bool is_grid(const struct kd_scene *scene) { return scene->volume.model == KD_VOLUME_GRID; }
static bool has_grid(const struct kd_scene *scene) { return is_grid(scene) && *scene->volume.grid; }
static bool has_no_grid(const struct kd_scene *scene) { return is_grid(scene) && !*scene->volume.grid; }
static bool is_series(const struct kd_scene *scene) { return has_grid(scene) && scene->matter.frames > 1; }

/* A grid whose file has not been found yet may have several frames. */
static uint32_t grid_traits(const struct kd_scene *scene)
{
    const bool series = has_grid(scene) && scene->matter.frames != 1;
    return KD_TRAIT_PLASMA_GRID | KD_TRAIT_AZIMUTH | (series ? KD_TRAIT_PLASMA_SERIES : 0) |
           (series && kd_scene_is_slow_volume(scene) ? KD_TRAIT_SLOW : 0);
}

static uint32_t traits(const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    if (v->model == KD_VOLUME_GOLD)
        return KD_TRAIT_PLASMA_GOLD;
    const uint32_t kind = v->model == KD_VOLUME_TORUS  ? KD_TRAIT_PLASMA_TORUS
                          : v->model == KD_VOLUME_GRID ? grid_traits(scene)
                                                       : 0;
    return kind | (v->electrons == KD_VOLUME_KAPPA ? KD_TRAIT_PLASMA_KAPPA : 0) |
           (v->field == KD_VOLUME_VERTICAL ? KD_TRAIT_PLASMA_VERTICAL
            : v->field == KD_VOLUME_RADIAL ? KD_TRAIT_PLASMA_RADIAL
                                           : 0) |
           (v->flow == KD_VOLUME_REST && v->model == KD_VOLUME_RIAF ? KD_TRAIT_PLASMA_REST : 0) |
           (v->electrons == KD_VOLUME_POWER_LAW ? KD_TRAIT_PLASMA_POWER : 0);
}

static void reach(const struct kd_scene *scene, double radii[2])
{
    radii[0] = kd_scene_volume_inner(scene);
    radii[1] = scene->volume.outer;
    if (scene->volume.model == KD_VOLUME_TORUS)
        radii[1] = fmin(radii[1], kd_torus_of(kd_scene_hole(scene), radii[0], scene->volume.torus_radius).outer);
}

/* cos(theta) of the greatest height at which a layer is visible: KD_PLASMA_SEEN scale heights. The height in scale
 * heights is steep u/sin(theta), or gold_flattening u in the analytic model. */
static double height(const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    if (v->model == KD_VOLUME_GOLD)
        return KD_PLASMA_SEEN / fmax(v->gold_flattening, KD_PLASMA_SEEN);
    if (v->model == KD_VOLUME_GRID)
        return 1;
    if (v->model == KD_VOLUME_TORUS)
        return fmin(
            1.01 * kd_torus_of(kd_scene_hole(scene), kd_scene_volume_inner(scene), v->torus_radius).height + 1e-3, 1);
    return v->height > 0 ? KD_PLASMA_SEEN * v->height / hypot(1, KD_PLASMA_SEEN * v->height) : 1;
}

/* The radius at which infall begins. */
static double knot(const struct kd_scene *scene)
{
    const double isco = kd_kerr_isco(kd_scene_hole(scene));
    const bool falls = scene->volume.model == KD_VOLUME_RIAF && scene->volume.flow == KD_VOLUME_ORBITS;
    return falls && kd_scene_volume_inner(scene) < isco && isco < scene->volume.outer ? isco : 0;
}

/* Number of nodes of the scene's grid. If the grid's file has not been found yet, returns the largest number of nodes
 * of a grid that is not packed. */
static uint64_t nodes_of(const struct kd_scene *scene)
{
    return scene->matter.nodes ? scene->matter.nodes : KD_MATTER_WHOLE;
}

static bool is_packed(const struct kd_scene *scene) { return nodes_of(scene) > KD_MATTER_WHOLE; }
static uint64_t node_bytes(const struct kd_scene *scene)
{
    return KD_MATTER_FLOATS * sizeof(float) / (is_packed(scene) ? 2 : 1);
}

static uint64_t device_bytes(const struct kd_scene *scene)
{
    return has_no_grid(scene) ? 4 * KD_MATTER_FLOATS * sizeof(float)
           : is_grid(scene)   ? nodes_of(scene) * node_bytes(scene) + KD_MATTER_PLACES * 4 * sizeof(float)
                              : 0;
}
/* Host memory for the nodes before they are packed, and for one array of the file. If the nodes stay unpacked, also
 * for the file's arrays and for the upload. */
static uint64_t making_bytes(const struct kd_scene *scene)
{
    return is_grid(scene) && *scene->volume.grid
               ? nodes_of(scene) * (is_packed(scene) ? KD_MATTER_FLOATS * sizeof(float) + sizeof(double)
                                                     : 2 * KD_MATTER_FLOATS * sizeof(float) + 3 * sizeof(double)) +
                     (uint64_t)KD_MATTER_PLACES * 8 * sizeof(float)
               : 0;
}

/* A grid counts as dependent on the azimuth, because the scene does not say whether the grid is axisymmetric. */
static unsigned varies(const struct kd_scene *scene)
{
    return (has_grid(scene) ? KD_MOVES_WITH_AZIMUTH : 0) | (is_series(scene) ? KD_MOVES_WITH_TIME : 0);
}

/* The range of times, on the grid's clock, that a picture shows. In slow light, the latest light comes from the outer
 * edge in front of the hole. The earliest comes from the outer edge behind the hole, in an image of order 2. For each
 * order light turns round the hole by pi more. This takes pi b_c, where b_c = 3 sqrt 3 M (J.-P. Luminet 1979, A&A 75,
 * 228). Light from near the horizon is older still, and is not included. */
#define ORDERS_M (2 * M_PI * 5.196152422706632)
static void needs_times(const struct kd_scene *scene, double out[2])
{
    const double r = fmin(scene->volume.outer, scene->matter.outer), flight = r + 2 * log(fmax(r, 1)),
                 time = scene->top.time - kd_scene_lead(scene);
    const bool slow = kd_scene_is_slow_volume(scene);
    out[0] = slow ? time - flight - ORDERS_M : scene->top.time;
    out[1] = slow ? time + flight + (scene->matter.late && r > 4 ? 2 * log(r / 2 - 1) : 0) : scene->top.time;
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    static const char *const names[] = { [KD_VOLUME_GOLD] = "The matter of Gold et al. 2020",
                                         [KD_VOLUME_RIAF] = "Hot electrons in a magnetic field",
                                         [KD_VOLUME_TORUS] = "A torus of hot gas",
                                         [KD_VOLUME_GRID] = "Matter from a grid of numbers" };
    if (has_no_grid(scene))
        snprintf(out, KD_EMIT_TOLD, "No matter: no file is chosen.");
    else if (is_series(scene)) {
        double needs[2];
        needs_times(scene, needs);
        snprintf(out, KD_EMIT_TOLD,
                 "Matter from a series of grids from %.6g M to %.6g M, at %.6g GHz, whose times are %.6g M to %.6g M; "
                 "its light left at %.6g M to %.6g M.",
                 kd_scene_volume_inner(scene), scene->volume.outer, scene->volume.frequency_ghz, scene->matter.first,
                 scene->matter.last, needs[0], needs[1]);
    } else
        snprintf(out, KD_EMIT_TOLD, "%s from %.6g M to %.6g M, at %.6g GHz.", names[scene->volume.model],
                 kd_scene_volume_inner(scene), scene->volume.outer, scene->volume.frequency_ghz);
}

static double log2_of(double x) { return x > 0 ? fmax(log2(x), NEVER) : NEVER; }

static void fill_gold(struct kd_plasma_block *out, const struct kd_volume *v, double metre, double unit)
{
    const double up = log2(v->frequency_ghz / GOLD_GHZ);
    out->gold_light = (float)(log2_of(v->gold_emission) + log2(ERG_CM3 * metre / unit) - v->gold_index * up);
    out->gold_depth = (float)(log2_of(v->gold_emission) + log2_of(v->gold_absorption) + log2(PER_CM * metre) -
                              (2.5 + v->gold_index) * up);
    out->gold_index = (float)v->gold_index;
    out->gold_flat = (float)v->gold_flattening;
    out->gold_momentum = (float)v->gold_momentum;
}

/* B^2 = 2 mu0 (magnetisation) n m_p c^2, with B in gauss and n in cm^-3; mu0 = 1/(epsilon0 c^2). */
static void fill_electrons(struct kd_plasma_block *out, const struct kd_volume *v)
{
    const double theta = KD_K_J_K / (KD_ELECTRON_KG * KD_C_M_S * KD_C_M_S);
    const struct kd_synchrotron_power power =
        kd_synchrotron_power(v->electrons_index, v->gamma_min, fmax(v->gamma_max, 1.001 * v->gamma_min));
    out->density = (float)log2_of(v->density_cm3);
    out->density_index = (float)v->density_index;
    out->heat = (float)log2(theta * v->electron_temperature_k);
    out->heat_index = (float)v->temperature_index;
    out->steep = v->height > 0 ? (float)(1 / v->height) : 0;
    out->field = (float)(log2_of(v->magnetisation) + log2(2 * CM3 * KD_PROTON_KG / (EPSILON_0 * GAUSS * GAUSS)));
    out->field_index = (float)v->magnetisation_index;
    out->power_index = (float)v->electrons_index;
    out->power_light = (float)power.log2_light;
    out->power_depth = (float)power.log2_depth;
}

/* P = n m_p c^2 (Gamma - 1)/Gamma (h - 1) = n k T_e (1 + ratio). */
static void fill_torus(struct kd_plasma_block *out, const struct kd_scene *scene)
{
    const struct kd_volume *v = &scene->volume;
    const struct kd_torus t = kd_torus_of(kd_scene_hole(scene), kd_scene_volume_inner(scene), v->torus_radius);
    const double share = (v->adiabatic_index - 1) / v->adiabatic_index;
    out->torus_momentum = (float)t.l;
    out->torus_edge = (float)t.edge;
    out->torus_index = (float)(1 / (v->adiabatic_index - 1));
    out->density = (float)(log2_of(v->density_cm3) - log2(expm1(t.log_most)) / (v->adiabatic_index - 1));
    out->heat = (float)log2(KD_PROTON_KG / KD_ELECTRON_KG * share / (1 + v->temperature_ratio));
    out->field = (float)log2(2 * CM3 * KD_PROTON_KG / (EPSILON_0 * GAUSS * GAUSS) * share / v->beta);
    out->outer = (float)fmin(v->outer, t.outer);
}

static void fill_kappa(struct kd_plasma_block *out, const struct kd_volume *v)
{
    const struct kd_synchrotron_kappa k = kd_synchrotron_kappa(v->kappa);
    out->kappa = (float)v->kappa;
    out->kappa_width = (float)log2(v->kappa - 3);
    out->kappa_light_low = (float)k.light_low;
    out->kappa_light_high = (float)k.light_high;
    out->kappa_light_sharp = (float)k.light_sharp;
    out->kappa_depth_low = (float)k.depth_low;
    out->kappa_depth_high = (float)k.depth_high;
    out->kappa_depth_sharp = (float)k.depth_sharp;
}

static void tables(struct kd_emit_tables *out, const struct kd_scene *scene)
{
    double f[KD_KAPPA_ROWS + 1];
    if (scene->volume.electrons != KD_VOLUME_KAPPA)
        return;
    kd_synchrotron_kappa_table(scene->volume.kappa, KD_KAPPA_FIRST, 1.0 / KD_KAPPA_OCTAVE, KD_KAPPA_ROWS + 1, f);
    for (int i = 0; i < KD_KAPPA_ROWS; i++) {
        out->kappa[i][0] = (float)f[i];
        out->kappa[i][1] = (float)(f[i + 1] - f[i]);
    }
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const double metre = scene->spacetime.mass_msun * KD_M_SUN_M,
                 unit = kd_radio_unit(scene->volume.frequency_ghz, KD_RADIO_KELVIN);
    struct kd_plasma_block *to = &out->plasma;
    *to = (struct kd_plasma_block) {
        .inner = (float)kd_scene_volume_inner(scene),
        .outer = (float)scene->volume.outer,
        .frequency = (float)log2(scene->volume.frequency_ghz),
        .light = (float)log2(kd_synchrotron_light_unit() * metre / unit),
        .depth = (float)log2(kd_synchrotron_depth_unit() * metre),
    };
    fill_gold(to, &scene->volume, metre, unit);
    fill_electrons(to, &scene->volume);
    fill_kappa(to, &scene->volume);
    if (scene->volume.model == KD_VOLUME_TORUS)
        fill_torus(to, scene);
    if (is_grid(scene))
        to->density = (float)log2_of(scene->volume.grid_scale); /* device/grids.c sets the other members */
}

static bool is_gold(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.model == KD_VOLUME_GOLD;
}
static bool is_hot(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.model != KD_VOLUME_GOLD;
}
static bool is_powers(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.model == KD_VOLUME_RIAF;
}
static bool is_torus(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->volume.model == KD_VOLUME_TORUS;
}
static bool is_from_series(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, is_series(scene);
}
static bool is_still(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, has_grid(scene) && !(is_series(scene) && kd_scene_is_slow_volume(scene));
}
static bool is_late(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return is_from_series(scene, rays) && kd_scene_is_slow_volume(scene);
}
static bool is_beyond(const struct kd_scene *scene, const struct kd_setting *rays)
{
    double needs[2];
    needs_times(scene, needs);
    return is_from_series(scene, rays) && (needs[0] < scene->matter.first || needs[1] > scene->matter.last);
}
static bool is_missing(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, has_no_grid(scene);
}
static bool is_unpolarised(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, scene->polarization.model != KD_POLARIZATION_TRANSFER;
}
static bool is_beside(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return (void)rays, !kd_scene_is_radio_alone(scene);
}

static const struct kd_sentence sentences[] = {
    { "plasma.frequency",
      "volume: its light has one frequency and is not scattered; brightness 1 is a brightness temperature of 1e10 K",
      NULL },
    { "plasma.unpolarised",
      "volume: all polarisations of light are emitted and absorbed equally, so that the light is not polarised",
      is_unpolarised },
    { "plasma.gold",
      "volume: it is the analytic model of Gold et al. 2020, which was made to compare programs; it ends at its edges",
      is_gold },
    { "plasma.powers",
      "volume: density, temperature and magnetic field are power laws of r, not solutions of an equation of motion; "
      "the matter ends at its edges, and 7 scale heights from the plane",
      is_powers },
    { "plasma.torus",
      "volume: it is the torus of Fishbone & Moncrief 1976, whose equilibrium ignores the magnetic field; the field "
      "follows from a chosen ratio of pressures; the ratio of ion and electron temperature is constant",
      is_torus },
    { "plasma.grid",
      "volume: matter is interpolated between the nodes of a grid, density and temperature by their logarithms; "
      "it is shown at one time and does not change while light passes",
      is_still },
    { "plasma.series",
      "volume: matter is interpolated in time too, between two frames of a series of grids, by the same rule as "
      "between nodes",
      is_from_series },
    { "plasma.series-slow",
      "volume: matter is interpolated between the nodes of a grid, density and temperature by their logarithms; "
      "each place is shown at the time when its light left it",
      is_late },
    { "plasma.series-ends",
      "volume: some light left before the first or after the last frame of the series, and shows that frame instead",
      is_beyond },
    { "plasma.no-grid", "volume: there is no matter, because volume.grid is not set", is_missing },
    { "plasma.pandya",
      "volume: synchrotron light follows the fits of Pandya et al. 2016, which are accurate to a few percent within "
      "their range; the electrons are isotropic",
      is_hot },
    { "plasma.no-flux",
      "volume: light at a radio frequency is shown beside light of other kinds, on different scales of "
      "brightness; the picture has no flux",
      is_beside },
};

const struct kd_emitter kd_emit_plasma = {
    .name = "plasma",
    .title = "radio volume",
    .tell = tell,
    .present = present,
    .traits = traits,
    .varies = varies,
    .own = &kd_emitter_buffers_plasma,
    .quads = KD_TRAIT_PLASMA_GRID,
    .device_bytes = device_bytes,
    .making_bytes = making_bytes,
    .reach = reach,
    .height = height,
    .knot = knot,
    .fill = fill,
    .tables = tables,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(volume) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

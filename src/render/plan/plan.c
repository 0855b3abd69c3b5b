#include "render/plan/plan.h"

#include "render/emit/emitter.h"

#include "interface.h"
#include "lens.h"
#include "physics/math/angle.h"
#include "physics/spacetime/kerr.h"
#include "render/accuracy/table.h"
#include "render/view/camera.h"
#include "render/view/layout.h"
#include "render/plan/cost_class.h"
#include "render/plan/lens_key.h"
#include "render/plan/parts.h"
#include "render/plan/room.h"
#include "render/plan/sample.h"
#include "scene/hole.h"

#include <math.h>
#include <string.h>

_Static_assert(KD_PLAN_EMITTERS >= KD_EMITTER_COUNT, "all of them");

/* Approximations that belong to no emitter. */
#define WHEN(name, condition) \
    static bool name(const struct kd_plan *plan, const struct kd_scene *scene) \
    { \
        return (void)plan, (void)scene, condition; \
    }
WHEN(crossings, kd_emit_at_crossings(scene))
WHEN(volumes, kd_emit_along(scene))
WHEN(sketched, plan->light.march.sketched)
WHEN(bright, plan->light.bright)
WHEN(few_rays,
     (plan->lens.orders > 1 || kd_emit_along(scene)) && !plan->lens.ring && !plan->lens.critical && plan->lens.side < 4)
WHEN(adapted, plan->lens.adaptive)
WHEN(not_adapted, kd_scene_adapts(scene) && !plan->lens.adaptive)
WHEN(film, scene->style.tone_map == KD_TONE_ACES && !plan->picture.numbers && !kd_plan_is_map(&plan->picture))
WHEN(neutral, scene->style.tone_map == KD_TONE_NEUTRAL && !plan->picture.numbers && !kd_plan_is_map(&plan->picture))
WHEN(bloom, plan->picture.bloom.levels && !plan->picture.numbers && !kd_plan_is_map(&plan->picture))
WHEN(beam, plan->picture.beam.cell && !plan->picture.numbers)
WHEN(near_beam, plan->picture.beam.cell && !plan->picture.numbers && isfinite(scene->camera.r))
WHEN(near_flux, kd_scene_is_radio_alone(scene) && isfinite(scene->camera.r))
WHEN(heat, scene->style.palette == KD_PALETTE_HEAT && !kd_scene_is_radio_alone(scene) && !plan->picture.numbers &&
               !kd_plan_is_map(&plan->picture))
WHEN(normalised, scene->volume.normalise_to_jy > 0 && !plan->light.reuse_normalisation)
WHEN(held, plan->light.reuse_normalisation)
WHEN(maps, plan->picture.n_layers > 0)
WHEN(cut, plan->light.points && plan->picture.bands > 1 && !plan->lens.cacheable)
WHEN(coloured, kd_plan_is_map(&plan->picture) && !plan->picture.numbers)
#define MORE(x, name, ...) WHEN(has_##name, scene->spacetime.name != 0)
KD_HOLE_MORE(MORE, )
#undef MORE
WHEN(projected, plan->lens.ring)
WHEN(rounded, !plan->lens.ring && !kd_scene_is_flat(scene))
WHEN(interpolated, plan->lens.interpolates > 0)
WHEN(single, plan->lens.setting.precision == KD_PRECISION_F32 && plan->lens.path != KD_LENS_LISTED)
WHEN(single_listed, plan->lens.setting.precision == KD_PRECISION_F32 && plan->lens.path == KD_LENS_LISTED)
WHEN(twice, plan->lens.setting.precision == KD_PRECISION_F64)
WHEN(paired, plan->picture.eyes == 2 && scene->camera.stereo)
WHEN(compared, plan->lens.setting.engine >= KD_ENGINE_KS_EULER)

static const struct sentence {
    const char *name, *text;
    bool (*in_force)(const struct kd_plan *plan, const struct kd_scene *scene);
} sentences[] = {
#define MORE(x, name, member, least, most, shown, unit, card, what, bound, help, source, told, text) \
    { told, text, has_##name },
    KD_HOLE_MORE(MORE, )
#undef MORE
        { "disk.orders", "disk: image orders beyond accuracy.orders are left out", crossings },
    { "volumes.march",
      "volumes: light is integrated in 32 bits with three points per step; the number of steps depends on the texture, "
      "the optical depth and the ray; the requested accuracy is a target, and an error of about 5e-5 remains in "
      "addition; the error is measured on a sample of rays with half the step length",
      volumes },
    { "volumes.sketch",
      "volumes: while the view changes, light is computed roughly; its measured error is about 5 %; fine octaves of "
      "the turbulence are left out, which adds an error of about 7 % that is not measured",
      sketched },
    { "sky.sketch",
      "sky: while the view changes, images of stars are left out that would brighten their pixel by less than "
      "sky.brightness, or whose pixel at the critical curve covers more than 0.15 rad of the sky; the other images are "
      "displaced by up to a fifth of the distance between rays",
      bright },
    { "colour.gamut", "colour: black bodies outside the sRGB gamut are moved to its edge at equal luminance",
      crossings },
    { "image.few-rays",
      "image: pixels at the critical curve have few rays, so that a photon ring thinner than a pixel appears dotted",
      few_rays },
    { "image.adaptive",
      "image: pixels that differ from the mean of their neighbours by at least twice image.pixel_error have 16 rays, "
      "the others have one; where the lens map is smooth, the 16 rays are interpolated; the remaining error is "
      "measured on a sample",
      adapted },
    { "image.one-ray",
      "image: if image.samples is \"auto\", maps, the ring projection and light curves have one ray a pixel",
      not_adapted },
    { "post.film", "post: the tone curve is like that of film; pixel values are not proportional to radiance", film },
    { "post.neutral",
      "post: the tone curve is neutral; light above 0.8 of white is compressed, and pixel values are not proportional "
      "to radiance",
      neutral },
    { "post.bloom",
      "post: the glare of a lens spreads part of bright light around its position; the total is conserved, and light "
      "that would leave the picture stays at its edge",
      bloom },
    { "post.beam",
      "post: a Gaussian beam represents a telescope, without gaps between stations, noise or reconstruction; no light "
      "comes from beyond the picture's edge",
      beam },
    { "post.near-beam",
      "post: for a near observer the beam is as wide at the hole, in M, as it is from spacetime.distance_pc",
      near_beam },
    { "flux.near",
      "flux: the flux at a near camera is multiplied by (camera.r / spacetime.distance_pc)^2; if matter surrounds the "
      "camera, no telescope would measure this flux",
      near_flux },
    { "post.heat",
      "post: colours are false; brightness is that of the model's band, not a brightness temperature at a radio "
      "frequency",
      heat },
    { "sky.cut", "sky: images of stars are cut at the edges of the bands in which a picture of this size is rendered",
      cut },
    { "volume.normalised",
      "volume: the density is chosen so that a picture of 128 pixels has the flux volume.normalise_to_jy; small "
      "pictures determine this density, and the estimated time does not include them; answers give the factor of the "
      "density as density_scale",
      normalised },
    { "volume.held",
      "volume: while the view is dragged, the density is the last one found for this matter in another view; the flux "
      "differs from volume.normalise_to_jy until the view rests",
      held },
    { "layers.one-ray", "layers: maps of positions and angles show one ray a pixel, not a mean over the pixel", maps },
    { "layers.false-colour", "layers: a picture of a map has false colours; FITS, EXR, NPZ and NPY have its numbers",
      coloured },
    { "projection.ring",
      "projection: distances to the critical curve are on a logarithmic scale, which no camera shows; areas are not to "
      "scale",
      projected },
    { "projection.angles",
      "projection: the picture is a map of half of the sky or of all of it; angles become distances, and areas are not "
      "to scale",
      rounded },
    { "camera.stereo",
      "camera: each eye of a pair is an observer of the same kind at the same time; its displacement from the middle "
      "is computed in the local frame, to first order in camera.eye_distance; the viewing directions are parallel as "
      "in flat space",
      paired },
    { "lens.interpolated",
      "lens map: rays are traced where the map bends and where image orders or fates change; elsewhere the map is "
      "interpolated to 1e-5, or to 2e-6 with the profile balanced; answers give the number of interpolated pixels",
      interpolated },
    { "arithmetic.f32",
      "arithmetic: rays are followed in 32 bits; rays whose fate or number of crossings is then uncertain are followed "
      "again in 64 bits",
      single },
    { "arithmetic.f32-listed",
      "arithmetic: rays are followed in 32 bits by an engine that does not trace them again in 64 bits; within about "
      "1e-5 of the critical curve rays may be lost, or their fate may be wrong",
      single_listed },
    { "arithmetic.f64", "arithmetic: rays are followed in 64 bits; the radii of their crossings are stored in 32 bits",
      twice },
    { "rays.kerr-schild",
      "rays: they are followed in Kerr-Schild coordinates for comparison; docs/accuracy.md gives the cost", compared },
};
enum { SENTENCES = sizeof sentences / sizeof *sentences };

size_t kd_plan_sentence_count(void) { return SENTENCES; }
struct kd_approximation kd_plan_sentence(size_t index)
{
    return (struct kd_approximation) { sentences[index].name, sentences[index].text };
}

static void say(void *user, struct kd_approximation approximation)
{
    struct kd_plan *plan = user;
    if (plan->report.n_approximations < KD_PLAN_MAX_APPROXIMATIONS) /* never exceeded: tests/unit/emitters.c */
        plan->report.approximations[plan->report.n_approximations++] = approximation;
}

void kd_plan_say(struct kd_plan *plan, const struct kd_scene *scene)
{
    plan->report.n_approximations = 0;
    kd_emit_sentences(scene, &plan->lens.setting, say, plan);
    for (int i = 0; i < SENTENCES; i++)
        if (sentences[i].in_force(plan, scene))
            say(plan, kd_plan_sentence((size_t)i));
}

static void passes(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c)
{
    plan->cost.class = kd_cost_class(plan, scene);
    plan->cost.trace_ns = kd_pass_cost(&kd_passes[KD_PASS_TRACE], plan, c).ns;
    for (int i = 0; i < KD_PASS_COUNT; i++) {
        const struct kd_pass_cost cost = kd_pass_cost(&kd_passes[i], plan, c);
        uint64_t n = kd_passes[i].invocations(plan, scene);
        if (!n)
            continue;
        const double known = kd_cost_known(c, plan->cost.class, (enum kd_pass_id)i);
        double ms = (double)n * (known > 0 ? known : cost.ns) * 1e-6;
        plan->cost.passes[plan->cost.n_passes++] =
            (struct kd_plan_pass) { kd_passes[i].name, cost.kernel, n, ms, cost.figure };
        plan->cost.estimate_ms += ms;
    }
}

/* relative precision of a lens map, which keeps w = 1/r in 32 bits */
#define KEPT 6e-8

static enum kd_status too_fine(double tolerance, const struct kd_capacity *c, struct kd_error *error)
{
    double best = INFINITY;
    for (uint32_t i = 0; i < c->accuracy->n; i++)
        best = fmin(best, kd_accuracy_holds(&c->accuracy->rows[i]));
    return kd_error_field(error, "/accuracy/tolerance",
                          "accuracy.tolerance is %.3g; for a picture, with radii in 32 bits, it must be at least %.3g; "
                          "lists of rays (POST /v1/rays, kerrd rays) reach %.3g%s",
                          tolerance, KEPT, 1.01 * best,
                          c->accuracy_measured ? " on this device"
                                               : ", by the table of llvmpipe, because this device has none");
}

static double ergosphere(const struct kd_scene *scene)
{
    return kd_kerr_ergosphere(kd_scene_hole(scene), kd_cos_deg(scene->camera.inclination_deg));
}

/* True if E is positive for each ray of the camera, as the device's engines assume for listed rays. The closed form
 * needs only L/E and Q/E^2. */
static bool outside(const struct kd_scene *scene) { return scene->camera.r > ergosphere(scene); }

static enum kd_status may_list(const struct kd_scene *scene, const struct kd_setting *by, struct kd_error *error)
{
    if (outside(scene) || by->engine == KD_ENGINE_CLOSED)
        return KD_OK;
    return kd_error_field(error, "/accuracy/engine",
                          "accuracy.engine is \"%s\" in %s; inside the ergosphere, at camera.r %.9g, it must be "
                          "\"auto\", \"closed\" or a Mino engine in f32, or the camera must be outside %.9g M",
                          kd_engine_name(by->engine), kd_precision_name(by->precision), scene->camera.r,
                          ergosphere(scene));
}

/* Settings for a ring. Its rays pass the critical curve at relative distances down to 1e-10, which neither 32 bits nor
 * few steps resolve. Unless an engine or steps are named, the closed form is used, because it needs no device and meets
 * each tolerance that a picture may request. The table's rows do not apply, because they were measured on other
 * rays. */
static enum kd_status ring(struct kd_accuracy_request *asked_accuracy, struct kd_error *error)
{
    if (asked_accuracy->precision == KD_PRECISION_F32)
        return kd_error_field(error, "/accuracy/precision",
                              "accuracy.precision is \"f32\"; in the ring projection it must be \"f64\" or \"auto\"");
    asked_accuracy->precision = KD_PRECISION_F64;
    asked_accuracy->profile = KD_PROFILE_REFERENCE;
    if (asked_accuracy->engine < 0 && !asked_accuracy->steps) {
        asked_accuracy->engine = KD_ENGINE_CLOSED;
        asked_accuracy->tolerance = INFINITY;
    }
    return KD_OK;
}

/* The least radius from which the closed form in f32 traces rays. It is outside all photon orbits: from there no ray
 * that starts outwards comes back. */
static double beyond_orbits(const struct kd_scene *scene)
{
    return 1.05 * kd_kerr_outermost_photon_orbit(kd_scene_hole(scene));
}

static bool within_horizon(const struct kd_scene *scene) { return scene->camera.r <= kd_scene_hole(scene)->outer; }

/* Settings for an observer inside the horizon, where only lens_map.comp traces light. The number of steps per half turn
 * was chosen for w = 1/2. Near the centre, where w'' = 3K w^2, the motion is faster by sqrt(6w), so more steps are
 * needed. */
static enum kd_status from_within(struct kd_plan *plan, const struct kd_scene *scene,
                                  const struct kd_accuracy_request *asked_accuracy, struct kd_error *error)
{
    struct kd_setting *by = &plan->lens.setting;
    if (kd_emit_slow_along(scene)) {
        const bool volume = kd_scene_is_slow_volume(scene);
        return kd_error_field(error, volume ? "/volume/slow_light" : "/disk/slow_light",
                              "%s.slow_light is true; inside the horizon, at camera.r %.9g, it must be false, "
                              "because coordinate time does not define the light's delay there",
                              volume ? "volume" : "disk", scene->camera.r);
    }
    if (plan->lens.path != KD_LENS_MAP)
        return kd_error_field(error, "/accuracy/engine",
                              "accuracy.engine is \"%s\" in %s; inside the horizon, at camera.r %.9g, it must be a "
                              "Mino engine in f32, without the light's delay",
                              kd_engine_name(by->engine), kd_precision_name(by->precision), scene->camera.r);
    for (double quicker = (1 + 6 / scene->camera.r) / 4; quicker > 1.2 && !asked_accuracy->steps && by->steps < 1024;
         quicker /= 4)
        by->steps *= 2;
    return KD_OK;
}

static enum kd_status choose(struct kd_plan *plan, const struct kd_scene *scene, const struct kd_capacity *c,
                             struct kd_error *error)
{
    struct kd_accuracy_request asked_accuracy = kd_accuracy_request_of(scene);
    struct kd_setting *by = &plan->lens.setting;
    /* true if lens_closed.comp can trace the picture */
    bool closed_form = scene->camera.r > beyond_orbits(scene) && !kd_plan_holds(&plan->lens, KD_LENS_DELAY);
    bool closed32 = asked_accuracy.engine == KD_ENGINE_CLOSED && asked_accuracy.precision == KD_PRECISION_F32;
    if (asked_accuracy.tolerance < KEPT)
        return too_fine(asked_accuracy.tolerance, c, error);
    enum kd_status status = plan->lens.ring ? ring(&asked_accuracy, error) : KD_OK;
    if (!status)
        status = kd_setting_of(&asked_accuracy, c->accuracy, c->float64, by, error);
    if (status)
        return status;
    if (isfinite(scene->accuracy.tolerance) && isinf(asked_accuracy.tolerance))
        by->holds = KEPT;
    if (plan->lens.ring && by->precision == KD_PRECISION_F32)
        return kd_error_field(error, "/accuracy/tolerance",
                              "accuracy.tolerance is %.3g; in the ring projection it must be \"profile\", because this "
                              "device lacks the f64 that a tolerance needs",
                              asked_accuracy.tolerance);
    if (closed32 && !closed_form)
        return kd_error_field(error, "/accuracy/precision",
                              "accuracy.precision must be f64 for the closed form: in f32 it needs an observer outside "
                              "%.9g M, beyond the photon orbits, and has no delay of light",
                              beyond_orbits(scene));
    if (closed_form && by->precision == KD_PRECISION_F32 && (closed32 || asked_accuracy.engine < 0) &&
        !asked_accuracy.steps) {
        plan->lens.path = KD_LENS_CLOSED;
        by->engine = KD_ENGINE_CLOSED;
        by->steps = 0;
        return KD_OK;
    }
    if (!outside(scene) && by->precision == KD_PRECISION_F64 && asked_accuracy.engine < 0 && !asked_accuracy.steps) {
        by->engine = KD_ENGINE_CLOSED;
        by->steps = 0;
    }
    bool map = (by->engine == KD_ENGINE_MINO_RKN4 || by->engine == KD_ENGINE_MINO_RKN6) &&
               by->precision == KD_PRECISION_F32 &&
               !kd_plan_holds(&plan->lens, KD_LENS_DELAY); /* delay is available for listed rays only */
    plan->lens.path = map ? KD_LENS_MAP : KD_LENS_LISTED;
    plan->lens.ingoing = scene->camera.observer == KD_OBSERVER_INFALL && isfinite(scene->camera.r);
    if (within_horizon(scene))
        return from_within(plan, scene, &asked_accuracy, error);
    if (kd_plan_holds(&plan->lens, KD_LENS_DELAY) && !outside(scene) && !scene->disk.slow_light)
        return kd_error_field(error, "/image/layers",
                              "image.layers has delay, which is not computed inside the ergosphere, at camera.r %.9g",
                              scene->camera.r);
    if (kd_plan_holds(&plan->lens, KD_LENS_DELAY) && !outside(scene))
        return kd_error_field(error, "/disk/slow_light",
                              "disk.slow_light is true; inside the ergosphere, at camera.r %.9g, it must be false",
                              scene->camera.r);
    return map ? KD_OK : may_list(scene, by, error);
}

/* Number of polarisation numbers that are stored after the radiance of a pixel. */
static uint32_t stokes_words(const struct kd_plan *plan)
{
    const bool plane = plan->light.traits[KD_EMITTER_polarization] & KD_TRAIT_PRESENT,
               volume = plan->light.traits[KD_EMITTER_stokes] & KD_TRAIT_PRESENT;
    bool kept = plan->light.photometry && (plane || volume);
    for (size_t i = 0; i < plan->picture.n_layers; i++)
        kept |= kd_plan_gathers(&plan->light, plan->picture.layers[i].kind);
    return kept ? KD_PLAN_STOKES + (plan->light.apart && plane ? 2 : 0) : 0;
}

bool kd_plan_is_spread(const struct kd_plan_light *light)
{
    uint32_t all = 0;
    for (size_t i = 0; i < sizeof light->traits / sizeof *light->traits; i++)
        all |= light->traits[i];
    return all & KD_TRAIT_SPREAD;
}

/* Plans everything except what depends on the pixels at the critical curve. */
static enum kd_status outline(const struct kd_scene *scene, const struct kd_needs *needs,
                              const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    struct kd_plan plan = { 0 };
    plan.picture.width = kd_scene_window(scene).width;
    plan.picture.height = kd_scene_window(scene).height;
    plan.lens.side = (uint32_t)kd_scene_side(scene);
    plan.lens.rays = (uint64_t)plan.picture.width * plan.picture.height * plan.lens.side * plan.lens.side;
    if (!needs->no_image)
        plan.picture.bloom = kd_bloom_of(plan.picture.width, plan.picture.height, scene->style.bloom,
                                         kd_camera_sight(scene) == KD_SIGHT_SPHERE);
    plan.light.photometry = needs->light;
    plan.picture.no_image = needs->no_image;
    plan.picture.numbers = needs->radiance;
    plan.light.reuse_normalisation = needs->reuse_normalisation && scene->volume.normalise_to_jy > 0;
    plan.lens.ring = scene->camera.projection == KD_PROJECTION_RING;
    kd_emit_traits(scene, plan.light.traits);
    plan.light.apart = kd_emit_separate_photometry(scene);
    plan.light.points = kd_emit_points(scene);
    plan.light.bright = plan.light.points && needs->bright;
    plan.lens.quantities = needs->quantities;
    plan.lens.quantities |= plan.lens.quantities & KD_LENS_SHAPE ? KD_LENS_FOOTPRINT : 0;
    /* footprints need azimuths, because they are differences of radii and azimuths */
    plan.lens.quantities |= plan.lens.quantities & KD_LENS_FOOTPRINT ? KD_LENS_PHI : 0;
    plan.lens.quantities |= plan.lens.quantities & KD_LENS_SKY_FOOTPRINT ? KD_LENS_SKY : 0;
    /* Even without a disk a ray is followed from crossing to crossing in long strides before it escapes. */
    plan.lens.orders = needs->quantities ? (uint32_t)scene->accuracy.orders : 0;
    plan.lens.ends = kd_emit_at_ends(scene) && kd_plan_holds(&plan.lens, KD_LENS_SKY);
    plan.picture.n_layers = kd_layers_of(scene, plan.picture.layers, &plan.picture.rgb);
    plan.picture.n_layers = needs->no_image ? 0 : plan.picture.n_layers;
    /* the search for bright images computes its own differences, so it needs no footprints */
    if (plan.light.bright && !plan.picture.n_layers && !kd_plan_is_spread(&plan.light))
        plan.lens.quantities &= ~(uint32_t)KD_LENS_SKY_FOOTPRINT;
    plan.picture.radiance = needs->radiance && plan.picture.rgb && !needs->no_image;
    if (!needs->no_image && !kd_plan_is_map(&plan.picture))
        plan.picture.beam = kd_beam_of(scene);
    plan.lens.quantities |= plan.lens.orders ? KD_LENS_W | (plan.lens.ring ? KD_LENS_ALPHA : 0) : 0;
    if (plan.light.photometry && !kd_scene_is_flat(scene))
        return kd_error_field(
            error, "/camera/projection",
            "camera.projection is \"ring\", \"equirectangular\" or \"fulldome\"; for a measurement of light it must be "
            "\"plane\" or \"pinhole\", because areas of the others are not to scale");
    enum kd_status status;
    if (plan.lens.ring && (kd_emit_along(scene) || kd_emit_met(scene)))
        return kd_error_field(error, "/camera/projection",
                              "camera.projection is \"ring\"; with volumes or bodies it must be another");
    KD_TRY(kd_layers_check(scene, error));
    KD_TRY(kd_plan_beam_fits(&plan.picture, capacity, error));
    KD_TRY(choose(&plan, scene, capacity, error));
    if (kd_emit_along(scene) && scene->accuracy.tolerance < KD_MARCH_HOLDS)
        KD_TRY(kd_error_field(
            error, "/accuracy/tolerance",
            "accuracy.tolerance is %.3g; for light through volumes, in 32 bits, it must be at least %.3g",
            scene->accuracy.tolerance, KD_MARCH_HOLDS));
    plan.light.meets = kd_emit_met(scene);
    if (kd_emit_along(scene) || plan.light.meets)
        plan.light.march = kd_march_of(scene, &plan.lens.setting);
    plan.light.stokes_words = stokes_words(&plan);
    if (needs->sketch && kd_emit_along(scene))
        plan.light.march = kd_march_sketch(plan.light.march, scene);
    plan.lens.planes = kd_lens_planes(plan.lens.quantities, plan.lens.orders);
    plan.lens.interpolates = needs->followed ? 0 : kd_sample_tolerance(&plan, scene);
    kd_plan_adapt(&plan, scene, capacity);
    plan.report.measured = capacity->measured;
    plan.report.accuracy_measured = capacity->accuracy_measured;
    *out = plan;
    KD_TRY(kd_plan_bands(out, scene, capacity, error));
done:
    return status;
}

enum kd_status kd_plan_one(const struct kd_scene *scene, const struct kd_needs *needs,
                           const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    struct kd_plan plan;
    enum kd_status status;
    /* checks the limits first, because listing the pixels of a picture that is too large takes long */
    KD_TRY(outline(scene, needs, capacity, &plan, error));
    KD_TRY(kd_plan_critical(&plan, scene, capacity, error));
    if (plan.lens.critical)
        KD_TRY(kd_plan_bands(&plan, scene, capacity, error));
    plan.lens.audit = plan.lens.cacheable && plan.lens.orders && !within_horizon(scene)
                          ? KD_AUDIT_RAYS
                          : 0; /* the audit's closed form requires an observer outside the horizon */
    passes(&plan, scene, capacity);
    kd_plan_say(&plan, scene);
    if (kd_plan_lens_key(&plan, scene))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory while hashing the scene"));
    *out = plan;
done:
    return status;
}

struct kd_needs kd_needs_of(const struct kd_scene *scene)
{
    return (struct kd_needs) {
        .quantities = kd_emit_needs(scene) | kd_layers_needs(scene),
        .light = (kd_emit_separate_photometry(scene) || kd_scene_is_radio_alone(scene)) && kd_scene_is_flat(scene),
    };
}

enum kd_status kd_plan_make(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                            struct kd_error *error)
{
    const struct kd_needs needs = kd_needs_of(scene);
    return kd_plan_make_for(scene, &needs, capacity, out, error);
}

enum kd_status kd_plan_one_fits(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_error *error)
{
    struct kd_plan plan;
    return outline(scene, needs, capacity, &plan, error);
}

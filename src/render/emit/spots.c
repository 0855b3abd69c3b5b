/* Hot spots as an emitter: shaders/emit/spots.glsl. */
#include "render/emit/emitter.h"

#include "physics/spacetime/kerr.h"
#include "render/emit/particles.h"
#include "scene/hole.h"

#include <math.h>
#include <stdio.h>

_Static_assert(KD_SPOT_MAX == KD_SPOTS, "those of a scene");

/* largest distance at which a spot is seen, in sizes of the spot. Beyond it, less than 1e-9 of the peak is left */
#define REACH 6.44

static bool present(const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    return kd_scene_spots(scene, on);
}

static uint32_t traits(const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    return kd_orbit_traits(scene) | KD_TRAIT_SEPARATE_PHOTOMETRY | (scene->disk.slow_light ? KD_TRAIT_SLOW : 0) |
           (uint32_t)kd_scene_spots(scene, on) << KD_TRAIT_SPOTS_SHIFT;
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_spot *on[KD_SPOTS];
    size_t n = kd_scene_spots(scene, on);
    double degrees = M_PI / 180, time = scene->top.time - kd_particle_delay(scene);
    for (size_t i = 0; i < n; i++) {
        double omega = kd_kerr_omega(kd_scene_hole(scene), on[i]->r), size = on[i]->size;
        double phase = remainder(omega * time, 2 * M_PI) + (on[i]->phase_deg - scene->camera.azimuth_deg) * degrees;
        out->spots.at[i] = (struct kd_spot_block) {
            .r = (float)on[i]->r,
            .phi = (float)remainder(phase, 2 * M_PI),
            .omega = (float)omega,
            .sharp = (float)(M_LOG2E / (2 * size * size)),
            .reach = (float)(REACH * REACH * size * size),
            .brightness = (float)on[i]->brightness,
            .power = (float)(3 + on[i]->index),
            .temperature = (float)on[i]->temperature_k,
        };
    }
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    const struct kd_spot *on[KD_SPOTS];
    size_t n = kd_scene_spots(scene, on), used = (size_t)snprintf(out, KD_EMIT_TOLD, "Hot spots going round at ");
    for (size_t i = 0; i < n && used < KD_EMIT_TOLD; i++)
        used += (size_t)snprintf(out + used, KD_EMIT_TOLD - used, "%s%.6g M%s", i ? ", " : "", on[i]->r,
                                 i + 1 == n ? "." : "");
}

static void reach(const struct kd_scene *scene, double radii[2])
{
    const struct kd_spot *on[KD_SPOTS];
    size_t n = kd_scene_spots(scene, on);
    radii[0] = INFINITY;
    radii[1] = 0;
    for (size_t i = 0; i < n; i++) {
        radii[0] = fmin(radii[0], on[i]->r - REACH * on[i]->size);
        radii[1] = fmax(radii[1], on[i]->r + REACH * on[i]->size);
    }
    radii[0] = fmax(radii[0], kd_kerr_isco(kd_scene_hole(scene)));
}

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(without_shift, scene->disk.model == KD_DISK_NONE && (!scene->disk.doppler || !scene->disk.redshift))
WHEN(fast, !scene->disk.slow_light)

static const struct kd_sentence sentences[] = {
    { "spots.drawn",
      "spots: they are Gaussians in r and phi that move rigidly with the orbit of their centre; they shine only in the "
      "equatorial plane outside the ISCO, with a power-law spectrum and the redshift of the gas at each place",
      NULL },
    { "spots.chosen", "spots: their brightness and colour are chosen, not computed; they absorb no light", NULL },
    { "spots.no-shift", "spots: the Doppler shift or the gravitational redshift of the gas is switched off",
      without_shift },
    { "spots.fast", "spots: all are shown at one coordinate time, and the delay of their light is ignored (fast light)",
      fast },
};

const struct kd_emitter kd_emit_spots = {
    .name = "spots",
    .title = "spots",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = kd_orbit_needs,
    .varies = kd_orbit_varies,
    .reach = reach,
    .fill = fill,
    .depends = { KD_SCENE_PART(spacetime), KD_SCENE_PART(camera), KD_SCENE_PART(disk), KD_SCENE_PART(spots),
                 KD_SCENE_PART(top) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

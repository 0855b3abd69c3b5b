/* This is the sky as an emitter: a drawn celestial grid, or stars and the light that is spread between them (shaders/emit/sky.glsl). */
#include "render/emit/emitter.h"

#include "faces.h"
#include "render/emit/sky_noise.h"
#include "render/sky/frame.h"
#include "render/sky/panorama.h"
#include "render/sky/star.h"

#include <math.h>
#include <stdio.h>

static bool present(const struct kd_scene *scene) { return scene->sky.model != KD_SKY_NONE && scene->sky.brightness > 0; }

static bool is_grid(const struct kd_scene *scene) { return scene->sky.model == KD_SKY_GRID; }
static bool has_stars(const struct kd_scene *scene) { return kd_stars_most(scene) > 0; }
static bool is_spread(const struct kd_scene *scene) { return !is_grid(scene) && scene->sky.milky_way > 0; }

static uint32_t traits(const struct kd_scene *scene)
{
    return (is_grid(scene) ? KD_TRAIT_SKY_GRID : 0) | (is_spread(scene) ? KD_TRAIT_SKY_SPREAD : 0) | (has_stars(scene) ? KD_TRAIT_POINTS : 0) |
           (scene->disk.band == KD_BAND_VISIBLE && !is_grid(scene) ? KD_TRAIT_VISIBLE : 0);
}

static uint32_t needs(const struct kd_scene *scene)
{
    return KD_LENS_SKY | (is_grid(scene) ? 0 : KD_LENS_SKY_FOOTPRINT);
}

static unsigned varies(const struct kd_scene *scene)
{
    (void)scene;
    return KD_MOVES_WITH_AZIMUTH;
}

static void tell(const struct kd_scene *scene, char out[KD_EMIT_TOLD])
{
    static const char *const sentences[] = {
        [KD_SKY_GRID] = "A celestial grid behind.", [KD_SKY_STARS] = "Stars and a Milky Way behind.",
        [KD_SKY_CATALOGUE] = "The stars of the Hipparcos catalogue and a Milky Way behind.",
    };
    snprintf(out, KD_EMIT_TOLD, "%s", sentences[scene->sky.model]);
}

static uint64_t device_bytes(const struct kd_scene *scene)
{
    const uint64_t cells = KD_FACES * KD_FACE_CELLS * KD_FACE_CELLS + 1, places = 3ull * kd_stars_most(scene);
    return (is_spread(scene) ? 4ull * kd_panorama_words(KD_MILKY_WAY_WIDTH, KD_MILKY_WAY_HEIGHT) : 0) +
           (has_stars(scene) ? 4 * (5 * places + cells) : 0);
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_rotation r = kd_sky_rotation(scene);
    out->sky = (struct kd_sky_block) {
        .brightness = (float)scene->sky.brightness,
        .spacing = (float)(scene->sky.grid_deg * (M_PI / 180)),
        .spread = (float)(scene->sky.brightness * scene->sky.milky_way),
        .columns = KD_MILKY_WAY_WIDTH,
        .rows = KD_MILKY_WAY_HEIGHT,
        .texel = (float)log2(M_PI / KD_MILKY_WAY_HEIGHT),
        .xx = (float)r.m[0][0], .xy = (float)r.m[0][1], .xz = (float)r.m[0][2],
        .yx = (float)r.m[1][0], .yy = (float)r.m[1][1], .yz = (float)r.m[1][2],
        .zx = (float)r.m[2][0], .zy = (float)r.m[2][1], .zz = (float)r.m[2][2],
    };
}

#define WHEN(name, condition)                                                                                  \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(drawn, is_grid(scene))
WHEN(starry, has_stars(scene))
WHEN(made_up, scene->sky.model == KD_SKY_STARS)
WHEN(listed, scene->sky.model == KD_SKY_CATALOGUE)
WHEN(milky, is_spread(scene))
WHEN(shifted, is_spread(scene) && isfinite(scene->camera.r))

static bool noise(const struct kd_scene *scene, const struct kd_setting *rays) { return kd_sky_is_noise(scene, rays->precision); }

static const struct kd_sentence sentences[] = {
    { "sky: a drawn celestial grid; its lensing is exact, its brightness carries no redshift", drawn },
    { "sky: from so near the horizon it is noise: for most pixels that see it the next one, or the last digit of the ray's constants, leads "
      "more than 0.1 rad away", noise },
    { "sky: stars are made up, as many of each magnitude as there are in truth", made_up },
    { "sky: stars of the Hipparcos catalogue, all at infinity; nearly complete to magnitude 8 alone, and without those that it lacks", listed },
    { "sky: stars shine as black bodies of the temperature that their colour stands for, and each image is spread over some 1.2 pixels", starry },
    { "sky: images of stars that would brighten their pixel by less than 0.03 of sky.brightness are left out, and those next to the critical "
      "curve, in pixels whose rays stand for more than 0.15 rad of the sky", starry },
    { "sky: the light between the stars is a Milky Way that is made up; no place in it is a place in the sky", milky },
    { "sky: the light between the stars is shifted as that of black bodies of 5600 K", shifted },
};

const struct kd_emitter kd_emit_sky = {
    .name = "sky",
    .title = "sky",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = varies,
    .own = &kd_own_sky,
    .device_bytes = device_bytes,
    .fill = fill,
    .depends = { KD_SCENE_PART(sky), KD_SCENE_PART(camera) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

/* The sky as an emitter: a drawn celestial grid, or stars and diffuse light (shaders/emit/sky.glsl). */
#include "render/emit/emitter.h"

#include "faces.h"
#include "render/emit/sky_noise.h"
#include "render/sky/frame.h"
#include "render/sky/panorama.h"
#include "scene/asset.h"
#include "render/sky/star.h"
#include "render/view/rim_grid.h"

#include <math.h>
#include <stdio.h>

static bool is_grid(const struct kd_scene *scene) { return scene->sky.model == KD_SKY_GRID; }
static bool has_stars(const struct kd_scene *scene) { return kd_stars_most(scene) > 0; }
static bool is_spread(const struct kd_scene *scene) { return !is_grid(scene) && scene->sky.milky_way > 0; }
static bool is_picture(const struct kd_scene *scene) { return is_spread(scene) && *scene->sky.image; }

static bool present(const struct kd_scene *scene)
{
    return scene->sky.model != KD_SKY_NONE && kd_scene_sky_brightness(scene) > 0 &&
           (is_grid(scene) || has_stars(scene) || is_spread(scene));
}

static uint32_t traits(const struct kd_scene *scene)
{
    return (is_grid(scene) ? KD_TRAIT_SKY_GRID : 0) | (is_spread(scene) ? KD_TRAIT_SKY_SPREAD : 0) |
           (has_stars(scene) ? KD_TRAIT_POINTS : 0) | (is_grid(scene) || is_spread(scene) ? KD_TRAIT_SPREAD : 0) |
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
    static const char *const stars[] = { "", "A celestial grid", "Stars", "The stars of the Hipparcos catalogue", "" };
    const char *spread = !is_spread(scene) ? "" : is_picture(scene) ? "a picture of the sky" : "a Milky Way";
    const char *before = stars[scene->sky.model],
               *and = *before && *spread ? is_picture(scene) ? " over " : " and " : "";
    const bool begins = !*before; /* true if the sentence begins with the diffuse light */
    snprintf(out, KD_EMIT_TOLD, "%s%s%s%s behind.", before, and, begins ? "A" : "", begins ? spread + 1 : spread);
}

static uint64_t device_bytes(const struct kd_scene *scene)
{
    const uint64_t cells = KD_FACE_TABLE(KD_FACE_FINE) + KD_FACE_TABLE(KD_FACE_COARSE),
                   places = 6ull * kd_stars_most(scene);
    const uint32_t rows = is_picture(scene) ? KD_SKY_IMAGE_ROWS : KD_MILKY_WAY_HEIGHT; /* upper limit */
    return (is_spread(scene) ? 4ull * kd_panorama_words(2 * rows, rows) : 0) +
           (has_stars(scene) ? 4 * (5 * places + cells) : 0);
}

/* Host memory for the panorama's light before it is packed. For sky.image, also memory for all pixels of the file.
 * The scene does not contain their number, so the largest permitted number is used. */
static uint64_t making_bytes(const struct kd_scene *scene)
{
    const uint64_t rows = is_picture(scene) ? KD_SKY_IMAGE_ROWS : KD_MILKY_WAY_HEIGHT, most = KD_PANORAMA_MOST;
    return is_spread(scene) ? 12 * 2 * rows * rows + (is_picture(scene) ? 6 * 2 * most * most : 0) : 0;
}

static void fill(struct kd_emission *out, const struct kd_scene *scene)
{
    const struct kd_rotation r = kd_sky_rotation(scene); /* device/skies.c fills in the panorama's size */
    out->sky = (struct kd_sky_block) {
        .brightness = (float)kd_scene_sky_brightness(scene),
        .spacing = (float)(scene->sky.grid_deg * (M_PI / 180)),
        .spread = (float)(kd_scene_sky_brightness(scene) * scene->sky.milky_way),
        .xx = (float)r.m[0][0],
        .xy = (float)r.m[0][1],
        .xz = (float)r.m[0][2],
        .yx = (float)r.m[1][0],
        .yy = (float)r.m[1][1],
        .yz = (float)r.m[1][2],
        .zx = (float)r.m[2][0],
        .zy = (float)r.m[2][1],
        .zz = (float)r.m[2][2],
    };
}

static bool has_rim(const struct kd_scene *scene)
{
    struct kd_rim rim;
    return kd_rim_of(scene, &rim);
}

static bool is_thinned(const struct kd_scene *scene)
{
    struct kd_rim rim;
    return kd_rim_of(scene, &rim) && kd_rim_is_thinned(scene, &rim);
}

#define WHEN(name, condition) \
    static bool name(const struct kd_scene *scene, const struct kd_setting *rays) { return (void)rays, condition; }
WHEN(drawn, is_grid(scene))
WHEN(starry, has_stars(scene))
WHEN(rimmed, has_stars(scene) && has_rim(scene))
WHEN(thinned, has_stars(scene) && is_thinned(scene))
WHEN(rimless, has_stars(scene) && !has_rim(scene))
WHEN(made_up, scene->sky.model == KD_SKY_STARS)
WHEN(listed, scene->sky.model == KD_SKY_CATALOGUE)
WHEN(milky, is_spread(scene) && !is_picture(scene))
WHEN(stands_in, is_spread(scene) && !is_picture(scene) && scene->sky.model == KD_SKY_IMAGE)
WHEN(picture, is_picture(scene))
WHEN(shifted, is_spread(scene) && !is_picture(scene) && isfinite(scene->camera.r))
WHEN(picture_shifted, is_picture(scene) && isfinite(scene->camera.r))

static bool noise(const struct kd_scene *scene, const struct kd_setting *rays)
{
    return kd_sky_is_noise(scene, rays->precision);
}

static const struct kd_sentence sentences[] = {
    { "sky.grid", "sky: it is a drawn celestial grid; its lensing is exact, but its brightness is not redshifted",
      drawn },
    { "sky.noise",
      "sky: it is noise, because the camera is very close to the horizon; for most pixels a step of one pixel, or of "
      "the last digit of a ray's constants, changes the direction by more than 0.1 rad",
      noise },
    { "sky.made-up", "sky: stars are generated, with the numbers of the real sky in each magnitude", made_up },
    { "sky.hipparcos",
      "sky: the stars are those of the Hipparcos catalogue, all at infinity; the catalogue is nearly complete only to "
      "magnitude 8",
      listed },
    { "sky.star-colour",
      "sky: stars shine as black bodies with the temperature of their colour; each image is spread over some "
      "1.2 pixels",
      starry },
    { "sky.faint",
      "sky: images of stars that would brighten their pixel by less than 0.03 of sky.brightness are left out", starry },
    { "sky.rim",
      "sky: images of stars closer to the critical curve than 3e-5 of its radius are left out; for fine pixels the "
      "limit is where Sirius is no longer visible, at least 1e-7",
      rimmed },
    { "sky.few-rays",
      "sky: close to the critical curve this spin and picture size need more than the 524288 rays that are followed; "
      "images of stars are left out where the sky is so demagnified that only a few of the brightest would be visible",
      thinned },
    { "sky.no-rim",
      "sky: close to the critical curve, images of stars are left out in pixels that cover more than 0.15 rad of the "
      "sky",
      rimless },
    { "sky.milky-way",
      "sky: the light between the stars is a generated Milky Way, which differs from the real one in its details",
      milky },
    { "sky.no-image", "sky: the generated Milky Way is shown, because sky.model is \"image\" but sky.image is not set",
      stands_in },
    { "sky.picture",
      "sky: the light between the stars is a photograph, which is not calibrated: its white is taken as 21 "
      "magnitudes a square arcsecond, and stars in it are treated as diffuse light",
      picture },
    { "sky.shift", "sky: the light between the stars is shifted like that of black bodies of 5600 K", shifted },
    { "sky.tint",
      "sky: a picture of three colours has no spectrum: its light is brightened and tinted like that of black "
      "bodies of 5600 K",
      picture_shifted },
};

const struct kd_emitter kd_emit_sky = {
    .name = "sky",
    .title = "sky",
    .tell = tell,
    .present = present,
    .traits = traits,
    .needs = needs,
    .varies = varies,
    .own = &kd_emitter_buffers_sky,
    .device_bytes = device_bytes,
    .making_bytes = making_bytes,
    .fill = fill,
    .depends = { KD_SCENE_PART(sky), KD_SCENE_PART(camera), KD_SCENE_PART(disk), KD_SCENE_PART(spots),
                 KD_SCENE_PART(flash), KD_SCENE_PART(volume), KD_SCENE_PART(jets), KD_SCENE_PART(bodies) },
    .sentences = sentences,
    .n_sentences = sizeof sentences / sizeof *sentences,
};

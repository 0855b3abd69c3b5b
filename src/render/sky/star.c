#include "render/sky/star.h"

#include "base/random.h"
#include "render/sky/frame.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double arcsecond = M_PI / (180 * 3600);

double kd_star_flux(double magnitude) { return pow(10, -0.4 * (magnitude - KD_SKY_UNIT_MAG)) * arcsecond * arcsecond; }
double kd_star_kelvin(double colour) { return 4600 * (1 / (0.92 * colour + 1.7) + 1 / (0.92 * colour + 0.62)); }

static struct kd_star star(struct kd_vec n, double magnitude, double colour)
{
    return (struct kd_star) { (float)n.x, (float)n.y, (float)n.z, (float)kd_star_flux(magnitude),
                              (float)kd_star_kelvin(colour) };
}

static void catalogue(const struct kd_scene *scene, struct kd_stars *out)
{
    const struct kd_rotation galactic = kd_rotation_galactic();
    for (size_t k = 0; k < KD_STARS_CATALOGUE; k++) {
        const struct kd_catalogue_star s = kd_catalogue_star(k);
        if (s.magnitude > scene->sky.limit_mag)
            return;
        out->at[out->n++] = star(kd_rotate(&galactic, kd_sky_direction(s.ra, s.dec)), s.magnitude, s.colour);
    }
}

/* Magnitude of the star of a given rank in brightness. The number of stars in the catalogue grows with magnitude at
 * this rate, as far as the catalogue is complete; it has 4 995 stars to V = 6. */
static double magnitude_of_rank(double rank) { return 6 + log10(rank / 4995) / 0.49; }

/* A random direction. Half of the bright stars and a third of the faint ones are isotropic. The others are in a layer
 * about the plane, denser towards the middle. */
static struct kd_vec made_up_place(struct kd_random *random, double magnitude)
{
    double spread = fmin(fmax(0.6 - 0.035 * magnitude, 0.3), 0.7), l = 2 * M_PI * kd_random(random),
           z = 2 * kd_random(random) - 1;
    bool anywhere = kd_random(random) < spread;
    double far = -log(1 - kd_random(random)), above = kd_random(random) < 0.5 ? -1 : 1, towards = kd_random(random),
           side = kd_random(random);
    if (anywhere)
        return kd_sky_direction(l, asin(z));
    if (towards < 0.3)
        l = (side < 0.5 ? -1 : 1) * far * (40 * M_PI / 180) + 0.3 * l;
    return kd_sky_direction(l, above * fmin(far * (8 * M_PI / 180), M_PI / 2));
}

static double made_up_colour(struct kd_random *random)
{
    double n = 0, of = kd_random(random);
    for (int i = 0; i < 4; i++) /* approximately Gaussian, of variance 1/3 */
        n += kd_random(random) - 0.5;
    return of < 0.45 ? 0.1 + 0.35 * n : of < 0.75 ? 0.6 + 0.3 * n : 1.15 + 0.35 * n;
}

static void made_up(const struct kd_scene *scene, struct kd_stars *out)
{
    struct kd_random random = { (uint64_t)scene->sky.seed << 32 };
    for (size_t k = 0; k < KD_STARS_MADE_UP; k++) {
        double magnitude = magnitude_of_rank((double)k + kd_random(&random));
        if (magnitude > scene->sky.limit_mag)
            return;
        struct kd_vec place = made_up_place(&random, magnitude);
        out->at[out->n++] = star(place, magnitude, made_up_colour(&random));
    }
}

size_t kd_stars_most(const struct kd_scene *scene)
{
    return scene->sky.model == KD_SKY_CATALOGUE ? KD_STARS_CATALOGUE
           : scene->sky.model == KD_SKY_STARS   ? KD_STARS_MADE_UP
                                                : 0;
}

enum kd_status kd_stars_make(const struct kd_scene *scene, struct kd_stars *out, struct kd_error *error)
{
    *out = (struct kd_stars) { .at = malloc((kd_stars_most(scene) + 1) * sizeof *out->at) };
    if (!out->at)
        return kd_error_set(error, KD_ENOMEM, "out of memory for stars");
    if (scene->sky.model == KD_SKY_CATALOGUE)
        catalogue(scene, out);
    if (scene->sky.model == KD_SKY_STARS)
        made_up(scene, out);
    return KD_OK;
}

void kd_stars_finish(struct kd_stars *stars)
{
    free(stars->at);
    *stars = (struct kd_stars) { 0 };
}

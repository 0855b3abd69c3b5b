/* The stars of a sky, as points: the stars of the Hipparcos catalogue, or the same number of random ones. Pure; any
 * thread.
 *
 * Directions are galactic, J2000: x towards l = 0, b = 0, z towards the galactic pole. Fluxes are in units of the light
 * of one steradian of surface brightness KD_SKY_UNIT_MAG: F = 10^(-0.4 (V - 21)) square arcseconds. Diffuse light and
 * points thus keep their true ratio in the V band; sky.brightness multiplies both. */
#ifndef KD_RENDER_SKY_STAR_H
#define KD_RENDER_SKY_STAR_H

#include "base/error.h"
#include "scene/scene.h"

#include <stddef.h>

#define KD_SKY_UNIT_MAG 21.0 /* magnitudes a square arcsecond */
#define KD_STARS_CATALOGUE 118216
#define KD_STARS_MADE_UP 131072

struct kd_star {
    float x, y, z;
    float flux;   /* flux in sr, in the unit described above */
    float kelvin; /* temperature of the black body that has the star's colour, K */
};
struct kd_stars {
    struct kd_star *at; /* the brightest first */
    size_t n;
};
/* Makes the stars of sky.model that are at least as bright as sky.limit_mag; no stars for other models. The only error
 * is KD_ENOMEM. About 30 ms. */
enum kd_status kd_stars_make(const struct kd_scene *scene, struct kd_stars *out, struct kd_error *error);
void kd_stars_finish(struct kd_stars *stars);
/* An upper bound on the number of stars that kd_stars_make returns. */
size_t kd_stars_most(const struct kd_scene *scene);

/* kd_star_flux: the flux of a magnitude V. kd_star_kelvin: the temperature of a black body of colour B-V: F. J.
 * Ballesteros 2012, EPL 97, 34008, eq. 14. */
double kd_star_flux(double magnitude);
double kd_star_kelvin(double colour);

/* Star k of the packed catalogue (scripts/pack-stars), the brightest first. */
/* ra, dec: radians, J2000; magnitude: V; colour: B-V */
struct kd_catalogue_star { double ra, dec, magnitude, colour; };
struct kd_catalogue_star kd_catalogue_star(size_t k);

#endif

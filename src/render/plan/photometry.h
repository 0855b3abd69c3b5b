/* Photometry says how much light a picture gets and where its centre is, from linear radiance: the same at any
 * exposure, and in any resolution but for what falls between its rays.
 *
 * The flux is the sum over the pixels of luminance times solid angle. At infinity that is the area in the image
 * plane, so that the unit is M^2 times that of brightness (the disk's brightest): over D^2 it is the flux at the
 * distance D. From a finite radius it is sr times that of brightness. The centroid, weighed by this, is (alpha,
 * beta) in M, or at a finite radius the mean direction, degrees to the right of the hole and above it. Both know
 * nothing of the camera's aim and roll.
 *
 * Of polarised light Stokes Q, U and V are the same sums of the layers of these names, in the unit of the flux: by
 * the top of the picture, which the camera's roll turns.
 *
 * shaders/comp/photometry.comp adds up 64 pixels each in 32 bits, to 3e-7; the rest is done in double. */
#ifndef KD_RENDER_PLAN_PHOTOMETRY_H
#define KD_RENDER_PLAN_PHOTOMETRY_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_plan;

struct kd_light {
    double flux;
    double x, y;    /* of the centroid; NAN: there is no light */
    double q, u, v; /* Stokes Q, U and V, as the flux is Stokes I; 0 where the scene is not polarised */
};

struct kd_light_report {
    bool measured;              /* the plan asked for it (kd_plan.light) */
    bool polarized, circular;   /* there is Q and U; and V */
    struct kd_light all, spots; /* of the whole picture; of what its hot spots add */
};

/* The part of the light that is linearly polarised; and the angle of its electric field, from the top of the picture
 * to its left, in (-pi/2, pi/2]. NAN: none. */
double kd_light_fraction(const struct kd_light *light);
double kd_light_evpa(const struct kd_light *light);

/* Count the groups of photometry.comp for the pixels of a band, the sums of an invocation, and the bytes of all:
 * every band has as many as the first. */
uint32_t kd_light_groups(uint32_t pixels);
uint32_t kd_light_sums(const struct kd_plan *plan);
uint64_t kd_light_bytes(const struct kd_plan *plan);

/* Makes flux, centroid and polarisation of the sums of photometry.comp, kd_light_bytes of them. Pure. */
struct kd_light_report kd_light_of(const struct kd_scene *scene, const struct kd_plan *plan, const float *sums);

#endif

/* Photometry says how much light a picture gets and where its centre is, from linear radiance: the same at any exposure, and in any resolution but
 * for what falls between its rays.
 *
 * The flux is the sum over the pixels of luminance times solid angle. At infinity that is the area in the image plane, so that the
 * unit is M^2 times that of brightness (the disk's brightest): over D^2 it is the flux at the distance D. From a finite radius
 * it is sr times that of brightness. The centroid, weighed by this, is (alpha, beta) in M, or at a finite radius the mean
 * direction, degrees to the right of the hole and above it. Both know nothing of the camera's aim and roll.
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
    double x, y; /* of the centroid; NAN: there is no light */
};

struct kd_light_report {
    bool measured;              /* the plan asked for it (kd_plan.light) */
    struct kd_light all, spots; /* of the whole picture; of what its hot spots add */
};

/* Count the groups of photometry.comp for the pixels of a band, and the bytes of the sums: every band has as many as the first. */
uint32_t kd_light_groups(uint32_t pixels);
uint64_t kd_light_bytes(const struct kd_plan *plan);

/* Makes flux and centroid of n times the KD_LIGHT_SUMS sums of photometry.comp. Pure. */
struct kd_light_report kd_light_of(const struct kd_scene *scene, const float *sums, size_t n);

#endif

/* Photometry: flux and centroid of a picture, from linear radiance. Flux and centroid are independent of the exposure.
 * Their only dependence on the resolution is that rays miss the light between them.
 *
 * The flux is the sum over the pixels of luminance times solid angle. At infinity solid angle is the area in the image
 * plane. The unit of the flux is then M^2 times the unit of brightness (the disk's maximum), and the flux at the
 * distance D is this number divided by D^2. At a finite radius the unit is sr times that of brightness. The centroid
 * has the same weights. It is (alpha, beta) in M; at a finite radius it is the mean direction, in degrees to the right
 * of the hole and above it. Neither depends on the camera's aim and roll.
 *
 * For polarised light, the same sums of the layers Q, U and V give Stokes Q, U and V, in the unit of the flux. Stokes Q
 * and U are relative to the top of the picture, which rotates with the camera's roll.
 *
 * shaders/comp/photometry.comp sums 64 pixels at a time in 32 bits, to 3e-7; these sums are added in double. */
#ifndef KD_RENDER_PLAN_PHOTOMETRY_H
#define KD_RENDER_PLAN_PHOTOMETRY_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_plan;
struct kd_plan_light;

struct kd_light {
    double flux;
    double x, y;    /* the centroid; NAN: there is no light */
    double q, u, v; /* Stokes Q, U and V in the unit of the flux (Stokes I); 0 if the scene is not polarised */
};

struct kd_light_report {
    bool measured;              /* true if the plan requested it (kd_plan_light.photometry) */
    bool polarized, circular;   /* polarized: true if there are Q and U; circular: true if there is V */
    struct kd_light all, spots; /* all: light of the whole picture; spots: light of the hot spots only */
};

/* kd_light_fraction: degree of linear polarisation. kd_light_evpa: angle of the electric field from the top of the
 * picture towards its left, in (-pi/2, pi/2]. NAN: undefined. */
double kd_light_fraction(const struct kd_light *light);
double kd_light_evpa(const struct kd_light *light);

/* kd_light_groups: number of workgroups of photometry.comp for the pixels of a band. kd_light_sums: number of sums of
 * one invocation. kd_light_bytes: bytes of all sums; each band has as many sums as the first. */
uint32_t kd_light_groups(uint32_t pixels);
uint32_t kd_light_sums(const struct kd_plan_light *light);
uint64_t kd_light_bytes(const struct kd_plan *plan);

/* Flux, centroid and polarisation from the sums of photometry.comp, which have kd_light_bytes bytes. Pure. */
struct kd_light_report kd_light_of(const struct kd_scene *scene, const struct kd_plan *plan, const float *sums);

#endif

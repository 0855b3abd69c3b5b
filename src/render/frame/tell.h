/* Reports the light of the pixel that the plan names, ray by ray and emitter by emitter, as the picture's own kernel
 * sums it (light/tell.glsl). Radiance is linear sRGB, in units of the picture. */
#ifndef KD_RENDER_FRAME_TELL_H
#define KD_RENDER_FRAME_TELL_H

#include "render/plan/plan.h"
#include "render/rays/steps.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_TOLD_PLACES 32 /* of a ray, at most */

/* An emitter gives this there. */
struct kd_told_glow {
    uint32_t emitter; /* kd_emitters */
    float light[3];   /* with its opacity in it, and without what lies in front */
    float opacity;
    float through; /* the part of it that comes to the observer, changed by what acts on all light there */
    bool points;   /* this is of its points of light, spread over the pixel */
};

/* A place where something may shine or hide. */
struct kd_told_place {
    uint32_t order;                 /* of the crossing */
    float w, phi, slope, footprint; /* of the lens map; 0 for what it does not hold */
    float g, temperature,
        angle;      /* of gas there, whether any is; K; between light and normal in the frame of the gas, radians */
    float through;  /* what all in front lets pass */
    bool polarized; /* its light is, by this: Stokes Q and U over I */
    float stokes[2];
    struct kd_told_glow glows[KD_PLAN_EMITTERS];
    size_t n_glows;
};

/* A stretch of the ray through volumes, all of which are in it together: a part of a step of the march, or some
 * neighbours where there are many. */
struct kd_told_stretch {
    uint32_t order;   /* of the next crossing, if it comes to one */
    float w[2], u[2]; /* 1/r and cos(theta) at its ends */
    float delay[2]; /* of light from there, as that of a crossing; of an observer within the horizon it means nothing */
    float light[3]; /* that it adds to what arrives */
    float through[2]; /* what all in front lets pass, and that with it */
};
#define KD_TOLD_STRETCHES 256

/* A volume gave this along the whole ray, as far as that was followed. */
struct kd_told_volume {
    uint32_t emitter;
    float light[3]; /* as it arrives */
    float depth;
};

/* A surface that hides all behind it. */
struct kd_told_met {
    bool met;
    uint32_t emitter, which;    /* kd_emitters; the place in its list */
    uint32_t order;             /* crossings of the plane before it */
    float w, u, phi, g, cosine; /* 1/r, cos(theta), azimuth: source minus observer; of the angle of emission */
    float light[3], through;    /* without what lies in front; what that lets pass */
};

struct kd_told_ray {
    uint32_t steps_a_pixel; /* it goes through the middle of one of so many by so many parts of the pixel, */
    uint32_t x, y;          /* counted through the picture from its upper left corner */
    struct kd_told_place places[KD_TOLD_PLACES];
    struct kd_told_stretch stretches[KD_TOLD_STRETCHES];
    struct kd_told_volume volumes[KD_PLAN_EMITTERS];
    uint32_t steps, samples; /* of the march: of its integrator, and places that it looked at */
    struct kd_told_met met;
    size_t n_places, n_stretches, n_volumes, lost; /* lost: records that were not kept because there was no room */
    bool transfers; /* light of volumes is polarised on its way, by this: Stokes Q, U and V as they arrive */
    float stokes[3];
    bool given_up; /* the engine gave the ray up, and the picture shows magenta */
    bool ended;    /* something may shine where it ends: */
    float end_u, end_phi, end_footprint;
    struct kd_told_glow ends[2 * KD_PLAN_EMITTERS]; /* opacity 0; through: of all that lies before it */
    size_t n_ends;
    float through;  /* of all crossings and volumes */
    float light[3]; /* the sum */
};

struct kd_told {
    uint32_t x, y;
    struct kd_told_ray middle; /* of the square grid of image.samples, or the one before the middle, as layers have it;
                                  not among `each` where the pixel has other rays */
    struct kd_told_ray *each;  /* malloc'd: those that the pixel's light is the mean of */
    uint32_t rays;
    struct kd_rays_steps
        *steps; /* malloc'd: of the middle ray, by the engine of the picture; NULL: not asked for, or there are none: */
    char no_steps[200]; /* why, a sentence */
    bool whole;         /* what is made from now on is not this picture */
    float radiance[3];  /* of the pixel, before glare, beam and tone curve */
};
void kd_told_destroy(struct kd_told *told);

#endif

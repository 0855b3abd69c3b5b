/* Describes the light of the plan's pixel ray by ray and emitter by emitter, as the picture's own kernel sums it
 * (light/probe.glsl). Radiance is linear sRGB, in the picture's unit. */
#ifndef KD_RENDER_FRAME_PROBE_H
#define KD_RENDER_FRAME_PROBE_H

#include "render/plan/plan.h"
#include "render/rays/steps.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_PROBED_PLACES 32 /* largest number of places of a ray */

/* Light of one emitter at a place. */
struct kd_probed_glow {
    uint32_t emitter; /* index in kd_emitters */
    float light[3];   /* light with the emitter's opacity applied, before absorption by matter in front of the place */
    float opacity;
    /* fraction of this light that reaches the observer, including factors that apply to all light at the place */
    float through;
    bool points; /* true if the light is that of the emitter's points, spread over the pixel */
};

/* A place where something may emit or absorb light. */
struct kd_probed_place {
    uint32_t order;                 /* image order of the crossing */
    float w, phi, slope, footprint; /* values of the lens map; 0 if the map does not hold the quantity */
    /* Properties of gas at the place, or those that gas there would have. g: redshift factor. temperature: in K.
     * angle: angle between light and normal in the frame of the gas, in radians */
    float g, temperature, angle;
    float through;  /* transmission of all matter in front of the place */
    bool polarized; /* true if the light is polarised; the next members are then Q/I and U/I */
    float stokes[2];
    struct kd_probed_glow glows[KD_PLAN_EMITTERS];
    size_t n_glows;
};

/* A stretch of the ray through volumes, for all volumes together. It is a part of a step of the march, or several
 * adjacent parts if there are many. */
struct kd_probed_stretch {
    uint32_t order;   /* order of the next crossing, if there is one */
    float w[2], u[2]; /* 1/r and cos(theta) at both ends of the stretch */
    float delay[2];   /* delays of the light from both ends, as for a crossing; meaningless for an observer inside the
                       * horizon */
    float light[3];   /* contribution of the stretch to the arriving light */
    float through[2]; /* transmission of all matter in front of the stretch, then with the stretch included */
};
#define KD_PROBED_STRETCHES 256

/* Contribution of one volume along the whole ray, or as far as the ray was traced. */
struct kd_probed_volume {
    uint32_t emitter;
    float light[3]; /* the volume's light as it arrives */
    float depth;
};

/* An opaque surface. */
struct kd_probed_met {
    bool met;
    uint32_t emitter, which; /* emitter: index in kd_emitters; which: index in the emitter's list */
    uint32_t order;          /* number of crossings of the plane before the surface */
    /* w: 1/r; u: cos(theta); phi: azimuth (source minus observer); g: redshift factor; cosine: cosine of the emission
     * angle */
    float w, u, phi, g, cosine;
    /* light: light before absorption in front of the surface; through: transmission of all matter in front */
    float light[3], through;
};

struct kd_probed_ray {
    uint32_t steps_a_pixel; /* number of cells along a side of a pixel; the ray goes through the centre of a cell */
    uint32_t x, y;          /* column and row of that cell, counted over the whole picture from its upper left corner */
    struct kd_probed_place places[KD_PROBED_PLACES];
    struct kd_probed_stretch stretches[KD_PROBED_STRETCHES];
    struct kd_probed_volume volumes[KD_PLAN_EMITTERS];
    uint32_t steps, samples; /* steps: number of integration steps of the march; samples: number of its samples */
    struct kd_probed_met met;
    size_t n_places, n_stretches, n_volumes, lost; /* lost: number of records that did not fit */
    bool transfers; /* true if volumes transfer polarised light; `stokes` is then Stokes Q, U and V as they arrive */
    float stokes[3];
    bool given_up; /* true if the engine gave the ray up; the picture then shows magenta */
    bool ended;    /* true if an emitter may shine at the ray's end, which the next three members describe */
    float end_u, end_phi, end_footprint;
    /* ends: light of each emitter at the end, with opacity 0; through: transmission of all matter before the end */
    struct kd_probed_glow ends[2 * KD_PLAN_EMITTERS];
    size_t n_ends;
    float through;  /* transmission of all crossings and volumes together */
    float light[3]; /* light of the whole ray */
};

struct kd_probed_pixel {
    uint32_t x, y;
    /* the middle ray of the square grid of image.samples; if the grid has no middle ray, the ray before the middle.
     * Layers are computed for this ray as well. This ray is not among `each` if the pixel has other rays */
    struct kd_probed_ray middle;
    struct kd_probed_ray *each; /* malloc'd: the rays whose mean is the pixel's light */
    uint32_t rays;
    struct kd_rays_steps *steps; /* malloc'd: engine steps of the middle ray; NULL: not requested, or not available */
    char no_steps[200];          /* a sentence that gives the reason why `steps` is NULL */
    /* true if the description is complete; later renders of this job are then ignored, because they do not belong to
     * this picture */
    bool whole;
    float radiance[3]; /* light of the pixel, before bloom, beam and tone curve */
};
void kd_probed_destroy(struct kd_probed_pixel *told);

#endif

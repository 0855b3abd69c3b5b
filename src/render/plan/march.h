/* Step sizes of the march through volumes (shaders/light/march.glsl), from the scene's accuracy. Pure; any thread. */
#ifndef KD_RENDER_PLAN_MARCH_H
#define KD_RENDER_PLAN_MARCH_H

#include "render/accuracy/engine.h"

/* Target of each profile for the relative error of light: draft, interactive, balanced, high, reference. Nine of ten
 * rays meet the target. accuracy.tolerance is such a target. Light has 32 bits, whose rounding leaves an error of
 * 5e-6 where light is smooth. Turbulence has targets of its own, because its error falls as the third power of the
 * cost instead of the sixth. Rounding leaves an error of 5e-5 of the turbulent noise. */
#define KD_MARCH_ERRORS { 2e-3, 1e-3, 1e-4, 1e-5, 5e-6 }
#define KD_MARCH_STIRRED_ERRORS { 2e-2, 1e-2, 1e-3, 1e-4, 5e-5 }

/* Pixels of a picture on a lattice. Columns are every[0] apart, from column first[0] on. Rows are every[1] apart, from
 * row first[1] on. */
struct kd_march_sample { uint32_t columns, rows, every[2], first[2]; };

struct kd_march {
    uint32_t steps; /* steps per half period, at least 8; 0: the scene has no volumes */
    double weight;  /* cost of a ray, relative to one through a smooth volume at the balanced profile */
    /* resolution, 2 to 64: a stretch is at most 4/fine grains long (grain: the length that an emitter reports). Where
     * light is smooth, the error falls at least as the fourth power of `fine` */
    uint32_t fine;
    /* a ray ends where less than this fraction of the light from behind is transmitted. The fraction is a tenth of the
     * target for the error */
    double opaque;
    /* octaves of noise are left out if their amplitude is less than this fraction of the first octave's; the
     * amplitude is reduced by the local gas and by the ray's footprint */
    double unseen;
    bool sketched; /* true if the march is a sketch, coarser than with any profile (kd_march_sketch) */
    struct kd_march_sample
        sample; /* pixels whose rays are followed twice more, to measure the error (frame/march_error.c) */
};
/* target of a sketch for the error; the octaves that a sketch leaves out cause an additional error */
#define KD_MARCH_SKETCHED 0.05
#define KD_MARCH_HOLDS 5e-5  /* the smallest tolerance that can be requested; this error is met even in turbulence */
#define KD_MARCH_SAMPLED 256 /* largest number of pixels of the sample */
#define KD_MARCH_FINER 2     /* factor by which the reference for measuring the error has more steps and stretches */
/* fraction of the light of the brightest ray. The errors of darker rays are relative to this light */
#define KD_MARCH_DARK 1e-3

/* The march for a scene with volumes or bodies, whose rays are traced with this setting. */
struct kd_march kd_march_of(const struct kd_scene *scene, const struct kd_setting *rays);

/* The march of a live view, used while the view changes on a slow machine. It has the fewest stretches and no finer
 * octaves of noise, and its error is measured on a quarter of the rays. */
struct kd_march kd_march_sketch(struct kd_march march, const struct kd_scene *scene);

/* The given march with the numbers of steps and stretches multiplied by KD_MARCH_FINER. */
struct kd_march kd_march_finer(struct kd_march march);

#endif

/* How closely the march follows a ray through volumes (shaders/light/march.glsl), by what the scene says of
 * accuracy. Pure; any thread. */
#ifndef KD_RENDER_PLAN_MARCH_H
#define KD_RENDER_PLAN_MARCH_H

#include "render/accuracy/engine.h"

/* The relative error of light that a profile aims at in nine of ten rays: draft, interactive, balanced, high,
 * reference. accuracy.tolerance is one itself. Light is in 32 bits: 5e-6 are left where all is smooth. Turbulence,
 * whose error falls as the third power of what it costs and not as the sixth, has aims of its own; of its noise 32
 * bits leave 5e-5. */
#define KD_MARCH_ERRORS { 2e-3, 1e-3, 1e-4, 1e-5, 5e-6 }
#define KD_MARCH_STIRRED_ERRORS { 2e-2, 1e-2, 1e-3, 1e-4, 5e-5 }

/* Pixels of a picture, on a lattice: columns a row, every[0] apart from first[0] on, and rows likewise. */
struct kd_march_sample { uint32_t columns, rows, every[2], first[2]; };

struct kd_march {
    uint32_t steps; /* a half period, at least 8; 0: the scene has no volumes */
    double weight;  /* what a ray takes, over one of a smooth volume at the balanced profile */
    uint32_t fine; /* quarters of a stretch a grain, 2 to 64: where all is smooth the error falls as its fourth power at
                      least */
    double
        opaque; /* a ray ends where less than this of the light behind comes through: a tenth of the error aimed at */
    double unseen; /* octaves of noise whose part of a place's is less than this one of the first, by what gas there is
                      and what a ray stands for, are left out */
    bool sketched; /* coarser than any profile: kd_march_sketch */
    struct kd_march_sample
        sample; /* of the pixels of which a ray is followed twice more, to measure the error (frame/march_error.c) */
};
#define KD_MARCH_SKETCHED 0.05 /* the error that a sketch aims at, beside the octaves that it leaves out */
#define KD_MARCH_HOLDS 5e-5    /* an error that is held in turbulence, too: no tolerance below it is taken */
#define KD_MARCH_SAMPLED 256   /* at most */
#define KD_MARCH_FINER 2   /* so many times as many steps and stretches have those that the others are compared with */
#define KD_MARCH_DARK 1e-3 /* of the brightest ray: what is darker is compared with so much */

/* For a scene that has volumes or bodies, whose rays are followed by this. */
struct kd_march kd_march_of(const struct kd_scene *scene, const struct kd_setting *rays);

/* This is the march that a live view has while it changes and its machine has no time for more: as few stretches as
 * there are, none of the finer octaves of noise, and an error that is measured on a quarter of the rays. */
struct kd_march kd_march_sketch(struct kd_march march, const struct kd_scene *scene);

/* The same, KD_MARCH_FINER times as closely. */
struct kd_march kd_march_finer(struct kd_march march);

#endif

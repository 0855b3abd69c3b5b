/* How closely the march follows a ray through volumes (shaders/light/march.glsl), by what the scene says of accuracy. Pure; any thread. */
#ifndef KD_RENDER_PLAN_MARCH_H
#define KD_RENDER_PLAN_MARCH_H

#include "render/accuracy/engine.h"

/* The relative error of light that a profile is meant to have: draft, interactive, balanced, high, reference. accuracy.tolerance is one itself. */
#define KD_MARCH_ERRORS { 2e-3, 1e-3, 1e-4, 1e-5, 1e-6 }

struct kd_march {
    uint32_t steps; /* a half period, at least 8; 0: the scene has no volumes */
    uint32_t fine;  /* quarters of a stretch a grain, 2 to 64: where all is smooth the error falls as its fourth power at least */
};

/* For a scene that has volumes, whose rays are followed by this. */
struct kd_march kd_march_of(const struct kd_scene *scene, const struct kd_setting *rays);
/* Twice as close in all, to measure an error by; at most what there is room for. */
struct kd_march kd_march_finer(struct kd_march march);

#endif

/* Quality of a live frame: how much of the scene is rendered, and the ladder of qualities below the requested one.
 * The governor (governor.h) chooses the rung. Plain values, pure functions; any thread. */
#ifndef KD_RENDER_LIVE_QUALITY_H
#define KD_RENDER_LIVE_QUALITY_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_quality {
    uint32_t width, height; /* pixels to render */
    double scale;           /* fraction of the requested width and height: 1, 3/4, 5/8, 1/2, 3/8 or 1/4 */
    int32_t samples;        /* rays along each side of a pixel */
    int32_t orders;         /* recorded crossings a ray */
    int32_t critical;       /* limit for image.critical_factor; 0: as requested */
    /* enum kd_profile: a profile that replaces all of accuracy.* except the engine; -1: accuracy.* as requested */
    int32_t profile;
    bool sketch; /* true if volumes are marched more coarsely than with any profile: render/plan/march.h */
    bool bright; /* true if only the bright images of stars are shown: plan.bright of render/plan/plan.h */
    bool final;  /* true if everything is as requested */
};

/* Makes the scene to render: *asked at this quality. The result is valid if *asked is valid. With quality.final it
 * equals *asked, byte for byte. */
void kd_quality_apply(const struct kd_quality *quality, const struct kd_scene *asked, struct kd_scene *out);

struct kd_rung {
    struct kd_quality quality;
    /* the work of a rung. rays: number of rays, weighted by the cost of one ray. pixels: number of pixels */
    double rays, pixels;
};

/* Limits for the lowest rung. */
struct kd_ladder_bounds {
    double scale;                     /* least scale, at least 1/4 */
    uint32_t width;                   /* least width in pixels of all rungs but the first */
    int32_t samples, orders, profile; /* lower limits, which never exceed the requested values */
};
#define KD_LADDER_BOUNDS_DEFAULT { .scale = 0.25, .width = 160, .samples = 1, .orders = 2, .profile = KD_PROFILE_DRAFT }

enum { KD_LADDER_RUNGS = 20, KD_LADDER_STEPS = 8 };

struct kd_ladder {
    /* The ladder downwards from the requested quality. It reduces samples first, because a moving picture needs its
     * pixels more than smooth edges. Next it reduces resolution, then orders (not for the projection "ring"), then the
     * steps along a ray. Last, for volumes, it reduces the steps through them. Each rung takes less work than the one
     * before. */
    struct kd_rung rungs[KD_LADDER_RUNGS];
    size_t n_rungs;
    /* The ladder upwards for a scene at rest. It begins with full resolution and one ray a pixel. The next steps have
     * more rays, with at most the profile "balanced". The last step is the requested quality. Each step takes more
     * work than the one before. */
    struct kd_rung steps[KD_LADDER_STEPS];
    size_t n_steps;
};
void kd_ladder_make(const struct kd_scene *asked, const struct kd_ladder_bounds *bounds, struct kd_ladder *out);

#endif

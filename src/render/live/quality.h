/* Quality of a live frame: how much of the scene it renders, and the ladder of qualities from all of it downwards.
 * Plain values, pure functions; any thread. The governor (governor.h) chooses the rung. */
#ifndef KD_RENDER_LIVE_QUALITY_H
#define KD_RENDER_LIVE_QUALITY_H

#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_quality {
    uint32_t width, height; /* pixels to render */
    double scale;           /* of the asked width and height: 1, 3/4, 5/8, 1/2, 3/8 or 1/4 */
    int32_t samples;        /* rays along each side of a pixel */
    int32_t orders;         /* crossings kept a ray */
    int32_t critical;       /* image.critical_factor at most; 0: as asked */
    int32_t profile;        /* enum kd_profile in place of all of accuracy.* but engine; -1: accuracy.* as asked */
    bool sketch;            /* volumes are followed more coarsely than any profile has them: render/plan/march.h */
    bool bright;            /* of stars only bright images: plan.bright of render/plan/plan.h */
    bool final;             /* everything is as asked */
};

/* Makes the scene to render: *asked at this quality. It is valid if *asked is; with quality.final it is *asked
 * itself, byte for byte. */
void kd_quality_apply(const struct kd_quality *quality, const struct kd_scene *asked, struct kd_scene *out);

struct kd_rung {
    struct kd_quality quality;
    double rays, pixels; /* work: rays, weighted by what one costs; pixels */
};

/* These bounds say how far down a ladder may go. */
struct kd_ladder_bounds {
    double scale;                     /* 1/4 is the least there is */
    uint32_t width;                   /* no rung but the first is narrower than this, in pixels */
    int32_t samples, orders, profile; /* never more than what is asked */
};
#define KD_LADDER_BOUNDS_DEFAULT { .scale = 0.25, .width = 160, .samples = 1, .orders = 2, .profile = KD_PROFILE_DRAFT }

enum { KD_LADDER_RUNGS = 20, KD_LADDER_STEPS = 8 };

struct kd_ladder {
    /* Makes the ladder downwards from what is asked. It gives up samples first, for what moves needs its pixels more
     * than smooth edges, then resolution, then orders (of the projection "ring" none), then the steps along a ray,
     * and last, where there are volumes, the steps through them. Each is less work than the one before. */
    struct kd_rung rungs[KD_LADDER_RUNGS];
    size_t n_rungs;
    /* Makes the ladder upwards, for a scene that rests: full resolution with one ray a pixel, then more, all by at
     * most the profile "balanced"; last, what is asked. Each is more work than the one before. */
    struct kd_rung steps[KD_LADDER_STEPS];
    size_t n_steps;
};
void kd_ladder_make(const struct kd_scene *asked, const struct kd_ladder_bounds *bounds, struct kd_ladder *out);

#endif

/* The passes of a frame and their costs, as two lists. Plan, capacity, cost measurement, the device's JSON, its cached
 * costs and sessions iterate over them. Constant data and pure functions, any thread.
 *
 * To add a pass, write its line here, its number of invocations in pass.c, its file in src/render/frame/, and its call
 * in frame.c, which names it by kd_passes[KD_PASS_...].name. A pass that belongs to an emitter is defined in the
 * emitter's files only (KD_PASS_name of shaders/shared/emitters.h, render/emit/own.h). Below, all such passes appear as
 * KD_EMIT_PASSES. */
#ifndef KD_RENDER_PLAN_PASS_H
#define KD_RENDER_PLAN_PASS_H

#include "emitters.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_capacity;
struct kd_plan;
struct kd_scene;

/* Performance figures: nanoseconds per item, measured on frames. F(id, word, guess): GET /v1/device and the cache use
 * the word. The guess is lavapipe's value; it is used until the figure has been measured. */
#define KD_FIGURES(F) \
    F(RAY_RADIUS, "ray_radius", 30)           /* a ray of a lens map of radii only, in closed form */ \
    F(RAY_FULL, "ray_full", 150)              /* any other ray that a kernel traces */ \
    F(SAMPLE_TRANSFER, "sample_transfer", 20) /* light of a ray */ \
    F(PIXEL_POST, "pixel_post", 30) \
    F(RAY_MARCH, "ray_march", 4000)     /* light of a ray through volumes */ \
    F(RAY_REFINED, "ray_refined", 400)  /* a ray planned for refinement, including its selection */ \
    F(RAY_STARS, "ray_stars", 220)      /* a ray's search for stars, and the images of these stars */ \
    F(SAMPLE_STARS, "sample_stars", 90) /* light of a ray under a sky of stars */

#define KD_FIGURE_ID_(id, word, guess) KD_NS_##id,
#define KD_P(emitter, id, word, guess) KD_NS_##id,
enum kd_figure_id { KD_FIGURES(KD_FIGURE_ID_) KD_EMIT_PASSES KD_FIGURE_COUNT, KD_NS_NONE = KD_FIGURE_COUNT };
#undef KD_P
extern const struct kd_figure {
    const char *word;
    double guess;
} kd_figures[KD_FIGURE_COUNT];

/* Passes, in the order in which a plan names them. P(id, name, invocations, cost, scale, when):
 *
 *   name         in Server-Timing and in plans
 *   invocations  a function of pass.c: number of invocations in a plan; 0: the plan does not have this pass
 *   cost         WHOLE(kernel, figure): an invocation costs the figure, which the pass's measured time updates
 *                PART(kernel, figure, share): an invocation costs this share of the figure
 *                BY(function): a function of pass.c computes kernel, figure and cost
 *   scale        its time grows with the number of RAYS or PIXELS, or is FIXED whatever the picture's size
 *   when         it runs for each FRAME, or only when a lens MAP is made
 *
 * A kernel is a file under shaders/comp; "" is a copy or work on the CPU. */
#define KD_PASSES(P) \
    P(TRACE, "trace", traced, BY(trace), RAYS, MAP) \
    P(INTERPOLATE, "interpolate", interpolated, BY(interpolate), RAYS, MAP) \
    P(FOOTPRINT, "footprint", footprints, PART("footprint.comp", RAY_FULL, 0.5), RAYS, MAP) \
    P(AUDIT, "audit", audited, BY(audit), FIXED, MAP) \
    KD_EMIT_PASSES \
    P(STARS, "stars", starred, WHOLE("star_tiles.comp", RAY_STARS), RAYS, FRAME) \
    P(TRANSFER, "transfer", lit, BY(transfer), RAYS, FRAME) \
    P(MARCH, "march", marched, BY(march), RAYS, FRAME) \
    P(MARCH_ERROR, "march_error", sampled, BY(march_error), RAYS, FRAME) \
    P(REFINE, "refine", refined, BY(refine), RAYS, FRAME) \
    P(LAYERS, "layers", layered, PART("layers.comp", SAMPLE_TRANSFER, 0.5), PIXELS, FRAME) \
    P(LIGHT, "light", added_up, PART("photometry.comp", PIXEL_POST, 1.5), PIXELS, FRAME) \
    P(BEAM, "beam", beamed, BY(beam), PIXELS, FRAME) \
    P(EXPOSE, "expose", exposed, PART("expose.comp", PIXEL_POST, 0.25), PIXELS, FRAME) \
    P(BLOOM, "bloom", spread, BY(bloom), PIXELS, FRAME) \
    P(POST, "post", posted, BY(post), PIXELS, FRAME) \
    P(READBACK, "readback", posted, PART("", PIXEL_POST, 0.1), PIXELS, FRAME)

#define KD_PASS_ID_(id, ...) KD_PASS_##id,
#define KD_P(emitter, id, word, guess) KD_PASS_OWN_##emitter,
enum kd_pass_id { KD_PASSES(KD_PASS_ID_) KD_PASS_COUNT };
#undef KD_P

struct kd_pass_cost {
    const char *kernel;
    double ns;
    enum kd_figure_id figure; /* the performance figure that the pass's measured time updates; KD_NS_NONE: none */
};

struct kd_pass {
    const char *name;
    uint64_t (*invocations)(const struct kd_plan *plan, const struct kd_scene *scene);
    struct kd_pass_cost (*by)(const struct kd_plan *plan,
                              const struct kd_capacity *capacity); /* NULL: the next members give the cost */
    const char *kernel;
    enum kd_figure_id figure;
    double share;
    bool whole;
    enum kd_pass_scale { KD_SCALE_RAYS, KD_SCALE_PIXELS, KD_SCALE_FIXED } scale;
    enum kd_pass_when { KD_EACH_FRAME, KD_EACH_MAP } when;
};
extern const struct kd_pass kd_passes[KD_PASS_COUNT];

/* Finds a pass by its name; NULL if there is none. */
const struct kd_pass *kd_pass_find(const char *name);
/* Estimates the cost of an invocation on a device. The plan's path, setting and quantities must be set. */
struct kd_pass_cost kd_pass_cost(const struct kd_pass *pass, const struct kd_plan *plan,
                                 const struct kd_capacity *capacity);

#endif

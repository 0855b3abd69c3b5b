/* A renderer makes pictures of scenes, on the thread that has it. */
#ifndef KD_RENDER_FRAME_FRAME_H
#define KD_RENDER_FRAME_FRAME_H

#include "render/device/renderer.h"
#include "render/frame/layer.h"
#include "render/plan/photometry.h"
#include "scene/scene.h"

#include <stddef.h>

struct kd_timing {
    char name[24];
    double ms;
};
#define KD_FRAME_MAX_TIMINGS 32

struct kd_frame {
    uint32_t width, height;
    struct kd_layer layers[KD_FRAME_MAX_LAYERS];
    size_t n_layers;
    char credit[KD_CREDIT]; /* whose work is in it, as they ask to be named; "": nobody does */
    double exposure;        /* stops that were applied */
    bool lens_reused;       /* the trace pass was skipped: the lens map was in the cache */
    uint32_t others_traced; /* lens maps of the other pictures that its light is the mean with (frame/blur.h) */
    struct kd_accuracy_report accuracy;
    struct kd_light_report light;
    double density_scale; /* what the density was multiplied by (volume.normalise_to_jy); 1: by nothing */
    struct kd_told *told; /* of the pixel that the plan names (frame/tell.h); NULL: of none */
    struct kd_timing timings[KD_FRAME_MAX_TIMINGS]; /* by the names of plan/pass.h, "upload", "fill", those that ran;
                                                       "kernels" where some had to be made; "total" */
    size_t n_timings;
};
void kd_frame_finish(struct kd_frame *frame);

/* These are of the first layer. */
static inline void *kd_frame_pixels(const struct kd_frame *frame) { return frame->layers[0].data; }
static inline int kd_frame_bit_depth(const struct kd_frame *frame)
{
    return frame->layers[0].type == KD_LAYER_U16 ? 16 : 8;
}

/* Render a valid scene by its plan (made with this renderer's capacity). */
enum kd_status kd_render(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                         kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error);

/* How a picture that takes long looks so far: it is drawn from the top, some rows at a time. Called between these. */
struct kd_glance {
    bool (*wanted)(void *user);
    /* frame: of the whole size, black from row `rows` on, with an exposure of its own where that is "auto", no
     * timings and no accuracy. Its layers are not the callee's to keep. */
    void (*seen)(void *user, const struct kd_frame *frame, uint32_t rows);
};

/* The same with buffers of its own. progress, called at least every 100 ms or so, may let other threads use the
 * renderer before it returns, for anything that this header has, and the picture stays the same to the byte. At most
 * KD_ASIDES are under way at once, and what they hold between them, their plans' device_bytes, is the callers' to
 * bound: lens maps that earlier ones left make room. Timings are without what progress took. glance: NULL, or both
 * functions, with the same user. */
enum kd_status kd_render_aside(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                               kd_progress_fn progress, const struct kd_glance *glance, void *user,
                               struct kd_frame *out, struct kd_error *error);

/* Linear light of other pictures of the same size, added up: red, green and blue of each pixel, rows from the top,
 * of n pictures. */
struct kd_light_sum {
    double *sum;
    unsigned n, traced; /* traced: lens maps that were made for them */
};
/* As kd_render, or with `aside` kd_render_aside, of a picture whose light is the mean with that of others;
 * frame/blur.h is how it is asked for. plan->radiance is true, and plan->eyes 1. How far off pixels are that were
 * refined is not measured. */
enum kd_status kd_render_mean(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_light_sum *others, bool aside, kd_progress_fn progress,
                              const struct kd_glance *glance, void *user, struct kd_frame *out, struct kd_error *error);

/* The lens map alone: plan->planes planes of plan->rays floats each, rows from the top, in the order that
 * shaders/comp/lens_map.comp describes. planes: room for planes * rays floats. *trace_ms (may be NULL): device time. */
enum kd_status kd_render_lens(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              float *planes, double *trace_ms, struct kd_error *error);

#endif

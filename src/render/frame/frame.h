/* Renders pictures of scenes, on the thread that owns the renderer. */
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
    char credit[KD_CREDIT]; /* credits of the picture's sources, in the form that their authors request; "": none */
    double exposure;        /* exposure that was applied, in stops */
    bool lens_reused;       /* true if the trace pass was skipped because the lens map was cached */
    uint32_t others_traced; /* number of lens maps traced for the other pictures of a mean (frame/blur.h) */
    struct kd_accuracy_report accuracy;
    struct kd_light_report light;
    double density_scale;         /* factor that was applied to the density (volume.normalise_to_jy); 1: none */
    struct kd_probed_pixel *told; /* light of the pixel that the plan names (frame/probe.h); NULL: none */
    /* times of the passes that ran, by the names of plan/pass.h. Also the times "upload", "fill" and "total", and
     * "kernels" if some kernels had to be made */
    struct kd_timing timings[KD_FRAME_MAX_TIMINGS];
    size_t n_timings;
};
void kd_frame_finish(struct kd_frame *frame);

/* Pixels and bit depth of the first layer. */
static inline void *kd_frame_pixels(const struct kd_frame *frame) { return frame->layers[0].data; }
static inline int kd_frame_bit_depth(const struct kd_frame *frame)
{
    return frame->layers[0].type == KD_LAYER_U16 ? 16 : 8;
}

/* Renders a valid scene by its plan, which must have been made with this renderer's capacity. */
enum kd_status kd_render(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                         kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error);

/* Preview of a long picture. The picture is drawn from the top, some rows at a time. The hook's functions are called
 * between two steps. */
struct kd_preview_hook {
    bool (*wanted)(void *user);
    /* Called with a frame of full size that is black from row `rows` on. If the exposure is "auto", the frame has an
     * exposure of its own. It has neither timings nor accuracy. The frame's layers are valid only during the call. */
    void (*seen)(void *user, const struct kd_frame *frame, uint32_t rows);
};

/* Renders like kd_render, with separate buffers. progress is called about every 100 ms. While progress runs, other
 * threads may use the renderer for anything in this header. The picture's bytes do not depend on such use. At most
 * KD_BACKGROUND_RENDERS may run concurrently, and the callers must limit their total memory, the sum of the plans'
 * device_bytes. Cached lens maps of finished background renders are evicted to make room. Timings exclude the time
 * spent in progress. preview: NULL, or both functions, called with `user`. */
enum kd_status kd_render_in_background(struct kd_renderer *renderer, const struct kd_scene *scene,
                                       const struct kd_plan *plan, kd_progress_fn progress,
                                       const struct kd_preview_hook *preview, void *user, struct kd_frame *out,
                                       struct kd_error *error);

/* Sum of the linear light of n other pictures of the same size: red, green and blue of each pixel, rows from the
 * top. */
struct kd_light_sum {
    double *sum;
    unsigned n, traced; /* traced: number of lens maps that were traced for these pictures */
};
/* Like kd_render (or kd_render_in_background if `background`), for a picture whose light is averaged with that of
 * others. Called by frame/blur.h. plan->picture.radiance must be true, and plan->picture.eyes 1. The error of
 * refined pixels is not measured. */
enum kd_status kd_render_mean(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_light_sum *others, bool background, kd_progress_fn progress,
                              const struct kd_preview_hook *preview, void *user, struct kd_frame *out,
                              struct kd_error *error);

/* Renders only the lens map: plan->lens.planes planes of plan->lens.rays floats each, rows from the top, in the order
 * that shaders/comp/lens_map.comp describes. planes: room for planes * rays floats. *trace_ms (may be NULL): device
 * time. */
enum kd_status kd_render_lens(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              float *planes, double *trace_ms, struct kd_error *error);

#endif

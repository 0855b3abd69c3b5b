/* Scenes to pictures on one device. One thread at a time has a struct kd_renderer, and hands it on with a lock; the only
 * call allowed from others meanwhile is kd_renderer_capacity. */
#ifndef KD_RENDER_RENDER_H
#define KD_RENDER_RENDER_H

#include "base/error.h"
#include "render/light.h"
#include "render/plan.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_renderer;

struct kd_renderer_params {
    const char *device;     /* as kd_vk_params */
    const char *cache_dir;  /* as kd_vk_params */
    bool validate;
    bool prove;             /* a device that is met for the first time is tested: half a second (first_start.h) */
    uint64_t memory_bytes;  /* most memory for pictures, those rendered aside included; 0: as the device and the host have it */
};
enum kd_status kd_renderer_create(const struct kd_renderer_params *params, struct kd_renderer **out,
                                  struct kd_error *error);
void kd_renderer_destroy(struct kd_renderer *renderer);

/* A copy of the present capacity, for kd_plan_make. Its accuracy table stays the renderer's. Any thread. */
void kd_renderer_capacity(struct kd_renderer *renderer, struct kd_capacity *out);
/* Device, driver, precision, memory, limits, versions: the JSON of GET /v1/device. */
enum kd_status kd_renderer_device_json(struct kd_renderer *renderer, struct kd_buffer *out);
/* One line: "llvmpipe (LLVM 15.0.6, 256 bits), llvmpipe Mesa 22.3.6". Any thread. */
const char *kd_renderer_device_name(const struct kd_renderer *renderer);
uint32_t kd_renderer_validation_messages(const struct kd_renderer *renderer);

/* What an answer says of its own accuracy: errors of crossing radii, measured on a sample of the picture's rays against the
 * closed form in double. sampled is 0 where that cannot be: a picture too large to keep its lens map, one without crossings. */
struct kd_accuracy_report {
    uint64_t undecided;          /* rays of the whole picture that were given up: magenta in it */
    uint32_t sampled, crossings; /* rays traced again; crossings compared */
    uint32_t differ;             /* crossings that one of the two has and the other has not; rays of another fate */
    double median, worst;        /* relative error of the radius */
};

struct kd_timing { char name[24]; double ms; };
#define KD_FRAME_MAX_TIMINGS 12

struct kd_frame {
    uint32_t width, height;
    int bit_depth;            /* 8 or 16 */
    void *pixels;             /* rows from the top, RGB, no padding; malloc'd */
    double exposure;          /* stops that were applied */
    bool lens_reused;         /* the trace pass was skipped: the lens map was in the cache */
    struct kd_accuracy_report accuracy;
    struct kd_light_report light;
    struct kd_timing timings[KD_FRAME_MAX_TIMINGS]; /* "trace", "rays", "transfer", ... (those that ran), "total" */
    size_t n_timings;
};
void kd_frame_finish(struct kd_frame *frame);

/* Called between slices with the fraction done; return false to stop: KD_ECANCELLED. */
typedef bool (*kd_progress_fn)(void *user, double fraction);

/* Render a valid scene by its plan (made with this renderer's capacity). */
enum kd_status kd_render(struct kd_renderer *renderer, const struct kd_scene *scene,
                         const struct kd_plan *plan, kd_progress_fn progress, void *user,
                         struct kd_frame *out, struct kd_error *error);

/* How a picture that takes long looks so far: it is drawn from the top, some rows at a time. Called between these. */
struct kd_glance {
    bool (*wanted)(void *user);
    /* frame: of the whole size, black from row `rows` on, with an exposure of its own where that is "auto", no timings and no
     * accuracy. Its pixels are not the callee's to keep. */
    void (*seen)(void *user, const struct kd_frame *frame, uint32_t rows);
};

/* The same with buffers of its own. progress, called at least every 100 ms or so, may let other threads use the renderer before it
 * returns, for anything that this header has, and the picture stays the same to the byte. At most KD_ASIDES are under way at once, and
 * what they hold between them, their plans' device_bytes, is the callers' to bound: lens maps that earlier ones left make room.
 * Timings are without what progress took. glance: NULL, or both functions, with the same user. */
#define KD_ASIDES 8
enum kd_status kd_render_aside(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                               kd_progress_fn progress, const struct kd_glance *glance, void *user, struct kd_frame *out,
                               struct kd_error *error);

/* The lens map alone: plan->planes planes of plan->rays floats each, rows from the top, in the order that
 * shaders/comp/lens_map.comp describes. planes: room for planes * rays floats. *trace_ms (may be NULL): device time. */
enum kd_status kd_render_lens(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              float *planes, double *trace_ms, struct kd_error *error);

#endif

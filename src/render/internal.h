/* What the files of src/render share about a renderer. */
#ifndef KD_RENDER_INTERNAL_H
#define KD_RENDER_INTERNAL_H

#include "render/kernels.h"
#include "render/rays.h"
#include "render/render.h"
#include "render/store.h"
#include "render/tables.h"

#include <pthread.h>

struct kd_renderer {
    struct kd_vk *vk;
    struct kd_kernels kernels;
    struct kd_store store;
    struct kd_vk_buffer *rays[3];    /* a list, its ends, and those on the host: rays_device.c's, kept for the next list */
    struct kd_transfer_data *tables; /* staging; its colour table is filled once */
    bool tables_ready;
    pthread_mutex_t lock; /* guards capacity */
    struct kd_capacity capacity;
    char name[800];
};

/* Learn from the device times of a frame: nanoseconds an item, smoothed. */
void kd_renderer_learn(struct kd_renderer *renderer, const struct kd_plan *plan, const struct kd_frame *frame);

/* kd_rays_trace for the engines of the device, params checked; g is left NaN. Render thread. */
enum kd_status kd_rays_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const double *alpha_beta, size_t n, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error);
/* Steps a half period that are in force: those asked for, or the engine's own. */
uint32_t kd_rays_device_steps(const struct kd_rays_params *params);
/* One ray, and the records that trace.glsl describes, as doubles: room for `numbers` of them. */
enum kd_status kd_rays_device_told(struct kd_renderer *renderer, const struct kd_rays_params *params, const double alpha_beta[2],
                                   struct kd_ray_crossing *crossings, struct kd_ray_end *end, double *told, size_t numbers,
                                   struct kd_error *error);

#endif

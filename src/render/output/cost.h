/* Estimates the total cost of several frames from their plans, before any frame is rendered. The frames are those of
 * a job, or the scenes of a sweep, which share lens maps. Pure, any thread. */
#ifndef KD_RENDER_OUTPUT_COST_H
#define KD_RENDER_OUTPUT_COST_H

#include "render/output/series.h"
#include "render/plan/sweep_order.h"

struct kd_cost {
    unsigned frames;   /* number of frames added so far */
    double ms;         /* time of all frames if each makes a lens map of its own */
    double trace_ms;   /* part of `ms`: time of lens maps that a sweep may share */
    double shared_ms;  /* time saved by sharing lens maps; set by kd_cost_end */
    double file_bytes; /* total size of the files, for formats whose file size depends only on the picture's size */
    uint64_t rays;
    uint64_t device_bytes, host_bytes; /* bytes that the largest frame needs */
    bool guessed;                      /* true if some pass has no measured cost */
    struct kd_sweep_order order;       /* order of the frames of a sweep */
    struct kd_cube_shape shape;        /* shape that all scenes of a cube have */
};

/* Adds a frame. sweep: the sweep that the frames' scenes belong to; NULL: none. Returns KD_ENOMEM, or KD_EINVAL if the
 * scenes of a cube differ in shape. */
enum kd_status kd_cost_add(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                           const struct kd_scene *scene, const struct kd_plan *plan, struct kd_error *error);
/* Call after the last frame. The only error is KD_ENOMEM. */
enum kd_status kd_cost_end(struct kd_cost *cost, struct kd_error *error);
void kd_cost_finish(struct kd_cost *cost);

/* Plans further scenes of a sweep until the time until_ms of kd_clock_ms, at least one scene. After the last scene
 * the function calls kd_cost_end. On failure, *error is about the first scene that is invalid or does not fit the
 * device. The message has the scene's number, and the pointer is /axes. series NULL: the output is not known. */
enum kd_status kd_cost_sweep(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                             const struct kd_capacity *capacity, double until_ms, struct kd_error *error);
/* Writes the document of `kerrd plan --axis` for all scenes. The only error is KD_ENOMEM. */
enum kd_status kd_cost_json(const struct kd_cost *cost, const struct kd_sweep *sweep, struct kd_buffer *out);

#endif

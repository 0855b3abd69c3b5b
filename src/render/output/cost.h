/* The total cost of several frames before any is rendered, by their plans: those of a job, or the scenes of a sweep,
 * which share lens maps. Pure, any thread. */
#ifndef KD_RENDER_OUTPUT_COST_H
#define KD_RENDER_OUTPUT_COST_H

#include "render/output/series.h"
#include "render/plan/sweep_order.h"

struct kd_cost {
    unsigned frames;   /* that are counted */
    double ms;         /* each lens map with its frame */
    double trace_ms;   /* of that lens maps, where a sweep may share them */
    double shared_ms;  /* what is not spent because they are shared; known at the end */
    double file_bytes; /* of files that have as many for each picture of a size */
    uint64_t rays;
    uint64_t device_bytes, host_bytes; /* of the largest frame */
    bool guessed;                      /* no figure for some pass has been measured */
    struct kd_sweep_order order;       /* of a sweep */
    struct kd_cube_shape shape;        /* that all scenes of a cube have */
};

/* Counts one frame more. sweep: whose scenes the frames are; NULL: of none. KD_ENOMEM; KD_EINVAL where scenes of a
 * cube differ. */
enum kd_status kd_cost_add(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                           const struct kd_scene *scene, const struct kd_plan *plan, struct kd_error *error);
/* All frames are counted. KD_ENOMEM. */
enum kd_status kd_cost_end(struct kd_cost *cost, struct kd_error *error);
void kd_cost_finish(struct kd_cost *cost);

/* Plans further scenes of a sweep until it is time (kd_clock_ms), one at least, and ends behind the last. Errors are
 * those of the first scene that is none, or that the device has no room for, by its number, at /axes. series NULL:
 * nobody has said what becomes of them. */
enum kd_status kd_cost_sweep(struct kd_cost *cost, const struct kd_series *series, const struct kd_sweep *sweep,
                             const struct kd_capacity *capacity, double until_ms, struct kd_error *error);
/* Writes the document of `kerrd plan --axis`, of all scenes. KD_ENOMEM. */
enum kd_status kd_cost_json(const struct kd_cost *cost, const struct kd_sweep *sweep, struct kd_buffer *out);

#endif

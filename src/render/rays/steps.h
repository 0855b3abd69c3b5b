/* Records each step of one ray as the device takes it. For this, the kernels of device.c are compiled with KD_TRACE
 * and write their state after each step. `kerrd rays --trace` and the explanation of a pixel use the records. Render
 * thread. */
#ifndef KD_RENDER_RAYS_STEPS_H
#define KD_RENDER_RAYS_STEPS_H

#include "render/rays/rays.h"

#include <stdlib.h>

enum kd_rays_stage {
    KD_STAGE_START,    /* the state at the observer, or at the place where a Cartesian ray starts */
    KD_STAGE_STEP,     /* a step towards the crossing of order `order`; discarded if there is no such crossing */
    KD_STAGE_CROSSING, /* the crossing of order `order`; this record is not a step */
    KD_STAGE_END,      /* a step after the last crossing, towards infinity or the horizon */
};

/* One record. Members that a stage or an engine does not have are NaN. Azimuths are as in render/rays/rays.h; in
 * START and END stages they are reduced to half a turn either way. Residuals are computed in double precision from
 * the device's own numbers and constants. They would be 0 without the errors of steps and rounding. */
struct kd_rays_step {
    enum kd_rays_stage stage;
    unsigned order, number; /* order: order of the next crossing; number: number of the step */
    /* Mino time since the observer; for Kerr-Schild engines their parameter s, with d(lambda) = r ds */
    double time;
    double r, phi, delay; /* delay: set for a crossing only */
    /* Mino engines: w = M/r, u = cos(theta) and their rates; n_x, n_y: the direction in the plane; u = n_z */
    double w, dw, u, du, n_x, n_y;
    double x, y, z, p_x, p_y, p_z; /* Kerr-Schild engines: position and momentum of the mirrored ray */
    double res_w;                  /* w'^2 - R(w) */
    double res_u;                  /* u'^2 - U(u) */
    double res_n;                  /* n.n - 1 */
    double res_dn;                 /* residual of n'.n' - (Q + L^2 + a^2 u^2) */
    double res_l;                  /* residuals of (n x n')_z - L (Mino) and of x p_y - y p_x - L (Kerr-Schild) */
    double res_null;               /* residual of p.p - 1 - f (1 + l.p)^2 */
};

struct kd_rays_steps {
    struct kd_rays_params params; /* the ray's parameters, with the steps and other settings that were used */
    double alpha, beta;
    bool outward;               /* true if the ray starts away from the hole */
    size_t n, lost;             /* n: number of records; lost: number of records that did not fit */
    struct kd_rays_step *steps; /* malloc'd */
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS];
    struct kd_ray_end end;
    bool same; /* true if the kernel without recording gives the same end, bit for bit */
};

/* Records the steps of one ray; params as for kd_rays_trace, with an engine that takes steps. Call
 * kd_rays_steps_finish in any case. */
enum kd_status kd_rays_steps(struct kd_renderer *renderer, const struct kd_rays_params *params,
                             const struct kd_ray_labels *ray, struct kd_rays_steps *out, struct kd_error *error);
/* Requests the kernels needed, for kd_kernels_note. */
enum kd_status kd_rays_steps_ask(struct kd_renderer *renderer, const struct kd_rays_params *params);
static inline void kd_rays_steps_finish(struct kd_rays_steps *steps)
{
    free(steps->steps);
    *steps = (struct kd_rays_steps) { 0 };
}

#endif

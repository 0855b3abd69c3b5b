/* Makes the lens map of a picture from listed rays: by any engine, in double precision, from a camera in double.
 * Slower than the kernels that derive each ray from its pixel, because rays pass through the host. For pictures that
 * ask for it. Render thread. */
#ifndef KD_RENDER_LENS_LISTED_H
#define KD_RENDER_LENS_LISTED_H

#include "render/device/internal.h"
#include "render/rays/rays.h"

struct kd_lens_rows {
    uint32_t first, count; /* rows of rays of the picture; or with `pixels`, which of those, */
    const struct kd_pixel *pixels;
    const struct kd_critical_lattice *lattice; /* with their rays */
    struct kd_vk_buffer *to;                   /* the band's planes */
    uint64_t offset, stride;                   /* rays before the first one in a plane; rays of a plane */
};

/* Writes plan->planes planes as lens_map.comp does, but -1 instead of a crossing that the engine gave up looking
 * for, delays before the slopes, and for a ring alpha before the sky's. *undecided grows by the rays that it gave
 * up. The upload is submitted and waited for. */
enum kd_status kd_lens_listed(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_lens_rows *rows, uint64_t *undecided, struct kd_error *error);

struct kd_camera_label;
/* Fills plan->planes planes of n numbers each, but for footprints, with rays that are followed in double on the
 * host: in closed form, and of an observer within the horizon by steps. *undecided grows by those that are on the
 * critical curve to the last digit. */
enum kd_status kd_lens_again(const struct kd_scene *scene, const struct kd_plan *plan,
                             const struct kd_camera_label *labels, size_t n, float *planes, uint64_t *undecided,
                             struct kd_error *error);

/* The rays of a plan by any engine, as kd_rays_device and kd_rays_closed; no g, no errors. */
enum kd_status kd_lens_trace(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                             const struct kd_setting *by, const struct kd_ray_labels *rays,
                             struct kd_ray_crossing *crossings, struct kd_ray_end *ends, struct kd_error *error);

#endif

/* Makes the lens map of a picture from listed rays, for scenes that request it. Any engine may trace these rays, in
 * either precision. The camera is computed in double. This is slower than the kernels that derive each ray from its
 * pixel, because listed rays pass through the host. Render thread. */
#ifndef KD_RENDER_LENS_LISTED_H
#define KD_RENDER_LENS_LISTED_H

#include "render/device/device_internal.h"
#include "render/rays/rays.h"

struct kd_lens_rows {
    uint32_t first, count; /* range of rows of rays of the picture; if `pixels` is set, range of indices in `pixels` */
    const struct kd_pixel *pixels;
    const struct kd_critical_lattice *lattice; /* lattice of the rays in each pixel */
    struct kd_vk_buffer *to;                   /* buffer with the planes of the band */
    /* offset: index of the first ray in a plane; stride: number of rays in a plane */
    uint64_t offset, stride;
};

/* Writes plan->lens.planes planes as lens_map.comp does, with three differences. -1 stands for a crossing that the
 * engine did not complete. The planes of delays precede the planes of slopes. For the ring projection a plane of alpha
 * precedes the planes of the sky. *undecided grows by the number of rays given up. Submits the upload and waits for
 * it. */
enum kd_status kd_lens_listed(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_lens_rows *rows, uint64_t *undecided, struct kd_error *error);

struct kd_camera_label;
/* Fills plan->lens.planes planes of n numbers each, except footprints, by tracing rays in double on the host: in
 * closed form, or by steps for an observer inside the horizon. *undecided grows by the number of rays that are on the
 * critical curve to the last digit: even double precision does not decide their fate. */
enum kd_status kd_lens_again(const struct kd_scene *scene, const struct kd_plan *plan,
                             const struct kd_camera_label *labels, size_t n, float *planes, uint64_t *undecided,
                             struct kd_error *error);

/* Computes the radii of the crossings, and the fates, of rays of a plan in closed form (KD_CLOSED_RADII). */
enum kd_status kd_lens_radii(const struct kd_scene *scene, const struct kd_plan *plan, const struct kd_ray_labels *rays,
                             struct kd_ray_crossing *crossings, struct kd_ray_end *ends, struct kd_error *error);

#endif

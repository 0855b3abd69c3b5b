/* These follow rays on the grid and on listed pixels alike. Render thread only. */
#ifndef KD_RENDER_FRAME_LENS_H
#define KD_RENDER_FRAME_LENS_H

#include "render/frame/job.h"
#include "render/view/camera.h"

/* What a kernel makes: light of rays that go on in pieces, what is told of one ray, rays, the light of the picture, or
 * the plan's layer of that number. */
enum { KD_MAKES_PIECES = -4, KD_MAKES_TOLD = -3, KD_MAKES_RAYS = -2, KD_MAKES_PICTURE = -1 };

/* Rows of pixels that one submission takes, given nanoseconds a row. */
uint32_t kd_frame_slice(double ns_per_row, uint32_t rows);

/* Kernels of listed pixels by their lattice, of the grid by one that is all 0. *out is NULL where no kernel traces. */
enum kd_status kd_frame_trace_kernel(struct kd_frame_job *job, const struct kd_critical_lattice *lattice,
                                     const struct kd_vk_pipeline **out);
enum kd_status kd_frame_light_kernel(struct kd_frame_job *job, const struct kd_critical_lattice *lattice, int makes,
                                     const struct kd_vk_pipeline **out);
/* How often the light of a pixel of so many rays is dispatched, once for each number of kd_slice.ray: the march
 * follows one ray at a time. */
uint32_t kd_frame_turns(const struct kd_plan *plan, uint32_t rays, int makes);
/* The dispatches of both but for their size: of rays of a camera (view/layout.h) to a lens map, and from there to
 * the radiance of a band. */
struct kd_vk_dispatch kd_frame_trace(const struct kd_frame_job *job, const struct kd_vk_pipeline *pipeline,
                                     struct kd_vk_buffer *lens, int camera);
struct kd_vk_dispatch kd_frame_transfer(const struct kd_frame_job *job, const struct kd_vk_pipeline *pipeline,
                                        struct kd_vk_buffer *lens, uint32_t band, int camera, int makes);
/* Rays through volumes that a driver has ended before their end. kd_frame_forget_lost empties the list behind a band's
 * light, or a sample's, before any is lit. kd_frame_follow_lost goes on with those that are listed since: of pixels
 * that `base` has lit, with `march` and by so many turns for each; submits what is recorded and waits for it. */
enum kd_status kd_frame_forget_lost(struct kd_frame_job *job, struct kd_vk_buffer *light, const char *pass);
enum kd_status kd_frame_follow_lost(struct kd_frame_job *job, const struct kd_vk_dispatch *base,
                                    const struct kd_slice *march, const struct kd_critical_lattice *lattice,
                                    uint32_t turns);
/* Rays by a plan whose path is KD_LENS_LISTED. */
struct kd_lens_rows;
enum kd_status kd_frame_list_rays(struct kd_frame_job *job, const struct kd_lens_rows *rows);

/* As many pixels of a list as one buffer holds the lens map of. */
struct kd_frame_part {
    const struct kd_frame_list *list;
    uint64_t first, n; /* among those pixels */
    struct kd_vk_buffer *lens;
    struct kd_slice push;
};
struct kd_frame_part kd_frame_part_of(const struct kd_frame_job *job, const struct kd_frame_list *list,
                                      uint64_t number);
/* Those of its pixels, counted from its first, that lie in a band: from *from on to before *to. */
void kd_frame_part_in_band(const struct kd_frame_job *job, const struct kd_frame_part *part, uint32_t band,
                           uint64_t *from, uint64_t *to);
/* Their places, behind the planes. */
enum kd_status kd_frame_upload_pixels(struct kd_frame_job *job, const struct kd_frame_part *part);

/* Tells the light of the plan's pixel anew, if it is one of a part that has just been lit. */
enum kd_status kd_frame_tell_listed(struct kd_frame_job *job, const struct kd_frame_part *part);

/* Rays that the kernels leave open, in a band of the grid or a part of a list (part: NULL for the band). The list of
 * open rays is emptied before rays are traced. Once they are, those on the list are followed again (settle.c): this
 * submits what is recorded and waits for it, and records what is written to the map. What is still open then is counted
 * in job->undecided. */
enum kd_status kd_frame_forget_open(struct kd_frame_job *job, const struct kd_frame_part *part);
enum kd_status kd_frame_settle(struct kd_frame_job *job, const struct kd_frame_part *part, uint32_t band);

/* Rays of pixels on a square grid, by interpolation in the lens map of the picture's grid (comp/between.comp).
 * kd_frame_has_between: that has one ray a pixel, and all of it is there. kd_frame_mark_between: of which pixels
 * that is right; a byte each, 1 or 0; waits for the device. */
bool kd_frame_has_between(const struct kd_frame_job *job);
enum kd_status kd_frame_mark_between(struct kd_frame_job *job, const struct kd_critical_pixels *pixels, uint8_t *marks);
enum kd_status kd_frame_between(struct kd_frame_job *job, const struct kd_frame_part *part);

#endif

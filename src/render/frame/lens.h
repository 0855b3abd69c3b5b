/* Functions that trace rays and compute their light, shared by the grid and listed pixels. Render thread only. */
#ifndef KD_RENDER_FRAME_LENS_H
#define KD_RENDER_FRAME_LENS_H

#include "render/frame/job.h"
#include "render/view/camera.h"

/* Products of a kernel. Negative numbers, in this order: the light of rays that continue in pieces; a description of
 * one ray; the lens map; the picture's light. Numbers from 0 on are the plan's layers. */
enum { KD_MAKES_PIECES = -4, KD_MAKES_TOLD = -3, KD_MAKES_RAYS = -2, KD_MAKES_PICTURE = -1 };

/* Number of items, such as rows of pixels, that the next submission processes. The time of an item on an idle device
 * is given in nanoseconds. */
static inline uint32_t kd_frame_slice(const struct kd_frame_job *j, double ns, uint32_t left)
{
    return kd_slice_items(&j->r->slice_pace, ns, left);
}
/* Like kd_frame_slice, for items of which only an upper bound of the time is known. The time of these items is not used
 * to measure the device. */
static inline uint32_t kd_frame_slice_at_most(const struct kd_frame_job *j, double ns, uint32_t left)
{
    const uint32_t items = kd_frame_slice(j, ns, left);
    j->r->slice_pace.expected_ms = 0;
    return items;
}

/* Get the kernels that trace rays and that compute their light. The kernels process listed pixels with the given
 * lattice, or the picture's grid if all members of the lattice are 0. *out is NULL if no kernel traces. */
enum kd_status kd_frame_trace_kernel(struct kd_frame_job *job, const struct kd_critical_lattice *lattice,
                                     const struct kd_vk_pipeline **out);
enum kd_status kd_frame_light_kernel(struct kd_frame_job *job, const struct kd_critical_lattice *lattice, int makes,
                                     const struct kd_vk_pipeline **out);
/* Number of dispatches for the light of a pixel with `rays` rays. The march follows one ray at a time, and needs one
 * dispatch for each value of kd_slice.ray. */
uint32_t kd_frame_turns(const struct kd_plan *plan, uint32_t rays, int makes);
/* The dispatches of both kernels, without their size. kd_frame_trace: from rays of a camera (view/layout.h) to a
 * lens map. kd_frame_transfer: from the lens map to the radiance of a band. */
struct kd_vk_dispatch kd_frame_trace(const struct kd_frame_job *job, const struct kd_vk_pipeline *pipeline,
                                     struct kd_vk_buffer *lens, int camera);
struct kd_vk_dispatch kd_frame_transfer(const struct kd_frame_job *job, const struct kd_vk_pipeline *pipeline,
                                        struct kd_vk_buffer *lens, uint32_t band, int camera, int makes);
/* Rays through volumes that a driver stopped early are listed. The list is stored behind the light of a band or of a
 * sample. kd_frame_forget_lost empties the list; call it before any of that light is computed. kd_frame_follow_lost
 * continues the rays listed since then. `base` is the dispatch that lit their pixels, and `march` has its push
 * constants. Each group of listed rays takes `turns` dispatches. The function submits what is recorded, and waits. */
enum kd_status kd_frame_forget_lost(struct kd_frame_job *job, struct kd_vk_buffer *light, const char *pass);
enum kd_status kd_frame_follow_lost(struct kd_frame_job *job, const struct kd_vk_dispatch *base,
                                    const struct kd_slice *march, const struct kd_critical_lattice *lattice,
                                    uint32_t turns);
/* Traces rays for a plan whose path is KD_LENS_LISTED. */
struct kd_lens_rows;
enum kd_status kd_frame_list_rays(struct kd_frame_job *job, const struct kd_lens_rows *rows);

/* Pixels of a list whose lens map fits in one buffer. */
struct kd_frame_part {
    const struct kd_frame_list *list;
    uint64_t first, n; /* range of the part among the pixels of the list */
    struct kd_vk_buffer *lens;
    struct kd_slice push;
};
struct kd_frame_part kd_frame_part_of(const struct kd_frame_job *job, const struct kd_frame_list *list,
                                      uint64_t number);
/* Finds which of the part's pixels lie in a band: those from *from to *to - 1, counted from the part's first pixel. */
void kd_frame_part_in_band(const struct kd_frame_job *job, const struct kd_frame_part *part, uint32_t band,
                           uint64_t *from, uint64_t *to);
/* Uploads the places of the part's pixels. The places are stored behind the planes. */
enum kd_status kd_frame_upload_pixels(struct kd_frame_job *job, const struct kd_frame_part *part);

/* Describes the light of the plan's pixel again, if that pixel is in the part that has just been lit. */
enum kd_status kd_frame_probe_listed(struct kd_frame_job *job, const struct kd_frame_part *part);

/* Functions for undecided rays, whose fate or number of crossings single precision does not determine. The rays are
 * those of a band of the grid (part NULL) or of a part of a list. kd_frame_forget_open empties the list of these
 * rays; call it before rays are traced. kd_frame_settle then traces the rays on the list again in double (settle.c):
 * it submits what is recorded, waits, and records the writes to the map. Rays that stay undecided are counted in
 * job->undecided. */
enum kd_status kd_frame_forget_open(struct kd_frame_job *job, const struct kd_frame_part *part);
enum kd_status kd_frame_settle(struct kd_frame_job *job, const struct kd_frame_part *part, uint32_t band);

/* Rays of pixels on a square grid, interpolated in the lens map of the picture's grid (comp/between.comp).
 * kd_frame_has_between: true if that map has one ray a pixel and is complete. kd_frame_mark_between: writes a byte for
 * each pixel, 1 if interpolation is accurate and 0 if it is not; waits for the device. */
bool kd_frame_has_between(const struct kd_frame_job *job);
enum kd_status kd_frame_mark_between(struct kd_frame_job *job, const struct kd_critical_pixels *pixels, uint8_t *marks);
enum kd_status kd_frame_between(struct kd_frame_job *job, const struct kd_frame_part *part);

#endif

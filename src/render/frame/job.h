/* State of a frame in progress, shared by its files: one picture, and the bands in which it is made. Render thread
 * only. */
#ifndef KD_RENDER_FRAME_JOB_H
#define KD_RENDER_FRAME_JOB_H

#include "base/cpu_pressure.h"
#include "render/device/device_internal.h"
#include "render/frame/frame.h"
#include "render/view/critical_pixels.h"
#include "render/view/layout.h"

struct kd_frame_job {
    struct kd_renderer *r;
    struct kd_store *store;
    struct kd_prepared *prepared;
    bool background;                           /* true if other pictures may be rendered during `progress` */
    struct kd_vk_time times[KD_VK_MAX_PASSES]; /* if `background` is true: device times of finished work */
    size_t n_times;
    double away_ms; /* time spent in calls of `progress` */
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    const struct kd_light_sum *others; /* pictures with which the light is averaged; NULL: none */
    /* light of the sampled pixels, traced once as in the picture and once more finely; NULL: none */
    struct kd_vk_buffer *marched;
    struct kd_lens_map *lens;
    struct kd_star_key star_key;   /* key of this frame's light of stars */
    bool stars_kept;               /* true if the cached light of stars is valid */
    uint64_t undecided;            /* number of rays of the lens map whose tracing was given up */
    uint64_t traced, interpolated; /* same meaning as in kd_accuracy_report */
    double listed_ms, audit_ms; /* time on the host in ms: listed_ms for tracing listed rays, audit_ms for the audit */
    double kernels_ms;          /* time on the host for making missing kernels before they first run */
    kd_progress_fn progress;
    const struct kd_preview_hook *preview;
    void *user;
    double done, weight; /* done: number of rows done so far, summed over all passes; weight: number of all rows */
    /* refine_rows: rows that stand for refinement in the progress and are not reported yet. refine_rays: number of
     * rays that refinement is expected to trace */
    double refine_rows, refine_rays;
    uint32_t lit;   /* number of rows of pixels, from the top, whose light is complete */
    bool looking;   /* true while a preview is being made */
    uint8_t *kinds; /* KD_REFINED_... of each pixel; NULL unless image.samples is "auto" */
    bool teaches;   /* true if the job's times count as measurements of the passes' costs */
    struct kd_cpu_pressure
        waiting; /* time that the job's threads waited for a core; it is subtracted from measured times */
    struct kd_frame *frame;
    struct kd_error *error;
};

/* kd_frame_learn updates the costs of passes from the device times of a frame: nanoseconds an item on idle cores,
 * smoothed. Call kd_frame_learn_begin before the frame. */
void kd_frame_learn_begin(struct kd_frame_job *job);
void kd_frame_learn(struct kd_frame_job *job, const struct kd_frame *frame);

/* Reports `rows` more rows as done. Returns KD_ECANCELLED if the picture was cancelled. */
enum kd_status kd_frame_report(struct kd_frame_job *job, double rows);

static inline uint32_t kd_frame_band_first(const struct kd_frame_job *j, uint32_t band)
{
    return band * j->plan->picture.band_rows;
}
static inline uint32_t kd_frame_band_rows(const struct kd_frame_job *j, uint32_t band)
{
    uint32_t left = j->plan->picture.height - kd_frame_band_first(j, band);
    return left < j->plan->picture.band_rows ? left : j->plan->picture.band_rows;
}
/* Number of rows of a band whose light is complete. */
static inline uint32_t kd_frame_band_lit(const struct kd_frame_job *j, uint32_t band)
{
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    return j->lit < first ? 0 : j->lit - first < rows ? j->lit - first : rows;
}
/* The light of a band that is displayed: its radiance, or its radiance after the beam. */
static inline struct kd_vk_buffer *kd_frame_band_light(const struct kd_frame_job *j, uint32_t band)
{
    return j->plan->picture.beam.cell ? j->store->beamed.buffers[band] : j->store->radiance.buffers[band];
}
static inline struct kd_vk_buffer *kd_frame_band_lens(const struct kd_frame_job *j, uint32_t band)
{
    return j->lens->bands.buffers[j->plan->lens.cacheable ? band : 0];
}
static inline uint32_t kd_frame_groups(uint64_t items)
{
    return (uint32_t)((items + KD_GROUP_SIZE - 1) / KD_GROUP_SIZE);
}

/* Requests, for kd_kernels_note, the kernels of the frame that take long to make. Uses only the job's renderer,
 * store, scene and plan. */
enum kd_status kd_frame_ask_kernels(struct kd_frame_job *job);
/* Renders the job's scene by its plan into *out. */
enum kd_status kd_frame_run(struct kd_frame_job *job, struct kd_frame *out);
/* Collects the times of all passes that ran, in the order of the list of passes. */
void kd_frame_collect_timings(struct kd_frame_job *job, struct kd_frame *frame, double total_ms);

/* The passes, one in each file. */

/* Uploads the cameras of the grid and of the pixels at the critical curve. */
enum kd_status kd_frame_send_cameras(struct kd_frame_job *job);
/* Makes the lens map, unless it is reused, and from it the radiance of all bands. */
enum kd_status kd_frame_light(struct kd_frame_job *job, bool reused);
/* Listed pixels whose light is computed anew, with several rays in each pixel (view/critical_pixels.h). Earlier
 * light of these pixels is overwritten. */
struct kd_frame_list {
    const struct kd_critical_pixels *pixels;
    struct kd_critical_lattice lattice;  /* the rays in each pixel */
    int camera;                          /* the camera whose unit is the lattice's step (view/layout.h) */
    uint64_t most;                       /* largest number of pixels whose lens map fits in one buffer */
    struct kd_vk_buffer *const *buffers; /* the first buffer is for the first `most` pixels, the second for the next
                                          * `most`, ... */
    bool again;                          /* true if one buffer is reused for all pixels, so that no map is kept */
    /* true if rays of pixels where interpolation is accurate are interpolated instead of traced (frame/lens.h) */
    bool between;
    bool layers;      /* true if layers of light are computed in addition to the picture */
    const char *pass; /* pass to which the time of these pixels is attributed; NULL: the usual passes */
};
/* Computes the light of a list. needed: true if the lens map must be made first. */
enum kd_status kd_frame_light_list(struct kd_frame_job *job, const struct kd_frame_list *list, bool needed);
/* Records footprints for rows of rays of a buffer, or for a range of rays on listed pixels. These rays and their
 * neighbours must be traced before. Nothing is submitted. Does nothing if the plan has no footprints. */
struct kd_footprint_area {
    struct kd_vk_buffer *lens;
    const struct kd_critical_lattice *lattice; /* NULL: rays of the grid */
    struct kd_footprint_push push;
};
enum kd_status kd_frame_footprint(struct kd_frame_job *job, const struct kd_footprint_area *area);
/* Like kd_frame_footprint, for a sampled map whose rows from `traced` on have just been sampled. row0: the first row of
 * the buffer, as a row of rays of the picture. Footprints are made for rays that were traced singly, and for earlier
 * rays that are marked as incomplete. */
enum kd_status kd_frame_footprint_sampled(struct kd_frame_job *job, const struct kd_footprint_area *area, uint32_t row0,
                                          uint32_t traced);
/* The kernel of footprints. lattice: that of the listed pixels; NULL: rays of the grid. *out is NULL if no light needs
 * footprints. */
enum kd_status kd_frame_footprint_kernel(struct kd_frame_job *job, const struct kd_critical_lattice *lattice,
                                         const struct kd_vk_pipeline **out);
/* Spreads the light of stars over the pixels of a band. The stars are those that the band's rays see. If the whole
 * map is cached, stars that rays of adjacent rows see are included. Does nothing if the light of stars is cached. The
 * band's map must be complete. Call this for the bands of a frame from first to last. */
enum kd_status kd_frame_stars(struct kd_frame_job *job, uint32_t band);
/* Gets all kernels of kd_frame_stars. */
enum kd_status kd_frame_star_kernels(struct kd_frame_job *job);
/* Determines whether the light of stars is cached. Call this after the emitters' numbers are set. */
void kd_frame_begin_stars(struct kd_frame_job *job);
/* kd_frame_find_rim finds the rim of the job's lens map, if there is one (view/rim.h). kd_frame_trace_rim traces the
 * rim's rays, unless they are already traced. */
void kd_frame_find_rim(struct kd_frame_job *job);
enum kd_status kd_frame_trace_rim(struct kd_frame_job *job);
/* Records the layers of light that the march stored with the radiance (kd_plan_gathers), for rows whose light is
 * complete. Nothing is submitted. */
enum kd_status kd_frame_gather(struct kd_frame_job *job);

/* kd_frame_probe describes the light of the plan's pixel if that pixel is in this band. The band's lens map must
 * exist. kd_frame_probe_pixel describes the pixel's result; call it when all light is complete. */
enum kd_status kd_frame_probe(struct kd_frame_job *job, uint32_t band);
enum kd_status kd_frame_probe_pixel(struct kd_frame_job *job);
/* Requests the kernels that record the pixel's steps, if the plan asks for steps. */
enum kd_status kd_frame_probe_ask(struct kd_frame_job *job);

/* kd_frame_sample_march traces rays through volumes again for a sample of this band's pixels, both as in the picture
 * and more finely. kd_frame_march_error is called after all bands and writes the differences into the frame's accuracy.
 * Both functions do nothing if the scene has no volumes. */
enum kd_status kd_frame_sample_march(struct kd_frame_job *job, uint32_t band);
enum kd_status kd_frame_march_error(struct kd_frame_job *job);

/* kd_frame_add_light sums the light of all bands and copies the sums to the host. kd_frame_read_light waits for the
 * sums, and computes the frame's flux and centroid. */
enum kd_status kd_frame_add_light(struct kd_frame_job *job);
enum kd_status kd_frame_read_light(struct kd_frame_job *job);
/* Replaces the light of all bands by the mean of this light and of j->others. Waits for the device. */
enum kd_status kd_frame_mean(struct kd_frame_job *job);
/* Convolves the completed light with a telescope's beam, for the passes that follow. Does nothing if the plan has no
 * beam. */
enum kd_status kd_frame_beam(struct kd_frame_job *job);
/* Sets the exposure from the completed light. Waits for the device if the exposure is "auto". */
enum kd_status kd_frame_expose(struct kd_frame_job *job);
/* kd_frame_refine traces more rays for the pixels that need them, at the frame's exposure. j->kinds records which
 * pixels these are. kd_frame_residual measures the remaining error of the picture, and writes the error to the
 * frame's accuracy. This overwrites the light of the sampled pixels. */
enum {
    KD_REFINED_NOT,
    KD_REFINED_NOT_AT_CURVE,
    KD_REFINED_AT_CURVE,
    KD_REFINED_FOLLOWED,
    KD_REFINED_BETWEEN,
    KD_REFINED_KINDS
};
enum kd_status kd_frame_refine(struct kd_frame_job *job);
enum kd_status kd_frame_residual(struct kd_frame_job *job);
/* Copies the displayed picture to the host row by row, at 16 bits without dither, bloom, beam or palette. Waits for
 * the device. */
enum kd_status kd_frame_bare(struct kd_frame_job *job, uint16_t *to);
/* Computes the bloom of the completed light in j->store->bloom, at the frame's exposure. Does nothing if the plan
 * has no bloom. */
enum kd_status kd_frame_bloom(struct kd_frame_job *job);
/* Makes pixels of the completed light and copies them to the host. */
enum kd_status kd_frame_post(struct kd_frame_job *job);
enum kd_status kd_frame_post_kernel(struct kd_frame_job *job, const struct kd_vk_pipeline **out); /* the kernel */
/* Runs, in order, the passes that turn light into pixels. */
enum kd_status kd_frame_show(struct kd_frame_job *job);
/* kd_frame_add_layers allocates the layers of a plan other than the picture. kd_frame_layers copies these layers to the
 * host, as far as light is complete. A single requested layer replaces the picture, in false colour. */
enum kd_status kd_frame_add_layers(struct kd_frame *frame, const struct kd_plan_picture *picture,
                                   struct kd_error *error);
enum kd_status kd_frame_layers(struct kd_frame_job *job);

#endif

/* The files of a frame share this: one picture on its way, and the bands it is made in. Render thread only. */
#ifndef KD_RENDER_FRAME_JOB_H
#define KD_RENDER_FRAME_JOB_H

#include "base/waiting.h"
#include "render/device/internal.h"
#include "render/frame/frame.h"
#include "render/view/critical_pixels.h"
#include "render/view/layout.h"

struct kd_frame_job {
    struct kd_renderer *r;
    struct kd_store *store;
    struct kd_prepared *prepared;
    bool aside;                                /* progress may render */
    struct kd_vk_time times[KD_VK_MAX_PASSES]; /* of an aside: of what is done, */
    size_t n_times;
    double away_ms; /* and what its progress took */
    const struct kd_scene *scene;
    const struct kd_plan *plan;
    const struct kd_light_sum *others; /* whose mean with the picture's light is shown; NULL: none's */
    struct kd_vk_buffer *marched; /* light of a sample, as the picture has it and more closely followed; NULL: none */
    struct kd_lens_map *lens;
    struct kd_star_key star_key;   /* what the light of stars is made of in this frame, */
    bool stars_kept;               /* and whether it is there already */
    uint64_t undecided;            /* rays of the lens map that are given up */
    uint64_t traced, interpolated; /* as in the accuracy report */
    double listed_ms, audit_ms;    /* the host's time for them, and for the audit */
    double
        kernels_ms; /* and for making kernels that were not there, as the driver makes them before they are run first */
    kd_progress_fn progress;
    const struct kd_glance *glance;
    void *user;
    double done, weight;             /* rows so far, of all passes */
    double refine_rows, refine_rays; /* what refining counts for among them, what is left of that; and rays that it is
                                        expected to follow */
    uint32_t lit;                    /* rows of pixels from the top whose light is there */
    bool looking;                    /* they are being looked at */
    uint8_t *kinds;                  /* of each pixel, KD_REFINED_...; NULL unless image.samples is "auto" */
    bool teaches;                    /* what passes cost, */
    struct kd_waiting waiting;       /* but for the time that its threads waited for a core */
    struct kd_frame *frame;
    struct kd_error *error;
};

/* Learn from the device times of a frame: nanoseconds an item as they are when nothing else wants the cores,
 * smoothed. */
void kd_frame_learn_begin(struct kd_frame_job *job);
void kd_frame_learn(struct kd_frame_job *job, const struct kd_frame *frame);

/* So many rows more are done. Cancelled: KD_ECANCELLED. */
enum kd_status kd_frame_report(struct kd_frame_job *job, double rows);

static inline uint32_t kd_frame_band_first(const struct kd_frame_job *j, uint32_t band)
{
    return band * j->plan->band_rows;
}
static inline uint32_t kd_frame_band_rows(const struct kd_frame_job *j, uint32_t band)
{
    uint32_t left = j->plan->height - kd_frame_band_first(j, band);
    return left < j->plan->band_rows ? left : j->plan->band_rows;
}
/* Those of them that are lit. */
static inline uint32_t kd_frame_band_lit(const struct kd_frame_job *j, uint32_t band)
{
    uint32_t first = kd_frame_band_first(j, band), rows = kd_frame_band_rows(j, band);
    return j->lit < first ? 0 : j->lit - first < rows ? j->lit - first : rows;
}
/* What is shown of a band: its radiance, or that as the beam sees it. */
static inline struct kd_vk_buffer *kd_frame_band_light(const struct kd_frame_job *j, uint32_t band)
{
    return j->plan->beam.cell ? j->store->beamed.buffers[band] : j->store->radiance.buffers[band];
}
static inline struct kd_vk_buffer *kd_frame_band_lens(const struct kd_frame_job *j, uint32_t band)
{
    return j->lens->bands.buffers[j->plan->cacheable ? band : 0];
}
static inline uint32_t kd_frame_groups(uint64_t items)
{
    return (uint32_t)((items + KD_GROUP_SIZE - 1) / KD_GROUP_SIZE);
}

/* Asks for the kernels that take long to make, as the frame will: for kd_kernels_note. Of the job it needs its
 * renderer, store, scene and plan. */
enum kd_status kd_frame_ask_kernels(struct kd_frame_job *job);
/* Render by job's scene and plan, into *out. */
enum kd_status kd_frame_run(struct kd_frame_job *job, struct kd_frame *out);
/* The times of all passes that ran, in the order in which they did. */
void kd_frame_collect_timings(struct kd_frame_job *job, struct kd_frame *frame, double total_ms);

/* The passes, a file each. */

/* The cameras of the grid and of the pixels at the critical curve, on their way to the device. */
enum kd_status kd_frame_send_cameras(struct kd_frame_job *job);
/* The lens map, unless it is reused, and from it the radiance of all bands. */
enum kd_status kd_frame_light(struct kd_frame_job *job, bool reused);
/* Light of listed pixels, row by row in the list, by so many rays each (view/critical_pixels.h); what they had
 * before is lost. */
struct kd_frame_list {
    const struct kd_critical_pixels *pixels;
    struct kd_critical_lattice lattice;  /* where each has how many, */
    int camera;                          /* whose steps are those of this camera (view/layout.h) */
    uint64_t most;                       /* pixels that one buffer holds the lens map of */
    struct kd_vk_buffer *const *buffers; /* for the first `most` of them, the next, ... */
    bool again;                          /* or one for all, in turn: nothing is kept */
    bool between;     /* their rays are not followed, but interpolated; on pixels where that is right (frame/lens.h) */
    bool layers;      /* layers of light likewise, or of the picture alone */
    const char *pass; /* that their time counts for; NULL: as that of the others */
};
/* needed: the lens map is not there yet. */
enum kd_status kd_frame_light_list(struct kd_frame_job *job, const struct kd_frame_list *list, bool needed);
/* Footprints of rows of rays of a buffer, or of a range of rays on listed pixels, all of which are traced with those
 * next to them. Recorded, not submitted. Nothing where the plan has none. */
struct kd_footprint_area {
    struct kd_vk_buffer *lens;
    const struct kd_critical_lattice *lattice; /* NULL: the grid */
    struct kd_footprint_push push;
};
enum kd_status kd_frame_footprint(struct kd_frame_job *job, const struct kd_footprint_area *area);
/* The same of a sampled map whose rows from `traced` on were sampled just now, that buffer's first row being row0 of
 * the picture's rays: of the rays that were followed alone, and of those before that were marked as not finished. */
enum kd_status kd_frame_footprint_sampled(struct kd_frame_job *job, const struct kd_footprint_area *area, uint32_t row0,
                                          uint32_t traced);
/* Its kernel; lattice: of listed pixels, NULL: of the grid. *out is NULL where no light needs footprints. */
enum kd_status kd_frame_footprint_kernel(struct kd_frame_job *job, const struct kd_critical_lattice *lattice,
                                         const struct kd_vk_pipeline **out);
/* Spreads the points of light that the rays of a band see, and of the rows next to it where the whole map is kept,
 * over its pixels; nothing where that light is there from the frame before. Its map must be whole. The bands of a
 * frame from the first to the last. */
enum kd_status kd_frame_stars(struct kd_frame_job *job, uint32_t band);
/* All of its kernels. */
enum kd_status kd_frame_star_kernels(struct kd_frame_job *job);
/* Whether that light is there: to be told as soon as the emitters are. */
void kd_frame_begin_stars(struct kd_frame_job *job);
/* Where the rim of the job's lens map is, if it has one (view/rim.h); and its rays, if they were not followed
 * before. */
void kd_frame_find_rim(struct kd_frame_job *job);
enum kd_status kd_frame_trace_rim(struct kd_frame_job *job);
/* Layers of light that the march has brought, of what it left in the radiance (kd_plan_gathers): as far as there is
 * light. Recorded, not submitted. */
enum kd_status kd_frame_gather(struct kd_frame_job *job);

/* Tells the light of the plan's pixel, if it lies in this band, whose lens map must be there; and, when all light
 * is, what became of it. */
enum kd_status kd_frame_tell(struct kd_frame_job *job, uint32_t band);
enum kd_status kd_frame_tell_pixel(struct kd_frame_job *job);
/* Asks for the kernels of its steps, where they are told. */
enum kd_status kd_frame_tell_ask(struct kd_frame_job *job);

/* Follows rays through volumes once more on a sample of this band's pixels, as the picture has them and more
 * closely, and, when all have been, says in the frame's accuracy how far apart these are. Nothing where there are no
 * volumes. */
enum kd_status kd_frame_sample_march(struct kd_frame_job *job, uint32_t band);
enum kd_status kd_frame_march_error(struct kd_frame_job *job);

/* Adds up the light of all bands, and sends the sums to the host; waits for them, and makes the frame's flux and
 * centroid of them. */
enum kd_status kd_frame_add_light(struct kd_frame_job *job);
enum kd_status kd_frame_read_light(struct kd_frame_job *job);
/* The light of all bands becomes the mean with j->others; waits for the device. */
enum kd_status kd_frame_mean(struct kd_frame_job *job);
/* Light as a telescope's beam sees what is lit, which the passes behind it take for light; nothing where the plan
 * has no beam. */
enum kd_status kd_frame_beam(struct kd_frame_job *job);
/* The exposure of what is lit; waits for the device where it is "auto". */
enum kd_status kd_frame_expose(struct kd_frame_job *job);
/* More rays for the pixels that need them, at the frame's exposure: into j->kinds which have what. And how far off
 * the picture is then, into the frame's accuracy; what is lit is no longer right afterwards. */
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
/* The picture as it is shown, at 16 bits without dither, glare, beam or palette, row by row to the host; waits for
 * the device. */
enum kd_status kd_frame_bare(struct kd_frame_job *job, uint16_t *to);
/* What a lens spreads of what is lit, in j->store->bloom, at the frame's exposure; nothing where the plan has no
 * bloom. */
enum kd_status kd_frame_bloom(struct kd_frame_job *job);
/* Pixels of what is lit, on the host. */
enum kd_status kd_frame_post(struct kd_frame_job *job);
enum kd_status kd_frame_post_kernel(struct kd_frame_job *job, const struct kd_vk_pipeline **out); /* the kernel */
/* All of these one after the other: from light to pixels. */
enum kd_status kd_frame_show(struct kd_frame_job *job);
/* Room for the layers of a plan behind the picture; and they, as far as there is light, on the host. One that is
 * asked for alone takes the place of the picture, in false colour. */
enum kd_status kd_frame_add_layers(struct kd_frame *frame, const struct kd_plan *plan, struct kd_error *error);
enum kd_status kd_frame_layers(struct kd_frame_job *job);

#endif

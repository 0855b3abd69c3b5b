/* The order of a frame's passes. */
#include "render/frame/job.h"

#include "render/lens/audit.h"
#include "base/clock.h"
#include "base/log.h"
#include "render/device/prepare.h"
#include "render/frame/lens.h"
#include "render/frame/sample.h"

#include <stdlib.h>
#include <string.h>

/* Allocates the buffers, and prepares what the kernels of light read. */
static enum kd_status make_ready(struct kd_frame_job *j, const struct kd_capacity *c, bool *reused)
{
    struct kd_renderer *r = j->r;
    enum kd_status status;
    /* Lens maps stay in the renderer's own store while they and this picture fit into a quarter of the memory.
     * Background renders then fit beside them. A background render keeps only its own lens map. */
    j->store->memory_bytes = j->background ? j->plan->cost.device_bytes : c->memory_bytes / 4;
    KD_TRY(kd_store_lens_map(j->store, j->plan, &j->lens, reused, j->error));
    KD_TRY(kd_store_frame(j->store, j->plan, j->plan->lens.adaptive ? 16 : kd_frame_bit_depth(j->frame), j->error));
    kd_emit_update(r->emit, j->scene, j->plan->picture.width * j->plan->picture.band_rows);
    KD_TRY(
        kd_prepare_tell(r, j->scene, &j->plan->light, &r->emit->data.emission, j->frame->credit, KD_CREDIT, j->error));
    KD_TRY(kd_store_send(j->store, &r->emit->data, j->error));
    if (j->plan->light.points) {
        kd_frame_begin_stars(j);
        if (!j->plan->light.bright)
            kd_frame_find_rim(j);
    }
    KD_TRY(kd_frame_send_cameras(j));
done:
    atomic_store(&r->held, kd_vk_allocated(r->vk));
    return status;
}

enum kd_status kd_frame_show(struct kd_frame_job *j)
{
    enum kd_status status;
    KD_TRY(kd_frame_beam(j));
    KD_TRY(kd_frame_expose(j));
    KD_TRY(kd_frame_bloom(j));
    KD_TRY(kd_frame_post(j));
done:
    return status;
}

/* The lattices of rays that a picture uses: those of the grid, of the critical curve and of refinement. */
static size_t lattices_of(const struct kd_plan_lens *lens, struct kd_critical_lattice out[5])
{
    size_t n = 0;
    out[n++] = (struct kd_critical_lattice) { 0 };
    if (lens->critical)
        out[n++] = kd_critical_lattice(lens->critical);
    if (!lens->adaptive)
        return n;
    out[n++] = kd_critical_grid(KD_PLAN_ADAPTIVE_SIDE);
    out[n++] = kd_critical_grid(KD_PLAN_TRUTH_SIDE);
    if (lens->critical_dense)
        out[n++] = kd_critical_lattice(lens->critical_dense);
    return n;
}

enum kd_status kd_frame_ask_kernels(struct kd_frame_job *j)
{
    struct kd_critical_lattice lattices[5];
    const size_t n = lattices_of(&j->plan->lens, lattices), kept = j->plan->lens.critical ? 2 : 1;
    const struct kd_vk_pipeline *later;
    const bool there = kd_store_has(j->store, j->plan);
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n; i++) {
        if (j->plan->lens.planes && !(there && i < kept)) {
            KD_TRY(kd_frame_trace_kernel(j, &lattices[i], &later));
            KD_TRY(kd_frame_footprint_kernel(j, i ? &lattices[i] : NULL, &later));
        }
        if (!j->plan->picture.no_image)
            KD_TRY(kd_frame_light_kernel(j, &lattices[i], KD_MAKES_PICTURE, &later));
        if (j->plan->report.probe.on && (j->plan->lens.planes || j->plan->light.march.steps))
            KD_TRY(kd_frame_light_kernel(j, &lattices[i], KD_MAKES_TOLD, &later));
    }
    for (size_t i = 0; i < j->plan->picture.n_layers; i++)
        KD_TRY(kd_frame_light_kernel(j, &lattices[0], (int)i, &later));
    if (j->plan->lens.interpolates > 0 && !there)
        KD_TRY(kd_frame_sample_kernels(j));
    if (j->plan->report.probe.on)
        KD_TRY(kd_frame_probe_ask(j));
    if (j->plan->light.points)
        KD_TRY(kd_frame_star_kernels(j));
    if (!j->plan->picture.no_image)
        KD_TRY(kd_frame_post_kernel(j, &later));
done:
    return status;
}

/* Makes the missing kernels that take long. It does so on several threads, while emitters work on the host. */
static enum kd_status make_kernels(struct kd_frame_job *j)
{
    kd_kernels_note(&j->r->kernels);
    const enum kd_status status = kd_frame_ask_kernels(j);
    const double begun = kd_clock_ms();
    const bool any = j->r->kernels.wishes.n > 0;
    kd_kernels_make(&j->r->kernels, j->r->vk);
    j->kernels_ms = any ? kd_clock_ms() - begun : 0;
    return status;
}

/* Audits and caches a lens map that has just been made. */
static enum kd_status judge_map(struct kd_frame_job *j)
{
    double start = kd_clock_ms();
    enum kd_status status;
    KD_TRY(kd_audit(j->r, j->scene, j->plan, j->lens, &j->lens->accuracy, j->error));
    if (j->plan->lens.audit)
        j->audit_ms = kd_clock_ms() - start;
    j->lens->accuracy.undecided = j->undecided;
    j->lens->accuracy.traced = j->traced;
    j->lens->accuracy.interpolated = j->interpolated;
    kd_store_commit(j->store, j->lens, &j->plan->lens);
done:
    return status;
}

/* Adds the accuracy of the lens map to the frame's accuracy, which already has that of pixels and volumes. */
static void report_accuracy(struct kd_frame_job *j)
{
    const struct kd_accuracy_report own = j->frame->accuracy;
    j->frame->accuracy = j->lens->accuracy;
    j->frame->accuracy.followed = own.followed;
    j->frame->accuracy.refined = own.refined;
    j->frame->accuracy.between = own.between;
    j->frame->accuracy.lost = own.lost;
    j->frame->accuracy.volume_sampled = own.volume_sampled;
    j->frame->accuracy.volume_error = own.volume_error;
    j->frame->accuracy.volume_error_worst = own.volume_error_worst;
}

static const struct kd_plan_pass *pass_of(const struct kd_plan_cost *cost, enum kd_pass_id id)
{
    for (size_t i = 0; i < cost->n_passes; i++)
        if (!strcmp(cost->passes[i].name, kd_passes[id].name))
            return &cost->passes[i];
    return NULL;
}

/* Number of rows that are traced and lit in the time that refinement is estimated to take. */
static double rows_of_refining(const struct kd_frame_job *j, double rows)
{
    const struct kd_plan_pass *refine = pass_of(&j->plan->cost, KD_PASS_REFINE),
                              *trace = pass_of(&j->plan->cost, KD_PASS_TRACE);
    const struct kd_plan_pass *light = pass_of(&j->plan->cost, kd_plan_light_pass(&j->plan->light));
    const double ms = (trace ? trace->estimate_ms : 0) + (light ? light->estimate_ms : 0);
    return refine && ms > 0 ? rows * refine->estimate_ms / ms : 0;
}

/* Refines the picture. Pixels are chosen at the exposure that the picture has before refinement. */
static enum kd_status refine(struct kd_frame_job *j)
{
    const struct kd_plan_pass *pass = pass_of(&j->plan->cost, KD_PASS_REFINE);
    enum kd_status status;
    KD_TRY(kd_frame_beam(j));
    KD_TRY(kd_frame_expose(j));
    j->refine_rays = pass ? (double)pass->invocations : 0;
    KD_TRY(kd_frame_refine(j));
    KD_TRY(kd_frame_report(j, j->refine_rows)); /* reported as done, because fewer rays than planned were needed */
    j->refine_rays = j->refine_rows = 0;
done:
    return status;
}

/* Empties the lists of stopped rays before this picture. */
static enum kd_status forget_lost(struct kd_frame_job *j)
{
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < j->plan->picture.bands && !status; band++) {
        struct kd_vk_buffer *light = j->store->radiance.buffers[band];
        status = kd_frame_forget_lost(j, light, kd_passes[kd_plan_light_pass(&j->plan->light)].name);
    }
    return status;
}

static enum kd_status run(struct kd_frame_job *j)
{
    struct kd_capacity c;
    bool reused = false;
    enum kd_status status;
    kd_renderer_capacity(j->r, &c);
    kd_prepare_begin(j->r, j->scene, &j->plan->light);
    KD_TRY(make_kernels(j));
    KD_TRY(make_ready(j, &c, &reused));
    j->frame->lens_reused = reused;
    j->refine_rows = j->plan->lens.adaptive ? rows_of_refining(j, j->plan->picture.height * (!reused + 1.0)) : 0;
    j->weight = (double)j->plan->picture.height * (!reused + 1 + !j->plan->picture.no_image) + j->refine_rows;
    KD_TRY(kd_prepare(j->r, j->prepared, j->scene, &j->plan->light, &c, j->error));
    KD_TRY(forget_lost(j));
    KD_TRY(kd_frame_light(j, reused));
    if (j->plan->lens.adaptive)
        KD_TRY(refine(j));
    KD_TRY(kd_frame_probe_pixel(j));
    if (j->others)
        KD_TRY(kd_frame_mean(j));
    if (j->plan->light.photometry)
        KD_TRY(kd_frame_add_light(j));
    if (!j->plan->picture.no_image)
        KD_TRY(kd_frame_show(j));
    KD_TRY(kd_frame_layers(j));
    if (j->plan->light.photometry)
        KD_TRY(kd_frame_read_light(j));
    KD_TRY(kd_frame_march_error(j));
    if (!reused)
        KD_TRY(judge_map(j));
    report_accuracy(j);
    if (j->plan->lens.adaptive && !j->others)
        KD_TRY(kd_frame_residual(j));
done:
    return status;
}

static enum kd_status add_layers(const struct kd_frame_job *job, struct kd_frame *frame)
{
    const enum kd_layer_type type = job->scene->image.bit_depth == 16 ? KD_LAYER_U16 : KD_LAYER_U8;
    enum kd_status status;
    if (!job->plan->picture.no_image)
        KD_TRY(kd_frame_add_layer(frame, "rgb", 3, type, job->error));
    KD_TRY(kd_frame_add_layers(frame, &job->plan->picture, job->error));
done:
    return status;
}

/* Drops all cached buffers after an internal error, because it may have corrupted them. The device is idle. */
static void begin_anew(struct kd_frame_job *job)
{
    kd_log(KD_LOG_ERROR, "a fault in kerrd: %s", job->error ? job->error->message : "no details");
    kd_store_empty(job->store);
    kd_prepared_finish(job->prepared, job->r->vk);
}

static enum kd_status render(struct kd_frame_job *job, struct kd_frame *out)
{
    struct kd_frame frame = { .width = job->plan->picture.width, .height = job->plan->picture.height };
    enum kd_status status;
    job->frame = &frame;
    KD_TRY(add_layers(job, &frame));
    KD_TRY(run(job));
    *out = frame;
done:
    free(job->kinds);
    job->kinds = NULL;
    if (!status) {
        kd_vk_buffer_destroy(job->r->vk, job->marched);
        return status;
    }
    kd_vk_discard(job->r->vk);
    kd_store_give_up(job->store);
    kd_prepared_forget(job->prepared);
    if (status != KD_EDEVICE)
        kd_vk_wait(job->r->vk, 0, NULL);
    kd_vk_buffer_destroy(job->r->vk, job->marched);
    if (status == KD_EINTERNAL)
        begin_anew(job);
    kd_frame_finish(&frame);
    return status;
}

enum kd_status kd_frame_run(struct kd_frame_job *job, struct kd_frame *out)
{
    double start = kd_clock_ms();
    kd_vk_times_reset(job->r->vk);
    kd_frame_learn_begin(job);
    enum kd_status status = render(job, out);
    if (status)
        return status;
    kd_frame_collect_timings(job, out, kd_clock_ms() - start - job->away_ms);
    kd_frame_learn(job, out);
    kd_renderer_count(job->r);
    return KD_OK;
}

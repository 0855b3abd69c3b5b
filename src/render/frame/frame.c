/* The order of a frame's passes. */
#include "render/frame/job.h"

#include "render/lens/audit.h"
#include "base/clock.h"
#include "render/device/prepare.h"

static enum kd_status run(struct kd_frame_job *j)
{
    struct kd_renderer *r = j->r;
    struct kd_frame *frame = j->frame;
    struct kd_capacity c;
    bool reused = false;
    kd_renderer_capacity(r, &c);
    /* Beside what is rendered aside there is a quarter to keep; of those each keeps its own lens map. */
    j->store->memory_bytes = j->aside ? j->plan->device_bytes : c.memory_bytes / 4;
    enum kd_status status = kd_store_lens_map(j->store, j->plan, &j->lens, &reused, j->error);
    if (!status)
        status = kd_store_frame(j->store, j->plan, kd_frame_bit_depth(frame), j->error);
    atomic_store(&r->held, kd_vk_allocated(r->vk));
    if (status)
        return status;

    kd_emit_update(r->emit, j->scene, j->plan->width * j->plan->band_rows);
    status = kd_store_send(j->store, &r->emit->data, j->error);
    if (!status)
        status = kd_frame_send_cameras(j);
    if (status)
        return status;

    frame->lens_reused = reused;
    j->weight = (double)j->plan->height * (!reused + 1 + !j->plan->unseen);
    status = kd_prepare(r, j->prepared, j->scene, j->plan, &c, j->error);
    if (!status)
        status = kd_frame_light(j, reused);
    if (!status && j->plan->light)
        status = kd_frame_add_light(j);
    if (!status && !j->plan->unseen)
        status = kd_frame_beam(j);
    if (!status && !j->plan->unseen)
        status = kd_frame_expose(j);
    if (!status && !j->plan->unseen)
        status = kd_frame_bloom(j);
    if (!status && !j->plan->unseen)
        status = kd_frame_post(j);
    if (!status)
        status = kd_frame_layers(j);
    if (!status && j->plan->light)
        status = kd_frame_read_light(j);
    double audited = kd_clock_ms();
    if (!status && !reused)
        status = kd_audit(r, j->scene, j->plan, j->lens, &j->lens->accuracy, j->error);
    if (j->plan->audit && !reused)
        j->audit_ms = kd_clock_ms() - audited;
    if (!status && !reused)
        status = kd_frame_undecided(j, &j->lens->accuracy.undecided);
    if (!status && !reused)
        kd_store_commit(j->store, j->lens, j->plan);
    frame->accuracy = j->lens->accuracy;
    return status;
}

static enum kd_status render(struct kd_frame_job *job, struct kd_frame *out)
{
    const struct kd_plan *plan = job->plan;
    struct kd_frame frame = { .width = plan->width, .height = plan->height };
    const enum kd_layer_type type = job->scene->image.bit_depth == 16 ? KD_LAYER_U16 : KD_LAYER_U8;
    enum kd_status status = plan->unseen ? KD_OK : kd_frame_add_layer(&frame, "rgb", 3, type, job->error);
    if (!status)
        status = kd_frame_add_layers(&frame, plan, job->error);
    if (status) {
        kd_frame_finish(&frame);
        return status;
    }
    job->frame = &frame;
    status = run(job);
    if (!status) {
        *out = frame;
        return KD_OK;
    }
    kd_vk_discard(job->r->vk);
    kd_store_give_up(job->store);
    kd_prepared_forget(job->prepared);
    if (status != KD_EDEVICE)
        kd_vk_wait(job->r->vk, 0, NULL);
    kd_frame_finish(&frame);
    return status;
}

enum kd_status kd_frame_run(struct kd_frame_job *job, struct kd_frame *out)
{
    double start = kd_clock_ms();
    kd_vk_times_reset(job->r->vk);
    enum kd_status status = render(job, out);
    if (status)
        return status;
    kd_frame_collect_timings(job, out, kd_clock_ms() - start - job->away_ms);
    kd_frame_learn(job->r, job->plan, out);
    return KD_OK;
}

/* Reports on a picture in progress: its completed fraction, previews, and the times of its passes. */
#include "render/frame/compilation.h"
#include "render/frame/job.h"

#include "base/clock.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static enum kd_status preview(struct kd_frame_job *j)
{
    size_t row = j->plan->picture.width * kd_layer_pixel_bytes(&j->frame->layers[0]);
    memset((char *)kd_frame_pixels(j->frame) + row * j->lit, 0, row * (j->plan->picture.height - j->lit));
    j->looking = true;
    enum kd_status status;
    KD_TRY(kd_frame_show(j));
    KD_TRY(kd_frame_layers(j));
    j->preview->seen(j->user, j->frame, j->lit);
done:
    j->looking = false;
    return status;
}

/* Adds the device's times since the last reset to the picture's own. */
static void keep_times(struct kd_frame_job *j)
{
    struct kd_vk_time now[KD_VK_MAX_PASSES];
    for (size_t i = 0, n = kd_vk_times(j->r->vk, now); i < n; i++) {
        size_t k = 0;
        while (k < j->n_times && strcmp(j->times[k].pass, now[i].pass))
            k++;
        if (k == j->n_times && k < KD_VK_MAX_PASSES)
            j->times[j->n_times++] = (struct kd_vk_time) { .pass = now[i].pass };
        if (k < j->n_times) {
            j->times[k].ms += now[i].ms;
            j->times[k].dispatches += now[i].dispatches;
        }
    }
}

/* Calls `tell`. If the picture is rendered in the background, others may use the device meanwhile. */
static enum kd_status away(struct kd_frame_job *j, bool (*tell)(struct kd_frame_job *job, void *what), void *what,
                           bool *go_on)
{
    /* waits for this work. Other pictures then need not wait for it, and their times do not include it */
    if (j->background) {
        enum kd_status status = kd_vk_wait(j->r->vk, 0, j->error);
        if (status)
            return status;
        keep_times(j);
        kd_slice_end(&j->r->slice_pace, kd_clock_ms());
    }
    double left = kd_clock_ms();
    *go_on = tell(j, what);
    if (j->background) {
        j->away_ms += kd_clock_ms() - left;
        kd_vk_times_reset(j->r->vk);
        kd_slice_begin(&j->r->slice_pace, kd_clock_ms());
    }
    return KD_OK;
}

static bool tell_lack(struct kd_frame_job *j, void *what) { return j->r->lacks(j->r->lacks_user, what, j->background); }

enum kd_status kd_frame_await_kernels(struct kd_frame_job *j, kd_kernels_ask_fn ask, const void *user)
{
    /* number of attempts: while kernels are compiled elsewhere, other pictures may evict this picture's kernels. After
     * the last attempt the kernels are made here */
    enum { TRIES = 4 };
    struct kd_compilation *c;
    enum kd_status status;
    bool go_on = true;
    for (int i = 0; i < TRIES && j->r->lacks && (c = kd_compilation_of(j->r, ask, user)); i++) {
        status = away(j, tell_lack, c, &go_on);
        if (status)
            return status;
        if (!go_on)
            return kd_error_set(j->error, KD_ECANCELLED, "the picture waits for a kernel");
    }
    return KD_OK;
}

static bool tell_progress(struct kd_frame_job *j, void *what)
{
    (void)what;
    return !j->progress || j->progress(j->user, fmin(j->done / j->weight, 1));
}

enum kd_status kd_frame_report(struct kd_frame_job *j, double rows)
{
    bool go_on;
    j->done += j->looking ? 0 : rows; /* rows of a preview do not count */
    const enum kd_status status = away(j, tell_progress, NULL, &go_on);
    if (status)
        return status;
    if (!go_on)
        return kd_error_set(j->error, KD_ECANCELLED, "the render was cancelled");
    bool part = j->preview && !j->plan->picture.no_image && !j->looking && j->lit && j->lit < j->plan->picture.height;
    if (!part || !j->preview->wanted(j->user))
        return KD_OK;
    const enum kd_status seen = preview(j);
    /* restarts the clock, because the time of this call is not that of the next slice */
    kd_slice_begin(&j->r->slice_pace, kd_clock_ms());
    return seen;
}

_Static_assert(KD_FRAME_MAX_TIMINGS >= KD_VK_MAX_PASSES + 4,
               "those of the device; kernels, listed rays and audit on the host; the total");
_Static_assert(KD_VK_MAX_PASSES >= KD_PASS_COUNT + 4, "all passes, copies, fills, and commands outside every pass");

static void add_timing(struct kd_frame *frame, const char *name, double ms)
{
    struct kd_timing *t = &frame->timings[frame->n_timings++];
    snprintf(t->name, sizeof t->name, "%s", name);
    t->ms = ms;
}

void kd_frame_collect_timings(struct kd_frame_job *j, struct kd_frame *frame, double total_ms)
{
    keep_times(j);
    if (j->kernels_ms > 0)
        add_timing(frame, "kernels", j->kernels_ms);
    if (j->listed_ms > 0)
        add_timing(frame, kd_passes[KD_PASS_TRACE].name, j->listed_ms);
    if (j->audit_ms > 0)
        add_timing(frame, kd_passes[KD_PASS_AUDIT].name, j->audit_ms);
    for (size_t i = 0; i < j->n_times; i++)
        add_timing(frame, j->times[i].pass, j->times[i].ms);
    add_timing(frame, "total", total_ms);
}

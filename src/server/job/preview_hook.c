/* Previews of a frame while it is rendered, for clients that request them. */
#include "image/png.h"
#include "base/clock.h"
#include "server/job/job_internal.h"

#include <stdio.h>

#define WANTED_MS 10000.0 /* time in ms after a request during which previews are made */
#define APART_MS 500.0    /* minimum time in ms between two previews; SHARE may make it longer */
/* minimum time between two previews, as a multiple of the time that making one takes */
#define SHARE 20.0

static bool wanted(void *user)
{
    struct kd_job *job = kd_job_of_frame(user, NULL);
    double now = kd_clock_ms();
    pthread_mutex_lock(&job->all->lock);
    bool yes = now < job->preview.until_ms && now >= job->preview.due_ms;
    job->preview.began_ms = now;
    pthread_mutex_unlock(&job->all->lock);
    return yes;
}

/* Stores a preview of an unfinished frame. A text in the PNG says that it is unfinished. */
static void seen(void *user, const struct kd_frame *frame, uint32_t rows)
{
    unsigned number;
    struct kd_job *job = kd_job_of_frame(user, &number);
    char text[32];
    struct kd_buffer png = { 0 };
    struct kd_error error;
    snprintf(text, sizeof text, "%u/%u", rows, frame->height);
    const struct kd_png_text rows_text = { "kerrd:rows", text };
    const struct kd_png_params params = {
        .width = frame->width,
        .height = frame->height,
        .bit_depth = kd_frame_bit_depth(frame),
        .compression = 1,
        .pixels = kd_frame_pixels(frame),
        .text = &rows_text,
        .n_text = 1,
    };
    if (kd_png_encode(&params, &png, &error)) /* on failure, which means out of memory, this preview is skipped */
        kd_buffer_finish(&png);
    double now = kd_clock_ms();
    pthread_mutex_lock(&job->all->lock);
    struct kd_job_preview_hook *g = &job->preview;
    kd_buffer_finish(&g->png);
    g->png = png;
    g->frame = number;
    g->rows = rows;
    g->height = frame->height;
    double took = SHARE * (now - g->began_ms);
    g->due_ms = now + (took > APART_MS ? took : APART_MS);
    pthread_mutex_unlock(&job->all->lock);
}

const struct kd_preview_hook kd_job_preview_hook = { wanted, seen };

bool kd_job_glimpse(struct kd_job *job, struct kd_buffer *png, struct kd_job_sight *out)
{
    pthread_mutex_lock(&job->all->lock);
    struct kd_job_preview_hook *g = &job->preview;
    g->until_ms = kd_clock_ms() + WANTED_MS;
    *out = (struct kd_job_sight) { .frame = g->frame, .rows = g->rows, .height = g->height };
    bool there = g->png.size && !job->have[g->frame] && kd_job_is_active(job) &&
                 !kd_buffer_append(png, g->png.data, g->png.size);
    for (unsigned i = job->frames; !there && i-- > 0;)
        if (job->have[i]) {
            *out = (struct kd_job_sight) { .frame = i, .finished = true };
            break;
        }
    pthread_mutex_unlock(&job->all->lock);
    return there || out->finished;
}

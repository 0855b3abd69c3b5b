/* Encodings of live frames. A frame gets only the encodings that viewers request. The renderer's encoder makes the
 * first one; others are made when a viewer waits for them. */
#include "server/session/session_internal.h"

#include <stdlib.h>

/* Time in ms after which the pixels of the latest frame are freed. After that, a request for another encoding gets
 * the next frame. */
#define PIXELS_MS 1000.0

struct added {
    struct kd_render_job job; /* must be the first member, because the queue stores a pointer to it */
    struct kd_session *session;
    struct kd_live_frame *frame;
};

/* All functions below except `done` are called with the lock held. */

static unsigned kind_of(const struct kd_viewer *viewer, bool last) { return last ? viewer->last_lossy : viewer->lossy; }

static void set_kind(struct kd_render_job *job, unsigned lossy)
{
    job->format = lossy ? &kd_format_jpg : kd_format_live();
    job->lossy = lossy;
}

/* The first encoding of the last frame is always the lossless one. Viewers that come after its pixels were freed get
 * this file. */
void kd_session_choose_kind(const struct kd_session *s, bool last, struct kd_render_job *job)
{
    const struct kd_viewer *first = NULL;
    for (const struct kd_viewer *v = s->viewers; v && !last; v = v->next)
        if (v->waiting && !v->any && (!first || !v->lossy))
            first = v;
    set_kind(job, first ? first->lossy : 0);
}

static const struct kd_live_file *file_of(const struct kd_live_frame *frame, unsigned lossy)
{
    const struct kd_live_file *near = NULL;
    for (unsigned i = 0; i < frame->n_files; i++) {
        const struct kd_live_file *file = &frame->files[i];
        if (file->lossy == lossy)
            return file;
        if (lossy && file->lossy && (!near || abs((int)(file->lossy - lossy)) < abs((int)(near->lossy - lossy))))
            near = file;
    }
    /* The last entry is reserved for the lossless encoding. If all other entries are in use, the viewer gets the
     * nearest quality, and the answer says which. */
    unsigned lossy_ones = 0;
    for (unsigned i = 0; i < frame->n_files; i++)
        lossy_ones += frame->files[i].lossy > 0;
    return lossy_ones == KD_LIVE_FILES - 1 ? near : NULL;
}

const struct kd_live_file *kd_session_file(const struct kd_viewer *viewer, const struct kd_live_frame *frame)
{
    /* true if no further encoding of the frame can be made */
    const bool gone = frame->last && !frame->picture.n_layers;
    const struct kd_live_file *file = file_of(frame, kind_of(viewer, frame->last));
    return file || !gone ? file : file_of(frame, 0);
}

void kd_session_forget_pixels(struct kd_session *s, double now)
{
    if (s->latest && !s->adding && now - s->shown_ms > PIXELS_MS)
        kd_frame_finish(&s->latest->picture);
}

/* Sends a frame in an encoding that was finished only after a newer frame had been published. Viewers that have
 * waited for the older frame in this encoding still get it. Otherwise, if encoding takes longer than the time
 * between frames, they would never get one. */
static void hand_out(struct kd_session *s, struct kd_live_frame *frame, unsigned lossy)
{
    for (struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->waiting && !v->any && kind_of(v, frame->last) == lossy && v->seen < frame->number && !v->owed)
            v->owed = kd_live_frame_share(frame);
}

static void done(struct kd_render_job *job)
{
    struct added *added = (struct added *)job;
    struct kd_session *s = added->session;
    struct kd_sessions *all = s->all;
    struct kd_live_frame *frame = added->frame;
    pthread_mutex_lock(&all->lock);
    s->adding = false;
    if (!job->status) {
        frame->files[frame->n_files++] = (struct kd_live_file) { job->format, job->lossy, job->file, job->encode_ms };
        all->bytes += job->file.size;
        job->file = (struct kd_buffer) { 0 };
        if (frame != s->latest)
            hand_out(s, frame, job->lossy);
    } else {
        s->failed = job->status;
        s->error = job->error;
    }
    kd_session_wake(s);
    kd_session_add_kinds(s);
    kd_live_frame_release(frame);
    kd_session_unref(s);
    pthread_mutex_unlock(&all->lock);
    kd_buffer_finish(&job->file);
    free(added);
}

static void add(struct kd_session *s, unsigned lossy)
{
    struct added *added = calloc(1, sizeof *added);
    if (!added) {
        s->failed = kd_error_set(&s->error, KD_ENOMEM, "out of memory for a frame");
        kd_session_wake(s);
        return;
    }
    added->session = s;
    added->frame = kd_live_frame_share(s->latest);
    added->job = (struct kd_render_job) {
        .claim.class = KD_CLASS_LIVE, .socket = -1, .effort = KD_EFFORT_LIVE, .keeps = true, .done = done
    };
    added->job.frame = s->latest->picture; /* the pixels still belong to `latest` */
    added->job.plan.cost.host_bytes = (uint64_t)3 * added->job.frame.width * added->job.frame.height;
    set_kind(&added->job, lossy);
    s->adding = true;
    s->references++;
    kd_render_queue_encode(s->all->params.renders, &added->job);
}

void kd_session_add_kinds(struct kd_session *s)
{
    if (!s->latest || !s->latest->picture.n_layers || s->adding || s->failed || !s->listed)
        return;
    for (const struct kd_viewer *v = s->viewers; v; v = v->next)
        if (v->waiting && !v->any && s->latest->number > v->seen && !kd_session_file(v, s->latest)) {
            add(s, kind_of(v, s->latest->last));
            return; /* another encoding is in progress; the next one starts when it is done */
        }
}

/* The bounded queue in front of the renderer, the thread that owns the renderer, and the encoders behind it.
 *
 * waiting (bounded) -> render thread -> encoders (bounded by the bytes of their frames) -> done()
 *
 * Pictures are submitted by one thread, which makes kd_render_queue_admit's answer hold until kd_render_queue_push; other
 * work may come from others, and exceed the limit by as many of them as there are. */
#ifndef KD_SERVER_RENDER_QUEUE_H
#define KD_SERVER_RENDER_QUEUE_H

#include "base/buffer.h"
#include "render/render.h"

#include <stdatomic.h>
#include <stdbool.h>

struct kd_render_queue;

#define KD_ENCODERS 2 /* one of which is for what is not in the background */
#define KD_BACKGROUND_MS 1000.0

struct kd_render_job {
    /* filled in by the submitter */
    struct kd_scene scene;
    struct kd_plan plan;
    int compression;
    /* NULL: a picture is rendered and encoded. Else this is called instead, on the render thread. */
    enum kd_status (*run)(struct kd_render_job *job, struct kd_renderer *renderer, kd_progress_fn progress,
                          void *progress_user);
    bool live; /* before all that is not, and not counted among what may wait */
    /* Behind all that is not, which also goes between its slices; but it begins after KD_BACKGROUND_MS at the latest, and has a tenth of the
     * time: others cannot stop it for good. A picture, and not counted either. */
    bool background;
    /* Of a live one that is long and that nobody drags: as `background`, but before that. While something in the background is under
     * way it goes between its slices instead, unless there are other live ones, and is KD_ECANCELLED when one comes. plan: for half
     * of the memory. */
    bool patient;
    bool sliced; /* a part of what comes in many: has its tenth of the time as well, that frames of sessions leave it none */
    void (*progress)(struct kd_render_job *job, double fraction); /* may be NULL; on the render thread */
    const struct kd_glance *glance; /* of one in the background or a patient one; may be NULL; user: the job. On the render thread */
    /* NULL: as a file, with its scene. Else this, from the frame to the bytes in png; on an encoder's thread, whose number it gets. */
    enum kd_status (*encode)(struct kd_render_job *job, unsigned encoder);
    _Atomic bool drop;                           /* set by whoever wants it no more: KD_ECANCELLED */
    int socket;                                  /* of the client; once it hangs up the job is dropped; -1: none */
    void (*rendered)(struct kd_render_job *job); /* may be NULL; on the render thread, before the frame is encoded */
    void (*done)(struct kd_render_job *job);     /* on a thread of the queue; may free the job */
    void *user;
    /* the outcome: KD_ECANCELLED when dropped */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer png;
    struct kd_frame frame; /* without its pixels */
    double queue_ms, encode_ms;
    bool aside; /* others went between its slices: kd_render_aside */
    /* the queue's own */
    struct kd_render_job *next;
    struct kd_render_queue *queue;
    double submitted_ms;
};

/* Returns when the device is open, or with the error. */
enum kd_status kd_render_queue_create(const struct kd_renderer_params *params, unsigned limit,
                                      struct kd_render_queue **out, struct kd_error *error);
/* Cancels what is left and calls its done(). A lost device is left as it is. Accepts NULL. */
void kd_render_queue_destroy(struct kd_render_queue *queue);

/* Any thread. */
void kd_render_queue_capacity(struct kd_render_queue *queue, struct kd_capacity *out);
const char *kd_render_queue_device_name(const struct kd_render_queue *queue);
/* As after the latest render. */
enum kd_status kd_render_queue_device_json(struct kd_render_queue *queue, struct kd_buffer *out);
/* As now on disk; errors as kd_renderer_accuracy_json. */
enum kd_status kd_render_queue_accuracy_json(const struct kd_render_queue *queue, struct kd_buffer *out,
                                             struct kd_error *error);
bool kd_render_queue_lost(struct kd_render_queue *queue, struct kd_error *error);
unsigned kd_render_queue_unfinished(struct kd_render_queue *queue);
double kd_render_queue_backlog_ms(struct kd_render_queue *queue); /* estimated, of all that is accepted */

/* Whether one more fits: KD_EBUSY, KD_EDEVICE, or KD_OK. The submitting thread. */
enum kd_status kd_render_queue_admit(struct kd_render_queue *queue, struct kd_error *error);
void kd_render_queue_push(struct kd_render_queue *queue, struct kd_render_job *job);

/* Drop waiting jobs whose clients have gone. Any thread. */
void kd_render_queue_sweep(struct kd_render_queue *queue);
/* Drop everything, what is running as soon as it can be stopped. Any thread. */
void kd_render_queue_cancel(struct kd_render_queue *queue);

#endif

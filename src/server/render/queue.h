/* All that wants the device goes through here: the bounded queue in front of it, who has it when, and the encoders
 * behind it.
 *
 * waiting (bounded) -> the device, by turns -> encoders (bounded by the bytes of their frames) -> done()
 *
 * Whose turn it is says http/shares.h: by client, then by class. A work that is short has the device until it is
 * done. A picture that is estimated to take longer than KD_MOMENT_MS, or that nobody waits for, has a lane, a thread
 * with buffers of its own, and goes on in slices of some 40 ms between which others have the device; a list of rays
 * is cut up by whoever submits it (`more`). So nobody waits for more than a slice, or a short work, of each client
 * that has had less of the device.
 *
 * Each client has one lane for each class, and two more for what takes a few seconds at most, so that no client can
 * have them all; and long pictures begin when there is memory for their buffers beside those of the others. Until
 * then they wait.
 *
 * A device that has failed is opened again (KD_EDEVICE; kd_renderer_reopen): whatever had begun begins once more as
 * if it had not, and only what had the device when it failed for the second time is told so. Where that cannot be
 * done, or has been done too often, the device is lost, and all that waits is told.
 *
 * What lacks kernels waits while a thread compiles them, one job's after the other's by the same shares; others have
 * the device meanwhile (compile.c). A picture that comes to need one on its way waits where it is, in a lane, or begins
 * once more.
 *
 * A picture before a sky whose picture has to be read first waits for that, which takes up to a second and no
 * device.
 *
 * Pictures are submitted by one thread, which makes kd_render_queue_admit's answer hold until kd_render_queue_push;
 * other work may come from others, and exceed the limit by as many of them as there are. */
#ifndef KD_SERVER_RENDER_QUEUE_H
#define KD_SERVER_RENDER_QUEUE_H

#include "base/buffer.h"
#include "render/frame/blur.h"
#include "render/frame/compilation.h"
#include "render/output/format.h"
#include "render/render.h"
#include "server/http/allowance.h"
#include "server/http/shares.h"

#include <limits.h>
#include <stdatomic.h>
#include <stdbool.h>

struct kd_render_queue;

#define KD_ENCODERS 2      /* one of which is for frames that do not take long */
#define KD_MOMENT_MS 100.0 /* of device time, that others may be made to wait */

/* How far a job is. The last two have begun. */
enum kd_render_stage {
    KD_RENDER_WAITS,          /* for its first turn */
    KD_RENDER_WAITS_FOR_LANE, /* the same, a long picture */
    KD_RENDER_WORKS,
    KD_RENDER_WORKS_IN_LANE,
};

/* Of the kernels of a picture. */
enum kd_render_kernels { KD_KERNELS_UNKNOWN, KD_KERNELS_MISSING, KD_KERNELS_THERE };

struct kd_render_job {
    /* filled in by the submitter */
    struct kd_claim claim; /* client and class, which says how it is served; what is left is by the plan */
    struct kd_scene scene;
    struct kd_plan plan;
    const struct kd_format *format; /* of the file that the picture becomes, */
    enum kd_effort effort;
    struct kd_blur blur;    /* samples 0, as it begins: there is none */
    unsigned number, lossy; /* as in struct kd_picture */
    char hash[65];          /* likewise */
    bool keeps;             /* the frame's layers, once it has been encoded */
    /* NULL: a picture is rendered and encoded. Else this is called instead, with the device; if it sets `more` it is
     * called again at the next turn, and so on. */
    enum kd_status (*run)(struct kd_render_job *job, struct kd_renderer *renderer, kd_progress_fn progress,
                          void *progress_user);
    kd_kernels_ask_fn ask; /* for the kernels of `run`, with the job as user; NULL: none that takes long */
    bool more;
    void (*progress)(struct kd_render_job *job, double fraction); /* may be NULL; with the device */
    const struct kd_glance *glance; /* of a picture in slices; may be NULL; user: the job. With the device */
    _Atomic bool drop;              /* set by whoever wants it no more: KD_ECANCELLED */
    int socket;                     /* of the client; once it hangs up the job is dropped; -1: none */
    void (*rendered)(struct kd_render_job *job); /* may be NULL; with the device, before the frame is encoded */
    void (*done)(struct kd_render_job *job);     /* on a thread of the queue; may free the job */
    void *user;
    /* the outcome: KD_ECANCELLED when dropped */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer file;
    struct kd_frame frame;      /* without its layers, unless it keeps them */
    double queue_ms, encode_ms; /* queue_ms: in which others had the device, before it began and between its slices */
    /* the queue's own */
    struct kd_render_job *next;
    struct kd_render_queue *queue;
    enum kd_render_stage stage;
    enum kd_render_kernels kernels;
    struct kd_compilation *compilation; /* of those that are missing; run, or only compared with what is being run */
    struct kd_compilation *lacked;      /* of those that it has come to need; it begins once more when they are there */
    unsigned lacks;                     /* how often it has */
    struct kd_claim missing;            /* for those, while there are any */
    double kernels_ms, missing_ms;      /* kernels_ms: waited for them; missing_ms: since when */
    bool sky;                           /* the picture of its sky was not there when it came */
    bool inside;                        /* it is at work with the renderer, or waits between two slices */
    bool repeated;                      /* the device has failed it once */
    double submitted_ms, turn_ms, away_ms; /* turn_ms: when its turn began; away_ms: since when it has none */
};

#define KD_REOPENINGS 3       /* of a device that fails, unless the queue is told otherwise, */
#define KD_REOPENINGS_S 600.0 /* in so many seconds */
#define KD_REOPENINGS_NONE UINT_MAX

/* Returns when the device is open, or with the error. client_limit: of those that may wait, how many one client may
 * have; client_s: seconds of the device's time that one may use in a minute, 0: all. reopenings: how often the
 * device may be opened again within KD_REOPENINGS_S; 0: KD_REOPENINGS; KD_REOPENINGS_NONE: never. */
enum kd_status kd_render_queue_create(const struct kd_renderer_params *params, unsigned limit, unsigned client_limit,
                                      unsigned client_s, unsigned reopenings, struct kd_render_queue **out,
                                      struct kd_error *error);
/* Cancels what is left and calls its done(). A lost device is left as it is. Accepts NULL. */
void kd_render_queue_destroy(struct kd_render_queue *queue);

/* How long nothing must have been asked for before memory is given back (render/device/rest.h); a minute unless this
 * says otherwise. Any thread. */
void kd_render_queue_rest_after(struct kd_render_queue *queue, unsigned ms);
/* Any thread. */
void kd_render_queue_capacity(struct kd_render_queue *queue, struct kd_capacity *out);
const char *kd_render_queue_device_name(const struct kd_render_queue *queue);
/* As kd_renderer_cache_file. */
char *kd_render_queue_cache_file(const struct kd_render_queue *queue, const char *suffix);
/* As after the latest render. */
enum kd_status kd_render_queue_device_json(struct kd_render_queue *queue, struct kd_buffer *out);
/* As now on disk; errors as kd_renderer_accuracy_json. */
enum kd_status kd_render_queue_accuracy_json(const struct kd_render_queue *queue, struct kd_buffer *out,
                                             struct kd_error *error);
/* Begins to read an asset that may become a sky, if a quarter of the memory that is left has room for its pixels
 * meanwhile. Any thread. */
void kd_render_queue_sky_ahead(struct kd_render_queue *queue, const char *hash, uint32_t width, uint32_t height);
/* What it has measured, and what there is of the device, in Prometheus's format. */
enum kd_status kd_render_queue_metrics(struct kd_render_queue *queue, struct kd_buffer *out);
bool kd_render_queue_lost(struct kd_render_queue *queue, struct kd_error *error);
/* Whether a frame of a job of this client may be pushed: it leaves half of what the client may use of the device's
 * time to what somebody asks for. */
bool kd_render_queue_may_push(struct kd_render_queue *queue, const char *client);
/* Loses the device if whoever has it has given no sign of life for too long (pulse.h), as when a call of the driver
 * does not return; or if another thread's hangs. Whether it is so: what waits may never be done. */
bool kd_render_queue_hangs(struct kd_render_queue *queue, bool another);
unsigned kd_render_queue_reopened(struct kd_render_queue *queue); /* times, so far */
unsigned kd_render_queue_unfinished(struct kd_render_queue *queue);
/* Estimates what compiling the kernels that a picture lacks will take, by those that have been compiled; 0: it lacks
 * none, or somebody has the device, and it is not known. Any thread. */
double kd_render_queue_kernels_ms(struct kd_render_queue *queue, const struct kd_scene *scene,
                                  const struct kd_plan *plan);
/* Estimated, of all that clients wait for: not of frames of sessions and jobs. */
double kd_render_queue_backlog_ms(struct kd_render_queue *queue);

/* Whether this client may begin something new: KD_OK, or KD_EBUSY with when it may, where its work has used, or is
 * estimated to use, as much of the device's time as one may (http/allowance.h). Any thread. */
enum kd_status kd_render_queue_afford(struct kd_render_queue *queue, const char *client, struct kd_error *error);
/* The same as numbers, where there is a limit. Any thread. */
struct kd_quota kd_render_queue_quota(struct kd_render_queue *queue, const char *client);
/* Whether one more of this client fits: KD_EBUSY, KD_EDEVICE, or KD_OK. *quota: it has as many waiting as one client
 * may, or cannot afford it. The submitting thread. */
enum kd_status kd_render_queue_admit(struct kd_render_queue *queue, const char *client, bool *quota,
                                     struct kd_error *error);
void kd_render_queue_push(struct kd_render_queue *queue, struct kd_render_job *job);
/* Has a frame encoded that is there already: job->frame, in one more format. Any thread. */
void kd_render_queue_encode(struct kd_render_queue *queue, struct kd_render_job *job);

/* Drop jobs whose clients have gone. Any thread. */
void kd_render_queue_sweep(struct kd_render_queue *queue);
/* Drop everything, what is running as soon as it can be stopped. Any thread. */
void kd_render_queue_cancel(struct kd_render_queue *queue);

#endif

/* Render queue: all work for the device passes through it. It consists of the bounded queue before the device, the
 * scheduler of the device, and the encoders.
 *
 *     waiting (bounded) -> the device, by turns -> encoders (bounded by the bytes of their frames) -> done()
 *
 * http/shares.h chooses the next work, first by client, then by class. Short work owns the device until the work is
 * done. A picture runs in a lane if its estimated time exceeds KD_MOMENT_MS, or if nobody waits for it. A lane is a
 * thread with its own buffers, which releases the device between slices of some 40 ms. A list of rays is divided
 * into pieces by the code that submits it (`more`). A client therefore waits for at most one slice or one short work
 * of each client that has used the device less.
 *
 * Each client has one lane for each class, and two more for pictures that take a few seconds at most, so that no
 * client can occupy all lanes. A long picture starts only when there is enough memory for its buffers in addition to
 * those of the other lanes.
 *
 * A device that has failed is reopened (KD_EDEVICE; kd_renderer_reopen). All work that had begun starts again,
 * except work that owned the device in two failures: that work ends with the error. If reopening fails, or has
 * happened too often, the device is lost, and all waiting work ends with the error.
 *
 * Work that lacks kernels waits while a thread compiles them, for one job after another in fair order. Other work
 * uses the device meanwhile (compile.c). If a kernel turns out to be missing after a picture has begun, the picture
 * waits in its lane or starts again.
 *
 * If the sky or the grid of a picture must be read first, the picture waits until it is read. Reading takes up to
 * some seconds and does not use the device.
 *
 * Pictures are submitted by one thread only, so that the answer of kd_render_queue_admit is valid until
 * kd_render_queue_push. Other threads may submit other work; each of them may exceed the limit by one. */
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

#define KD_ENCODERS 2 /* number of encoders; one of them accepts only frames that are encoded quickly */
/* limit in ms: work that uses the device for at most this time is not interrupted */
#define KD_MOMENT_MS 100.0

/* Stage of a job. In the last two stages the job has started. */
enum kd_render_stage {
    KD_RENDER_WAITS,          /* the job waits for its first turn, and needs no lane */
    KD_RENDER_WAITS_FOR_LANE, /* a long picture that waits for its first turn */
    KD_RENDER_WORKS,
    KD_RENDER_WORKS_IN_LANE,
};

/* State of the kernels that a picture needs. */
enum kd_render_kernels { KD_KERNELS_UNKNOWN, KD_KERNELS_MISSING, KD_KERNELS_THERE };

struct kd_render_job {
    /* From here on, the submitter sets the members. */
    struct kd_claim claim; /* client and class, for the scheduler; left_ms is set from the plan */
    struct kd_scene scene;
    struct kd_plan plan;
    const struct kd_format *format; /* format of the file that is made from the picture */
    enum kd_effort effort;
    struct kd_blur blur;    /* motion blur; samples = 0 (the default): no motion blur */
    unsigned number, lossy; /* as in struct kd_picture */
    char hash[65];          /* as in struct kd_picture */
    bool keeps;             /* true if the layers of the frame are kept after it was encoded */
    /* NULL: the queue renders and encodes a picture. Otherwise the queue calls this function instead, while the job
     * owns the device. If the function sets `more`, it is called again in the job's next turn. */
    enum kd_status (*run)(struct kd_render_job *job, struct kd_renderer *renderer, kd_progress_fn progress,
                          void *progress_user);
    /* requests the kernels that `run` needs, with the job as user; NULL: it needs none that take long to compile */
    kd_kernels_ask_fn ask;
    bool more;
    /* A scene of a view that nobody is moving, or NULL. When the job is done, the kernels for explaining the pixels
     * of this view are compiled in advance. */
    const struct kd_scene *settled;
    void (*progress)(struct kd_render_job *job, double fraction); /* called by the owner of the device; may be NULL */
    /* Preview of a picture that is rendered in slices, or NULL. Its user pointer is the job. Called by the owner of
     * the device. */
    const struct kd_preview_hook *preview;
    _Atomic bool drop; /* another thread sets this to cancel the job, which ends with KD_ECANCELLED */
    int socket;        /* socket of the client; if the client disconnects, the job is cancelled; -1: none */
    void (*rendered)(struct kd_render_job *job); /* called before encoding, by the owner of the device; may be NULL */
    void (*done)(struct kd_render_job *job);     /* called on a thread of the queue; may free the job */
    void *user;
    /* The following members are results. status is KD_ECANCELLED if the job was cancelled. */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer file;
    struct kd_frame frame; /* contains its layers only if `keeps` is set */
    /* queue_ms: time during which others owned the device, before the job started and between its slices */
    double queue_ms, encode_ms;
    double used_ms; /* device time that the job has used, in ms */
    /* The following members are private to the queue. */
    struct kd_render_job *next;
    struct kd_render_queue *queue;
    enum kd_render_stage stage;
    enum kd_render_kernels kernels;
    struct kd_compilation *compilation; /* kernels that the job lacks; they are being compiled or wait to be compiled */
    /* Kernels that turned out to be missing after the job had started. When they are compiled, the job starts again. */
    struct kd_compilation *lacked;
    struct kd_compilation *ahead; /* kernels for explaining the pixels of `settled` */
    unsigned lacks;               /* number of times that kernels were missing after the job had started */
    /* the job's claim in the fair queueing of compilations; valid while kernels are missing */
    struct kd_claim missing;
    /* kernels_ms: time for which the job has waited for kernels; missing_ms: time when it began to wait */
    double kernels_ms, missing_ms;
    /* true if an asset of the scene was not read yet when the job was submitted */
    bool reads;
    bool inside;                           /* true while the job uses the renderer or waits between two slices */
    bool repeated;                         /* true if the device has failed once while this job owned it */
    double submitted_ms, turn_ms, away_ms; /* turn_ms: start of the present turn; away_ms: end of the last turn */
};

#define KD_REOPENINGS 3       /* default limit of the number of reopenings of a device within KD_REOPENINGS_S */
#define KD_REOPENINGS_S 600.0 /* period in seconds in which reopenings are counted */
#define KD_REOPENINGS_NONE UINT_MAX

/* Returns when the device is open, or with an error. client_limit: maximum number of waiting jobs of one client.
 * client_s: seconds of device time that a client may use in a minute; 0: no limit. reopenings: number of times that
 * the device may be reopened within KD_REOPENINGS_S; 0 stands for KD_REOPENINGS, and KD_REOPENINGS_NONE for never. */
enum kd_status kd_render_queue_create(const struct kd_renderer_params *params, unsigned limit, unsigned client_limit,
                                      unsigned client_s, unsigned reopenings, struct kd_render_queue **out,
                                      struct kd_error *error);
/* Cancels the remaining jobs, and calls their done(). If the device is lost, it is not closed. Accepts NULL. */
void kd_render_queue_destroy(struct kd_render_queue *queue);

/* Sets the time without requests after which memory is freed (render/device/rest.h). The default is a minute. Any
 * thread. */
void kd_render_queue_rest_after(struct kd_render_queue *queue, unsigned ms);
/* Gets the capacity of the device (kd_renderer_capacity). Any thread. */
void kd_render_queue_capacity(struct kd_render_queue *queue, struct kd_capacity *out);
const char *kd_render_queue_device_name(const struct kd_render_queue *queue);
/* Calls kd_renderer_cache_file for the renderer of the queue. */
char *kd_render_queue_cache_file(const struct kd_render_queue *queue, const char *suffix);
/* Appends the description of the device, which is updated after each render. */
enum kd_status kd_render_queue_device_json(struct kd_render_queue *queue, struct kd_buffer *out);
/* Appends the record of accuracy from the disk. The errors are those of kd_renderer_accuracy_json. */
enum kd_status kd_render_queue_accuracy_json(const struct kd_render_queue *queue, struct kd_buffer *out,
                                             struct kd_error *error);
/* Starts to decode an asset that may be used as a sky, if its pixels fit into a quarter of the free memory. Any
 * thread. */
void kd_render_queue_sky_ahead(struct kd_render_queue *queue, const char *hash, uint32_t width, uint32_t height);
/* Writes the metrics of the queue and of the device in Prometheus's format. */
enum kd_status kd_render_queue_metrics(struct kd_render_queue *queue, struct kd_buffer *out);
bool kd_render_queue_lost(struct kd_render_queue *queue, struct kd_error *error);
/* True if a job of this client may submit its next frame. Jobs leave half of the client's device time for
 * interactive requests. */
bool kd_render_queue_may_push(struct kd_render_queue *queue, const char *client);
/* If the owner of the device has not made progress for too long (pulse.h), for example because a driver call does
 * not return, declares the device lost. `another`: true if another device hangs, which has the same effect. Returns
 * true if a device hangs; waiting jobs may then never end. */
bool kd_render_queue_hangs(struct kd_render_queue *queue, bool another);
unsigned kd_render_queue_reopened(struct kd_render_queue *queue); /* number of reopenings since the start */
unsigned kd_render_queue_unfinished(struct kd_render_queue *queue);
/* Estimates, from earlier compilations, how long it takes to compile the kernels that a picture lacks. Returns 0 if
 * none are missing, and also if this is not known because the device is in use. Any thread. */
double kd_render_queue_kernels_ms(struct kd_render_queue *queue, const struct kd_scene *scene,
                                  const struct kd_plan *plan);
/* Estimated time of all work for which clients wait. Frames of sessions and of jobs are not included. */
double kd_render_queue_backlog_ms(struct kd_render_queue *queue);

/* Tests whether this client may start new work. Returns KD_OK, or KD_EBUSY if the client's work has used, or is
 * estimated to use, all of the client's device time (http/allowance.h). The error then contains the time to wait.
 * Any thread. */
enum kd_status kd_render_queue_afford(struct kd_render_queue *queue, const char *client, struct kd_error *error);
/* Gets the client's quota, if device time is limited. Any thread. */
struct kd_quota kd_render_queue_quota(struct kd_render_queue *queue, const char *client);
/* Tests whether the client may submit another job: KD_OK, KD_EBUSY or KD_EDEVICE. *quota: true if the limit that was
 * reached is the client's own limit of waiting jobs or of device time. Must be called by the thread that submits
 * pictures. */
enum kd_status kd_render_queue_admit(struct kd_render_queue *queue, const char *client, bool *quota,
                                     struct kd_error *error);
void kd_render_queue_push(struct kd_render_queue *queue, struct kd_render_job *job);
/* Encodes the frame of a finished job, job->frame, in another format. Any thread. */
void kd_render_queue_encode(struct kd_render_queue *queue, struct kd_render_job *job);

/* Cancels jobs whose clients have disconnected. Any thread. */
void kd_render_queue_sweep(struct kd_render_queue *queue);
/* Cancels all jobs. Running jobs end as soon as they can be interrupted. Any thread. */
void kd_render_queue_cancel(struct kd_render_queue *queue);

#endif

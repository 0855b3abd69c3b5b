/* Live sessions. A session has a scene that its owner changes, the newest frame of that scene, and viewers.
 *
 * A frame is rendered only while a viewer waits for a newer one, and only if it would differ from the newest one: the
 * scene has changed, the scene moves by itself, or a finer picture is still to come. One frame is traced while the
 * previous one is encoded, and all viewers share the frames. Any thread; functions on viewers belong to the HTTP
 * thread. */
#ifndef KD_SERVER_SESSION_SESSIONS_H
#define KD_SERVER_SESSION_SESSIONS_H

#include "server/render/live_frame.h"
#include "server/render/queue.h"
#include "scene/dynamic_bodies.h"
#include "scene/timeline.h"
#include "server/http/counts.h"
#include "server/http/once.h"

#include <microhttpd.h>

struct kd_sessions;
struct kd_session;

struct kd_sessions_params {
    struct kd_render_queue *renders;
    unsigned limit;                 /* limit of all sessions */
    unsigned client_limit;          /* limit of the sessions of one client */
    unsigned idle_ms;               /* a session ends after this time without viewers and requests */
    unsigned longest_s;             /* limit of the estimated time of a frame in full quality, in s */
    const struct kd_assets *assets; /* assets that scenes may use */
};
enum kd_status kd_sessions_create(const struct kd_sessions_params *params, struct kd_sessions **out,
                                  struct kd_error *error);
/* Call it after kd_sessions_close, when the render queue has finished, so that no frame is under way. Accepts NULL. */
void kd_sessions_destroy(struct kd_sessions *all);

/* Returns KD_ETOOBIG if a frame of the plan would take too long. */
enum kd_status kd_sessions_takes(const struct kd_sessions *all, const struct kd_plan *plan, struct kd_error *error);

/* Limits of the quality reduction while a session moves. The width of a frame is at least `min_scale` times the
 * requested width. An exception is a frame that would then take longer than max_frame_ms (kd_governor_least). */
struct kd_session_pace { double min_scale, max_frame_ms; };
#define KD_SESSION_PACE_DEFAULT { 0.25, INFINITY }

/* Opens a session of a valid scene with its plan. Its frames count towards the client's share. The caller gets a
 * reference. crowded: the session also shows bodies of a playground; it then waits for kd_session_show before it
 * renders a frame. pace: see kd_session_keep; NULL: the default. Returns KD_EBUSY at a limit; *quota is true if it
 * is the limit of one client. */
enum kd_status kd_sessions_open(struct kd_sessions *all, const struct kd_scene *scene, const struct kd_plan *plan,
                                const char *client, bool crowded, const struct kd_session_pace *pace, bool *quota,
                                struct kd_session **out, struct kd_error *error);
/* Shows these bodies of a playground from now on. Their time is added to the scene's time. Takes over the reference.
 * Does not change the revision. */
void kd_session_show(struct kd_session *session, struct kd_dynamic_bodies *dynamic);
/* Sets the limits of the quality reduction. */
void kd_session_keep(struct kd_session *session, const struct kd_session_pace *pace);
/* Replaces the scene. kd_sessions_takes must have accepted the plan before. */
void kd_session_put(struct kd_session *session, const struct kd_scene *scene, const struct kd_plan *plan);
bool kd_session_watched(struct kd_session *session);     /* true if a viewer waits or reads a stream */
unsigned kd_session_viewers(struct kd_session *session); /* number of viewers that wait or read a stream */
/* true if a frame has shown the latest bodies; kd_session_show then accepts new ones */
bool kd_session_hungry(struct kd_session *session);
bool kd_session_over(struct kd_session *session); /* true if the session has ended or failed, and so publishes no
                                                   * more frames */
/* Continues the frame numbers of another session. Call it before the session has published a frame. */
void kd_session_go_on_from(struct kd_session *session, struct kd_session *other);
struct kd_session *kd_session_share(struct kd_session *session); /* adds a reference */
/* Returns a reference to the session of this id, or NULL. The session's idle time starts again. */
struct kd_session *kd_sessions_find(struct kd_sessions *all, const char *id);
void kd_session_release(struct kd_session *session);
/* Idempotency-Key of a session: kd_session_promise stores it, kd_sessions_find_once finds a session by it ("" finds
 * none), kd_session_once reads it. HTTP thread. */
void kd_session_promise(struct kd_session *session, const struct kd_once *once);
struct kd_session *kd_sessions_find_once(struct kd_sessions *all, const char *key);
const struct kd_once *kd_session_once(const struct kd_session *session);

const char *kd_session_id(const struct kd_session *session);
/* The possible values of "varies" (session/routes.c); NULL beyond the last. */
const char *kd_session_varies_word(size_t index);
const char *kd_session_token(const struct kd_session *session);
/* compares in constant time; token may be NULL */
bool kd_session_owned(const struct kd_session *session, const char *token);

/* State of a session. `scene` is the present scene, including its own motion. */
struct kd_session_state {
    struct kd_scene scene;
    unsigned revision, viewers;
    uint64_t frame;           /* number of the newest frame; 0: none yet */
    uint64_t order;           /* order of the latest patch that had an order; 0: no patch had one */
    double path_at, path_end; /* seconds since the path began, and length of the path; both 0: there is no path */
    struct kd_session_progress {
        /* true: the frame being made refines a scene at rest; false: it is the first frame of the present scene */
        bool refines;
        /* fraction of that frame that is done, and estimated time left in s; NAN: no frame is being made, or the
         * value is not known */
        double fraction, left_s;
    } progress;
};
void kd_session_state(struct kd_session *session, struct kd_session_state *out);
/* Changes the scene by `edit`, whose argument is `to`. On failure nothing changes. order: of changes that are sent
 * at the same time, the one with the highest order takes effect. A change whose order is lower than that of an
 * earlier change is ignored, and the result is KD_OK. 0 means no order: the change is always made. */
typedef enum kd_status kd_scene_edit(struct kd_scene *scene, const void *to, struct kd_error *error);
enum kd_status kd_session_edit(struct kd_session *session, kd_scene_edit *edit, const void *to, uint64_t order,
                               struct kd_session_state *out, struct kd_error *error);
#define KD_SESSION_PATH_S 3600 /* limit of the length of a path, in s */
/* Makes the session follow a path that path.c has checked, and takes over the path. A patch or kd_session_stop ends
 * the path. The scene then keeps its state of that moment. */
enum kd_status kd_session_follow(struct kd_session *session, struct kd_timeline *path, struct kd_session_state *out,
                                 struct kd_error *error);
enum kd_status kd_session_stop(struct kd_session *session, struct kd_error *error);
/* Ends the session and notifies its viewers. */
void kd_session_end(struct kd_session *session);

/* A viewer of a session: a suspended request or a stream. */
struct kd_viewer {
    struct kd_session *session; /* a counted reference */
    struct MHD_Connection *mhd;
    int socket;
    uint64_t seen; /* number of the newest frame that the viewer has received */
    bool any;      /* the viewer reads only the descriptions of frames, so any encoding suffices */
    /* qualities of lossy frames that the viewer accepts, 1 to 100; 0: lossless only. last_lossy is for the last
     * frame, `lossy` for all other frames */
    unsigned lossy, last_lossy;
    const struct kd_live_file *file; /* the frame's file in the encoding of this viewer; the frame owns the file */
    /* A frame whose encoding was finished only after a newer frame had replaced it; a counted reference. */
    struct kd_live_frame *owed;
    unsigned patched; /* if this request is a patch: the revision that it has made; otherwise 0 */
    /* Hash of the approximations that the client already has, so that they are not sent again. A value above 32
     * bits: the client has none. */
    uint64_t sentences;
    double begun_ms, deadline_ms; /* begun_ms: start of waiting; deadline_ms: end of waiting; both on kd_clock_ms.
                                   * INFINITY: no end */
    bool waiting;                 /* the request's connection is suspended */
    /* why the connection was resumed. late: the deadline has passed; gone: the client has disconnected */
    bool late, gone;
    struct kd_viewer *previous, *next;
};
/* Takes over the reference in viewer->session. */
void kd_viewer_attach(struct kd_viewer *viewer);
void kd_viewer_detach(struct kd_viewer *viewer);
enum kd_viewer_news {
    /* there is a frame newer than viewer->seen; *frame is a reference to it, and viewer->file is set */
    KD_VIEWER_FRAME,
    KD_VIEWER_OVER,  /* no frame will follow: the session has ended, or has failed for the reason in *error */
    KD_VIEWER_GONE,  /* the client has disconnected */
    KD_VIEWER_LATE,  /* the deadline has passed; the caller may set another */
    KD_VIEWER_LATER, /* the connection is suspended, and will be resumed for one of the other results */
};
/* Returns the viewer's news. After KD_VIEWER_LATER, the session owns the viewer until the connection is resumed.
 * error may be NULL. */
enum kd_viewer_news kd_viewer_next(struct kd_viewer *viewer, struct kd_live_frame **frame, struct kd_error *error);

/* Handles deadlines, disconnected clients, idle sessions, and refinements that are due. One thread calls it ten times a
 * second. */
void kd_sessions_sweep(struct kd_sessions *all);
/* Refuses new sessions, and notifies all viewers that their session has ended. Frames that are being rendered are
 * finished. */
void kd_sessions_close(struct kd_sessions *all);
struct kd_sessions_counts;
/* Reads the counts. Returns false if the lock does not become free soon. */
bool kd_sessions_counts(struct kd_sessions *all, struct kd_sessions_counts *out);

struct kd_request;
struct kd_particles_job;
/* Finds the session that the path names. Returns a counted reference, or NULL with *refused. In routes.c. */
struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused);
/* kd_session_answer answers with the session's state. If the request has a task, the answer includes the task's
 * time. kd_session_forbid refuses a request without the session's token. In routes.c. */
enum MHD_Result kd_session_answer(struct kd_request *request, const struct kd_session *session,
                                  const struct kd_session_state *state);
enum MHD_Result kd_session_forbid(struct kd_request *request);
void kd_particles_job_destroy(struct kd_particles_job *job); /* particles.c; accepts NULL */
void kd_live_abandon(struct kd_request *request);            /* live.c: stops waiting for a frame */
/* kd_live_newest answers with the newest frame of the session that `find` returns. kd_live_frames answers with a
 * stream of all frames of that session. find: kd_session_of or a function like it. kinds: lossy encodings are
 * available, and the request may be a patch (routes.c). */
typedef struct kd_session *kd_session_find_fn(struct kd_request *request, enum MHD_Result *refused);
enum MHD_Result kd_live_newest(struct kd_request *request, kd_session_find_fn *find, bool kinds);
/* Applies the request as a patch to the session. Returns false with *refused. In routes.c. */
bool kd_session_change(struct kd_request *request, struct kd_session *session, struct kd_session_state *state,
                       enum MHD_Result *refused);
enum MHD_Result kd_live_frames(struct kd_request *request, kd_session_find_fn *find);

#endif

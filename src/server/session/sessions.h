/* Live sessions. A session consists of a scene that its owner changes, the newest frame of that scene, and viewers.
 * A frame is rendered only if a viewer waits for a newer frame, and if it would differ from the newest one. It
 * differs if the scene has changed, if the scene moves by itself, or if a finer picture is possible. One frame is
 * traced while the previous one is encoded, and all viewers share the frames. Any thread; functions on viewers
 * belong to the HTTP thread. */
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
    unsigned limit;                 /* maximum number of sessions of all clients together */
    unsigned client_limit;          /* maximum number of sessions of one client */
    unsigned idle_ms;               /* milliseconds without viewers and requests after which a session ends */
    unsigned longest_s;             /* maximum estimated time of a frame in full quality, in s */
    const struct kd_assets *assets; /* the assets that scenes may use */
};
enum kd_status kd_sessions_create(const struct kd_sessions_params *params, struct kd_sessions **out,
                                  struct kd_error *error);
/* Call this after kd_sessions_close, when the render queue has finished, so that no frame is in progress. Accepts
 * NULL. */
void kd_sessions_destroy(struct kd_sessions *all);

/* Returns KD_ETOOBIG if a frame of the plan would take too long. */
enum kd_status kd_sessions_takes(const struct kd_sessions *all, const struct kd_plan *plan, struct kd_error *error);

/* Limits of quality reduction while a session moves. The width of a frame is at least `min_scale` times the
 * requested width, unless such a frame would take longer than max_frame_ms (kd_governor_least). */
struct kd_session_pace { double min_scale, max_frame_ms; };
#define KD_SESSION_PACE_DEFAULT { 0.25, INFINITY }

/* Opens a session with a valid scene and its plan. Its frames count towards the client's share. The caller gets a
 * reference. crowded: true if the session also shows the bodies of a playground; it then waits for kd_session_show
 * before it renders a frame. pace: see kd_session_keep; NULL: the default. Returns KD_EBUSY at a limit; *quota is
 * then true if it is the limit of one client. */
enum kd_status kd_sessions_open(struct kd_sessions *all, const struct kd_scene *scene, const struct kd_plan *plan,
                                const char *client, bool crowded, const struct kd_session_pace *pace, bool *quota,
                                struct kd_session **out, struct kd_error *error);
/* From now on, the session shows these bodies of a playground. Their time is added to the scene's time. Takes over
 * the reference. Does not change the revision. */
void kd_session_show(struct kd_session *session, struct kd_dynamic_bodies *dynamic);
/* Sets the limits of quality reduction. */
void kd_session_keep(struct kd_session *session, const struct kd_session_pace *pace);
/* Replaces the scene. The plan must have been accepted by kd_sessions_takes. */
void kd_session_put(struct kd_session *session, const struct kd_scene *scene, const struct kd_plan *plan);
bool kd_session_watched(struct kd_session *session);     /* true if a viewer waits or reads a stream */
unsigned kd_session_viewers(struct kd_session *session); /* number of viewers that wait or read a stream */
/* True if a frame has shown the latest bodies, so that kd_session_show accepts new ones. */
bool kd_session_hungry(struct kd_session *session);
/* true if the session has ended or failed, so that it publishes no more frames */
bool kd_session_over(struct kd_session *session);
/* Continues the frame numbers of another session. Call this before the session has published a frame. */
void kd_session_go_on_from(struct kd_session *session, struct kd_session *other);
struct kd_session *kd_session_share(struct kd_session *session); /* adds a reference */
/* Returns a reference to the session with this id, or NULL. Restarts the session's idle time. */
struct kd_session *kd_sessions_find(struct kd_sessions *all, const char *id);
void kd_session_release(struct kd_session *session);
/* The Idempotency-Key of a session. kd_session_promise stores the key, kd_sessions_find_once finds a session by it
 * (the key "" finds none), and kd_session_once gets it. HTTP thread. */
void kd_session_promise(struct kd_session *session, const struct kd_once *once);
struct kd_session *kd_sessions_find_once(struct kd_sessions *all, const char *key);
const struct kd_once *kd_session_once(const struct kd_session *session);

const char *kd_session_id(const struct kd_session *session);
/* Returns word i of the possible values of "varies" (session/routes.c); NULL beyond the last one. */
const char *kd_session_varies_word(size_t index);
const char *kd_session_token(const struct kd_session *session);
/* Compares in constant time. token may be NULL. */
bool kd_session_owned(const struct kd_session *session, const char *token);

/* State of a session. `scene` is the present scene, including its own motion. */
struct kd_session_state {
    struct kd_scene scene;
    unsigned revision, viewers;
    uint64_t frame; /* number of the newest frame; 0 if there is none yet */
    uint64_t order; /* order of the latest patch that had one; 0 if no patch had one */
    /* seconds since the path began, and length of the path in seconds; both are 0 if there is no path */
    double path_at, path_end;
    struct kd_session_progress {
        /* true if the frame that is being made refines a scene at rest; false if it is the first frame of the
         * present scene */
        bool refines;
        /* of the frame that is being made: fraction that is done, and estimated remaining time in s; NAN if no frame is
         * being made, or if the value is unknown */
        double fraction, left_s;
    } progress;
};
void kd_session_state(struct kd_session *session, struct kd_session_state *out);
/* Changes the scene by calling `edit` with the argument `to`. On failure nothing changes. order: of changes that are
 * sent at the same time, the one with the highest order takes effect. A change with a lower order than an earlier
 * change is ignored, with the result KD_OK. order 0: the change is always made. */
typedef enum kd_status kd_scene_edit(struct kd_scene *scene, const void *to, struct kd_error *error);
enum kd_status kd_session_edit(struct kd_session *session, kd_scene_edit *edit, const void *to, uint64_t order,
                               struct kd_session_state *out, struct kd_error *error);
#define KD_SESSION_PATH_S 3600 /* maximum length of a path, in s */
/* Makes the session follow a path that path.c has checked, and takes over the path. A patch or kd_session_stop ends
 * the path; the scene then stays as it is at that moment. */
enum kd_status kd_session_follow(struct kd_session *session, struct kd_timeline *path, struct kd_session_state *out,
                                 struct kd_error *error);
enum kd_status kd_session_stop(struct kd_session *session, struct kd_error *error);
/* Ends the session, and notifies its viewers. */
void kd_session_end(struct kd_session *session);

/* A viewer of a session: either a suspended request or a stream. */
struct kd_viewer {
    struct kd_session *session; /* a counted reference */
    struct MHD_Connection *mhd;
    int socket;
    uint64_t seen; /* number of the newest frame that the viewer has received */
    bool any;      /* true if the viewer reads only the descriptions of frames, so that any encoding will do */
    /* Qualities of lossy frames that the viewer accepts, 1 to 100; 0: only lossless frames. last_lossy is for the
     * last frame, and `lossy` for all others. */
    unsigned lossy, last_lossy;
    const struct kd_live_file *file; /* the file of the frame in this viewer's encoding; the frame owns it */
    /* A counted reference to a frame whose encoding was finished only after a newer frame had replaced it. */
    struct kd_live_frame *owed;
    unsigned patched; /* the revision that this request has made, if it is a patch; otherwise 0 */
    /* Hash of the approximations that the client already has, so that they are not sent again. A value above 32 bits
     * means that the client has none. */
    uint64_t sentences;
    /* begin and end of the waiting time, on the clock of kd_clock_ms; deadline_ms INFINITY: no end */
    double begun_ms, deadline_ms;
    bool waiting; /* true while the request's connection is suspended */
    /* reasons why the connection was resumed; late: the deadline has passed; gone: the client has disconnected */
    bool late, gone;
    struct kd_viewer *previous, *next;
};
/* Takes over the reference in viewer->session. */
void kd_viewer_attach(struct kd_viewer *viewer);
void kd_viewer_detach(struct kd_viewer *viewer);
enum kd_viewer_news {
    /* there is a frame newer than viewer->seen; *frame is a reference to it, and viewer->file is set */
    KD_VIEWER_FRAME,
    KD_VIEWER_OVER,  /* no frame follows: the session has ended, or has failed for the reason in *error */
    KD_VIEWER_GONE,  /* the client has disconnected */
    KD_VIEWER_LATE,  /* the deadline has passed; the caller may set a new one */
    KD_VIEWER_LATER, /* the connection is suspended, and is resumed as soon as one of the other results applies */
};
/* Returns the news for the viewer. After KD_VIEWER_LATER, the session owns the viewer until the connection is
 * resumed. error may be NULL. */
enum kd_viewer_news kd_viewer_next(struct kd_viewer *viewer, struct kd_live_frame **frame, struct kd_error *error);

/* Handles deadlines, clients that have disconnected, idle sessions, and refinements that are due. Called ten times a
 * second, by one thread. */
void kd_sessions_sweep(struct kd_sessions *all);
/* Refuses new sessions, and notifies all viewers that their session has ended. Frames in progress are finished. */
void kd_sessions_close(struct kd_sessions *all);
struct kd_sessions_counts;
/* Reads the counts. Returns false if the lock is not free soon. */
bool kd_sessions_counts(struct kd_sessions *all, struct kd_sessions_counts *out);

struct kd_request;
struct kd_particles_job;
/* routes.c: finds the session that the path names. Returns a counted reference, or NULL with *refused. */
struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused);
/* routes.c: kd_session_answer answers with the state of the session, and with the task's time if the request has a
 * task. kd_session_forbid refuses a request that lacks the session's token. */
enum MHD_Result kd_session_answer(struct kd_request *request, const struct kd_session *session,
                                  const struct kd_session_state *state);
enum MHD_Result kd_session_forbid(struct kd_request *request);
void kd_particles_job_destroy(struct kd_particles_job *job); /* particles.c; accepts NULL */
void kd_live_abandon(struct kd_request *request);            /* live.c: stops waiting for a frame */
/* kd_live_newest answers with the newest frame of a session, and kd_live_frames with a stream of all its frames.
 * find: returns the session; kd_session_of, or a similar function. kinds: true if lossy encodings are available and
 * the request may be a patch (routes.c). */
typedef struct kd_session *kd_session_find_fn(struct kd_request *request, enum MHD_Result *refused);
enum MHD_Result kd_live_newest(struct kd_request *request, kd_session_find_fn *find, bool kinds);
/* routes.c: applies the request to the session as a patch. Returns false with *refused. */
bool kd_session_change(struct kd_request *request, struct kd_session *session, struct kd_session_state *state,
                       enum MHD_Result *refused);
enum MHD_Result kd_live_frames(struct kd_request *request, kd_session_find_fn *find);

#endif

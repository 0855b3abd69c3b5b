/* Live sessions. A session has a scene that its owner changes, the newest frame of it, and viewers.
 *
 * A session is rendered only while a viewer waits for a newer frame, and only if that would differ: the scene has
 * changed, it moves by itself, or a finer picture of it is still to come. One frame is traced while the previous one
 * is encoded, and all viewers share it. Any thread; functions on viewers belong to the HTTP thread. */
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
    unsigned limit;                 /* sessions in all */
    unsigned client_limit;          /* sessions of one client */
    unsigned idle_ms;               /* a session without viewers and requests for this long ends */
    unsigned longest_s;             /* longest full-quality frame, by its plan, in s */
    const struct kd_assets *assets; /* assets that scenes may use */
};
enum kd_status kd_sessions_create(const struct kd_sessions_params *params, struct kd_sessions **out,
                                  struct kd_error *error);
/* Call it after kd_sessions_close and when the render queue has finished, so that no frame is under way. Accepts
 * NULL. */
void kd_sessions_destroy(struct kd_sessions *all);

/* Returns KD_ETOOBIG if a frame of the plan would take too long. */
enum kd_status kd_sessions_takes(const struct kd_sessions *all, const struct kd_plan *plan, struct kd_error *error);

/* Limits of the quality reduction while a session moves: frames have at least the part `least` of the requested width,
 * unless a frame then takes longer than patience_ms (kd_governor_least). */
struct kd_session_pace { double least, patience_ms; };
#define KD_SESSION_PACE_DEFAULT { 0.25, INFINITY }

/* Opens a session of a valid scene with its plan; its frames count toward the client's share. The caller gets a
 * reference. crowded: it also shows a crowd, and no frame before kd_session_show. pace: as in kd_session_keep; NULL:
 * the default. Returns KD_EBUSY at a limit; *quota: it is the limit of one client. */
enum kd_status kd_sessions_open(struct kd_sessions *all, const struct kd_scene *scene, const struct kd_plan *plan,
                                const char *client, bool crowded, const struct kd_session_pace *pace, bool *quota,
                                struct kd_session **out, struct kd_error *error);
/* Shows this crowd from now on; the crowd's time is added to the scene's. Takes over the reference. Does not change the
 * revision. */
void kd_session_show(struct kd_session *session, struct kd_dynamic_bodies *crowd);
/* Sets the limits of the quality reduction. */
void kd_session_keep(struct kd_session *session, const struct kd_session_pace *pace);
/* Replaces the scene. The plan has passed kd_sessions_takes. */
void kd_session_put(struct kd_session *session, const struct kd_scene *scene, const struct kd_plan *plan);
bool kd_session_watched(struct kd_session *session);     /* a viewer waits or reads a stream */
unsigned kd_session_viewers(struct kd_session *session); /* number of those viewers */
/* a frame has used the latest crowd, so a new one can be shown */
bool kd_session_hungry(struct kd_session *session);
bool kd_session_over(struct kd_session *session); /* ended or failed: it publishes no more frames */
/* Continues the frame numbers of another session. The session has published no frame yet. */
void kd_session_go_on_from(struct kd_session *session, struct kd_session *other);
struct kd_session *kd_session_share(struct kd_session *session); /* adds a reference */
/* Returns a reference to the session of this id, or NULL. The session's idle time starts again. */
struct kd_session *kd_sessions_find(struct kd_sessions *all, const char *id);
void kd_session_release(struct kd_session *session);
/* Idempotency-Key of a session: store it, find a session by it, read it. HTTP thread. "" finds none. */
void kd_session_promise(struct kd_session *session, const struct kd_once *once);
struct kd_session *kd_sessions_find_once(struct kd_sessions *all, const char *key);
const struct kd_once *kd_session_once(const struct kd_session *session);

const char *kd_session_id(const struct kd_session *session);
/* The values of "varies" (session/routes.c); NULL beyond the last. */
const char *kd_session_varies_word(size_t index);
const char *kd_session_token(const struct kd_session *session);
/* compares in constant time; token may be NULL */
bool kd_session_owned(const struct kd_session *session, const char *token);

/* State of a session. The scene is the present one, its own motion included. */
struct kd_session_state {
    struct kd_scene scene;
    unsigned revision, viewers;
    uint64_t frame;           /* number of the newest frame; 0: none yet */
    uint64_t order;           /* of the latest patch that had an order; 0: none had */
    double path_at, path_end; /* seconds along its path, and the path's length; both 0: no path */
    struct kd_session_progress {
        bool refines; /* the frame being made refines a scene at rest; else it is the first of the present scene */
        /* part that is done, and estimated time left; NAN: no frame is being made, or unknown */
        double fraction, left_s;
    } progress;
};
void kd_session_state(struct kd_session *session, struct kd_session_state *out);
/* Merges a patch (RFC 7396) into the scene. On failure nothing changes. order: of concurrent patches the one with the
 * highest order wins. A patch with a lower order than an earlier one is ignored, which is not a failure. 0: no order;
 * the patch is applied. */
enum kd_status kd_session_patch(struct kd_session *session, const char *text, size_t length, uint64_t order,
                                struct kd_session_state *out, struct kd_error *error);
#define KD_SESSION_PATH_S 3600 /* longest path in s */
/* Makes the session follow a path, which path.c has checked, and takes over the path. A patch or kd_session_stop ends
 * it at the scene reached then. */
enum kd_status kd_session_follow(struct kd_session *session, struct kd_timeline *path, struct kd_session_state *out,
                                 struct kd_error *error);
enum kd_status kd_session_stop(struct kd_session *session, struct kd_error *error);
/* Ends the session and notifies its viewers. */
void kd_session_end(struct kd_session *session);

/* A viewer of a session: a suspended request or a stream. */
struct kd_viewer {
    struct kd_session *session; /* a reference */
    struct MHD_Connection *mhd;
    int socket;
    uint64_t seen;  /* number of the newest frame taken */
    bool any;       /* it reads descriptions of frames only, so any encoding will do */
    unsigned lossy; /* quality of lossy frames that it accepts before the final one, 1 to 100; 0: lossless only */
    const struct kd_live_file *file; /* the frame's file in this viewer's encoding; owned by the frame */
    /* a frame whose encoding was finished after it was replaced by a newer one; a reference */
    struct kd_live_frame *owed;
    unsigned patched; /* revision that this request has made by a patch; 0: none */
    /* hash of the approximations that the client knows, so that they are not sent again; above 32 bits: none */
    uint64_t sentences;
    double begun_ms, deadline_ms; /* on kd_clock_ms: start; end of waiting, INFINITY: none */
    bool waiting;                 /* suspended */
    bool late, gone;              /* why it was resumed: the deadline has passed; the client has disconnected */
    struct kd_viewer *previous, *next;
};
/* Takes over the reference in viewer->session. */
void kd_viewer_attach(struct kd_viewer *viewer);
void kd_viewer_detach(struct kd_viewer *viewer);
enum kd_viewer_news {
    KD_VIEWER_FRAME, /* *frame (a reference) is newer than viewer->seen; viewer->file is set */
    KD_VIEWER_OVER,  /* no frame will follow: the session has ended, or *error says why */
    KD_VIEWER_GONE,  /* the client has disconnected */
    KD_VIEWER_LATE,  /* the deadline has passed; the caller may set another */
    KD_VIEWER_LATER, /* the connection is suspended, and will be resumed for one of the others */
};
/* Returns the viewer's news. After KD_VIEWER_LATER the viewer belongs to the session until the connection is resumed.
 * error may be NULL. */
enum kd_viewer_news kd_viewer_next(struct kd_viewer *viewer, struct kd_live_frame **frame, struct kd_error *error);

/* Handles deadlines, disconnected clients, idle sessions and refinements that are due. One thread calls it ten times a
 * second. */
void kd_sessions_sweep(struct kd_sessions *all);
/* Refuses new sessions and notifies all viewers of the end. Frames being rendered finish. */
void kd_sessions_close(struct kd_sessions *all);
struct kd_sessions_counts;
/* Reads the counts. Returns false if the lock is not free soon. */
bool kd_sessions_counts(struct kd_sessions *all, struct kd_sessions_counts *out);

struct kd_request;
struct kd_particles_job;
/* Finds the session that the path names: a reference, or NULL with *refused. routes.c */
struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused);
/* Answer with the state and the time of the request's task; and refuse a request without the session's token.
 * routes.c */
enum MHD_Result kd_session_answer(struct kd_request *request, const struct kd_session *session,
                                  const struct kd_session_state *state);
enum MHD_Result kd_session_forbid(struct kd_request *request);
void kd_particles_job_destroy(struct kd_particles_job *job); /* particles.c; accepts NULL */
void kd_live_abandon(struct kd_request *request);            /* live.c: stops waiting for a frame */
/* Answer with the newest frame, and with a stream of all frames, of the session that `find` returns (kd_session_of or a
 * function like it). kinds: lossy encodings are available, and the request may be a patch (routes.c). */
typedef struct kd_session *kd_session_find_fn(struct kd_request *request, enum MHD_Result *refused);
enum MHD_Result kd_live_newest(struct kd_request *request, kd_session_find_fn *find, bool kinds);
/* Patches the session by the request. Returns false with *refused. routes.c */
bool kd_session_change(struct kd_request *request, struct kd_session *session, struct kd_session_state *state,
                       enum MHD_Result *refused);
enum MHD_Result kd_live_frames(struct kd_request *request, kd_session_find_fn *find);

#endif

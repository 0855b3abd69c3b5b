/* Live sessions. A session has a scene that its owner changes, the newest frame of it, and viewers.
 *
 * A session is rendered only while a viewer waits for a newer frame, and only if that would differ: the scene has
 * changed, it moves by itself, or a finer picture of it is still to come. One frame is traced while the previous one
 * is encoded, and all viewers share it. Any thread; functions on viewers belong to the HTTP thread. */
#ifndef KD_SERVER_SESSION_SESSIONS_H
#define KD_SERVER_SESSION_SESSIONS_H

#include "server/render/live_frame.h"
#include "server/render/queue.h"
#include "scene/crowd.h"
#include "scene/timeline.h"
#include "server/http/counts.h"
#include "server/http/once.h"

#include <microhttpd.h>

struct kd_sessions;
struct kd_session;

struct kd_sessions_params {
    struct kd_render_queue *renders;
    unsigned limit;                 /* sessions at once, */
    unsigned client_limit;          /* and those of one client */
    unsigned idle_ms;               /* without anybody watching or asking, after which a session ends */
    unsigned longest_s;             /* a frame as asked may take, by its plan */
    const struct kd_assets *assets; /* that scenes may name */
};
enum kd_status kd_sessions_create(const struct kd_sessions_params *params, struct kd_sessions **out,
                                  struct kd_error *error);
/* To be called after kd_sessions_close, and when the render queue has finished: nothing may be under way. Accepts
 * NULL. */
void kd_sessions_destroy(struct kd_sessions *all);

/* Fails with KD_ETOOBIG where a frame of the plan would take too long. */
enum kd_status kd_sessions_takes(const struct kd_sessions *all, const struct kd_plan *plan, struct kd_error *error);

/* While it moves, frames of a session keep this part of the asked width, unless they take longer than patience_ms:
 * kd_governor_least. */
struct kd_session_pace { double least, patience_ms; };
#define KD_SESSION_PACE_DEFAULT { 0.25, INFINITY }

/* Opens a session of a valid scene with its plan; its frames are counted in the client's share. The caller holds a
 * reference. crowded: it shows a crowd besides its scene, and nothing before kd_session_show. pace: as
 * kd_session_keep; NULL: the default. KD_EBUSY: there are as many sessions as may be, or with *quota as many of this
 * client. */
enum kd_status kd_sessions_open(struct kd_sessions *all, const struct kd_scene *scene, const struct kd_plan *plan,
                                const char *client, bool crowded, const struct kd_session_pace *pace, bool *quota,
                                struct kd_session **out, struct kd_error *error);
/* Shows this crowd from now on, at its time after the scene's; takes over the reference. The revision stays what it
 * is. */
void kd_session_show(struct kd_session *session, struct kd_crowd *crowd);
/* Its frames keep to this from now on. */
void kd_session_keep(struct kd_session *session, const struct kd_session_pace *pace);
/* Puts a scene in the place of the present one; its plan is one that kd_sessions_takes. */
void kd_session_put(struct kd_session *session, const struct kd_scene *scene, const struct kd_plan *plan);
bool kd_session_watched(struct kd_session *session);     /* somebody waits, or reads a stream */
unsigned kd_session_viewers(struct kd_session *session); /* how many do */
bool kd_session_hungry(struct kd_session *session);      /* a frame has taken the crowd that was shown last */
bool kd_session_over(struct kd_session *session);        /* or failed: it shows nothing more */
/* The frames of a session that has shown none are numbered behind those of the other. */
void kd_session_go_on_from(struct kd_session *session, struct kd_session *other);
struct kd_session *kd_session_share(struct kd_session *session); /* another reference */
/* Finds the session of this id: a reference, or NULL. The session counts as asked for. */
struct kd_session *kd_sessions_find(struct kd_sessions *all, const char *id);
void kd_session_release(struct kd_session *session);
/* By what it was asked for, which the HTTP thread says and asks. "" finds none. */
void kd_session_promise(struct kd_session *session, const struct kd_once *once);
struct kd_session *kd_sessions_find_once(struct kd_sessions *all, const char *key);
const struct kd_once *kd_session_once(const struct kd_session *session);

const char *kd_session_id(const struct kd_session *session);
/* The words of "varies" (session/routes.c); NULL behind the last. */
const char *kd_session_varies_word(size_t index);
const char *kd_session_token(const struct kd_session *session);
bool kd_session_owned(const struct kd_session *session, const char *token); /* in constant time; token may be NULL */

/* The state holds the scene as it is now, what goes on by itself included. */
struct kd_session_state {
    struct kd_scene scene;
    unsigned revision, viewers;
    uint64_t frame;           /* the newest one's number, 0: none yet */
    uint64_t order;           /* of the latest patch that had one, 0: none had */
    double path_at, path_end; /* seconds along its path; both 0: it has none */
    struct kd_session_progress {
        bool refines; /* the picture that is being made is a finer one of what rests, else the first one of the scene as
                         it is */
        double fraction, left_s; /* the part of it that is done, and how long the rest takes, estimated; NAN: none is
                                    being made, or not known yet */
    } progress;
};
void kd_session_state(struct kd_session *session, struct kd_session_state *out);
/* Merges a patch (RFC 7396) into the scene. On failure nothing changes. order: of patches that are under way at once
 * the one with the highest number counts; one with a lower number than a patch before it had comes too late, changes
 * nothing, and is no failure. 0: it has none, and counts. */
enum kd_status kd_session_patch(struct kd_session *session, const char *text, size_t length, uint64_t order,
                                struct kd_session_state *out, struct kd_error *error);
#define KD_SESSION_PATH_S 3600 /* a path may take so long */
/* Lets the session go along a path from now on, which somebody has looked along (path.c), and takes it over. A patch
 * ends it where it is then, and so does kd_session_stop. */
enum kd_status kd_session_follow(struct kd_session *session, struct kd_timeline *path, struct kd_session_state *out,
                                 struct kd_error *error);
enum kd_status kd_session_stop(struct kd_session *session, struct kd_error *error);
/* Ends the session, and tells all who watch. */
void kd_session_end(struct kd_session *session);

/* A viewer watches a session: a suspended request or a stream. */
struct kd_viewer {
    struct kd_session *session; /* a reference */
    struct MHD_Connection *mhd;
    int socket;
    uint64_t seen;  /* number of the newest frame taken */
    bool any;       /* it reads what is said of frames: their files are nothing to it */
    unsigned lossy; /* the quality at which it takes frames that are not the last, 1 to 100; 0: it takes what is exact
                       alone */
    const struct kd_live_file *file; /* of the frame taken, as it is for this viewer; the frame's */
    struct kd_live_frame *owed;      /* one that was ready in its kind when it was the latest no more; held */
    unsigned patched;                /* the revision that the request itself made; 0: none */
    uint64_t sentences; /* the hash of the approximations that it has, so that a frame with the same ones does without;
                           more than 32 bits: none */
    double begun_ms, deadline_ms; /* on kd_clock_ms: when it came; of waiting, INFINITY: none */
    bool waiting;                 /* suspended */
    bool late, gone;              /* woken because the deadline has passed; because the client has hung up */
    struct kd_viewer *previous, *next;
};
/* Takes over the reference in viewer->session. */
void kd_viewer_attach(struct kd_viewer *viewer);
void kd_viewer_detach(struct kd_viewer *viewer);
enum kd_viewer_news {
    KD_VIEWER_FRAME, /* *frame, a reference: the newest, newer than viewer->seen, and viewer->file */
    KD_VIEWER_OVER,  /* none will come: the session has ended, or *error says why */
    KD_VIEWER_GONE,  /* the client has hung up */
    KD_VIEWER_LATE,  /* the deadline has passed, which the caller may set anew */
    KD_VIEWER_LATER, /* the connection has been suspended, and is resumed for one of these */
};
/* After KD_VIEWER_LATER the viewer is the session's until the connection is resumed. error may be NULL. */
enum kd_viewer_news kd_viewer_next(struct kd_viewer *viewer, struct kd_live_frame **frame, struct kd_error *error);

/* Looks after deadlines, clients that have gone, idle sessions and refinement that is due. One thread calls it, ten
 * times a second. */
void kd_sessions_sweep(struct kd_sessions *all);
/* Takes no more sessions, and tells all viewers that it is over. What is being rendered finishes. */
void kd_sessions_close(struct kd_sessions *all);
struct kd_sessions_counts;
/* Counts sessions and frames; false, with nothing known, where that takes more than a moment. */
bool kd_sessions_counts(struct kd_sessions *all, struct kd_sessions_counts *out);

struct kd_request;
struct kd_particles_job;
/* Finds the session that the path names: a reference, or NULL after a refusal. routes.c */
struct kd_session *kd_session_of(struct kd_request *request, enum MHD_Result *refused);
/* Answers with the state, and what a task of the request took; refuses who has not its token. routes.c */
enum MHD_Result kd_session_answer(struct kd_request *request, const struct kd_session *session,
                                  const struct kd_session_state *state);
enum MHD_Result kd_session_forbid(struct kd_request *request);
void kd_particles_job_destroy(struct kd_particles_job *job); /* particles.c; accepts NULL */
void kd_live_abandon(struct kd_request *request);            /* live.c: nobody waits for a frame any more */
/* Answer with the newest frame, and with all of them, of the session that `find` gives, as kd_session_of does.
 * kinds: it may be asked for in a kind that is not exact, and the request may be a patch: routes.c. */
typedef struct kd_session *kd_session_find_fn(struct kd_request *request, enum MHD_Result *refused);
enum MHD_Result kd_live_newest(struct kd_request *request, kd_session_find_fn *find, bool kinds);
/* Patches the session as the request says; false: *refused is the answer. routes.c */
bool kd_session_change(struct kd_request *request, struct kd_session *session, struct kd_session_state *state,
                       enum MHD_Result *refused);
enum MHD_Result kd_live_frames(struct kd_request *request, kd_session_find_fn *find);

#endif

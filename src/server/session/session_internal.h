/* Internals of sessions, shared by sessions.c, run.c and watch.c. */
#ifndef KD_SERVER_SESSION_INTERNAL_H
#define KD_SERVER_SESSION_INTERNAL_H

#include "render/live/governor.h"
#include "server/http/secret.h"
#include "server/session/budget.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_session_frame; /* a frame in the render queue */
/* Progress of the frame that is being made; in run.c. */
struct kd_session_progress kd_session_progress_of(const struct kd_session *session, double now);

struct kd_session {
    struct kd_sessions *all;
    unsigned references;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    struct kd_once once;     /* hashes of the request that created the session */
    struct kd_scene scene;   /* the session's scene at the time since_ms */
    struct kd_timeline path; /* path that the session has followed since since_ms; without keyframes: no path */
    struct kd_scene on_path; /* the latest scene on the path that was valid */
    struct kd_dynamic_bodies *dynamic; /* bodies of a playground that are shown in the scene; NULL: none, or none yet */
    /* crowded: the session shows bodies of a playground; dynamic_moved: the bodies differ from those in the latest
     * frame */
    bool crowded, dynamic_moved;
    double since_ms, used_ms;
    char lens_key[65]; /* key of the full scene, that is before its quality is reduced */
    struct kd_governor governor;
    struct kd_budget_entry demand; /* the session's entry in the budget, while the session is listed */
    unsigned revision;             /* revision of the scene */
    double patched_ms;             /* time of the last patch; if there was none, time of the creation */
    uint64_t order;                /* order of the latest patch that had an order */
    uint64_t begun;                /* number of frames begun */
    bool moved;                    /* in the latest frame some part of the scene moved by itself */
    bool flew;                     /* in the latest frame the camera moved by itself as well */
    bool listed;
    struct kd_session_frame *rendering; /* frame that is not rendered yet */
    unsigned encoding;
    bool adding; /* true: the latest frame is being encoded in a further format */
    struct kd_live_frame *latest;
    /* exposed_ms: time at which the latest frame was rendered; exposure: exposure of that frame, in stops */
    double exposed_ms, exposure;
    unsigned exposed_revision; /* revision of the scene in that frame; 0: there is no such frame */
    /* shown_ms: time at which the latest frame was published; interval_ms: smoothed interval between frames */
    double shown_ms, interval_ms;
    enum kd_status failed; /* status of the latest render, with `error` as its error; cleared by a patch */
    struct kd_error error;
    struct kd_viewer *viewers;
    struct kd_session *next;
};

struct kd_sessions {
    struct kd_sessions_params params;
    pthread_mutex_t lock;
    struct kd_session *first;
    struct kd_budget budget; /* shares of the device's time that moving sessions can rely on */
    unsigned count;
    uint64_t frames, bytes; /* totals of published frames */
    bool closed;
    double looked_ms;
};

/* Callers of the functions below hold all->lock unless a comment says otherwise. */

void kd_session_unref(struct kd_session *session); /* drops a reference */
void kd_session_unlist(struct kd_session *session);
/* Computes the scene at a time, with its own motion or on its path. Fails if the scene there is not valid. */
enum kd_status kd_session_scene(const struct kd_session *session, double now, struct kd_scene *out,
                                struct kd_error *error);
/* true if the session follows a path that has not ended */
bool kd_session_on_its_way(const struct kd_session *session, double now);

/* Begins a frame if a viewer waits, the picture would differ, and the queue has room. In run.c. */
void kd_session_pump(struct kd_session *session);
/* Sets the expected cost of frames to the cost in the plan. This value is used until a frame has been measured. */
void kd_session_expect(struct kd_session *session, const struct kd_plan_cost *cost);
/* Passes a scene to the governor, with the bodies of a playground that are shown in it. Called with the lock. */
void kd_session_govern(struct kd_session *session, double now, const struct kd_scene *scene, bool lens);
/* Cancels the frame that is being rendered if it is a refinement, because a refinement takes long and is now
 * obsolete. */
void kd_session_drop_refinement(struct kd_session *session);
void kd_session_drop(struct kd_session *session); /* cancels the frame that is being rendered, if any */

/* True if a viewer waits. Also true before the first frame, which is made before anybody requests it. In watch.c. */
bool kd_session_awaited(const struct kd_session *session);
void kd_session_wake(struct kd_session *session); /* resumes viewers that have news */

/* The functions below are in kinds.c and deal with encodings of a frame. The next function chooses the first
 * encoding of the frame, from the encodings that the waiting viewers accept. */
void kd_session_choose_kind(const struct kd_session *session, bool last, struct kd_render_job *job);
/* Returns the frame's file in the encoding that the viewer wants; NULL: it is not encoded yet. */
const struct kd_live_file *kd_session_file(const struct kd_viewer *viewer, const struct kd_live_frame *frame);
/* Frees the pixels of the latest frame if nobody has requested another encoding of it lately. */
void kd_session_forget_pixels(struct kd_session *session, double now);
/* Starts encodings of the latest frame that are missing and that viewers wait for. */
void kd_session_add_kinds(struct kd_session *session);

#endif

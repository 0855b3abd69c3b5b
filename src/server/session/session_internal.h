/* Internals of sessions, shared by the files of this folder. */
#ifndef KD_SERVER_SESSION_INTERNAL_H
#define KD_SERVER_SESSION_INTERNAL_H

#include "render/live/governor.h"
#include "server/http/secret.h"
#include "server/session/budget.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_session_frame; /* a frame that is in the render queue */
/* run.c: the progress of the frame that is being made. */
struct kd_session_progress kd_session_progress_of(const struct kd_session *session, double now);

struct kd_session {
    struct kd_sessions *all;
    unsigned references;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    struct kd_once once;   /* hashes of the request that created the session */
    struct kd_scene scene; /* the scene at the time since_ms */
    /* the path that the session has followed since the time since_ms; it has no keyframes if there is no path */
    struct kd_timeline path;
    struct kd_scene on_path;           /* the latest valid scene on the path */
    struct kd_dynamic_bodies *dynamic; /* the playground's bodies in the scene; NULL if there are none, or none yet */
    /* crowded: true if the session shows the bodies of a playground; dynamic_moved: true if the bodies differ from
     * those in the latest frame */
    bool crowded, dynamic_moved;
    double since_ms, used_ms;
    char lens_key[65]; /* key of the full scene, before its quality is reduced */
    struct kd_governor governor;
    struct kd_budget_entry demand; /* entry of the session in the budget, while the session is in the list */
    unsigned revision;             /* revision of the scene */
    double patched_ms;             /* time of the last patch, or of the creation if there was no patch */
    uint64_t order;                /* order of the latest patch that had one */
    uint64_t begun;                /* number of frames that were started */
    bool moved;                    /* true if some part of the scene moved by itself in the latest frame */
    bool flew;                     /* true if the camera also moved by itself in the latest frame */
    bool listed;
    struct kd_session_frame *rendering; /* the frame that is not rendered yet; NULL if there is none */
    unsigned encoding;
    bool adding; /* true while the latest frame is encoded in another format */
    struct kd_live_frame *latest;
    /* exposed_ms: time when the latest frame was rendered; exposure: exposure of that frame in stops */
    double exposed_ms, exposure;
    unsigned exposed_revision; /* revision of the scene in the frame rendered at exposed_ms; 0: none */
    /* shown_ms: time when the latest frame was published; interval_ms: smoothed time between frames */
    double shown_ms, interval_ms;
    enum kd_status failed; /* status of the latest render, with its error in `error`; a patch clears it */
    struct kd_error error;
    struct kd_viewer *viewers;
    struct kd_session *next;
};

struct kd_sessions {
    struct kd_sessions_params params;
    pthread_mutex_t lock;
    struct kd_session *first;
    struct kd_budget budget; /* the shares of the device's time on which moving sessions can rely */
    unsigned count;
    uint64_t frames, bytes; /* totals over all published frames */
    bool closed;
    double looked_ms;
};

/* The functions below must be called with all->lock held, unless their comment says otherwise. */

void kd_session_unref(struct kd_session *session); /* drops a reference */
void kd_session_unlist(struct kd_session *session);
/* Computes the scene at a given time, from its own motion or from its path. Fails if that scene is not valid. */
enum kd_status kd_session_scene(const struct kd_session *session, double now, struct kd_scene *out,
                                struct kd_error *error);
/* True if the session follows a path that has not ended. */
bool kd_session_on_its_way(const struct kd_session *session, double now);

/* run.c: starts a frame if a viewer waits, the picture would differ, and there is room in the queue. */
void kd_session_pump(struct kd_session *session);
/* Sets the expected cost of frames to that of the plan. It is used until a frame was measured. */
void kd_session_expect(struct kd_session *session, const struct kd_plan_cost *cost);
/* Passes a scene to the governor, with the playground's bodies that are shown in it. Called with the lock held. */
void kd_session_govern(struct kd_session *session, double now, const struct kd_scene *scene, bool lens);
/* If a refinement is being rendered, cancels it, because refinements take long and it is now obsolete. */
void kd_session_drop_refinement(struct kd_session *session);
void kd_session_drop(struct kd_session *session); /* cancels the frame that is being rendered, if there is one */

/* watch.c: true if a viewer waits. Also true before the first frame, which is made before anybody requests it. */
bool kd_session_awaited(const struct kd_session *session);
void kd_session_wake(struct kd_session *session); /* resumes the viewers that have news */

/* The functions from here on are in kinds.c, and concern the encodings of a frame. The first function chooses the first
 * encoding of the frame, from those that the waiting viewers accept. */
void kd_session_choose_kind(const struct kd_session *session, bool last, struct kd_render_job *job);
/* Returns the frame's file in the encoding for this viewer; NULL if it is not encoded yet. */
const struct kd_live_file *kd_session_file(const struct kd_viewer *viewer, const struct kd_live_frame *frame);
/* Frees the pixels of the latest frame if nobody has recently requested another encoding. */
void kd_session_forget_pixels(struct kd_session *session, double now);
/* Starts those encodings of the latest frame that viewers wait for and that are missing. */
void kd_session_add_kinds(struct kd_session *session);

#endif

/* Internals of sessions, shared by sessions.c, run.c and watch.c. */
#ifndef KD_SERVER_SESSION_INTERNAL_H
#define KD_SERVER_SESSION_INTERNAL_H

#include "render/live/governor.h"
#include "server/http/secret.h"
#include "server/session/budget.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_session_frame; /* one in the render queue */
/* Progress of the frame being made. run.c */
struct kd_session_progress kd_session_progress_of(const struct kd_session *session, double now);

struct kd_session {
    struct kd_sessions *all;
    unsigned references;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    struct kd_once once;             /* hashes of the request that created it */
    struct kd_scene scene;           /* the scene at the time since_ms */
    struct kd_timeline path;         /* path that it has followed since then, if it has keyframes */
    struct kd_scene on_path;         /* latest valid scene on the path */
    struct kd_dynamic_bodies *crowd; /* bodies of a playground shown in the scene; NULL: none, or none yet */
    /* crowded: it shows a crowd; crowd_moved: the crowd differs from that of the latest frame */
    bool crowded, crowd_moved;
    double since_ms, used_ms;
    char lens_key[65]; /* of the full scene, before quality is reduced */
    struct kd_governor governor;
    struct kd_budget_entry demand; /* in the budget while the session is listed */
    unsigned revision;             /* of the scene */
    double patched_ms;             /* last change by a patch, or creation */
    uint64_t order;                /* of the latest patch that had an order */
    uint64_t begun;                /* number of frames begun */
    bool moved;                    /* the scene of the latest frame was moving by itself */
    bool flew;                     /* and so was its camera */
    bool listed;
    struct kd_session_frame *rendering; /* frame not yet rendered */
    unsigned encoding;
    bool adding; /* encoding a further file of the latest frame */
    struct kd_live_frame *latest;
    double exposed_ms, exposure;  /* when the latest frame was rendered, and its exposure in stops */
    unsigned exposed_revision;    /* revision of that frame; 0: none */
    double shown_ms, interval_ms; /* when the latest frame was published; smoothed interval between frames */
    enum kd_status failed;        /* status of the latest render, with `error`; a patch clears it */
    struct kd_error error;
    struct kd_viewer *viewers;
    struct kd_session *next;
};

struct kd_sessions {
    struct kd_sessions_params params;
    pthread_mutex_t lock;
    struct kd_session *first;
    struct kd_budget budget; /* shares of the device's time among moving sessions */
    unsigned count;
    uint64_t frames, bytes; /* published */
    bool closed;
    double looked_ms;
};

/* Callers hold all->lock unless a comment says otherwise. */

void kd_session_unref(struct kd_session *session); /* drops a reference */
void kd_session_unlist(struct kd_session *session);
/* Computes the scene at a time, with its own motion or its path. Fails where the path's scene is not valid. */
enum kd_status kd_session_scene(const struct kd_session *session, double now, struct kd_scene *out,
                                struct kd_error *error);
bool kd_session_on_its_way(const struct kd_session *session, double now); /* follows a path that has not ended */

/* Begins a frame if a viewer waits, the picture would differ, and the queue has room. run.c */
void kd_session_pump(struct kd_session *session);
/* Sets the expected cost of frames from the plan, until a frame has been measured. */
void kd_session_expect(struct kd_session *session, const struct kd_plan *plan);
/* Cancels the frame being rendered if it is a refinement, which takes long and is obsolete. */
void kd_session_drop_refinement(struct kd_session *session);
void kd_session_drop(struct kd_session *session); /* cancels any frame */

/* Whether a viewer waits. True before the first frame, which is made in advance. watch.c */
bool kd_session_awaited(const struct kd_session *session);
void kd_session_wake(struct kd_session *session); /* resumes viewers that have news */

/* Encodings of a frame; kinds.c. Sets the first encoding, by the waiting viewers. */
void kd_session_choose_kind(const struct kd_session *session, bool last, struct kd_render_job *job);
/* The file of the frame in the viewer's encoding; NULL: not encoded yet. */
const struct kd_live_file *kd_session_file(const struct kd_viewer *viewer, const struct kd_live_frame *frame);
/* Frees the pixels of a frame that nobody has requested in another encoding lately. */
void kd_session_forget_pixels(struct kd_session *session, double now);
/* Starts encodings of the latest frame that waiting viewers lack. */
void kd_session_add_kinds(struct kd_session *session);

#endif

/* Internals of sessions, shared by sessions.c, run.c and watch.c. */
#ifndef KD_SERVER_SESSION_INTERNAL_H
#define KD_SERVER_SESSION_INTERNAL_H

#include "render/live/governor.h"
#include "server/http/secret.h"
#include "server/session/budget.h"
#include "server/session/sessions.h"

#include <pthread.h>

struct kd_session_frame; /* one on its way through the render queue */
/* How far the one is that is being made. run.c */
struct kd_session_progress kd_session_progress_of(const struct kd_session *session, double now);

struct kd_session {
    struct kd_sessions *all;
    unsigned references;
    char id[KD_SECRET_ID], token[KD_SECRET_TOKEN];
    struct kd_once once;       /* what it was asked for by */
    struct kd_scene scene;     /* as at since_ms */
    struct kd_timeline path;   /* what it goes along since then instead, if it has keys; */
    struct kd_scene on_path;   /* the latest valid scene of which */
    struct kd_crowd *crowd;    /* that it shows besides; NULL: none, or none yet */
    bool crowded, crowd_moved; /* it has one; another one than in the latest frame */
    double since_ms, used_ms;
    char lens_key[65]; /* of the scene as asked */
    struct kd_governor governor;
    struct kd_budget_entry demand; /* entered while it is listed */
    unsigned revision;             /* of the scene */
    double patched_ms;             /* when somebody changed it last, or made it */
    uint64_t order;                /* of the latest patch that had one */
    uint64_t begun;                /* frames */
    bool moved;                    /* the scene of the latest one went on by itself, */
    bool flew;                     /* and so did its camera */
    bool listed;
    struct kd_session_frame *rendering; /* before it is encoded */
    unsigned encoding;
    bool adding; /* a file to a frame that is there */
    struct kd_live_frame *latest;
    double exposed_ms, exposure;  /* when the latest was rendered, and the stops that it got; */
    unsigned exposed_revision;    /* 0: none */
    double shown_ms, interval_ms; /* when the latest came; between frames, smoothed */
    enum kd_status failed;        /* the latest render, with `error`; a patch starts anew */
    struct kd_error error;
    struct kd_viewer *viewers;
    struct kd_session *next;
};

struct kd_sessions {
    struct kd_sessions_params params;
    pthread_mutex_t lock;
    struct kd_session *first;
    struct kd_budget budget; /* of the device's time, among those that move */
    unsigned count;
    uint64_t frames, bytes; /* published */
    bool closed;
    double looked_ms;
};

/* Callers hold all->lock where nothing else is said. */

void kd_session_let_go(struct kd_session *session); /* of a reference */
void kd_session_unlist(struct kd_session *session);
/* The scene with what goes on by itself, or along its path, valid. Fails where the path is not. */
enum kd_status kd_session_scene(const struct kd_session *session, double now, struct kd_scene *out,
                                struct kd_error *error);
bool kd_session_on_its_way(const struct kd_session *session, double now); /* along a path that has not ended */

/* Begins a frame if one is awaited, would differ, and there is room for it. run.c */
void kd_session_pump(struct kd_session *session);
/* Frames are believed to cost what the plan of the scene says, as long as none was measured. */
void kd_session_expect(struct kd_session *session, const struct kd_plan *plan);
/* The frame that is being rendered is given up if it refines: it is long, and nobody waits for it any more. */
void kd_session_drop_refinement(struct kd_session *session);
void kd_session_drop(struct kd_session *session); /* whatever it is */

/* Says whether somebody waits. The first frame is made before anybody asks. watch.c */
bool kd_session_awaited(const struct kd_session *session);
void kd_session_wake(struct kd_session *session); /* those for whom there is something */

/* The kinds in which a frame is asked for. kinds.c */
void kd_session_choose_kind(const struct kd_session *session, bool last,
                            struct kd_render_job *job); /* the first, by who waits */
/* What the viewer takes of the frame: NULL where that is still to be made. */
const struct kd_live_file *kd_session_file(const struct kd_viewer *viewer, const struct kd_live_frame *frame);
void kd_session_forget_pixels(struct kd_session *session,
                              double now); /* of a frame that nobody has asked for in another kind */
void kd_session_add_kinds(
    struct kd_session *session); /* begins to make what is missing of the latest frame for those who wait */

#endif

/* The table of routes: path, methods, handler, media type, statuses, parameters. /openapi.json and the Allow header
 * are generated from it. */
#ifndef KD_SERVER_HTTP_ROUTE_H
#define KD_SERVER_HTTP_ROUTE_H

#include "server/http/base_path.h"
#include "server/http/problem.h"

#include <microhttpd.h>
#include <stdbool.h>
#include <stddef.h>

struct kd_request;

enum { KD_GET = 1, KD_POST = 2, KD_PATCH = 4, KD_DELETE = 8, KD_PUT = 16 }; /* HEAD goes with GET */

/* These five, for whoever lists them. */
struct kd_method {
    const char *name, *lower; /* "GET", "get" */
    unsigned bit;
};
enum { KD_METHODS = 5 };
extern const struct kd_method kd_methods[KD_METHODS];

enum kd_takes {
    KD_TAKES_NOTHING,
    KD_TAKES_SCENE, /* in the body, or with GET in the query */
    KD_TAKES_PLAN,  /* a scene, or one with axes, in the body */
    KD_TAKES_RAYS,  /* in the body, JSON or NPY */
    KD_TAKES_ORBITS,
    KD_TAKES_INTEGRAL, /* what the path names */
    KD_TAKES_JOB,
    KD_TAKES_ASSET,
    KD_TAKES_STRIKE, /* in the body, or none */
    KD_TAKES_PATH,
    KD_TAKES_PARTICLES,  /* which and what of them, in the query */
    KD_TAKES_PLAYGROUND, /* a document, or what changes one */
    KD_TAKES_STEP,
    KD_TAKES_TICK,     /* which and how many of its things, in the query */
    KD_TAKES_LINK,     /* a scene by the code of a link, in the path */
    KD_TAKES_QUANTITY, /* the parameters of the quantity that the path names, in the query */
};

/* Media types of an answer. */
enum kd_gives {
    KD_GIVES_ITS_ANSWER, /* what `answer` and `also` say */
    KD_GIVES_PICTURE,    /* a frame in each format that there is: render/output/format.h */
    KD_GIVES_RESULT,     /* of a job: job/formats.h */
};

struct kd_route {
    const char *path; /* a segment in braces, at most one, stands for any: request->rest */
    unsigned methods;
    /* Called when the whole body is there, and again when the render it has asked for is done. */
    enum MHD_Result (*handle)(struct kd_request *request);
    const char *answer, *summary; /* media type, NULL where `gives` says them; and a sentence for openapi.json */
    enum kd_takes takes;
    enum kd_gives gives;
    const char *also;   /* other media types of answers, "a/b c/d"; NULL: none */
    bool question;      /* its POST leaves nothing at the server, so that the role view may send it (access.h) */
    bool open;          /* answered without an access token, too */
    bool once;          /* its POST takes Idempotency-Key (once.h) */
    bool parts;         /* its GET may answer with a part, 206 (representation.h) */
    unsigned status[2]; /* of an answer that is no problem; { 0 }: 200; DELETE answers 204 */
    const char
        *own[2]; /* parameters of the query that are no fields of the scene, beside which they stand; NULL: none */
};

/* The table: server/routes.c. */
extern const struct kd_route kd_routes[];
extern const size_t kd_n_routes;

/* Sets request->route, ->matched, and ->rest, which points into the target's path; takes the base path from that.
 * The base path alone is the page's, too, with an empty path. False with *problem filled (404; 405, where
 * request->route is set too). */
bool kd_route_find(struct kd_request *request, struct kd_problem *problem);
/* The methods that a route takes, with OPTIONS, which each does, as the Allow header has them; until the next call
 * on this thread. NULL: those of all routes. */
const char *kd_route_allow(const struct kd_route *route);
/* The same without OPTIONS, for preflights. */
const char *kd_route_methods(const struct kd_route *route);
/* The bit of a method by its name, KD_GET, ...; 0: no route takes it. */
unsigned kd_route_method(const char *method);
/* Whether a raw target is one that is answered whatever else is the matter: /healthz, /readyz, /metrics, with the
 * base path and without it. */
bool kd_route_is_health(const struct kd_base_path *base, const char *raw);
/* Says the same of the first n bytes of a connection, which may end too early to tell; KD_BEGINS_BYTES of them tell
 * in any case. */
enum kd_begins { KD_BEGINS_UNCLEAR, KD_BEGINS_HEALTH, KD_BEGINS_OTHER };
#define KD_BEGINS_BYTES (KD_BASE_PATH_MOST + 32)
enum kd_begins kd_route_begins(const struct kd_base_path *base, const char *bytes, size_t n);

/* Whether a browser that is refused wants a page that asks for its access token, and that page: answers/sign_in.c */
struct kd_problem;
bool kd_sign_in_wanted(struct kd_request *request, const struct kd_problem *problem);
enum MHD_Result kd_sign_in_page(struct kd_request *request, const struct kd_problem *problem);

/* handlers, by file */
enum MHD_Result kd_handle_page(struct kd_request *request);   /* answers/pages.c */
enum MHD_Result kd_handle_health(struct kd_request *request); /* answers/reports.c */
enum MHD_Result kd_handle_ready(struct kd_request *request);
enum MHD_Result kd_handle_metrics(struct kd_request *request); /* answers/metrics.c */
enum MHD_Result kd_handle_device(struct kd_request *request);
enum MHD_Result kd_handle_kept(struct kd_request *request);   /* what openapi/kept.h has */
enum MHD_Result kd_handle_plan(struct kd_request *request);   /* answers/plan.c */
enum MHD_Result kd_handle_render(struct kd_request *request); /* render/renders.c */
enum MHD_Result kd_handle_pixel(struct kd_request *request);
enum MHD_Result kd_handle_shared_picture(struct kd_request *request);
enum MHD_Result kd_handle_share(struct kd_request *request); /* answers/share.c */
enum MHD_Result kd_handle_oembed(struct kd_request *request);
enum MHD_Result kd_handle_shared(struct kd_request *request); /* answers/shared_page.c */
enum MHD_Result kd_handle_embed(struct kd_request *request);
enum MHD_Result kd_handle_thumbnail(struct kd_request *request); /* render/thumbnails.c */
enum MHD_Result kd_handle_rays(struct kd_request *request);      /* answers/rays.c */
enum MHD_Result kd_handle_orbits(struct kd_request *request);    /* answers/orbits.c */
enum MHD_Result kd_handle_integral(struct kd_request *request);  /* answers/integrals.c */
enum MHD_Result kd_handle_accuracy(struct kd_request *request);  /* answers/accuracy.c */
enum MHD_Result kd_handle_assets(struct kd_request *request);    /* answers/assets.c */
enum MHD_Result kd_handle_asset(struct kd_request *request);
enum MHD_Result kd_handle_sessions(struct kd_request *request); /* session/routes.c */
enum MHD_Result kd_handle_session(struct kd_request *request);
enum MHD_Result kd_handle_session_ringdown(struct kd_request *request);
enum MHD_Result kd_handle_session_path(struct kd_request *request);
enum MHD_Result kd_handle_session_particles(struct kd_request *request); /* session/particles.c */
enum MHD_Result kd_handle_session_frame(struct kd_request *request);     /* session/live.c */
enum MHD_Result kd_handle_session_picture(struct kd_request *request);
enum MHD_Result kd_handle_session_frames(struct kd_request *request);
enum MHD_Result kd_handle_session_events(struct kd_request *request);
enum MHD_Result kd_handle_plays(struct kd_request *request); /* playground/routes.c */
enum MHD_Result kd_handle_play(struct kd_request *request);
enum MHD_Result kd_handle_play_step(struct kd_request *request);
enum MHD_Result kd_handle_play_snapshot(struct kd_request *request);
enum MHD_Result kd_handle_play_series(struct kd_request *request);
enum MHD_Result kd_handle_play_fallback(struct kd_request *request);
enum MHD_Result kd_handle_play_frame(struct kd_request *request);
enum MHD_Result kd_handle_play_frames(struct kd_request *request);
enum MHD_Result kd_handle_play_bodies(struct kd_request *request); /* playground/data.c */
enum MHD_Result kd_handle_play_debris(struct kd_request *request);
enum MHD_Result kd_handle_play_events(struct kd_request *request); /* playground/events.c */
enum MHD_Result kd_handle_jobs(struct kd_request *request);        /* job/routes.c */
enum MHD_Result kd_handle_job(struct kd_request *request);
enum MHD_Result kd_handle_job_events(struct kd_request *request);
enum MHD_Result kd_handle_job_result(struct kd_request *request);  /* job/result.c */
enum MHD_Result kd_handle_job_preview(struct kd_request *request); /* job/result.c */
enum MHD_Result kd_handle_quantity(struct kd_request *request);    /* answers/physics.c */

#endif

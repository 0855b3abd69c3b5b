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

enum { KD_GET = 1, KD_POST = 2, KD_PATCH = 4, KD_DELETE = 8, KD_PUT = 16 }; /* HEAD is served wherever GET is */

/* All methods, for iteration. */
struct kd_method {
    const char *name, *lower; /* "GET", "get" */
    unsigned bit;
};
enum { KD_METHODS = 5 };
extern const struct kd_method kd_methods[KD_METHODS];

enum kd_takes {
    KD_TAKES_NOTHING,
    KD_TAKES_SCENE, /* a scene, in the body, or with GET in the query */
    KD_TAKES_PLAN,  /* a scene, or a scene with axes of a sweep, in the body */
    KD_TAKES_RAYS,  /* rays, in the body, as JSON or NPY */
    KD_TAKES_ORBITS,
    KD_TAKES_INTEGRAL, /* the integral that the path names */
    KD_TAKES_JOB,
    KD_TAKES_ASSET,
    KD_TAKES_LESSON, /* a lesson, or changes of one */
    KD_TAKES_HAND,   /* an answer of a pupil */
    KD_TAKES_STRIKE, /* a ringdown in the body, or no body */
    KD_TAKES_PATH,
    KD_TAKES_PARTICLES,  /* selection of particles and quantities, in the query */
    KD_TAKES_PLAYGROUND, /* a playground's document, or changes of one */
    KD_TAKES_STEP,
    KD_TAKES_TICK,     /* names of lists and numbers of entries, in the query */
    KD_TAKES_LINK,     /* a scene as the code of a link, in the path */
    KD_TAKES_QUANTITY, /* the parameters, in the query, of the quantity that the path names */
};

/* Where an answer's media types are listed. */
enum kd_gives {
    KD_GIVES_ITS_ANSWER, /* the members `answer` and `also` list them */
    KD_GIVES_PICTURE,    /* every format of a picture: render/output/format.h */
    KD_GIVES_RESULT,     /* every result of a job: job/formats.h */
};

struct kd_route {
    const char *path; /* at most one segment is in braces; it matches any text, which becomes request->rest */
    unsigned methods;
    /* Called when the body is complete, and again when the work that the handler started is done. */
    enum MHD_Result (*handle)(struct kd_request *request);
    const char *answer, *summary; /* answer: media type (NULL: see `gives`); summary: a sentence for openapi.json */
    enum kd_takes takes;
    enum kd_gives gives;
    const char *also;   /* further media types of answers, "a/b c/d"; NULL: none */
    bool question;      /* the role view may send this POST: it renders nothing that stays, and stores nothing but
                         * a pupil's answer (access.h) */
    bool open;          /* needs no access token */
    bool page;          /* a page of a browser: takes the access token in its address, and asks for it (access.h) */
    bool once;          /* POST takes Idempotency-Key (once.h) */
    bool parts;         /* GET may answer with a range, 206 (representation.h) */
    unsigned status[2]; /* success statuses; { 0 }: 200; DELETE answers 204 */
    const char *own[4]; /* names of query parameters that are not fields of the scene, up to the first NULL */
};

/* All routes, in server/routes.c. */
extern const struct kd_route kd_routes[];
extern const size_t kd_n_routes;

/* Finds the route of the request's path. Sets request->route, ->matched and ->rest. `rest` points into the target's
 * path, from which the base path is removed. The base path alone, without a slash, leads to the page. Returns false
 * with *problem filled: 404, or 405 with request->route set. */
bool kd_route_find(struct kd_request *request, struct kd_problem *problem);
/* Value of Allow: the route's methods and OPTIONS; NULL: methods of all routes. Valid until the next call on this
 * thread. */
const char *kd_route_allow(const struct kd_route *route);
/* Like kd_route_allow, without OPTIONS; for preflights. */
const char *kd_route_methods(const struct kd_route *route);
/* Bit of a method's name, such as KD_GET; 0: unknown. */
unsigned kd_route_method(const char *method);
/* Whether a raw target is /healthz, /readyz or /metrics, with or without the base path. These are always answered. */
bool kd_route_is_health(const struct kd_base_path *base, const char *raw);
/* Like kd_route_is_health, decided by the first n bytes of a connection. KD_BEGINS_UNCLEAR: more bytes are needed.
 * KD_BEGINS_BYTES bytes always suffice. */
enum kd_begins { KD_BEGINS_UNCLEAR, KD_BEGINS_HEALTH, KD_BEGINS_OTHER };
#define KD_BEGINS_BYTES (KD_BASE_PATH_MOST + 32)
enum kd_begins kd_route_begins(const struct kd_base_path *base, const char *bytes, size_t n);

/* Whether a refused browser gets a page that asks for the access token; kd_sign_in_page sends it
 * (answers/sign_in.c). */
struct kd_problem;
bool kd_sign_in_wanted(struct kd_request *request, const struct kd_problem *problem);
enum MHD_Result kd_sign_in_page(struct kd_request *request, const struct kd_problem *problem);

/* The handlers. The comments name the files that define them. */
enum MHD_Result kd_handle_page(struct kd_request *request);   /* answers/pages.c */
enum MHD_Result kd_handle_health(struct kd_request *request); /* answers/reports.c */
enum MHD_Result kd_handle_ready(struct kd_request *request);
enum MHD_Result kd_handle_metrics(struct kd_request *request); /* answers/metrics.c */
enum MHD_Result kd_handle_device(struct kd_request *request);
/* cached documents: openapi/cached_documents.h */
enum MHD_Result kd_handle_cached_document(struct kd_request *request);
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
enum MHD_Result kd_handle_lessons(struct kd_request *request); /* lesson/routes.c */
enum MHD_Result kd_handle_lesson(struct kd_request *request);
enum MHD_Result kd_handle_lesson_hands(struct kd_request *request);
enum MHD_Result kd_handle_playgrounds(struct kd_request *request); /* playground/routes.c */
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

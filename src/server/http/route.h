/* The table of routes. Each line of server/http/routes.def describes one route completely. /openapi.json,
 * docs/routes.md, the Allow header, the required role and the size limit of the body are made from that line. */
#ifndef KD_SERVER_HTTP_ROUTE_H
#define KD_SERVER_HTTP_ROUTE_H

#include "server/http/base_path.h"
#include "server/http/problem.h"

#include <microhttpd.h>
#include <stdbool.h>
#include <stddef.h>

struct kd_request;

enum { KD_GET = 1, KD_POST = 2, KD_PATCH = 4, KD_DELETE = 8, KD_PUT = 16 }; /* every route with GET also has HEAD */

/* List of all methods. */
struct kd_method {
    const char *name, *lower; /* "GET", "get" */
    unsigned bit;
};
enum { KD_METHODS = 5 };
extern const struct kd_method kd_methods[KD_METHODS];

enum kd_takes {
    KD_TAKES_NOTHING,
    KD_TAKES_SCENE, /* a scene in the body; with GET, a scene in the query */
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

/* Description of each kind of request, in openapi/takes.c. */
struct kd_json;
struct cJSON;
struct kd_route;
struct kd_taken {
    const char *about, *what;     /* about: the request in a few words; what: a name for the request's body */
    size_t most;                  /* largest size of the body in bytes; 0: the default KD_BODY_MAX */
    const char *types;            /* media types of the body, "a/b c/d"; NULL: application/json. A PATCH may also
                                   * send a merge patch */
    const char *schema, *changes; /* schema: JSON Schema of a body, as text; changes: the same for PATCH */
    bool may_lack;                /* the body may be missing */
    /* body writes the member "requestBody" in place of `schema`; parameters writes entries of "parameters". Either
     * may be NULL. */
    void (*body)(struct kd_json *json, const struct kd_route *route);
    void (*parameters)(struct kd_json *json, unsigned method, const struct cJSON *scene_schema);
};
enum { KD_TAKES = KD_TAKES_QUANTITY + 1 };
extern const struct kd_taken kd_taken[KD_TAKES];

/* The place where an answer's media types are listed. */
enum kd_gives {
    KD_GIVES_ITS_ANSWER, /* listed in the members `answer` and `also` */
    KD_GIVES_PICTURE,    /* every format of a picture: render/output/format.h */
    KD_GIVES_RESULT,     /* every result of a job: job/formats.h */
};

/* In the structs below, methods 0 means all methods of the route. */
struct kd_query {                     /* a query parameter that is not a field of the scene */
    const char *name, *schema, *help; /* schema: JSON Schema as text; NULL: the names of the formats of jobs */
    unsigned methods;
    bool required;
    const char *was; /* the parameter's former name, which is deprecated; NULL: none */
};
struct kd_route {
    const char *path; /* at most one segment is in braces; it matches any text, which is stored in request->rest */
    unsigned methods;
    const char *answer, *summary; /* answer: media type (NULL: see `gives`); summary: a sentence for openapi.json */
    enum kd_takes takes;
    enum kd_gives gives;
    const char *also; /* further media types of answers, "a/b c/d"; NULL: none */
    /* the role view may send this POST, because it changes nothing on the server except a pupil's answer (access.h) */
    bool question;
    bool open;     /* needs no access token */
    bool signable; /* GET may come by a signed link instead of an access token (link.h) */
    /* a page for browsers: the access token may be in the page's address; if there is none, the page asks for the
     * token (access.h) */
    bool page;
    bool once;          /* POST takes Idempotency-Key (once.h) */
    bool parts;         /* GET may answer with a range, 206 (representation.h) */
    bool folders;       /* the parameter at the end of the path may contain slashes */
    bool owner;         /* POST needs the token of the object; PATCH and DELETE always do */
    bool brief;         /* PATCH accepts the header Prefer: return=minimal */
    bool changes;       /* some answers have no ETag, because unfinished objects change */
    unsigned status[2]; /* statuses of success; { 0 }: 200. The status of DELETE is 204 */
    /* The handler. Called when the body is complete, and again when the work that it started is done. */
    enum MHD_Result (*handle)(struct kd_request *request);
    const struct kd_query *queries; /* ends with a NULL name; NULL: none */
    struct {
        unsigned methods;
        const char *text;
    } schemas[2]; /* JSON Schema of JSON answers, as text */
    struct {
        unsigned methods, status;
        const char *headers;
    } tells[3];                                  /* names of the answers' headers, "A B" */
    struct { unsigned methods, status; } may[2]; /* problems of the route that its other members do not imply */
};

/* All routes, in server/routes.c. */
extern const struct kd_route kd_routes[];
extern const size_t kd_n_routes;

/* True if an entry with these methods applies to this method. */
static inline bool kd_route_for(unsigned methods, unsigned method) { return !methods || methods & method; }
/* True if the route has a query parameter of this name or former name; route may be NULL. */
bool kd_route_has_query(const struct kd_route *route, const char *name);

/* Value of the route's own query parameter. NULL if the query does not have it, or if the route has no such
 * parameter. *given: the name that the query uses, which may be the former name. Returns KD_EINVAL if the query has
 * both names. */
enum kd_status kd_route_query(const struct kd_request *request, const char *name, const char **given,
                              const char **value, struct kd_error *error);
/* Returns KD_OK if the query has only parameters of the route and method, each at most once, and "token". Otherwise
 * returns KD_EINVAL. Three kinds of queries are not checked: fields of a scene, parameters of a quantity (both are
 * read by the handler), and queries of pages. */
enum kd_status kd_route_only(const struct kd_request *request, struct kd_error *error);
bool kd_route_checks_query(const struct kd_route *route);
/* True if the query has a former name of a parameter. */
bool kd_route_is_dated(const struct kd_request *request);

/* Appends the path of the route, below the base path. `rest` replaces the segment in braces. */
enum kd_status kd_route_path(const struct kd_route *route, const char *rest, struct kd_buffer *out);
/* Returns the route that a decoded path leads to, or NULL. Modifies the path: *rest points into it and is terminated
 * there. Ignores the base path. */
const struct kd_route *kd_route_of(char *path, const char **rest);

/* Finds the route of the request's path. Sets request->route, ->matched and ->rest. `rest` points into the target's
 * path, from which the base path is removed. The base path without a slash at its end leads to the page. Returns
 * false with *problem filled: 404, or 405 with request->route set. */
bool kd_route_find(struct kd_request *request, struct kd_problem *problem);
/* Value of Allow: the route's methods and OPTIONS; NULL: methods of all routes. Valid until the next call on this
 * thread. */
const char *kd_route_allow(const struct kd_route *route);
/* Like kd_route_allow, without OPTIONS; for preflights. */
const char *kd_route_methods(const struct kd_route *route);
/* Bit of a method's name, such as KD_GET; 0: unknown. */
unsigned kd_route_method(const char *method);
/* True if a raw target is /healthz, /readyz or /metrics, with or without the base path. These routes are always
 * answered. */
bool kd_route_is_health(const struct kd_base_path *base, const char *raw);
/* Like kd_route_is_health, decided by the first n bytes of a connection. KD_BEGINS_UNCLEAR: more bytes are needed.
 * KD_BEGINS_BYTES bytes always suffice. */
enum kd_begins { KD_BEGINS_UNCLEAR, KD_BEGINS_HEALTH, KD_BEGINS_OTHER };
#define KD_BEGINS_BYTES (KD_BASE_PATH_MOST + 32)
enum kd_begins kd_route_begins(const struct kd_base_path *base, const char *bytes, size_t n);

/* True if a refused browser gets a page that asks for the access token; kd_sign_in_page sends it
 * (answers/sign_in.c). */
struct kd_problem;
bool kd_sign_in_wanted(struct kd_request *request, const struct kd_problem *problem);
enum MHD_Result kd_sign_in_page(struct kd_request *request, const struct kd_problem *problem);

/* The handlers. */
#define ROUTE(handler, ...) enum MHD_Result handler(struct kd_request *request);
#include "server/http/routes.def"
#undef ROUTE

#endif

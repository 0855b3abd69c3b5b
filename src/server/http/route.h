/* The table of routes. Each line of server/http/routes.def describes one route completely. That line determines the
 * route's part of /openapi.json and docs/routes.md, its Allow header, its required role, and the size limit of its
 * body. */
#ifndef KD_SERVER_HTTP_ROUTE_H
#define KD_SERVER_HTTP_ROUTE_H

#include "server/http/base_path.h"
#include "server/http/problem.h"

#include <microhttpd.h>
#include <stdbool.h>
#include <stddef.h>

struct kd_request;

/* every route that supports GET also supports HEAD */
enum { KD_GET = 1, KD_POST = 2, KD_PATCH = 4, KD_DELETE = 8, KD_PUT = 16 };

/* List of all methods. */
struct kd_method {
    const char *name, *lower; /* "GET", "get" */
    unsigned bit;
};
enum { KD_METHODS = 5 };
extern const struct kd_method kd_methods[KD_METHODS];

enum kd_takes {
    KD_TAKES_NOTHING,
    KD_TAKES_SCENE, /* a scene: in the body, or for GET in the query */
    KD_TAKES_PLAN,  /* a scene, or a scene with axes (a sweep), in the body */
    KD_TAKES_RAYS,  /* rays in the body, as JSON or NPY */
    KD_TAKES_ORBITS,
    KD_TAKES_INTEGRAL, /* a request for the integral that the path names */
    KD_TAKES_JOB,
    KD_TAKES_ASSET,
    KD_TAKES_LESSON, /* a lesson, or changes to one */
    KD_TAKES_HAND,   /* a pupil's answer */
    KD_TAKES_STRIKE, /* a ringdown in the body, or no body */
    KD_TAKES_PATH,
    KD_TAKES_PARTICLES,  /* names of particles and quantities, in the query */
    KD_TAKES_PLAYGROUND, /* a playground's document, or changes to one */
    KD_TAKES_STEP,
    KD_TAKES_TICK,     /* names of lists, and numbers of entries, in the query */
    KD_TAKES_LINK,     /* a scene, in the path, as the code of a link */
    KD_TAKES_QUANTITY, /* parameters of the quantity that the path names, in the query */
};

/* Descriptions of the kinds of requests, in openapi/takes.c. */
struct kd_json;
struct cJSON;
struct kd_route;
struct kd_taken {
    const char *about, *what; /* about: the request in a few words; what: name of the request's body */
    size_t most;              /* maximum size of the body in bytes; 0: the default, KD_BODY_MAX */
    /* media types of the body, as in "a/b c/d"; NULL: application/json. The body of PATCH may also be a merge patch. */
    const char *types;
    const char *schema, *changes; /* JSON Schemas as text; schema: that of a body; changes: that of the body of PATCH */
    bool may_lack;                /* true if the body may be missing */
    /* body: writes the member "requestBody" instead of `schema`; parameters: writes entries of "parameters". Both
     * may be NULL. */
    void (*body)(struct kd_json *json, const struct kd_route *route);
    void (*parameters)(struct kd_json *json, unsigned method, const struct cJSON *scene_schema);
};
enum { KD_TAKES = KD_TAKES_QUANTITY + 1 };
extern const struct kd_taken kd_taken[KD_TAKES];

/* Where the media types of an answer are listed. */
enum kd_gives {
    KD_GIVES_ITS_ANSWER, /* in the members `answer` and `also` */
    KD_GIVES_PICTURE,    /* all formats of a picture, in render/output/format.h */
    KD_GIVES_RESULT,     /* all results of a job, in job/formats.h */
};

/* In the structs below, methods 0 stands for all methods of the route. */
struct kd_query {                     /* a query parameter that is not a field of the scene */
    const char *name, *schema, *help; /* schema: JSON Schema as text; NULL: the value is the name of a job's format */
    unsigned methods;
    bool required;
    const char *was; /* former name of the parameter, which is deprecated; NULL: none */
};
struct kd_route {
    /* path of the route; a segment in braces, at most one, matches any text, which is stored in request->rest */
    const char *path;
    unsigned methods;
    const char *answer, *summary; /* answer: media type; NULL: see `gives`; summary: one sentence for openapi.json */
    enum kd_takes takes;
    enum kd_gives gives;
    const char *also; /* other media types of the answer, as in "a/b c/d"; NULL: none */
    /* true if the role view may send this POST, because it changes nothing on the server except a pupil's answer
     * (access.h) */
    bool question;
    bool open;     /* true if no access token is needed */
    bool signable; /* true if GET may come by a signed link instead of an access token (link.h) */
    /* true for a page for browsers: its address may contain the access token, and if there is no token, the page
     * asks for it (access.h) */
    bool page;
    bool once;          /* true if POST supports Idempotency-Key (once.h) */
    bool parts;         /* true if GET may answer with a range, status 206 (representation.h) */
    bool folders;       /* true if the parameter at the end of the path may contain slashes */
    bool owner;         /* true if POST needs the token of the object; PATCH and DELETE always do */
    bool brief;         /* true if PATCH supports the header Prefer: return=minimal */
    bool changes;       /* true if some answers have no ETag, because unfinished objects change */
    unsigned status[2]; /* statuses of success; { 0 } stands for 200; DELETE always has 204 */
    /* The handler. It is called when the body is complete, and again when work that it has started is done. */
    enum MHD_Result (*handle)(struct kd_request *request);
    const struct kd_query *queries; /* an array that ends with a NULL name; NULL: none */
    struct {
        unsigned methods;
        const char *text;
    } schemas[2]; /* JSON Schemas of JSON answers, as text */
    struct {
        unsigned methods, status;
        const char *headers;
    } tells[3];                                  /* names of the headers of answers, as in "A B" */
    struct { unsigned methods, status; } may[2]; /* problems of the route that do not follow from its other members */
};

/* All routes; defined in server/routes.c. */
extern const struct kd_route kd_routes[];
extern const size_t kd_n_routes;

/* True if an entry with these methods applies to the given method. */
static inline bool kd_route_for(unsigned methods, unsigned method) { return !methods || methods & method; }
/* True if the route has a query parameter with this name or former name. route may be NULL. */
bool kd_route_has_query(const struct kd_route *route, const char *name);

/* Value of a query parameter that belongs to the route. NULL if the query does not contain it, or if the route has
 * no such parameter. *given: the name in the query, which may be the former name. Returns KD_EINVAL if the query has
 * both names. */
enum kd_status kd_route_query(const struct kd_request *request, const char *name, const char **given,
                              const char **value, struct kd_error *error);
/* Returns KD_OK if the query contains only parameters of the route and method, each at most once, and "token";
 * otherwise KD_EINVAL. Three kinds of queries are not checked: fields of a scene and parameters of a quantity, which
 * their handlers check, and queries of pages. */
enum kd_status kd_route_only(const struct kd_request *request, struct kd_error *error);
bool kd_route_checks_query(const struct kd_route *route);
/* True if the query uses the former name of a parameter. */
bool kd_route_is_dated(const struct kd_request *request);

/* Appends the path of the route, below the base path. `rest` replaces the segment in braces. */
enum kd_status kd_route_path(const struct kd_route *route, const char *rest, struct kd_buffer *out);
/* Returns the route of a decoded path, or NULL. The path is modified: *rest points into it and is terminated there.
 * The base path is not considered. */
const struct kd_route *kd_route_of(char *path, const char **rest);

/* Finds the route for the request's path. Sets request->route, ->matched and ->rest; `rest` points into the target's
 * path, from which the base path was removed. The base path without a slash at its end is the route of the page. If
 * it returns false, it has filled *problem: 404, or 405 with request->route set. */
bool kd_route_find(struct kd_request *request, struct kd_problem *problem);
/* Value of the Allow header: the methods of the route, and OPTIONS. route NULL: the methods of all routes. Valid
 * until the next call on this thread. */
const char *kd_route_allow(const struct kd_route *route);
/* Like kd_route_allow, but without OPTIONS, for preflights. */
const char *kd_route_methods(const struct kd_route *route);
/* The bit for the name of a method, such as KD_GET; 0 if it is unknown. */
unsigned kd_route_method(const char *method);
/* True if a raw target is /healthz, /readyz or /metrics, with or without the base path. These routes are answered
 * even when all others are refused. */
bool kd_route_is_health(const struct kd_base_path *base, const char *raw);
/* Like kd_route_is_health, but decided from the first n bytes of a connection. KD_BEGINS_UNCLEAR: more bytes are
 * needed; KD_BEGINS_BYTES bytes are always enough. */
enum kd_begins { KD_BEGINS_UNCLEAR, KD_BEGINS_HEALTH, KD_BEGINS_OTHER };
#define KD_BEGINS_BYTES (KD_BASE_PATH_MOST + 32)
enum kd_begins kd_route_begins(const struct kd_base_path *base, const char *bytes, size_t n);

/* True if a browser whose request is refused gets the page that asks for the access token. kd_sign_in_page sends
 * this page (answers/sign_in.c). */
struct kd_problem;
bool kd_sign_in_wanted(struct kd_request *request, const struct kd_problem *problem);
enum MHD_Result kd_sign_in_page(struct kd_request *request, const struct kd_problem *problem);

/* The handlers. */
#define ROUTE(handler, ...) enum MHD_Result handler(struct kd_request *request);
#include "server/http/routes.def"
#undef ROUTE

#endif

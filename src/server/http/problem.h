/* Problem documents (RFC 9457), the bodies of all error answers, and their types. */
#ifndef KD_SERVER_HTTP_PROBLEM_H
#define KD_SERVER_HTTP_PROBLEM_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* X(name, HTTP status, word in the type's URI, title) */
#define KD_PROBLEMS(X) \
    X(BAD_REQUEST, 400, "bad-request", "The request is not valid HTTP") \
    X(MALFORMED_JSON, 400, "malformed-json", "The body cannot be read as a JSON object") \
    X(UNAUTHORIZED, 401, "unauthorized", "This server needs a token") \
    X(ROLE, 403, "role", "The role of your token does not allow this") \
    X(LINK, 403, "link", "The signed link is not valid") \
    X(CROSS_SITE, 403, "cross-site", "Pages of other sites must not use this server") \
    X(FORBIDDEN, 403, "forbidden", "This request needs a token") \
    X(NOT_FOUND, 404, "not-found", "There is nothing at this address") \
    X(METHOD, 405, "method-not-allowed", "This address does not accept this method") \
    X(NOT_ACCEPTABLE, 406, "not-acceptable", "No available media type is acceptable") \
    X(NOT_READY, 409, "not-ready", "The requested resource is not ready yet") \
    X(CONFLICT, 409, "conflict", "The present state does not allow this request") \
    X(TIMEOUT, 408, "timeout", "The request took too long to arrive") \
    X(PRECONDITION, 412, "precondition-failed", "The resource does not match If-Match") \
    X(BODY_TOO_LARGE, 413, "body-too-large", "The body is too large") \
    X(URI_TOO_LONG, 414, "uri-too-long", "The address is too long") \
    X(MEDIA_TYPE, 415, "unsupported-media-type", "The media type of the body is not accepted here") \
    X(MISDIRECTED, 421, "misdirected", "This host name is not served here") \
    X(RANGE, 416, "range-not-satisfiable", "The range is beyond the end") \
    X(INVALID_SCENE, 422, "invalid-scene", "The scene is not valid") \
    X(INVALID_RAYS, 422, "invalid-rays", "The request for rays is not valid") \
    X(INVALID_PARAMETERS, 422, "invalid-parameters", "A parameter is not valid") \
    X(INVALID_ORBIT, 422, "invalid-orbit", "The request for orbits is not valid") \
    X(INVALID_JOB, 422, "invalid-job", "The request for a job is not valid") \
    X(INVALID_PLAYGROUND, 422, "invalid-playground", "The request for a playground is not valid") \
    X(INVALID_ASSET, 422, "invalid-asset", "The asset is not of an accepted kind") \
    X(TOO_LARGE, 422, "too-large", "The scene is too large for this server") \
    X(KEY_REUSED, 422, "idempotency-key-reused", "The Idempotency-Key belongs to another request") \
    X(QUOTA, 429, "quota", "This client has reached its limit") \
    X(WRONG_TOKENS, 429, "wrong-tokens", "Too many wrong tokens have come from this address") \
    X(HEADER_TOO_LARGE, 431, "header-too-large", "The header is too large") \
    X(INTERNAL, 500, "internal", "The server failed") \
    X(DEVICE_LOST, 500, "device-lost", "The device failed") \
    X(ABSENT, 501, "not-installed", "This server lacks a program that the request needs") \
    X(NO_MEMORY, 503, "out-of-memory", "Memory ran out") \
    X(QUEUE_FULL, 503, "queue-full", "Too many requests are waiting") \
    X(LINKS_FULL, 503, "links-full", "Too many signed links with a budget are in use") \
    X(CROWDED, 503, "too-many-connections", "Too many connections are open") \
    X(STOPPING, 503, "stopping", "The server is stopping") \
    X(DISK_FULL, 507, "disk-full", "The disk is full") \
    X(ASSETS_FULL, 507, "assets-full", "The store of assets is full") \
    X(HTTP_VERSION, 505, "http-version", "The server supports only HTTP/1.1 and HTTP/1.0")

enum kd_problem_type {
#define KD_PROBLEM_ENUM(name, ...) KD_PROBLEM_##name,
    KD_PROBLEMS(KD_PROBLEM_ENUM)
#undef KD_PROBLEM_ENUM
};

struct kd_problem {
    enum kd_problem_type type;
    const char *detail;        /* one sentence about this occurrence */
    const char *pointer;       /* RFC 6901 pointer into the document; NULL or "" if there is none */
    const char *offered;       /* for 406 and 415: the media types that are accepted */
    const char *allow;         /* for 405: the methods that the route supports */
    const char *content_range; /* for 416: value of Content-Range, which states the length of the file */
    const char *request_id;    /* NULL or "" for none */
    unsigned retry_after;      /* value of Retry-After in seconds; 0: the header is not sent */
    /* true if the connection is closed, because the rest of the request is not read or cannot be parsed safely */
    bool close;
};

/* Makes the problem that belongs to the status of *error. Its pointer and detail point into *error. */
struct kd_problem kd_problem_from(const struct kd_error *error);

/* Completes a result of kd_problem_from that may be caused by a limit. quota: true if the limit is that of one
 * client; the status then becomes 429. Retry-After: for KD_EBUSY, the number of seconds in the error; otherwise
 * otherwise_s. */
void kd_problem_limit(struct kd_problem *problem, const struct kd_error *error, bool quota, unsigned otherwise_s);

unsigned kd_problem_status(enum kd_problem_type type);
const char *kd_problem_title(enum kd_problem_type type);
/* The type's URI, "urn:kerrd:problem:..."; NULL if `type` is beyond the last type. */
const char *kd_problem_uri(size_t type);

/* Writes the document, whose media type is application/problem+json. */
enum kd_status kd_problem_to_json(const struct kd_problem *problem, struct kd_buffer *out);

/* Writes a complete HTTP answer to a socket, in situations in which libmicrohttpd cannot send one. request_id: NULL
 * or "" if there is none yet. Never blocks. */
void kd_problem_send_raw(int socket, enum kd_problem_type type, const char *detail, const char *request_id);

#endif

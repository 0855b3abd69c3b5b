/* Problem documents (RFC 9457), the bodies of all error answers, and their types. */
#ifndef KD_SERVER_HTTP_PROBLEM_H
#define KD_SERVER_HTTP_PROBLEM_H

#include "base/buffer.h"
#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* X(name, HTTP status, word in the type's URI, title) */
#define KD_PROBLEMS(X) \
    X(BAD_REQUEST, 400, "bad-request", "The request is not sound HTTP") \
    X(MALFORMED_JSON, 400, "malformed-json", "The body cannot be read as a JSON object") \
    X(UNAUTHORIZED, 401, "unauthorized", "This server takes a token") \
    X(ROLE, 403, "role", "The role of your token does not allow this") \
    X(CROSS_SITE, 403, "cross-site", "Pages of other sites may not use this server") \
    X(FORBIDDEN, 403, "forbidden", "This takes a token") \
    X(NOT_FOUND, 404, "not-found", "There is nothing under this address") \
    X(METHOD, 405, "method-not-allowed", "This address does not take this method") \
    X(NOT_ACCEPTABLE, 406, "not-acceptable", "No offered media type is acceptable") \
    X(NOT_READY, 409, "not-ready", "What this asks for is not there yet") \
    X(CONFLICT, 409, "conflict", "What there is does not allow it now") \
    X(TIMEOUT, 408, "timeout", "The request took too long to arrive") \
    X(PRECONDITION, 412, "precondition-failed", "What there is is not what If-Match names") \
    X(BODY_TOO_LARGE, 413, "body-too-large", "The body is too large") \
    X(URI_TOO_LONG, 414, "uri-too-long", "The address is too long") \
    X(MEDIA_TYPE, 415, "unsupported-media-type", "The body's media type is not taken here") \
    X(MISDIRECTED, 421, "misdirected", "This host name is not served here") \
    X(RANGE, 416, "range-not-satisfiable", "The range is beyond the end") \
    X(INVALID_SCENE, 422, "invalid-scene", "The scene is not valid") \
    X(INVALID_RAYS, 422, "invalid-rays", "The request for rays is not valid") \
    X(INVALID_PARAMETERS, 422, "invalid-parameters", "A parameter is not valid") \
    X(INVALID_ORBIT, 422, "invalid-orbit", "The request for orbits is not valid") \
    X(INVALID_JOB, 422, "invalid-job", "The request for a job is not valid") \
    X(INVALID_PLAYGROUND, 422, "invalid-playground", "The request for a playground is not valid") \
    X(INVALID_ASSET, 422, "invalid-asset", "The asset is not one that is taken") \
    X(TOO_LARGE, 422, "too-large", "The scene is larger than this server renders") \
    X(KEY_REUSED, 422, "idempotency-key-reused", "The Idempotency-Key is that of another request") \
    X(QUOTA, 429, "quota", "This client has as much as one may") \
    X(WRONG_TOKENS, 429, "wrong-tokens", "Too many wrong tokens have come from this address") \
    X(HEADER_TOO_LARGE, 431, "header-too-large", "The header is too large") \
    X(INTERNAL, 500, "internal", "The server failed") \
    X(DEVICE_LOST, 500, "device-lost", "The device failed") \
    X(ABSENT, 501, "not-installed", "This server lacks a program that this takes") \
    X(NO_MEMORY, 503, "out-of-memory", "Memory ran out") \
    X(QUEUE_FULL, 503, "queue-full", "Too many requests are waiting") \
    X(CROWDED, 503, "too-many-connections", "Too many connections are open") \
    X(STOPPING, 503, "stopping", "The server is stopping") \
    X(DISK_FULL, 507, "disk-full", "There is no room on the disk") \
    X(ASSETS_FULL, 507, "assets-full", "There is no room for more assets") \
    X(HTTP_VERSION, 505, "http-version", "Only HTTP/1.1 and HTTP/1.0 are spoken here")

enum kd_problem_type {
#define KD_PROBLEM_ENUM(name, ...) KD_PROBLEM_##name,
    KD_PROBLEMS(KD_PROBLEM_ENUM)
#undef KD_PROBLEM_ENUM
};

struct kd_problem {
    enum kd_problem_type type;
    const char *detail;        /* one sentence for this occurrence */
    const char *pointer;       /* RFC 6901 pointer into the scene; NULL or "" for none */
    const char *offered;       /* 406, 415: the media types that are accepted */
    const char *allow;         /* 405: the methods that are accepted */
    const char *content_range; /* 416: the value of Content-Range, which has the length */
    const char *request_id;    /* NULL or "" for none */
    unsigned retry_after;      /* Retry-After in seconds; 0: no such header */
    /* close the connection, because the rest of what the client sends is not wanted or cannot be parsed safely */
    bool close;
};

/* Makes the problem of a status. pointer and detail point into *error. */
struct kd_problem kd_problem_from(const struct kd_error *error);

/* Completes a result of kd_problem_from if a limit may be the reason. quota: the limit is that of one client, so the
 * status is 429. Retry-After is the number of seconds in the error for KD_EBUSY, else otherwise_s. */
void kd_problem_limit(struct kd_problem *problem, const struct kd_error *error, bool quota, unsigned otherwise_s);

unsigned kd_problem_status(enum kd_problem_type type);
const char *kd_problem_title(enum kd_problem_type type);
/* The document's type, "urn:kerrd:problem:..."; NULL beyond the last. */
const char *kd_problem_uri(size_t type);

/* Writes the document, application/problem+json. */
enum kd_status kd_problem_to_json(const struct kd_problem *problem, struct kd_buffer *out);

/* Writes a complete HTTP answer to a socket, where libmicrohttpd cannot. request_id: NULL or "" if there is none yet.
 * Never blocks. */
void kd_problem_send_raw(int socket, enum kd_problem_type type, const char *detail, const char *request_id);

#endif

/* Idempotency-Key (draft-ietf-httpapi-idempotency-key-header-07): a repeated POST with the same key creates nothing
 * new. The key is stored with the object that the first request created, as long as this object exists; the key of a
 * job also survives restarts. If the same client repeats the same request, it gets this object as the answer. HTTP
 * thread only.
 *
 * A handler of a route that is marked `once` first looks for an object that holds the request's key. Before it
 * creates anything, it calls kd_once_begin with that object's struct kd_once. It copies request->once into the
 * object that it creates. */
#ifndef KD_SERVER_HTTP_ONCE_H
#define KD_SERVER_HTTP_ONCE_H

#include "server/http/problem.h"

#include <microhttpd.h>

#define KD_ONCE_HEADER "Idempotency-Key"
#define KD_ONCE_MOST 128 /* maximum number of characters of a key */
enum { KD_ONCE_TEXT = 300 };

struct kd_request;

/* Two SHA-256 hashes in hexadecimal digits. Both are "" if the request has no key. */
struct kd_once {
    char key[65];     /* hash of client, route and key together */
    char request[65]; /* hash of target and body together */
};

/* Reads the header before the body arrives. Returns false if the key is malformed; `text` then contains the detail
 * of *problem. A request without the header has no key. */
bool kd_once_read(struct kd_request *request, struct kd_problem *problem, char text[KD_ONCE_TEXT]);
/* Adds the next part of the body to the hash. */
void kd_once_take(struct kd_request *request, const void *data, size_t size);

/* Decides about a request. earlier: the key of an object that already exists; NULL if there is none. KD_ONCE_FIRST:
 * the caller creates the object. KD_ONCE_AGAIN: the caller answers with the earlier object. KD_ONCE_REFUSED: the
 * caller returns *refused. Its status is 409 while a request with the same key is in progress, and 422 if the
 * earlier request was a different one. */
enum kd_once_verdict { KD_ONCE_FIRST, KD_ONCE_AGAIN, KD_ONCE_REFUSED };
enum kd_once_verdict kd_once_begin(struct kd_request *request, const struct kd_once *earlier, enum MHD_Result *refused);
void kd_once_end(struct kd_request *request); /* must be called when the request was answered */

#endif

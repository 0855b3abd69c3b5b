/* Access control by bearer token: reads the token file of kerrd serve --token-file, and checks each request against
 * it. */
#ifndef KD_SERVER_HTTP_ACCESS_H
#define KD_SERVER_HTTP_ACCESS_H

#include "base/error.h"
#include "server/http/problem.h"

#include <stdint.h>

#define KD_ACCESS_HEADER "Kerrd-Access"
#define KD_ACCESS_COOKIE "kerrd_access"
/* query parameter of pages (route.h); the server answers it by setting the cookie of the same token */
#define KD_ACCESS_QUERY "access"
#define KD_ACCESS_TOKEN_MIN 16 /* characters */
#define KD_ACCESS_TOKEN_MAX 256
#define KD_ACCESS_NAME_MAX 32
/* minimum characters of a key. A key must be long, because anybody who has a link can test guesses of its key
 * offline */
#define KD_ACCESS_KEY_MIN 32
#define KD_ACCESS_SIGNATURE 32 /* bytes of a signature, HMAC-SHA256 */

struct kd_access;
struct kd_request;
struct kd_route;

/* Roles. view: requests that store nothing on the server except a pupil's answer. render: all requests. link: the
 * entry is not a token but a key that signs addresses (link.h). A signed address may be fetched by everybody who has
 * it. */
#define KD_ROLES(X) X(VIEW, "view") X(RENDER, "render") X(LINK, "link")
enum kd_role {
#define KD_ROLE_ENUM(name, word) KD_ROLE_##name,
    KD_ROLES(KD_ROLE_ENUM)
#undef KD_ROLE_ENUM
};

/* True if the role may send this method to the route. */
bool kd_role_may(enum kd_role role, const struct kd_route *route, unsigned method);

struct kd_visitor {
    char name[KD_ACCESS_NAME_MAX + 1];
    enum kd_role role;
};

/* Reads a token file: NAME ROLE TOKEN on each line; # begins a comment. Returns KD_EINVAL if the file cannot be
 * read, if its group may write to it, if others may read or write it, or if a line is malformed. The message names
 * the line and never the token. */
enum kd_status kd_access_read(const char *path, struct kd_access **out, struct kd_error *error);
void kd_access_free(struct kd_access *access); /* accepts NULL */

/* Returns the owner of a token, or NULL if no entry has it. A key for links does not count as a token. Takes
 * constant time: the same for a wrong token and for a right one, and for every entry. Any thread. */
const struct kd_visitor *kd_access_find(const struct kd_access *access, const char *token);

/* Signs a text with the key of this name; *owner: the key's entry. Returns false if the file has no such key. Any
 * thread. */
bool kd_access_sign(const struct kd_access *access, const char *name, const void *text, size_t size,
                    uint8_t signature[KD_ACCESS_SIGNATURE], const struct kd_visitor **owner);

/* The token in a page's address, ?access=TOKEN. NULL if there is none, or if the server has no token file. */
const char *kd_access_query(const struct kd_request *request);
/* Authorises a request whose target has been parsed. request->route is its route, or NULL if no route has its path.
 * Sets request->visitor, ->spent and ->link. Returns false with *problem filled (401, 403, 429, 503), which may point
 * into *error. HTTP threads. */
bool kd_access_check(struct kd_request *request, struct kd_problem *problem, struct kd_error *error);

#endif

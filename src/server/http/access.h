/* Access control by bearer tokens. Reads the token file of kerrd serve --token-file, and checks each request against
 * it. */
#ifndef KD_SERVER_HTTP_ACCESS_H
#define KD_SERVER_HTTP_ACCESS_H

#include "base/error.h"
#include "server/http/problem.h"

#include <stdint.h>

#define KD_ACCESS_HEADER "Kerrd-Access"
#define KD_ACCESS_COOKIE "kerrd_access"
/* query parameter with the access token in the address of a page (route.h); the server's answer sets a cookie with the
 * same token */
#define KD_ACCESS_QUERY "access"
#define KD_ACCESS_TOKEN_MIN 16 /* characters */
#define KD_ACCESS_TOKEN_MAX 256
#define KD_ACCESS_NAME_MAX 32
/* minimum number of characters in a key; keys must be long, because anybody who has a link can test guesses of its
 * key offline */
#define KD_ACCESS_KEY_MIN 32
#define KD_ACCESS_SIGNATURE 32 /* number of bytes in a signature, HMAC-SHA256 */

struct kd_access;
struct kd_request;
struct kd_route;

/* Roles. view: requests that store nothing on the server except a pupil's answer. render: all requests. link: the entry
 * is not a token, but a key that signs addresses (link.h); anybody who has a signed address may use it. */
#define KD_ROLES(X) X(VIEW, "view") X(RENDER, "render") X(LINK, "link")
enum kd_role {
#define KD_ROLE_ENUM(name, word) KD_ROLE_##name,
    KD_ROLES(KD_ROLE_ENUM)
#undef KD_ROLE_ENUM
};

/* True if the role permits this method on the route. */
bool kd_role_may(enum kd_role role, const struct kd_route *route, unsigned method);

struct kd_visitor {
    char name[KD_ACCESS_NAME_MAX + 1];
    enum kd_role role;
};

/* Reads a token file. Each line is NAME ROLE TOKEN; # starts a comment. Returns KD_EINVAL if the file cannot be
 * read, if its group may write to it, if others may read or write it, or if a line is malformed. The message gives
 * the line's number, and never the token. */
enum kd_status kd_access_read(const char *path, struct kd_access **out, struct kd_error *error);
void kd_access_free(struct kd_access *access); /* accepts NULL */

/* Returns the owner of a token, or NULL if no entry has this token. A key for links does not count as a token. The
 * function takes the same time for right and wrong tokens, and for every entry. Any thread. */
const struct kd_visitor *kd_access_find(const struct kd_access *access, const char *token);

/* Signs a text with the key of this name. *owner: the entry of the key. Returns false if the file has no such key.
 * Any thread. */
bool kd_access_sign(const struct kd_access *access, const char *name, const void *text, size_t size,
                    uint8_t signature[KD_ACCESS_SIGNATURE], const struct kd_visitor **owner);

/* The token in the address of a page, ?access=TOKEN. NULL if there is none, or if the server has no token file. */
const char *kd_access_query(const struct kd_request *request);
/* Authorises a request whose target was already parsed. request->route must be its route, or NULL if no route has
 * its path. Sets request->visitor, ->spent and ->link. If it returns false, it has filled *problem (401, 403, 429,
 * 503), which may point into *error. HTTP threads. */
bool kd_access_check(struct kd_request *request, struct kd_problem *problem, struct kd_error *error);

#endif

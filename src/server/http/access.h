/* Access control by bearer token: reads the token file of kerrd serve --token-file, and checks each request against
 * it. */
#ifndef KD_SERVER_HTTP_ACCESS_H
#define KD_SERVER_HTTP_ACCESS_H

#include "base/error.h"
#include "server/http/problem.h"

#define KD_ACCESS_HEADER "Kerrd-Access"
#define KD_ACCESS_COOKIE "kerrd_access"
#define KD_ACCESS_QUERY "access" /* on the page alone, which answers it with the cookie */
#define KD_ACCESS_TOKEN_MIN 16   /* characters */
#define KD_ACCESS_TOKEN_MAX 256
#define KD_ACCESS_NAME_MAX 32

struct kd_access;
struct kd_request;
struct kd_route;

/* Roles, each of which may do what those before it may. view: ask for whatever leaves nothing at the server; render:
 * all. */
enum kd_role { KD_ROLE_VIEW = 1, KD_ROLE_RENDER };

/* Whether a role may use a method of a route. */
bool kd_role_may(enum kd_role role, const struct kd_route *route, unsigned method);

struct kd_visitor {
    char name[KD_ACCESS_NAME_MAX + 1];
    enum kd_role role;
};

/* Reads a token file: NAME ROLE TOKEN a line, # begins a comment. KD_EINVAL, with a sentence that names the line and
 * no token, where it cannot be read, others may read or write it, or a line is not as it should be. */
enum kd_status kd_access_read(const char *path, struct kd_access **out, struct kd_error *error);
void kd_access_free(struct kd_access *access); /* accepts NULL */

/* Whose token it is; NULL: nobody's. Takes as long for a wrong one as for a right one, whichever of them it is. Any
 * thread. */
const struct kd_visitor *kd_access_find(const struct kd_access *access, const char *token);

/* The token in the address of the page, as ?access=TOKEN; NULL: there is none, or the server takes none. */
const char *kd_access_query(const struct kd_request *request);
/* Whether a request may go on: its target has been taken apart, and request->route is where it leads, NULL for
 * nowhere. Sets request->visitor and ->spent. False with *problem filled (401, 403, 429). HTTP threads. */
bool kd_access_check(struct kd_request *request, struct kd_problem *problem);

#endif

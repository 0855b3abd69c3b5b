/* Access control in openapi.json: the tokens of a token file, and the tokens of a session, playground, job or asset. */
#ifndef KD_SERVER_OPENAPI_ACCESS_H
#define KD_SERVER_OPENAPI_ACCESS_H

#include "base/json.h"
#include "server/http/route.h"

/* Writes the member "securitySchemes" of the components. */
void kd_openapi_access_schemes(struct kd_json *json);
/* Writes the document's member "security", the default for all operations. closed: true if the server has a token
 * file. */
void kd_openapi_access_default(struct kd_json *json, bool closed);
/* Writes the member "security" of an operation if its requirements differ from the default. closed: true if the
 * server has a token file. */
void kd_openapi_access_operation(struct kd_json *json, const struct kd_route *route, unsigned method, bool closed);
/* True if an operation requires the token of the session, playground, job or asset on which it acts. */
bool kd_openapi_is_owners(const struct kd_route *route, unsigned method);

#endif

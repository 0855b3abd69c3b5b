/* Access control in openapi.json: the tokens of a token file, and those of a session, a playground, a job, an asset. */
#ifndef KD_SERVER_OPENAPI_ACCESS_H
#define KD_SERVER_OPENAPI_ACCESS_H

#include "base/json.h"
#include "server/http/route.h"

/* The member "securitySchemes" of the components. */
void kd_openapi_access_schemes(struct kd_json *json);
/* The member "security" of the document, for all operations that have none. */
void kd_openapi_access_default(struct kd_json *json, bool closed);
/* The member "security" of an operation, where it needs one. closed: the server has a token file. */
void kd_openapi_access_operation(struct kd_json *json, const struct kd_route *route, unsigned method, bool closed);
/* Whether an operation takes the token of the session, playground, job or asset that it is for. */
bool kd_openapi_is_owners(const struct kd_route *route, unsigned method);

#endif

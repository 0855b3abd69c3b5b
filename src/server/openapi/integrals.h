/* POST /v1/line and other integrals in openapi.json. */
#ifndef KD_SERVER_OPENAPI_INTEGRALS_H
#define KD_SERVER_OPENAPI_INTEGRALS_H

#include "base/json.h"
#include "server/http/route.h"

/* kd_openapi_integral_body writes the requestBody of the operation at a path. kd_openapi_integral_schemas writes the
 * components of all operations for integrals. */
void kd_openapi_integral_body(struct kd_json *json, const struct kd_route *route);
void kd_openapi_integral_schemas(struct kd_json *json);

#endif

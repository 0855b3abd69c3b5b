/* Links in openapi.json. They lead from the answer that creates an object to the operations on this object. */
#ifndef KD_SERVER_OPENAPI_LINKS_H
#define KD_SERVER_OPENAPI_LINKS_H

#include "base/json.h"
#include "server/http/route.h"

/* Writes the member "links" of an answer that has created an object (201, 202). */
void kd_openapi_links(struct kd_json *json, const struct kd_route *route, unsigned status);

#endif

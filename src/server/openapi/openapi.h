/* The OpenAPI document of the service. Any thread. */
#ifndef KD_SERVER_OPENAPI_OPENAPI_H
#define KD_SERVER_OPENAPI_OPENAPI_H

#include "base/buffer.h"

#include <stdbool.h>

/* Appends an OpenAPI 3.1 document, made from the route table, the scene's schema and the problem table. Making it
 * takes some milliseconds, so the document is cached. base_path: prefix of each path. If it is "", the paths are
 * relative to the document's own folder, so that proxies may change the prefix. closed: the server has a token file. */
enum kd_status kd_openapi_json(const char *base_path, bool closed, struct kd_buffer *out);

#endif

/* The OpenAPI document of the service. Any thread. */
#ifndef KD_SERVER_OPENAPI_OPENAPI_H
#define KD_SERVER_OPENAPI_OPENAPI_H

#include "base/buffer.h"

#include <stdbool.h>

/* Appends an OpenAPI 3.1 document, made from the table of routes, the schema of a scene, and the table of problems.
 * This takes some milliseconds, so the document is cached. base_path: prefix of all paths. If it is "", the paths
 * are relative to the folder of the document, so that proxies may change the prefix. closed: true if the server has
 * a token file. */
enum kd_status kd_openapi_json(const char *base_path, bool closed, struct kd_buffer *out);

#endif

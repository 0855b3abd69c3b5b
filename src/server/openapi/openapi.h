/* The service describes itself by this document. Any thread. */
#ifndef KD_SERVER_OPENAPI_OPENAPI_H
#define KD_SERVER_OPENAPI_OPENAPI_H

#include "base/buffer.h"

#include <stdbool.h>

/* OpenAPI 3.1 from the route table, the scene's schema and the problem table; appended. Some milliseconds: it is
 * made once. base_path: what stands before each path of it; "": the folder that the document is in, whatever a proxy
 * calls that. closed: the server has a token file. */
enum kd_status kd_openapi_json(const char *base_path, bool closed, struct kd_buffer *out);

#endif

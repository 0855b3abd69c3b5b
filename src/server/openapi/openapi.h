/* The service describes itself by this document. Any thread. */
#ifndef KD_SERVER_OPENAPI_OPENAPI_H
#define KD_SERVER_OPENAPI_OPENAPI_H

#include "base/buffer.h"

/* OpenAPI 3.1 from the route table, the scene's schema and the problem table; appended. Some milliseconds: it is made once. */
enum kd_status kd_openapi_json(struct kd_buffer *out);

#endif

/* Short names for functions of base/schema.h, for the schemas of the server's answers. */
#ifndef KD_SERVER_OPENAPI_STRICT_H
#define KD_SERVER_OPENAPI_STRICT_H

#include "base/schema.h"

#define kd_openapi_member kd_schema_member
#define kd_openapi_strict kd_schema_strict
#define KD_OPENAPI_STRICT KD_SCHEMA_STRICT
#define KD_OPENAPI_TOLD KD_SCHEMA_TOLD

#endif

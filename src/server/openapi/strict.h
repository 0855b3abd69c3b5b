/* Schemas of the server's own answers, by the names that its tables have: base/schema.h. */
#ifndef KD_SERVER_OPENAPI_STRICT_H
#define KD_SERVER_OPENAPI_STRICT_H

#include "base/schema.h"

/* A number as it is typed (scene/number.h), in patterns. */
#define KD_OPENAPI_DECIMAL "-?((0|[1-9][0-9]*)([.][0-9]*)?|[.][0-9]+)([eE][-+]?[0-9]+)?"

#define kd_openapi_member kd_schema_member
#define kd_openapi_strict kd_schema_strict
#define KD_OPENAPI_STRICT KD_SCHEMA_STRICT
#define KD_OPENAPI_TOLD KD_SCHEMA_TOLD

#endif

/* Names of base/schema.h for the schemas of the server's answers. */
#ifndef KD_SERVER_OPENAPI_STRICT_H
#define KD_SERVER_OPENAPI_STRICT_H

#include "base/schema.h"

/* Pattern of a decimal number (document/number.h). */
#define KD_OPENAPI_DECIMAL "-?((0|[1-9][0-9]*)([.][0-9]*)?|[.][0-9]+)([eE][-+]?[0-9]+)?"

#define kd_openapi_member kd_schema_member
#define kd_openapi_strict kd_schema_strict
#define KD_OPENAPI_STRICT KD_SCHEMA_STRICT
#define KD_OPENAPI_TOLD KD_SCHEMA_TOLD

#endif

/* Schemas of answers in openapi.json. */
#ifndef KD_SERVER_OPENAPI_ANSWERS_H
#define KD_SERVER_OPENAPI_ANSWERS_H

#include "base/json.h"

#include <stdbool.h>

/* The schema, as JSON, of what a route answers a method (KD_GET, …) as application/json; NULL: it is in no table. */
const char *kd_openapi_answer(const char *path, unsigned method);

#endif

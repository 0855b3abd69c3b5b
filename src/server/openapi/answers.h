/* Schemas of answers in openapi.json. */
#ifndef KD_SERVER_OPENAPI_ANSWERS_H
#define KD_SERVER_OPENAPI_ANSWERS_H

#include "base/json.h"

#include <stdbool.h>

/* Schema, as JSON text, of a route's application/json answer to a method such as KD_GET; NULL: not in the table. */
const char *kd_openapi_answer(const char *path, unsigned method);

#endif

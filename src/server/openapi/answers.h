/* Schemas of answers in openapi.json. */
#ifndef KD_SERVER_OPENAPI_ANSWERS_H
#define KD_SERVER_OPENAPI_ANSWERS_H

#include "base/json.h"

#include <stdbool.h>

/* Schema, as JSON text, of the application/json answer that a route gives to a method such as KD_GET. NULL: the route
 * has no such answer in the table. */
const char *kd_openapi_answer(const char *path, unsigned method);

#endif

/* /v1/lessons in openapi.json. */
#ifndef KD_SERVER_OPENAPI_LESSONS_H
#define KD_SERVER_OPENAPI_LESSONS_H

#include "base/json.h"

/* Writes Lesson and its parts, members of components.schemas. */
void kd_openapi_lesson_schema(struct kd_json *json);
extern const char kd_openapi_hand_schema[]; /* schema of the body of .../hands */

#endif

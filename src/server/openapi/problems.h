/* Problems that an operation may answer in openapi.json, by status, and the meaning of each status. From the table of
 * problems. */
#ifndef KD_SERVER_OPENAPI_PROBLEMS_H
#define KD_SERVER_OPENAPI_PROBLEMS_H

#include "base/json.h"
#include "server/http/route.h"

/* Members of an operation's "responses". */
void kd_openapi_problems(struct kd_json *json, const struct kd_route *route, unsigned method);
/* Members of components.responses: one a status, "Problem404". */
void kd_openapi_problem_responses(struct kd_json *json);
/* Problem, a member of components.schemas. */
void kd_openapi_problem_schema(struct kd_json *json);

#endif

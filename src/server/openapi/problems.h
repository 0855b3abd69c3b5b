/* The problems of each operation in openapi.json, by status, generated from the table of problems. */
#ifndef KD_SERVER_OPENAPI_PROBLEMS_H
#define KD_SERVER_OPENAPI_PROBLEMS_H

#include "base/json.h"
#include "server/http/route.h"

/* Writes the members of an operation's "responses". */
void kd_openapi_problems(struct kd_json *json, const struct kd_route *route, unsigned method);
/* kd_openapi_has_problem: true if this operation may answer with this status. kd_openapi_problem_is_common: true if
 * any operation may answer with it, whatever its route. */
bool kd_openapi_has_problem(const struct kd_route *route, unsigned method, unsigned status);
bool kd_openapi_problem_is_common(unsigned status);
/* Writes the members of components.responses, one for each status, such as "Problem404". */
void kd_openapi_problem_responses(struct kd_json *json);
/* Writes Problem, a member of components.schemas. */
void kd_openapi_problem_schema(struct kd_json *json);

#endif

/* Jobs in openapi.json, and the body of POST /v1/plan, which is a scene, or a sweep as in a job. */
#ifndef KD_SERVER_OPENAPI_JOBS_H
#define KD_SERVER_OPENAPI_JOBS_H

#include "base/json.h"
#include "server/http/route.h"

/* Both functions write the requestBody of an operation. */
void kd_openapi_jobs_body(struct kd_json *json, const struct kd_route *route);
void kd_openapi_plan_body(struct kd_json *json, const struct kd_route *route);
/* Writes the schemas of a job's status and of the axes of a sweep. */
void kd_openapi_job_schema(struct kd_json *json);

#endif

/* This is what openapi.json says of jobs, and of the body of POST /v1/plan: a scene, or a sweep as a job takes it. */
#ifndef KD_SERVER_OPENAPI_JOBS_H
#define KD_SERVER_OPENAPI_JOBS_H

#include "base/json.h"

/* The operation's requestBody. */
void kd_openapi_jobs_body(struct kd_json *json);
void kd_openapi_plan_body(struct kd_json *json);
/* The schemas of how far a job is, and of a sweep's axes. */
void kd_openapi_job_schema(struct kd_json *json);

#endif

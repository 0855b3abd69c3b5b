/* This is what openapi.json says of POST /v1/jobs, and of the body of POST /v1/plan: a scene, or a sweep as a job takes it. */
#ifndef KD_SERVER_OPENAPI_JOBS_H
#define KD_SERVER_OPENAPI_JOBS_H

#include "base/json.h"

/* The operation's requestBody; what belongs into the content of its answer. */
void kd_openapi_jobs_body(struct kd_json *json);
void kd_openapi_plan_body(struct kd_json *json);
void kd_openapi_jobs_answer(struct kd_json *json);

#endif

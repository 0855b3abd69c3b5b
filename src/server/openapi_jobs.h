/* What openapi.json says of POST /v1/jobs. */
#ifndef KD_SERVER_OPENAPI_JOBS_H
#define KD_SERVER_OPENAPI_JOBS_H

#include <cjson/cJSON.h>

/* The request's body, and the answer's content in `ok`. */
void kd_openapi_jobs_bodies(cJSON *operation, cJSON *ok);

#endif

/* The formats of GET /v1/jobs/ID/result, by their names in the parameter `format`. Pure; any thread. */
#ifndef KD_SERVER_JOB_FORMATS_H
#define KD_SERVER_JOB_FORMATS_H

#include "render/output/series.h"

#include <stdbool.h>

struct kd_job_format { const char *name, *media_type; };

/* The stream of a job's frames, which can begin at any frame. Series whose frames are files have it. */
extern const struct kd_job_format kd_job_as_stream;

/* Gets entry i of the list of all formats, which has no duplicates. Returns false beyond the end. */
bool kd_job_format(size_t i, struct kd_job_format *out);

#endif

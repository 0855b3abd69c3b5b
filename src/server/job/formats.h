/* Formats of GET /v1/jobs/ID/result, by their names in `format=`. Pure; any thread. */
#ifndef KD_SERVER_JOB_FORMATS_H
#define KD_SERVER_JOB_FORMATS_H

#include "render/output/series.h"

#include <stdbool.h>

struct kd_job_format { const char *name, *media_type; };

/* What holds the frames of a job that are files, from any on, as they come. */
extern const struct kd_job_format kd_job_as_stream;

/* Every format of any job, each once, number i from 0 on; false: there are no more. */
bool kd_job_format(size_t i, struct kd_job_format *out);

#endif

/* routes.c and result.c share this. HTTP thread. */
#ifndef KD_SERVER_JOB_ROUTES_H
#define KD_SERVER_JOB_ROUTES_H

#include "server/http/request.h"

/* A reference to the job that the path names, or NULL after a refusal. */
struct kd_job *kd_job_of(struct kd_request *request, enum MHD_Result *refused);

/* A 200 of unknown length that may take its time. release(cls) is called in the end, also on failure. */
enum MHD_Result kd_job_stream(struct kd_request *request, const char *type, MHD_ContentReaderCallback produce, void *cls,
                              MHD_ContentReaderFreeCallback release);

#endif

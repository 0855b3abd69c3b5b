/* Declarations shared by routes.c, result.c, table.c and whole.c. HTTP thread. */
#ifndef KD_SERVER_JOB_ROUTES_H
#define KD_SERVER_JOB_ROUTES_H

#include "server/http/request.h"

#include <string.h>

/* What "state" of a job can be; NULL behind the last. */
const char *kd_job_state_word(size_t i);

/* A reference to the job that the path names, or NULL after a refusal. */
struct kd_job *kd_job_of(struct kd_request *request, enum MHD_Result *refused);

/* Refusals, which take the reference over: frames are missing, and there will be more or not; what the query says
 * does not go. */
struct kd_job_status;
enum MHD_Result kd_job_not_ready(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status);
enum MHD_Result kd_job_bad(struct kd_request *request, struct kd_job *job, const char *detail);

/* A 200 of unknown length that may take its time. release(cls) is called in the end, also on failure. */
enum MHD_Result kd_job_stream(struct kd_request *request, const char *type, MHD_ContentReaderCallback produce,
                              void *cls, MHD_ContentReaderFreeCallback release);

/* Hands over what is made and not yet taken, from *at on, as much as there is room for. Returns how many bytes;
 * without any `instead`. */
static inline ssize_t kd_job_hand_over(const struct kd_buffer *made, size_t *at, char *to, size_t size, ssize_t instead)
{
    const size_t left = made->size - *at, n = left < size ? left : size;
    if (!n)
        return instead;
    memcpy(to, made->data + *at, n);
    *at += n;
    return (ssize_t)n;
}

#endif

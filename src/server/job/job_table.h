/* Sends the table of a finished job whose frames are rows (render/output/series.h). Workers read and format the
 * rows, one per frame. HTTP thread. */
#ifndef KD_SERVER_JOB_JOB_TABLE_H
#define KD_SERVER_JOB_JOB_TABLE_H

#include "server/http/request.h"
#include "server/job/jobs.h"

/* Sends the table, and takes over the reference to the job. format: value of the query parameter, or NULL. The
 * handler is called again with request->task set, and must then call that task's `answer`. */
enum MHD_Result kd_job_send_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const char *format);

#endif

/* Answers with the table of a finished job whose frames are rows (render/output/series.h). Workers read and format
 * the rows, one for each frame. HTTP thread. */
#ifndef KD_SERVER_JOB_JOB_TABLE_H
#define KD_SERVER_JOB_JOB_TABLE_H

#include "server/http/request.h"
#include "server/job/jobs.h"

/* Sends the table and takes over the reference to the job. format: from the query, or NULL. The handler is called again
 * with request->task set, and then calls that task's `answer`. */
enum MHD_Result kd_job_send_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const char *format);

#endif

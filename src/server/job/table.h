/* Answers with the table of a job that is done, whose frames are rows (render/output/series.h). The rows, as many as
 * frames, are read and written by the workers. HTTP thread. */
#ifndef KD_SERVER_JOB_TABLE_H
#define KD_SERVER_JOB_TABLE_H

#include "server/http/request.h"
#include "server/job/jobs.h"

/* Takes the reference over. format: of the query, NULL: none. The handler is called again where request->task is
 * there then, and answers with its `answer`. */
enum MHD_Result kd_job_send_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const char *format);

#endif

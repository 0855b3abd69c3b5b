/* Answers with the table of a finished job whose frames are rows (render/output/series.h). Workers read and write the
 * rows, of which there may be as many as frames. HTTP thread. */
#ifndef KD_SERVER_JOB_TABLE_H
#define KD_SERVER_JOB_TABLE_H

#include "server/http/request.h"
#include "server/job/jobs.h"

/* Takes the reference over. format: of the query, NULL: none. The handler is called again where request->task is
 * there then, and answers with its `answer`. */
enum MHD_Result kd_job_send_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const char *format);

#endif

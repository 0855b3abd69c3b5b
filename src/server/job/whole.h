/* Answers with all files of a finished job in one (render/output/gather.h), piece by piece. Before the first byte,
 * workers read through the files of a cube, or wait until ffmpeg has encoded a film. HTTP thread. */
#ifndef KD_SERVER_JOB_WHOLE_H
#define KD_SERVER_JOB_WHOLE_H

#include "server/http/request.h"
#include "server/job/jobs.h"

/* rate: frames a second, of a film. Takes the reference over. The handler is called again where request->task is
 * there then, and answers with its `answer`. */
enum MHD_Result kd_job_send_whole(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const struct kd_gather_format *format, unsigned rate);

#endif

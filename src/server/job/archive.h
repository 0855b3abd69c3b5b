/* Sends all files of a finished job as one archive (render/output/gather.h), which is made in small pieces. Before
 * the first byte is sent, workers read the files of a cube, or wait until ffmpeg has encoded a film. HTTP thread. */
#ifndef KD_SERVER_JOB_ARCHIVE_H
#define KD_SERVER_JOB_ARCHIVE_H

#include "server/http/request.h"
#include "server/job/jobs.h"

/* Sends the archive, and takes over the reference to the job. rate: frames per second of a film. When the workers
 * have finished, the handler is called again with request->task set, and must then call that task's `answer`. */
enum MHD_Result kd_job_send_whole(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const struct kd_gather_format *format, unsigned rate);

#endif

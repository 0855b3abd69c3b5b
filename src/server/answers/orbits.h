/* Handler of POST /v1/orbits. */
#ifndef KD_SERVER_ANSWERS_ORBITS_H
#define KD_SERVER_ANSWERS_ORBITS_H

struct kd_orbits_job;

/* To be called when the job's request is closed. Drops the request's reference; the job then ends at its next slice.
 * HTTP thread; accepts NULL. */
void kd_orbits_job_abandon(struct kd_orbits_job *job);

#endif

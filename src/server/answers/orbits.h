/* Handler of POST /v1/orbits. */
#ifndef KD_SERVER_ANSWERS_ORBITS_H
#define KD_SERVER_ANSWERS_ORBITS_H

struct kd_orbits_job;

/* Releases the job of a closed request, which ends it at its next turn. HTTP thread; accepts NULL. */
void kd_orbits_job_abandon(struct kd_orbits_job *job);

#endif

/* Handler of POST /v1/orbits. */
#ifndef KD_SERVER_ANSWERS_ORBITS_H
#define KD_SERVER_ANSWERS_ORBITS_H

struct kd_orbits_job;

/* The request is closed: its job ends at its next turn, if it has not. HTTP thread; accepts NULL. */
void kd_orbits_job_abandon(struct kd_orbits_job *job);

#endif

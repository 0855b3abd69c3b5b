/* Shorter scheduling slices for threads that do little work but are waited for, so that they run soon after they wake
 * even when all cores are busy. */
#ifndef KD_SERVER_HTTP_SCHED_SLICE_H
#define KD_SERVER_HTTP_SCHED_SLICE_H

/* Requests short time slices for the calling thread. That needs no privilege and takes no time from others: of two
 * threads that have had equally little, the scheduler prefers the one whose slice ends first (EEVDF, Linux 6.12 and
 * later; older kernels ignore it). */
void kd_sched_short_slices(void);

#endif

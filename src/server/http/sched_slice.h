/* Short scheduling slices for threads that do little work, but on which other threads wait. Such a thread then runs
 * soon after it wakes up, even if all cores are busy. */
#ifndef KD_SERVER_HTTP_SCHED_SLICE_H
#define KD_SERVER_HTTP_SCHED_SLICE_H

/* Requests short time slices for the calling thread. This needs no privilege, and does not reduce the total time
 * that other threads get. Of two threads that have received equally little time, the kernel runs the one whose slice
 * ends first (EEVDF, Linux 6.12 and later; older kernels ignore the request). */
void kd_sched_short_slices(void);

#endif

/* The number of processor cores. Any thread. */
#ifndef KD_BASE_CORES_H
#define KD_BASE_CORES_H

unsigned kd_cores(void); /* that this process may run on: those of its affinity, at least 1 */

/* How many of these nobody uses at this moment, the calling thread's own not counted; negative if more threads want to
 * run than there are cores. Threads of all processes count (proc_loadavg(5)); where this process may run on a part of
 * the machine's cores alone, the rest is taken to be as busy. Without /proc: all cores but the caller's. */
int kd_cores_idle(void);

#endif

/* Counts processor cores: all of them, or only those that are idle. Any thread. */
#ifndef KD_BASE_CORES_H
#define KD_BASE_CORES_H

unsigned kd_cores(void); /* number of cores in the process's affinity mask, at least 1 */

/* Returns the number of these cores that are idle now. The core of the calling thread counts as busy. The result is
 * negative if more threads are runnable than there are cores. The threads of all processes count (proc_loadavg(5)).
 * If this process may use only some of the machine's cores, the load is assumed to be spread evenly over all of
 * them. Without /proc, all cores except the caller's count as idle. */
int kd_cores_idle(void);

#endif

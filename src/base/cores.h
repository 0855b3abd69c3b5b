/* Counts processor cores, all and idle. Any thread. */
#ifndef KD_BASE_CORES_H
#define KD_BASE_CORES_H

unsigned kd_cores(void); /* number of cores in the process's affinity mask, at least 1 */

/* Returns how many of these cores are idle now. The core of the calling thread counts as busy. The result is
 * negative if more threads want to run than there are cores. Threads of all processes count (proc_loadavg(5)). If
 * the process may use only some of the machine's cores, they are assumed to be as busy as the others. Without /proc,
 * all cores except the caller's count as idle. */
int kd_cores_idle(void);

#endif

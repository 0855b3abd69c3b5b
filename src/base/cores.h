/* Counts processor cores, all and idle. Any thread. */
#ifndef KD_BASE_CORES_H
#define KD_BASE_CORES_H

unsigned kd_cores(void); /* cores in the process's affinity mask, at least 1 */

/* Number of these cores that are idle now. The core of the calling thread counts as busy. Negative if more threads want
 * to run than there are cores. Threads of all processes count (proc_loadavg(5)). If the process may use only some of
 * the machine's cores, these are taken to be as busy as the others. Without /proc: all cores but the caller's. */
int kd_cores_idle(void);

#endif

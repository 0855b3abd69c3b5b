/* This counts the processor cores that this process may run on: those of its affinity, at least 1. Any thread. */
#ifndef KD_BASE_CORES_H
#define KD_BASE_CORES_H

unsigned kd_cores(void);

#endif

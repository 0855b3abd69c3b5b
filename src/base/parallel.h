/* Runs a function for each of n items, on the caller's thread and others, and returns when all are done. The items must
 * not depend on one another; their order is not fixed. Any thread may call it. It runs on as many threads as there are
 * cores, at most KD_PARALLEL_THREADS; where none can be started, the caller does all the work. */
#ifndef KD_BASE_PARALLEL_H
#define KD_BASE_PARALLEL_H

#include <stddef.h>

#define KD_PARALLEL_THREADS 16

void kd_parallel(size_t n, void (*each)(void *user, size_t item), void *user);

#endif

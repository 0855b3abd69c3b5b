/* Runs a function for each of n items, on the caller's thread and on others. Returns when all items are done. Items
 * must be independent of each other: they start in order, but may end in any order. Any thread. If no thread can be
 * started, the caller's thread does all the work. */
#ifndef KD_BASE_PARALLEL_H
#define KD_BASE_PARALLEL_H

#include <stddef.h>

#define KD_PARALLEL_THREADS 16

/* Uses as many threads as there are cores, but at most KD_PARALLEL_THREADS. */
void kd_parallel(size_t n, void (*each)(void *user, size_t item), void *user);

/* Like kd_parallel, but on idle cores only. It is meant for items that take about 100 us or more. Before the caller
 * runs an item itself, it starts a thread for each idle core. After each item, a started thread ends if more threads
 * are runnable than there are cores. All calls together start at most one thread less than there are cores. */
void kd_parallel_idle(size_t n, void (*each)(void *user, size_t item), void *user);

/* For tests and benchmarks: number of threads that kd_parallel_idle uses, however busy the cores are. 0: it uses
 * idle cores only. */
extern _Thread_local unsigned kd_parallel_threads;

#endif

/* Processor pressure: how long this process's threads have waited for a core, from /proc/self/task/N/schedstat
 * (Documentation/scheduler/sched-stats.rst of Linux). Other load makes the host's work slower by about that much. Any
 * thread. */
#ifndef KD_BASE_WAITING_H
#define KD_BASE_WAITING_H

struct kd_waiting {
    double ran_ns, waited_ns; /* summed over the threads that live; both 0 where the kernel does not say */
};

struct kd_waiting kd_waiting_now(void);

/* The share of the time since in which threads that could run did run: 1 when nobody else wants the cores, or
 * nothing is known. */
double kd_waiting_share(const struct kd_waiting *since);

#endif

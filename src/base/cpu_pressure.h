/* Processor pressure: the time for which this process's threads have waited for a core, from
 * /proc/self/task/N/schedstat (Documentation/scheduler/sched-stats.rst of Linux). It measures how much other load
 * slows this process down. Any thread. */
#ifndef KD_BASE_CPU_PRESSURE_H
#define KD_BASE_CPU_PRESSURE_H

struct kd_cpu_pressure {
    double ran_ns, waited_ns; /* sums over the living threads; both are 0 if the kernel does not report these times */
};

struct kd_cpu_pressure kd_cpu_pressure_now(void);

/* Returns run / (run + waited) for the time since `since`, summed over all threads. Returns 1 if no thread has
 * waited for a core, or if the kernel reports no times. */
double kd_cpu_pressure_share(const struct kd_cpu_pressure *since);

#endif

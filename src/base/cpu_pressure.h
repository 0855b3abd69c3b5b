/* Processor pressure: how long this process's threads have waited for a core, from /proc/self/task/N/schedstat
 * (Documentation/scheduler/sched-stats.rst of Linux). The waiting time is a measure of how much other load slows
 * this process down. Any thread. */
#ifndef KD_BASE_CPU_PRESSURE_H
#define KD_BASE_CPU_PRESSURE_H

struct kd_cpu_pressure {
    double ran_ns, waited_ns; /* summed over the living threads; both are 0 if the kernel does not report them */
};

struct kd_cpu_pressure kd_cpu_pressure_now(void);

/* Returns the fraction run / (run + waited) of the threads' time since `since`. The result is 1 if they never waited
 * for a core, or if the kernel reports no times. */
double kd_cpu_pressure_share(const struct kd_cpu_pressure *since);

#endif

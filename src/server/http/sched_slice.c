#include "server/http/sched_slice.h"

#include <sched.h>
#include <stdint.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#define SLICE_NS 100000 /* shortest slice in ns that the kernel accepts */

/* The struct sched_attr of linux/sched/types.h, version 0. It is defined here because older C libraries lack it, and
 * newer ones have their own declaration. */
struct attributes {
    uint32_t size, policy;
    uint64_t flags;
    int32_t nice;
    uint32_t priority;
    uint64_t runtime, deadline, period;
};

void kd_sched_short_slices(void)
{
    static _Thread_local int asked;
    if (asked || sched_getscheduler(0) != SCHED_OTHER) /* a policy that was set for the whole process is kept */
        return;
    asked = 1;
    struct attributes a = {
        .size = sizeof a, .policy = SCHED_OTHER, .nice = getpriority(PRIO_PROCESS, 0), .runtime = SLICE_NS
    };
    syscall(SYS_sched_setattr, 0, &a, 0); /* a failure is ignored, because the short slice is only an optimisation */
}

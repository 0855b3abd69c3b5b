#include "base/nice.h"

#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

void kd_nice_thread(int more)
{
    const id_t self = (id_t)syscall(SYS_gettid);
    setpriority(PRIO_PROCESS, self, getpriority(PRIO_PROCESS, self) + more);
}

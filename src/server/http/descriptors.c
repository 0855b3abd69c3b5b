#include "server/http/descriptors.h"

#include "base/log.h"
#include "server/http/connections.h"

#include <dirent.h>
#include <math.h>
#include <pthread.h>
#include <stdbool.h>
#include <sys/resource.h>

#define MOST 65536u /* upper bound of the limit, because each descriptor costs the kernel memory */
/* Number of descriptors for other uses: the device, files that are being sent, lingering sockets, connections that
 * have not sent anything yet, and health checks. */
#define RESERVE 200u

/* True if the limit of descriptors is sufficient for this number of connections. Each connection needs two: its
 * socket and a file to send. */
static bool fit(unsigned connections, rlim_t limit) { return 2 * kd_connections_most(connections) + RESERVE <= limit; }

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
static DIR *folder; /* /proc/self/fd, kept open */

double kd_descriptors_open(void)
{
    double n = 0;
    pthread_mutex_lock(&lock);
    if (folder)
        rewinddir(folder);
    else
        folder = opendir("/proc/self/fd");
    const bool known = folder;
    for (const struct dirent *one; known && (one = readdir(folder));)
        n += *one->d_name != '.';
    pthread_mutex_unlock(&lock);
    return known ? n : NAN;
}

unsigned kd_descriptors_for(unsigned connections)
{
    kd_descriptors_open();
    struct rlimit limit;
    unsigned n = connections;
    if (getrlimit(RLIMIT_NOFILE, &limit))
        return n;
    rlim_t wanted = limit.rlim_max < MOST ? limit.rlim_max : MOST;
    if (limit.rlim_cur < wanted) {
        struct rlimit raised = { wanted, limit.rlim_max };
        if (!setrlimit(RLIMIT_NOFILE, &raised))
            limit.rlim_cur = wanted;
    }
    while (n > 4 && !fit(n, limit.rlim_cur))
        n--;
    if (n < connections)
        kd_log(KD_LOG_WARN,
               "%llu descriptors (ulimit -n) are enough for %u connections; the limits of this server need %u",
               (unsigned long long)limit.rlim_cur, n, connections);
    return n;
}

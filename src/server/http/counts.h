/* Counters of requests for /metrics. */
#ifndef KD_SERVER_HTTP_COUNTS_H
#define KD_SERVER_HTTP_COUNTS_H

#include <stdint.h>

struct kd_sessions_counts {
    unsigned sessions, viewers;
    /* totals since the server's start; bytes counts each frame once, however many clients receive it */
    uint64_t frames, bytes;
};

struct kd_playground_sessions_counts {
    unsigned open, watchers;
    uint64_t bytes;         /* upper bound of the memory of all playgrounds, in bytes */
    uint64_t steps, events; /* totals since the server's start; steps counts the sub-steps of running playgrounds */
};

struct kd_jobs_counts {
    unsigned waiting, running, done, failed;
    uint64_t frames; /* number of frames that this server has finished since it started */
    uint64_t bytes;  /* size of all jobs on disk, in bytes */
};

#endif

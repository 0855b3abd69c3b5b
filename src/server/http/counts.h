/* Counters of requests for /metrics. */
#ifndef KD_SERVER_HTTP_COUNTS_H
#define KD_SERVER_HTTP_COUNTS_H

#include <stdint.h>

struct kd_sessions_counts {
    unsigned sessions, viewers;
    uint64_t frames, bytes; /* totals since the start; bytes: the size of each frame is counted once */
};

struct kd_playground_sessions_counts {
    unsigned open, watchers;
    uint64_t bytes;         /* upper bound of the memory of all playgrounds */
    uint64_t steps, events; /* totals since the start; steps: sub-steps of running playgrounds */
};

struct kd_jobs_counts {
    unsigned waiting, running, done, failed;
    uint64_t frames; /* number of frames that this server has finished since its start */
    uint64_t bytes;  /* size of all jobs on disk */
};

#endif

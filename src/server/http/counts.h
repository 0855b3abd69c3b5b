/* Counters of requests for /metrics. */
#ifndef KD_SERVER_HTTP_COUNTS_H
#define KD_SERVER_HTTP_COUNTS_H

#include <stdint.h>

struct kd_sessions_counts {
    unsigned sessions, viewers;
    uint64_t frames, bytes; /* published so far, of all; of those, once each */
};

struct kd_plays_counts {
    unsigned plays, watchers;
    uint64_t bytes;         /* of memory that they may take */
    uint64_t steps, events; /* so far, of all: sub-steps while they went on by themselves */
};

struct kd_jobs_counts {
    unsigned waiting, running, done, failed;
    uint64_t frames; /* finished by this server */
    uint64_t bytes;  /* of the frames of all jobs */
};

#endif

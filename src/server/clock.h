/* Milliseconds on the monotonic clock. */
#ifndef KD_SERVER_CLOCK_H
#define KD_SERVER_CLOCK_H

#include <time.h>

static inline double kd_clock_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec * 1e3 + (double)t.tv_nsec * 1e-6;
}

#endif

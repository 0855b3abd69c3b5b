/* Preemption points in long computations. A function that may compute for longer than some milliseconds calls kd_pause
 * every few thousand operations. On a thread that serves several requests (server/http/turns.h) that lets others run
 * first; everywhere else it does nothing. The caller must not hold a lock that others need meanwhile. Any thread. */
#ifndef KD_BASE_PAUSE_H
#define KD_BASE_PAUSE_H

#include <stdint.h>

extern _Thread_local void (*kd_pause_hook)(void); /* NULL: this thread serves one request only */

static inline void kd_pause(void)
{
    if (kd_pause_hook)
        kd_pause_hook();
}

/* Pauses at every n-th i of a loop. */
static inline void kd_pause_every(uint64_t i, uint64_t n)
{
    if (i % n == 0)
        kd_pause();
}

#endif

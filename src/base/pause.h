/* This gives long computations points of preemption. A function that may compute for longer than some milliseconds
 * calls kd_pause every few thousand operations; a thread that shares its processor among requests (server/http/turns.h)
 * then lets others go first. Everywhere else it does nothing. A caller of such functions may hold no lock that others
 * need meanwhile. Any thread. */
#ifndef KD_BASE_PAUSE_H
#define KD_BASE_PAUSE_H

#include <stdint.h>

extern _Thread_local void (*kd_pause_hook)(void); /* NULL: this thread shares nothing */

static inline void kd_pause(void)
{
    if (kd_pause_hook)
        kd_pause_hook();
}

/* In a loop: each n-th time. */
static inline void kd_pause_every(uint64_t i, uint64_t n)
{
    if (i % n == 0)
        kd_pause();
}

#endif

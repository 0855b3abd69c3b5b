/* Preemption points in long computations. A function that may compute for longer than some milliseconds calls
 * kd_pause every few thousand operations. On a thread that serves several requests (server/http/task_scheduler.h)
 * kd_pause lets others run first; everywhere else it does nothing. The caller must not hold a lock that another
 * request may need in the meantime. Any thread.
 *
 * When nobody waits for the result any more, kd_pause returns true, and continues to do so until the request ends. A
 * loop must then stop. Its result is incomplete and must not be stored for other requests. A function that returns a
 * status then returns KD_ECANCELLED. */
#ifndef KD_BASE_PAUSE_H
#define KD_BASE_PAUSE_H

#include <stdbool.h>
#include <stdint.h>

extern _Thread_local bool (*kd_pause_hook)(void); /* NULL if this thread does not serve several requests */

static inline bool kd_pause(void) { return kd_pause_hook && kd_pause_hook(); }

/* For use in a loop: calls kd_pause if i is a multiple of n. */
static inline bool kd_pause_every(uint64_t i, uint64_t n) { return i % n == 0 && kd_pause(); }

#endif

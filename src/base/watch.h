/* Debug checks on the server's threads, compiled in by -Dwatch=true. The program aborts with a backtrace when one of
 * these rules is broken:
 *
 *     A thread that answers requests never waits for a disk (fsync, unlink).
 *     A worker's slice takes at most 50 ms of the thread's processor time, and a lock is held for at most 2 ms of
 *     it.
 *     (A violation of less than four times these limits is tolerated twice for each thread.)
 *     No thread calls fsync while it holds a lock that request-answering threads also take.
 *     A slow lock, which is held while a driver opens or closes a device, may be held for any time, but a thread
 *     that answers requests never takes a slow lock.
 *
 * The linker redirects the calls of our own code to this file (src/base/meson.build). With KERRD_WATCH=tell in the
 * environment the program prints each violation and continues. Other builds contain none of this. Any thread. */
#ifndef KD_BASE_WATCH_H
#define KD_BASE_WATCH_H

#ifdef KD_WATCH
#include <stdbool.h>

void kd_watch_answers(void); /* marks the calling thread as one that answers requests */
void kd_watch_turn_begins(void);
void kd_watch_turn_ends(void);
void kd_watch_slow_lock(void); /* marks the lock that the calling thread took last as a slow lock */
/* Hooks for watch_calls.c. Each is called when the calling thread has taken a lock, has released a lock, is about to
 * use a disk (syncs: true for fsync), or is about to destroy a lock. */
void kd_watch_taken(const void *lock);
void kd_watch_given(const void *lock);
void kd_watch_disk(bool syncs);
void kd_watch_forget(const void *lock);
#else
static inline void kd_watch_answers(void) {}
static inline void kd_watch_turn_begins(void) {}
static inline void kd_watch_turn_ends(void) {}
static inline void kd_watch_slow_lock(void) {}
#endif

#endif

/* Rules of a server's threads, checked in a build with -Dwatch=true, which aborts where one is broken and names the
 * calls:
 *
 *     a thread that answers requests never waits for a disk (fsync, unlink);
 *     a worker's slice takes at most 50 ms of the thread's processor time, and a lock is held for at most 2 ms of that
 *       (four times as much at once, or the third time);
 *     nobody waits for a disk (fsync) while holding a lock that a thread which answers requests takes.
 *
 * The linker redirects the calls of our own code to this file (src/server/meson.build). With KERRD_WATCH=tell in the
 * environment the program prints each violation and continues. Other builds contain nothing of this. Any thread. */
#ifndef KD_BASE_WATCH_H
#define KD_BASE_WATCH_H

#ifdef KD_WATCH
void kd_watch_answers(void); /* the calling thread answers requests from now on */
void kd_watch_turn_begins(void);
void kd_watch_turn_ends(void);
#else
static inline void kd_watch_answers(void) {}
static inline void kd_watch_turn_begins(void) {}
static inline void kd_watch_turn_ends(void) {}
#endif

#endif

/* Rules of a server's threads, which a build with -Dwatch=true holds: it aborts where one is broken, says which, and
 * by which calls.
 *
 *   a thread that answers requests never waits for a disk (fsync, unlink);
 *   a worker's turn takes at most 50 ms of the thread's processor time, and a lock is held for at most 2 ms of that
 *     (four times as much at once, or the third time);
 *   nobody waits for a disk (fsync) while a lock is held that a thread which answers requests takes.
 *
 * The linker leads the calls of our own code here (src/server/meson.build); the environment's KERRD_WATCH=tell lets
 * the program say it, each time, and go on. Other builds have nothing of this. Any thread. */
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

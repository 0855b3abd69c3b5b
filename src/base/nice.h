/* Lowers the priority of a thread. */
#ifndef KD_BASE_NICE_H
#define KD_BASE_NICE_H

/* Adds `more` to the calling thread's niceness. Threads that it starts later, including the driver's, inherit it.
 * Does nothing if the system refuses. */
void kd_nice_thread(int more);

#endif

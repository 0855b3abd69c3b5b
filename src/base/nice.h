/* Lowers the priority of a thread. */
#ifndef KD_BASE_NICE_H
#define KD_BASE_NICE_H

/* Adds `more` to the calling thread's niceness. Threads that this thread starts later inherit it, including those of
 * the driver. Does nothing if the system refuses. */
void kd_nice_thread(int more);

#endif

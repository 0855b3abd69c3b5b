/* Lowers the priority of a thread. */
#ifndef KD_BASE_NICE_H
#define KD_BASE_NICE_H

/* Adds so much to the calling thread's niceness. Threads that it starts, the driver's too, have it from it. Where the
 * system refuses, all stays as it is. */
void kd_nice_thread(int more);

#endif

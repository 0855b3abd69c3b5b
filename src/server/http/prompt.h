/* Shorter scheduling slices for threads that do little work but are waited for, so that they run soon after they wake
 * even when all cores are busy. */
#ifndef KD_SERVER_HTTP_PROMPT_H
#define KD_SERVER_HTTP_PROMPT_H

/* The calling thread is one of these. It asks for short slices of time, which takes no privilege and no time off
 * others: of two that have had as little, the scheduler prefers the one whose slice ends first (EEVDF, Linux 6.12
 * on; older ones are asked in vain). */
void kd_prompt_thread(void);

#endif

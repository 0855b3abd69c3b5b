/* File descriptors: how many connections the process's limit allows, and how many descriptors are open. */
#ifndef KD_SERVER_HTTP_DESCRIPTORS_H
#define KD_SERVER_HTTP_DESCRIPTORS_H

/* Raises the soft limit of descriptors to the hard limit. Returns how many of the wanted connections fit within it,
 * next to all other descriptors. With so many, accept and open do not fail, and a connection over the limit gets an
 * answer. */
unsigned kd_descriptors_for(unsigned connections);

/* Open descriptors of this process; NAN where /proc is not available. After kd_descriptors_for has been called, this
 * function does not open a descriptor, so it works even when the limit is reached. Any thread. */
double kd_descriptors_open(void);

#endif

/* File descriptors: how many connections the limit of the process permits, and how many descriptors are open. */
#ifndef KD_SERVER_HTTP_DESCRIPTORS_H
#define KD_SERVER_HTTP_DESCRIPTORS_H

/* Raises the soft limit of descriptors to the hard limit. Returns how many of the wanted connections fit into it,
 * besides all other descriptors. With this number of connections, accept and open do not fail, and a connection
 * beyond the limit gets an answer. */
unsigned kd_descriptors_for(unsigned connections);

/* Number of open descriptors of this process; NAN if /proc is not available. After kd_descriptors_for was called,
 * this function opens no descriptor, so it works even at the limit. Any thread. */
double kd_descriptors_open(void);

#endif

/* File descriptors: how many connections the process's limit allows, and how many descriptors are open. */
#ifndef KD_SERVER_HTTP_DESCRIPTORS_H
#define KD_SERVER_HTTP_DESCRIPTORS_H

/* Raises the soft limit to the hard one. As many connections as are wanted, or as few as leave descriptors for all
 * else: then no accept and no open fails for want of one, and who is one too many is told so. */
unsigned kd_descriptors_for(unsigned connections);

/* Open descriptors of this process; NAN where /proc does not tell. After kd_descriptors_for it needs none of its
 * own: it can be asked when there is none left. Any thread. */
double kd_descriptors_open(void);

#endif

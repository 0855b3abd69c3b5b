/* Observations that are built into the program, from data/eht. */
#ifndef KD_OBSERVE_EMBEDDED_H
#define KD_OBSERVE_EMBEDDED_H

#include <stddef.h>

struct kd_embedded_observation {
    const char *name;
    const unsigned char *data; /* contents of a file, for kd_observation_read */
    size_t size;
};
/* the list ends with an entry whose name is NULL */
extern const struct kd_embedded_observation kd_embedded_observations[];
/* names of these observations, for messages */
#define KD_EMBEDDED_OBSERVATIONS "m87-2017-04-05-lo"

/* Returns NULL if there is no observation of this name. */
const struct kd_embedded_observation *kd_embedded_observation_find(const char *name);

#endif

/* Observations that are part of the program, from data/eht. */
#ifndef KD_OBSERVE_EMBEDDED_H
#define KD_OBSERVE_EMBEDDED_H

#include <stddef.h>

struct kd_embedded_observation {
    const char *name;
    const unsigned char *data; /* file that kd_observation_read accepts */
    size_t size;
};
extern const struct kd_embedded_observation kd_embedded_observations[]; /* ends with a name of NULL */
#define KD_EMBEDDED_OBSERVATIONS "m87-2017-04-05-lo"                    /* their names, for messages */

/* NULL: there is none of this name. */
const struct kd_embedded_observation *kd_embedded_observation_find(const char *name);

#endif

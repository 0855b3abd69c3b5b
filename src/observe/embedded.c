#include "observe/embedded.h"

#include <string.h>

const struct kd_embedded_observation *kd_embedded_observation_find(const char *name)
{
    for (const struct kd_embedded_observation *o = kd_embedded_observations; o->name; o++)
        if (!strcmp(o->name, name))
            return o;
    return NULL;
}

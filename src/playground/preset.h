/* Presets of playgrounds. Any thread. */
#ifndef KD_PLAYGROUND_PRESET_H
#define KD_PLAYGROUND_PRESET_H

#include "playground/playground.h"

struct kd_playground_preset {
    const char *name, *title;
    double rate;             /* suggested speed of time, M per second */
    double centre[3], reach; /* suggested view: centre and half width, M */
    void (*settings)(struct kd_playground_params *params);
    /* Adds the preset's bodies to an empty playground. The playground may have other settings than the preset's. */
    enum kd_status (*fill)(struct kd_playground *p, struct kd_error *error);
    const char *scene; /* JSON of a suitable scene, with the members that differ from the default scene */
};
extern const struct kd_playground_preset kd_playground_presets[];
extern const size_t kd_playground_n_presets;

/* The preset with this name; NULL if there is none. */
const struct kd_playground_preset *kd_playground_preset_of(const char *name);

#endif

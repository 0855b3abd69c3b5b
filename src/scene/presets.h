/* The table of presets behind kd_scene_preset. Internal to src/scene. */
#ifndef KD_SCENE_PRESETS_H
#define KD_SCENE_PRESETS_H

#include <stdbool.h>
#include <stddef.h>

struct kd_preset {
    const char *name, *label, *title; /* label: name for people; title: one sentence without a full stop */
    /* true: the preset is merged over the preset "smooth"; false: over the defaults */
    bool smooth;
    const char *json;
};
extern const struct kd_preset kd_presets[];
extern const size_t kd_preset_count;

#endif

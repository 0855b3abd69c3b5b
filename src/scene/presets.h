/* The table of presets that kd_scene_preset uses. Internal to src/scene. */
#ifndef KD_SCENE_PRESETS_H
#define KD_SCENE_PRESETS_H

#include <stdbool.h>
#include <stddef.h>

struct kd_preset {
    const char *name, *label, *title; /* label: readable name; title: one sentence without a full stop */
    /* true: the preset is merged onto the preset "smooth"; false: onto the defaults */
    bool smooth;
    const char *json;
};
extern const struct kd_preset kd_presets[];
extern const size_t kd_preset_count;

#endif

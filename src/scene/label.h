/* Names of presets for people, in addition to the identifiers. Any thread. */
#ifndef KD_SCENE_LABEL_H
#define KD_SCENE_LABEL_H

#include <stddef.h>

/* The name of the preset at this index, such as "Gas and stars"; NULL beyond the last. */
const char *kd_scene_preset_label(size_t index);

#endif

/* Readable names of presets, besides their identifiers. Any thread. */
#ifndef KD_SCENE_LABEL_H
#define KD_SCENE_LABEL_H

#include <stddef.h>

/* The readable name of the preset at this index, such as "Gas and stars"; NULL beyond the last preset. */
const char *kd_scene_preset_label(size_t index);

#endif

/* Presets have names for people, beside those by which programs ask for them. Any thread. */
#ifndef KD_SCENE_LABEL_H
#define KD_SCENE_LABEL_H

#include <stddef.h>

/* "Gas and stars" of the preset at that place in the list; NULL: there is none. */
const char *kd_scene_preset_label(size_t index);

#endif

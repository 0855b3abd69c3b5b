/* Suggests which field an unknown name was probably meant to be. Any thread. */
#ifndef KD_SCENE_HINT_H
#define KD_SCENE_HINT_H

#include "base/error.h"

#include <stddef.h>

/* Fails with KD_EINVAL for an unknown field. The error has the field's pointer and the nearest name, as in "did you
 * mean camera.r?". If no name is near, it has the names of the section. section: "" for the document itself; it need
 * not exist. index: that of the element, if the section is a list. */
enum kd_status kd_hint_unknown(struct kd_error *error, const char *section, size_t index, const char *name);

#endif

/* Guesses what someone may have meant by a name that does not exist. Any thread. */
#ifndef KD_SCENE_HINT_H
#define KD_SCENE_HINT_H

#include "base/error.h"

#include <stddef.h>

/* Fails with KD_EINVAL for a field that does not exist. The error has its pointer and the nearest name, "did you
 * mean camera.r?", or the names that the section knows when none is near. section: "" for the document itself; need
 * not exist. index: of the element, where the section is a list. */
enum kd_status kd_hint_unknown(struct kd_error *error, const char *section, size_t index, const char *name);

#endif

/* Elements of a list are known by their index, as documents and paths write it. Any thread. */
#ifndef KD_SCENE_ELEMENT_H
#define KD_SCENE_ELEMENT_H

#include "scene/table.h"

/* Reads an index: token is "0", "1", ... below the list's `most`, without leading zeros; else KD_EINVAL with the
 * pointer to it. */
enum kd_status kd_element_find(const struct kd_section *list, const char *token, size_t *index, struct kd_error *error);

/* A list grows by the next free index alone: KD_EINVAL for one beyond it, which names it. */
enum kd_status kd_element_reach(const struct kd_section *list, size_t size, size_t index, struct kd_error *error);

/* Checks that a list may have so many; else KD_EINVAL with the pointer to the first one that is too many. */
enum kd_status kd_element_count(const struct kd_section *list, size_t size, struct kd_error *error);

/* Spells "/spots/3". */
void kd_element_pointer(const struct kd_section *list, size_t index, char out[KD_PATH_SIZE]);

#endif

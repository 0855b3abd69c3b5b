/* Indices of list elements, as they are written in documents and paths. Any thread. */
#ifndef KD_SCENE_ELEMENT_H
#define KD_SCENE_ELEMENT_H

#include "scene/table.h"

/* Reads an index: "0", "1", ... below the list's `most`, without leading zeros. Otherwise returns KD_EINVAL with the
 * pointer to it. */
enum kd_status kd_element_find(const struct kd_section *list, const char *token, size_t *index, struct kd_error *error);

/* Checks that an index is at most `size`, because a list grows only by its next free index. Otherwise returns KD_EINVAL
 * with a message that names that index. */
enum kd_status kd_element_reach(const struct kd_section *list, size_t size, size_t index, struct kd_error *error);

/* Checks that a list may have `size` elements. Otherwise returns KD_EINVAL with the pointer to the first element beyond
 * the limit. */
enum kd_status kd_element_count(const struct kd_section *list, size_t size, struct kd_error *error);

/* Writes the JSON pointer of an element, such as "/spots/3". */
void kd_element_pointer(const struct kd_section *list, size_t index, char out[KD_PATH_SIZE]);

#endif

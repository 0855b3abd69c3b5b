/* Checks a value from a document or a command line against the row of its field, and stores it. Any thread. */
#ifndef KD_SCENE_VALUE_H
#define KD_SCENE_VALUE_H

#include "document/value.h"
#include "scene/table.h"

/* Stores the value; words of a WORDS field are read from the text of a STRING. On failure returns KD_EINVAL with the
 * field's pointer, the value and what is allowed; *scene is then unchanged. */
enum kd_status kd_value_store(struct kd_scene *scene, const struct kd_field *field, size_t index,
                              const struct kd_value *value, struct kd_error *error);

/* Checks the member "version", which must be 1. */
enum kd_status kd_value_version(const struct kd_value *value, struct kd_error *error);

/* Describes what a field allows, for messages. Ranges are written as "-1 to 1 M", words as "\"a\" and \"b\"", and a
 * BOOL as "true or false". */
void kd_value_allowed(const struct kd_field *field, char out[KD_ALLOWED_SIZE]);

#endif

/* Reads a JSON document into cJSON's tree, and refuses what cJSON accepts by mistake (see scan.h). Any thread. */
#ifndef KD_DOCUMENT_TREE_H
#define KD_DOCUMENT_TREE_H

#include "base/error.h"
#include "document/value.h"

#include <cjson/cJSON.h>
#include <stdbool.h>
#include <stddef.h>

/* Reads a document. The text need not end in a NUL. Returns KD_EINVAL without a pointer if the text is not a JSON
 * document, has more than `most` bytes, or has more than `values` values. Other requests may run during the call
 * (base/pause.h). Free *out with kd_tree_free, during which other requests may run as well. For a small tree
 * cJSON_Delete is sufficient. */
enum kd_status kd_tree_parse(const char *text, size_t length, size_t most, size_t values, cJSON **out,
                             struct kd_error *error);
void kd_tree_free(cJSON *root); /* accepts NULL */

/* Parses text of kerrd's own files. Returns NULL if the text is not JSON, or when out of memory; *starved is true
 * only in the second case. Free the result with cJSON_Delete. */
cJSON *kd_tree_read(const char *text, size_t length, bool *starved);

/* Converts an item to a value. The value is valid as long as the item. */
struct kd_value kd_tree_value(const cJSON *item);

#endif

/* Finds, in one pass over the bytes, what cJSON accepts although a scene document may not contain it. Any thread.
 *
 * cJSON skips any byte below 33 as a blank; accepts 01, 1. and raw control characters in strings; cuts a key at an
 * escaped NUL, and takes \u00zz for one; reads only 63 bytes of a number; recurses 1000 deep; and does not check
 * UTF-8. */
#ifndef KD_SCENE_SCAN_H
#define KD_SCENE_SCAN_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Advances past a byte order mark, which readers ignore (RFC 8259, 8.1). An empty text may be NULL. */
void kd_scan_skip_mark(const char **text, size_t *length);

/* Checks a whole document, without byte order mark. most: the maximum number of values, each of which costs cJSON
 * some 64 bytes. KD_SCAN_FEW is far more than a scene has fields, so that an oversized document is refused cheaply. */
enum { KD_SCAN_FEW = 4096 };
enum kd_status kd_scan_json(const char *text, size_t length, size_t most, struct kd_error *error);

/* Checks only the bytes from start to end, of at most KD_SCAN_FEW values, for a reader that handles the rest itself.
 * Positions in messages count from text. */
enum kd_status kd_scan_json_part(const char *text, size_t start, size_t end, struct kd_error *error);

/* True if the object has a member of this name (ASCII letters); its values are not read. Undefined result if the
 * text is not JSON. */
bool kd_scan_names(const char *text, size_t length, const char *name);

#endif

/* Finds in one look at the bytes what cJSON lets pass and a scene document may not hold. Any thread.
 *
 * cJSON skips any byte below 33 as a blank, reads 01 and 1. and strings with raw control characters, cuts a
 * key at an escaped NUL and takes \u00zz for one, looks at 63 bytes of a number, recurses 1000 deep, and does
 * not check UTF-8. */
#ifndef KD_SCENE_SCAN_H
#define KD_SCENE_SCAN_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Moves the beginning of a text behind its byte order mark, which readers ignore (RFC 8259, 8.1). A text of no bytes
 * may be NULL. */
void kd_scan_skip_mark(const char **text, size_t *length);

/* Looks at a whole document, without such a mark. most: how many values it may hold, each of which costs cJSON some
 * 64 bytes. KD_SCAN_FEW is far more than a scene has fields: a document with more is wrong, and cheap to refuse. */
enum { KD_SCAN_FEW = 4096 };
enum kd_status kd_scan_json(const char *text, size_t length, size_t most, struct kd_error *error);

/* Looks at the bytes from start to end alone, of KD_SCAN_FEW values at most, for a reader that takes the rest
 * itself. Messages count from text. */
enum kd_status kd_scan_json_part(const char *text, size_t start, size_t end, struct kd_error *error);

/* Whether an object has a member of this name, of ASCII letters; found without reading its values. Of what is no
 * JSON it may say anything. */
bool kd_scan_names(const char *text, size_t length, const char *name);

#endif

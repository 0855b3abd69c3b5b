/* Checks a document, in one pass over its bytes, for everything that cJSON accepts although a scene document must
 * not contain it. Any thread.
 * cJSON skips any byte below 33 as if it were a blank. It accepts 01, 1. and raw control characters in strings. It
 * truncates a key at an escaped NUL, and reads \u00zz as such a NUL. It reads only 63 bytes of a number, recurses
 * 1000 levels deep, and does not check UTF-8. */
#ifndef KD_DOCUMENT_SCAN_H
#define KD_DOCUMENT_SCAN_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>

/* Advances past a byte order mark, which readers ignore (RFC 8259, 8.1). text may be NULL if the length is 0. */
void kd_scan_skip_mark(const char **text, size_t *length);

/* Checks a whole document that has no byte order mark. most: limit of the number of values, because each value costs
 * cJSON some 64 bytes. KD_SCAN_FEW is far more than a scene has fields. Because of this limit, a document that is
 * too large is refused at little cost. */
enum { KD_SCAN_FEW = 4096 };
enum kd_status kd_scan_json(const char *text, size_t length, size_t most, struct kd_error *error);

/* Checks only the bytes from start to end, with at most KD_SCAN_FEW values. For callers that read the other bytes
 * themselves. Positions in messages are counted from text. */
enum kd_status kd_scan_json_part(const char *text, size_t start, size_t end, struct kd_error *error);

/* True if the object has a member with this name; the name must consist of ASCII letters. Values are not read. If
 * the text is not JSON, the result is undefined. */
bool kd_scan_names(const char *text, size_t length, const char *name);

#endif

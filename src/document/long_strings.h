/* Handles long strings of a JSON document, such as a playground's debris. cJSON would read such a string for up to
 * 200 ms without a pause. Long strings are therefore cut out of the text before cJSON parses it, and inserted into
 * cJSON's tree afterwards. The document must have been checked by scan.h, so that all escapes are complete. Any
 * thread. */
#ifndef KD_DOCUMENT_LONG_STRINGS_H
#define KD_DOCUMENT_LONG_STRINGS_H

#include "base/error.h"

#include <cjson/cJSON.h>
#include <stdbool.h>

#define KD_LONG_STRING ((size_t)4 << 20) /* minimum size of a long string, in bytes */

struct kd_long_strings {
    const char *text; /* text of the whole document */
    size_t n, length; /* n: number of long strings; length: size of the text without them */
    struct {
        size_t start, end;
        bool escapes;
    } at[32]; /* places of the long strings in the document; when the array is full, further strings stay in the text */
};

void kd_long_strings_find(struct kd_long_strings *strings, const char *text, size_t length);
/* Copies the text without the long strings. out has room for strings->length bytes. */
void kd_long_strings_cut(const struct kd_long_strings *strings, size_t length, char *out);
/* Converts an offset in the shortened text to the offset in the document. */
size_t kd_long_strings_place(const struct kd_long_strings *strings, size_t at);
/* Inserts the long strings into the tree that was made from the shortened text. KD_ENOMEM. */
enum kd_status kd_long_strings_fill(const struct kd_long_strings *strings, cJSON *root, struct kd_error *error);

#endif

/* Long strings of a JSON document, such as a playground's debris: cJSON would read one in a single piece of up to 200
 * ms. They are cut out before it reads the rest, and put into its tree afterwards. The document has been scanned
 * (scan.h), so that each escape is a whole one. Any thread. */
#ifndef KD_SCENE_LONG_STRINGS_H
#define KD_SCENE_LONG_STRINGS_H

#include "base/error.h"

#include <cjson/cJSON.h>
#include <stdbool.h>

#define KD_LONG_STRING ((size_t)4 << 20) /* bytes from which on a string is long */

struct kd_long_strings {
    const char *text; /* of the document */
    size_t n, length; /* of the text without them */
    struct {
        size_t start, end;
        bool escapes;
    } at[32]; /* others stay where they are */
};

void kd_long_strings_find(struct kd_long_strings *strings, const char *text, size_t length);
/* Copies the text without them. out has room for strings->length bytes. */
void kd_long_strings_cut(const struct kd_long_strings *strings, size_t length, char *out);
/* The place in the document of a place in what cut has copied. */
size_t kd_long_strings_place(const struct kd_long_strings *strings, size_t at);
/* Puts them into the tree of what cut has copied. KD_ENOMEM. */
enum kd_status kd_long_strings_fill(const struct kd_long_strings *strings, cJSON *root, struct kd_error *error);

#endif

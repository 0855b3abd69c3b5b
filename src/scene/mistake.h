/* The commonest mistakes of people who write JSON by hand, each in words that say what to write instead. Pure, any
 * thread. */
#ifndef KD_SCENE_MISTAKE_H
#define KD_SCENE_MISTAKE_H

#include <stddef.h>

/* What is wrong at a place where the text is no JSON; NULL: nothing that is known here. before: the last character
 * of syntax before that place, 'v' for the end of a value, 0 at the beginning. */
const char *kd_json_mistake(const char *text, size_t length, size_t at, char before);

/* What encoding a text has that is no UTF-8, "UTF-16" or "UTF-32"; NULL: none of these. */
const char *kd_json_encoding(const char *text, size_t length);

#endif

/* Recognises the most common mistakes in hand-written JSON, and says what to write instead. Pure, any thread. */
#ifndef KD_DOCUMENT_MISTAKE_H
#define KD_DOCUMENT_MISTAKE_H

#include <stddef.h>

/* Explains why the JSON is not valid at offset `at`. Returns NULL if this is none of the known mistakes. before: the
 * last syntax character before `at`; 'v' stands for the end of a value, and 0 for the beginning of the text. */
const char *kd_json_mistake(const char *text, size_t length, size_t at, char before);

/* Guesses the encoding of text that is not UTF-8. Returns "UTF-16", "UTF-32", or NULL if it is neither. */
const char *kd_json_encoding(const char *text, size_t length);

#endif

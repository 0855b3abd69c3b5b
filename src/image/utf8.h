/* PNG chunks need this little of text encodings. Any thread. */
#ifndef KD_IMAGE_UTF8_H
#define KD_IMAGE_UTF8_H

#include <stdbool.h>
#include <stddef.h>

bool kd_utf8_ascii(const char *text);
bool kd_utf8_valid(const char *text); /* RFC 3629: no overlong form, no surrogate, nothing past U+10FFFF */

/* Latin-1 to UTF-8: bytes needed with the NUL; copy, returning the byte after the NUL. */
size_t kd_latin1_size(const char *text);
char *kd_latin1_copy(char *to, const char *text);

#endif

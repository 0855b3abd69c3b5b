#include "image/utf8.h"

#include "base/utf8.h"

#include <string.h>

bool kd_utf8_ascii(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text >= 0x80)
            return false;
    return true;
}

bool kd_utf8_valid(const char *text)
{
    for (size_t left = strlen(text), n; left; text += n, left -= n)
        if (!(n = kd_utf8_sequence(text, left)))
            return false;
    return true;
}

size_t kd_latin1_size(const char *text)
{
    size_t n = 1;
    for (; *text; text++)
        n += (unsigned char)*text < 0x80 ? 1 : 2;
    return n;
}

char *kd_latin1_copy(char *to, const char *text)
{
    for (; *text; text++) {
        unsigned char c = (unsigned char)*text;
        if (c < 0x80) {
            *to++ = (char)c;
        } else {
            *to++ = (char)(0xc0 | c >> 6);
            *to++ = (char)(0x80 | (c & 0x3f));
        }
    }
    *to++ = 0;
    return to;
}

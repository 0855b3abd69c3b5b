#include "base/utf8.h"

#include <stdint.h>
#include <string.h>

bool kd_utf8_ascii(const char *text)
{
    for (; *text; text++)
        if ((unsigned char)*text >= 0x80)
            return false;
    return true;
}

/* Bytes of the sequence that starts here, 0 if it is none. Stops at the NUL, which continues nothing. */
static size_t sequence(const unsigned char *p)
{
    static const uint32_t least[5] = { 0, 0, 0x80, 0x800, 0x10000 };
    size_t n = p[0] < 0x80 ? 1 : p[0] >> 5 == 6 ? 2 : p[0] >> 4 == 14 ? 3 : p[0] >> 3 == 30 ? 4 : 0;
    if (n < 2)
        return n;
    uint32_t code = p[0] & (0x7fu >> n);
    for (size_t i = 1; i < n; i++) {
        if (p[i] >> 6 != 2)
            return 0;
        code = code << 6 | (p[i] & 0x3fu);
    }
    return code < least[n] || code > 0x10ffff || code >> 11 == 0x1b ? 0 : n;
}

bool kd_utf8_valid(const char *text)
{
    const unsigned char *p = (const unsigned char *)text;
    while (*p) {
        size_t n = sequence(p);
        if (!n)
            return false;
        p += n;
    }
    return true;
}

void kd_utf8_print(char *to, size_t size, const char *text)
{
    static const char digits[] = "0123456789abcdef";
    const unsigned char *p = (const unsigned char *)text;
    while (*p) {
        const size_t n = sequence(p);
        const bool printing = n && *p >= 0x20 && *p != 0x7f && !(n == 2 && p[0] == 0xc2 && p[1] < 0xa0);
        const size_t room = printing ? n : 4;
        if (room >= size)
            break;
        if (printing)
            memcpy(to, p, n);
        else
            memcpy(to, (const char[4]) { '\\', 'x', digits[*p >> 4], digits[*p & 15] }, 4);
        to += room, size -= room;
        p += printing ? n : 1;
    }
    *to = 0;
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

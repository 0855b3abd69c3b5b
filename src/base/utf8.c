#include "base/utf8.h"

#include <string.h>

size_t kd_utf8_sequence(const char *text, size_t length)
{
    const unsigned char *p = (const unsigned char *)text;
    if (!length)
        return 0;
    if (p[0] < 0x80)
        return 1;
    size_t n = p[0] >= 0xc2 && p[0] <= 0xdf   ? 2
               : p[0] >= 0xe0 && p[0] <= 0xef ? 3
               : p[0] >= 0xf0 && p[0] <= 0xf4 ? 4
                                              : 0;
    if (!n || n > length)
        return 0;
    for (size_t i = 1; i < n; i++)
        if ((p[i] & 0xc0) != 0x80)
            return 0;
    /* The second byte shows whether the sequence is an overlong form, a surrogate or a code point beyond U+10FFFF. */
    if ((p[0] == 0xe0 && p[1] < 0xa0) || (p[0] == 0xed && p[1] > 0x9f) || (p[0] == 0xf0 && p[1] < 0x90) ||
        (p[0] == 0xf4 && p[1] > 0x8f))
        return 0;
    return n;
}

bool kd_utf8_is_control(const char *text, size_t n)
{
    const unsigned char *p = (const unsigned char *)text;
    return (n == 1 && (p[0] < 0x20 || p[0] == 0x7f)) || (n == 2 && p[0] == 0xc2 && p[1] < 0xa0);
}

static void mend(char *text, bool controls)
{
    for (size_t left = strlen(text), n; left; text += n, left -= n) {
        n = kd_utf8_sequence(text, left);
        if (!n || (controls && kd_utf8_is_control(text, n)))
            memset(text, strchr("\n\t\r", *text) ? ' ' : '?', n ? n : 1);
        n = n ? n : 1;
    }
}

void kd_utf8_sanitize(char *text) { mend(text, false); }

void kd_utf8_show(char *text) { mend(text, true); }

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

void kd_utf8_print(char *to, size_t size, const char *text)
{
    static const char digits[] = "0123456789abcdef";
    for (size_t left = strlen(text), step; left; text += step, left -= step) {
        const size_t n = kd_utf8_sequence(text, left);
        const bool printing = n && !kd_utf8_is_control(text, n);
        const size_t room = printing ? n : 4;
        if (room >= size)
            break;
        if (printing)
            memcpy(to, text, n);
        else
            memcpy(to, (const char[4]) { '\\', 'x', digits[(unsigned char)*text >> 4], digits[*text & 15] }, 4);
        to += room, size -= room;
        step = printing ? n : 1;
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

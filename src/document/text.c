#include "document/text.h"

#include "base/utf8.h"

#include <string.h>

const char *kd_text_or(size_t i, size_t n) { return !i ? "" : i + 1 < n ? ", " : " or "; }

void kd_text_clip(char *out, size_t size, const char *text)
{
    size_t used = 0, length = strnlen(text, size), whole = 0;
    for (size_t i = 0; i < length;) {
        size_t n = kd_utf8_sequence(text + i, length - i), step = n ? n : 1;
        int plain = n && !kd_utf8_is_control(text + i, n);
        if (used + (plain ? n : 1) >= size) {
            strcpy(out + whole, "...");
            return;
        }
        if (plain)
            memcpy(out + used, text + i, n);
        else
            out[used] = '?';
        used += plain ? n : 1;
        i += step;
        if (used + 3 < size)
            whole = used; /* end of the longest part after which "..." still fits */
    }
    out[used] = 0;
}

void kd_text_pointer(char *pointer, size_t size, const char *token)
{
    size_t start = strlen(pointer), used = start;
    if (used + 1 >= size)
        return;
    pointer[used++] = '/';
    for (; *token; token++) {
        int escape = *token == '~' || *token == '/';
        if (used + 1 + (size_t)escape >= size) {
            pointer[start] = 0;
            return;
        }
        if (escape)
            pointer[used++] = '~';
        pointer[used++] = *token == '~' ? '0' : *token == '/' ? '1' : *token;
    }
    pointer[used] = 0;
}

struct kd_text_place kd_text_place_of(const char *text, size_t at)
{
    struct kd_text_place place = { 1, 1 };
    for (size_t i = 0; i < at; i++) {
        if (text[i] == '\n')
            place = (struct kd_text_place) { place.line + 1, 1 };
        else if (((unsigned char)text[i] & 0xc0) != 0x80) /* true if the byte starts a character */
            place.column++;
    }
    return place;
}

#include "document/long_strings.h"

#include "base/pause.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* placeholder of a long string; this byte never occurs in UTF-8, so no text or escape can contain it */
#define MARK '\xff'
#define PIECE ((size_t)1 << 20)

/* Returns the index of a string's closing quote; the string begins at `at`. *escapes: true if the string contains
 * escapes. */
static size_t end_of(const char *text, size_t length, size_t at, bool *escapes)
{
    const char *quote = memchr(text + at, '"', length - at);
    size_t end = quote ? (size_t)(quote - text) : length;
    *escapes = memchr(text + at, '\\', end - at);
    if (!*escapes)
        return end;
    uint64_t characters = 0;
    for (end = at; end < length && text[end] != '"'; end++) {
        kd_pause_every(++characters, PIECE / 4);
        end += text[end] == '\\';
    }
    return end < length ? end : length;
}

void kd_long_strings_find(struct kd_long_strings *strings, const char *text, size_t length)
{
    *strings = (struct kd_long_strings) { .text = text, .length = length };
    if (length < KD_LONG_STRING)
        return;
    const size_t most = sizeof strings->at / sizeof *strings->at;
    const char *quote;
    for (size_t at = 0, i = 0; strings->n < most && at < length && (quote = memchr(text + at, '"', length - at)); i++) {
        bool escapes;
        kd_pause_every(i, 4096);
        const size_t start = (size_t)(quote - text) + 1, end = end_of(text, length, start, &escapes);
        if (end - start >= KD_LONG_STRING) {
            strings->at[strings->n].start = start;
            strings->at[strings->n].escapes = escapes;
            strings->at[strings->n++].end = end;
            strings->length -= end - start - 1;
        }
        at = end + 1;
    }
}

static char *copy(char *to, const char *from, size_t n)
{
    for (size_t at = 0; at < n; at += PIECE) {
        kd_pause();
        memcpy(to + at, from + at, n - at < PIECE ? n - at : PIECE);
    }
    return to + n;
}

void kd_long_strings_cut(const struct kd_long_strings *strings, size_t length, char *out)
{
    size_t at = 0;
    for (size_t i = 0; i < strings->n; i++) {
        out = copy(out, strings->text + at, strings->at[i].start - at);
        *out++ = MARK;
        at = strings->at[i].end;
    }
    copy(out, strings->text + at, length - at);
}

size_t kd_long_strings_place(const struct kd_long_strings *strings, size_t at)
{
    for (size_t i = 0; i < strings->n && at > strings->at[i].start; i++)
        at += strings->at[i].end - strings->at[i].start - 1;
    return at;
}

static unsigned digits(const char *text)
{
    char four[5] = "";
    memcpy(four, text, 4);
    return (unsigned)strtoul(four, NULL, 16);
}

/* Encodes a character in UTF-8 (RFC 3629, section 3). */
static char *put_utf8(char *to, unsigned code)
{
    if (code < 0x80) {
        *to++ = (char)code;
        return to;
    }
    const int more = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    *to++ = (char)((0xf00u >> (more + 1) & 0xff) | code >> 6 * more);
    for (int i = more - 1; i >= 0; i--)
        *to++ = (char)(0x80 | (code >> 6 * i & 0x3f));
    return to;
}

/* Decodes one escape, which was validated by the scan. Returns the position after the escape. */
static const char *unescape(const char *from, char **to)
{
    static const char names[] = "bfnrt", are[] = "\b\f\n\r\t";
    const char c = from[1], *name = strchr(names, c);
    if (c != 'u') {
        *(*to)++ = name ? are[name - names] : c;
        return from + 2;
    }
    const unsigned unit = digits(from + 2);
    /* a surrogate pair: its second half follows (RFC 8259, section 7) */
    const bool pair = unit >= 0xd800 && unit < 0xdc00;
    *to = put_utf8(*to, pair ? 0x10000 + ((unit - 0xd800) << 10) + (digits(from + 8) - 0xdc00) : unit);
    return from + (pair ? 12 : 6);
}

/* Copies a string and decodes its escapes. The result always fits, because no escape is shorter than its character. */
static char *copy_unescaped(char *to, const char *from, size_t n)
{
    const char *const end = from + n;
    for (uint64_t characters = 0; from < end;) {
        kd_pause_every(characters++, PIECE / 4);
        if (*from == '\\')
            from = unescape(from, &to);
        else
            *to++ = *from++;
    }
    return to;
}

/* State of the walk through the tree, with the next string to insert. */
struct fill {
    const struct kd_long_strings *strings;
    size_t next;
    uint64_t seen;
};

static bool put(struct fill *f, char **string)
{
    if (!*string || **string != MARK)
        return true;
    const size_t start = f->strings->at[f->next].start, n = f->strings->at[f->next].end - start;
    char *whole = cJSON_malloc(n + 1);
    if (!whole)
        return false;
    *(f->strings->at[f->next].escapes ? copy_unescaped : copy)(whole, f->strings->text + start, n) = 0;
    cJSON_free(*string);
    *string = whole;
    f->next++;
    return true;
}

/* Inserts the strings in the order of the document. The recursion is at most 32 levels deep. */
static bool fill(struct fill *f, cJSON *item)
{
    for (; item && f->next < f->strings->n; item = item->next) {
        kd_pause_every(f->seen++, 4096);
        if (!put(f, &item->string) || !put(f, &item->valuestring) || !fill(f, item->child))
            return false;
    }
    return true;
}

enum kd_status kd_long_strings_fill(const struct kd_long_strings *strings, cJSON *root, struct kd_error *error)
{
    struct fill f = { .strings = strings };
    return fill(&f, root) ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for a long string");
}

#include "document/scan.h"

#include "document/mistake.h"
#include "document/number.h"
#include "base/pause.h"
#include "base/utf8.h"
#include "document/text.h"

#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    DEPTH_MAX = 32,
    NUMBER_MAX = 60, /* limit of the length of a number in bytes; cJSON reads only 63 bytes of a number */
};

struct scan {
    const char *text;
    size_t length, at, values, most;
    int depth;
    char before; /* the last syntax character; 'v' stands for the end of a value, and 0 for the beginning */
    struct kd_error *error;
};

static enum kd_status fail(struct scan *s, size_t at, const char *what)
{
    const char *mistake = kd_json_mistake(s->text, s->length, at, s->before);
    struct kd_text_place place = kd_text_place_of(s->text, at);
    if (mistake)
        return kd_error_set(s->error, KD_EINVAL, "the document is not valid JSON at byte %zu, line %zu, column %zu: %s",
                            at, place.line, place.column, mistake);
    return kd_error_set(s->error, KD_EINVAL, "the document is not valid JSON: %s at byte %zu, line %zu, column %zu",
                        what, at, place.line, place.column);
}

/* Returns the value of the \u escape at `at`, or 0 if there is none. (An escape with the value 0 is refused anyway.) */
static unsigned unit_at(const struct scan *s, size_t at)
{
    char digits[5] = "";
    if (at + 6 > s->length || s->text[at] != '\\' || s->text[at + 1] != 'u')
        return 0;
    memcpy(digits, s->text + at + 2, 4);
    return (unsigned)strtoul(digits, NULL, 16);
}

/* Checks the escape whose backslash is at s->at. */
static enum kd_status escape(struct scan *s)
{
    char c = s->at + 1 < s->length ? s->text[s->at + 1] : 0;
    if (c != 'u') {
        if (!c || !strchr("\"\\/bfnrt", c))
            return fail(s, s->at, "unknown escape");
        s->at += 2;
        return KD_OK;
    }
    if (s->length - s->at < 6)
        return fail(s, s->at, "an escape that ends too early");
    for (int i = 2; i < 6; i++)
        if (!isxdigit((unsigned char)s->text[s->at + i]))
            return fail(s, s->at, "malformed escape");
    if (!memcmp(s->text + s->at + 2, "0000", 4))
        return fail(s, s->at, "NUL in a string");
    const unsigned unit = unit_at(s, s->at), next = unit_at(s, s->at + 6);
    const bool high = unit >= 0xd800 && unit < 0xdc00, low = unit >= 0xdc00 && unit < 0xe000;
    if (low || (high && (next < 0xdc00 || next >= 0xe000)))
        return fail(s, s->at, "half of a surrogate pair");
    s->at += high ? 12 : 6;
    return KD_OK;
}

static enum kd_status string(struct scan *s)
{
    size_t start = s->at++;
    for (uint64_t characters = 1; s->at < s->length; characters++) {
        kd_pause_every(characters, 1 << 18);
        char c = s->text[s->at];
        enum kd_status status = KD_OK;
        if (c == '"') {
            s->at++;
            return KD_OK;
        }
        if (c == '\\') {
            status = escape(s);
        } else if ((unsigned char)c < 0x20) {
            status = fail(s, s->at, "a control character in a string");
        } else {
            size_t n = kd_utf8_sequence(s->text + s->at, s->length - s->at);
            if (!n)
                return fail(s, s->at, "invalid UTF-8");
            s->at += n;
        }
        if (status)
            return status;
    }
    return fail(s, start, "a string without an end");
}

static enum kd_status number(struct scan *s)
{
    size_t n = kd_number_span(s->text + s->at, s->length - s->at);
    char next = s->at + n < s->length ? s->text[s->at + n] : 0;
    if (!n || (next && strchr("0123456789.+-eE", next)))
        return fail(s, s->at, "malformed number");
    if (n > NUMBER_MAX)
        return fail(s, s->at, "a number of more than 60 characters");
    s->at += n;
    return KD_OK;
}

static enum kd_status word(struct scan *s)
{
    static const char *const words[] = { "true", "false", "null" };
    size_t n = 0;
    while (s->at + n < s->length && (s->text[s->at + n] | 32) >= 'a' && (s->text[s->at + n] | 32) <= 'z')
        n++;
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        if (n == strlen(words[i]) && !memcmp(s->text + s->at, words[i], n)) {
            s->at += n;
            return KD_OK;
        }
    }
    char what[48];
    snprintf(what, sizeof what, "the unknown word %.*s", (int)(n < 24 ? n : 24), s->text + s->at);
    return fail(s, s->at, what);
}

static enum kd_status too_many(struct scan *s)
{
    char what[40];
    snprintf(what, sizeof what, "more than %zu values", s->most);
    return fail(s, s->at, what);
}

static enum kd_status mark(struct scan *s, char c)
{
    if (c == '{' || c == '[') {
        if (++s->depth > DEPTH_MAX)
            return fail(s, s->at, "nested deeper than 32 levels");
    } else if (c == '}' || c == ']') {
        if (s->before == ',' || s->before == ':')
            return fail(s, s->at, "a bracket where a value is missing");
        s->depth--; /* no check here, because cJSON itself finds brackets that do not match */
    } else if (c == ',') {
        if (s->before && strchr(",{[:", s->before))
            return fail(s, s->at, "a comma where a value is missing");
        if (++s->values >= s->most)
            return too_many(s);
    } else if (c && !strchr(": \t\n\r", c)) {
        return fail(s, s->at,
                    (c & 0x80) && !kd_utf8_sequence(s->text + s->at, s->length - s->at) ? "invalid UTF-8"
                                                                                        : "unexpected character");
    } else if (!c) {
        return fail(s, s->at, "NUL");
    }
    if (strchr("{[,:", c))
        s->before = c;
    else if (c == '}' || c == ']')
        s->before = 'v';
    s->at++;
    return KD_OK;
}

static enum kd_status scan(const char *text, size_t start, size_t end, size_t most, struct kd_error *error)
{
    struct scan s = { .text = text, .length = end, .at = start, .most = most, .error = error };
    enum kd_status status = KD_OK;
    const char *encoding = start ? NULL : kd_json_encoding(text, end);
    if (encoding)
        return kd_error_set(error, KD_EINVAL, "the document is not valid JSON: it is %s; JSON must be UTF-8", encoding);
    for (uint64_t tokens = 0; !status && s.at < end; tokens++) {
        kd_pause_every(tokens, 16384);
        char c = text[s.at];
        bool letter = (c | 32) >= 'a' && (c | 32) <= 'z',
             value = letter || c == '"' || c == '-' || (c >= '0' && c <= '9');
        if (value && s.before == 'v')
            return fail(&s, s.at,
                        s.depth > 0 || start ? "a value right after another, without a comma or a colon between them"
                                             : "text after the document");
        status = c == '"'                             ? string(&s)
                 : c == '-' || (c >= '0' && c <= '9') ? number(&s)
                 : letter                             ? word(&s)
                                                      : mark(&s, c);
        s.before = value ? 'v' : s.before;
    }
    return status;
}

void kd_scan_skip_mark(const char **text, size_t *length)
{
    if (*length < 3 || memcmp(*text, "\xef\xbb\xbf", 3))
        return;
    *text += 3;
    *length -= 3;
}

enum kd_status kd_scan_json(const char *text, size_t length, size_t most, struct kd_error *error)
{
    return scan(text, 0, length, most, error);
}

enum kd_status kd_scan_json_part(const char *text, size_t start, size_t end, struct kd_error *error)
{
    return scan(text, start, end, KD_SCAN_FEW, error);
}

/* Index of the closing quote of the string that starts at `at`; length of the text if there is none. */
static size_t end_of(const char *text, size_t length, size_t at)
{
    for (at++; at < length && text[at] != '"'; at++)
        at += text[at] == '\\';
    return at < length ? at : length;
}

/* True if the text of a string spells the name. Letters in the text may be escaped, as in \u0061. */
static bool spells(const char *text, size_t n, const char *name)
{
    char digits[5] = "";
    for (; n && *name; name++) {
        const bool escaped = n >= 6 && text[0] == '\\' && text[1] == 'u';
        if (escaped)
            memcpy(digits, text + 2, 4);
        if ((escaped ? strtoul(digits, NULL, 16) : (unsigned char)*text) != (unsigned char)*name)
            return false;
        text += escaped ? 6 : 1;
        n -= escaped ? 6 : 1;
    }
    return !n && !*name;
}

bool kd_scan_names(const char *text, size_t length, const char *name)
{
    size_t depth = 0;
    for (size_t at = 0; at < length; at++) {
        if (text[at] == '{' || text[at] == '[')
            depth++;
        if (text[at] == '}' || text[at] == ']')
            depth--;
        if (text[at] != '"')
            continue;
        const size_t start = at + 1;
        at = end_of(text, length, at);
        size_t next = at + 1;
        while (next < length && strchr(" \t\r\n", text[next]) && text[next])
            next++;
        if (depth == 1 && next < length && text[next] == ':' && spells(text + start, at - start, name))
            return true;
    }
    return false;
}

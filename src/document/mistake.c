#include "document/mistake.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>
#include <strings.h>

static const struct {
    const char *word, *says;
} words[] = {
    { "nan", "NaN, which JSON lacks: leave the member out" },
    { "infinity", "Infinity, which JSON lacks: a field that accepts it needs the string \"infinity\"" },
    { "-infinity", "Infinity, which JSON lacks: a field that accepts it needs the string \"infinity\"" },
    { "inf", "inf, which JSON lacks: a field that accepts it needs the string \"infinity\"" },
    { "-inf", "inf, which JSON lacks: a field that accepts it needs the string \"infinity\"" },
    { "none", "None, which is null in JSON" },
    { "undefined", "undefined, which is null in JSON" },
    { "nil", "nil, which is null in JSON" },
    { "true", "a word in capitals, which is true in JSON" },
    { "false", "a word in capitals, which is false in JSON" },
    { "null", "a word in capitals, which is null in JSON" },
};

/* Length of the word that starts here, including a sign. */
static size_t span(const char *text, size_t length)
{
    size_t n = length && *text == '-';
    while (n < length && (isalnum((unsigned char)text[n]) || text[n] == '_' || text[n] == '$' || text[n] == '.'))
        n++;
    return n;
}

static bool is_json(const char *word, size_t length)
{
    return (length == 4 && (!memcmp(word, "true", 4) || !memcmp(word, "null", 4))) ||
           (length == 5 && !memcmp(word, "false", 5));
}

static const char *about_word(const char *text, size_t length, char before)
{
    const size_t n = span(text, length);
    size_t next = n;
    while (next < length && text[next] && strchr(" \t\r\n", text[next]))
        next++;
    if (n && next < length && text[next] == ':' && (before == '{' || before == ','))
        return "a name without double quotes";
    for (size_t i = 0; i < sizeof words / sizeof *words; i++)
        if (n == strlen(words[i].word) && !strncasecmp(text, words[i].word, n) && !is_json(text, n))
            return words[i].says;
    return NULL;
}

static bool is_quote(const char *text, size_t length) /* True for a typographic quote (U+2018 to U+201F). */
{
    return length > 2 && !memcmp(text, "\xe2\x80", 2) && (unsigned char)text[2] >= 0x98 &&
           (unsigned char)text[2] <= 0x9f;
}

const char *kd_json_mistake(const char *text, size_t length, size_t at, char before)
{
    const char *here = text + at;
    const size_t left = length - at;
    if (!left)
        return NULL;
    if (*here == '}' || *here == ']')
        return before == ','   ? "a bracket after a comma: JSON has no comma after the last value"
               : before == ':' ? "no value after a colon"
                               : NULL;
    if (*here == ',')
        return before == ',' || before == '{' || before == '[' || before == ':' ? "a comma without a value before it"
                                                                                : NULL;
    if (*here == '\'')
        return "a single quote: in JSON, strings and names have double quotes";
    if (is_quote(here, left))
        return "a typographic quote: in JSON, strings and names have plain double quotes (\")";
    if (*here == '#' || (*here == '/' && left > 1 && (here[1] == '/' || here[1] == '*')))
        return "a comment, which JSON lacks";
    if (*here == '.')
        return "a point without a digit before it: .5 is 0.5 in JSON";
    if (*here == '+')
        return "a plus before a number, which JSON lacks";
    if (*here == '=')
        return "an equals sign: in JSON a colon separates name and value";
    return about_word(here, left, before);
}

const char *kd_json_encoding(const char *text, size_t length)
{
    if (length >= 4 && (!memcmp(text, "\xff\xfe\0\0", 4) || !memcmp(text, "\0\0\xfe\xff", 4) ||
                        (!text[1] && !text[2] && (!text[0] || !text[3]))))
        return "UTF-32";
    if (length >= 2 && (!memcmp(text, "\xff\xfe", 2) || !memcmp(text, "\xfe\xff", 2) || (!text[0] != !text[1])))
        return "UTF-16";
    return NULL;
}

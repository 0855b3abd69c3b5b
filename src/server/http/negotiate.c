#include "server/http/negotiate.h"

#include <stddef.h>
#include <ctype.h>
#include <string.h>
#include <strings.h>

struct span {
    const char *at;
    size_t size;
};

static bool blank(char c) { return c == ' ' || c == '\t'; }

static struct span trim(struct span s)
{
    while (s.size && blank(*s.at))
        s.at++, s.size--;
    while (s.size && blank(s.at[s.size - 1]))
        s.size--;
    return s;
}

static bool equals(struct span s, const char *text)
{
    return s.size == strlen(text) && !strncasecmp(s.at, text, s.size);
}

/* Returns the text before the separator. *rest is moved to the text after the separator, or is set to NULL at the
 * end. Separators in quoted text are skipped. */
static struct span take(const char **rest, char separator)
{
    const char *start = *rest, *p = start;
    bool quoted = false;

    for (; *p && (quoted || *p != separator); p++) {
        if (*p == '"')
            quoted = !quoted;
        else if (quoted && *p == '\\' && p[1])
            p++;
    }
    *rest = *p ? p + 1 : NULL;
    return trim((struct span) { start, (size_t)(p - start) });
}

/* Parses a weight (RFC 9110 12.4.2), such as 0, 0.5 or 1.000. Returns it in thousandths, or -1 if it is malformed. */
static int weight(struct span s)
{
    if (!s.size || s.size > 5 || (s.at[0] != '0' && s.at[0] != '1') || (s.size > 1 && s.at[1] != '.'))
        return -1;
    int value = (s.at[0] - '0') * 1000, place = 100;
    for (size_t i = 2; i < s.size; i++, place /= 10) {
        if (s.at[i] < '0' || s.at[i] > '9')
            return -1;
        value += (s.at[i] - '0') * place;
    }
    return value <= 1000 ? value : -1;
}

/* How closely a media range matches a type. 3: the whole type is the same; 2: the same before the slash; 1: the
 * range matches all types; 0: no match. */
static int fit(struct span range, const char *type)
{
    size_t family = strcspn(type, "/") + 1;
    if (equals(range, type))
        return 3;
    if (range.size == family + 1 && !strncasecmp(range.at, type, family) && range.at[family] == '*')
        return 2;
    return equals(range, "*/*") ? 1 : 0;
}

static int entry_weight(const char *parameters)
{
    int q = 1000;
    while (parameters) {
        struct span parameter = take(&parameters, ';');
        if (parameter.size >= 2 && (parameter.at[0] | 0x20) == 'q' && parameter.at[1] == '=')
            q = weight((struct span) { parameter.at + 2, parameter.size - 2 });
    }
    return q;
}

/* An entry of a weighted list. `name` points into `text`; weight is -1 if the weight is malformed. */
struct entry {
    char text[256];
    struct span name;
    int weight;
};

/* Reads the next entry that is not empty and not too long. Moves *list past it. Returns false at the end. */
static bool next_entry(const char **list, struct entry *out)
{
    while (*list) {
        struct span entry = take(list, ',');
        if (!entry.size || entry.size >= sizeof out->text)
            continue;
        memcpy(out->text, entry.at, entry.size);
        out->text[entry.size] = 0;
        const char *rest = out->text;
        out->name = take(&rest, ';');
        out->weight = entry_weight(rest);
        return true;
    }
    return false;
}

/* Weight of a type in thousandths; 0: the type is not acceptable. */
static int type_weight(const char *accept, const char *type)
{
    struct entry entry;
    int best = 0, best_weight = 0;

    if (!accept || !accept[strspn(accept, " \t")])
        return 1000;
    while (next_entry(&accept, &entry)) {
        int how = fit(entry.name, type);
        if (entry.weight >= 0 && (how > best || (how == best && entry.weight > best_weight))) {
            best = how;
            best_weight = entry.weight;
        }
    }
    return best ? best_weight : 0;
}

const char *kd_accept_string(size_t i, const void *list) { return ((const char *const *)list)[i]; }

size_t kd_accept_best(const char *accept, size_t n, const char *(*type)(size_t i, const void *list), const void *list)
{
    size_t best = n;
    int most = 0;
    for (size_t i = 0; i < n; i++) {
        int wanted = type_weight(accept, type(i, list));
        if (wanted > most) {
            best = i;
            most = wanted;
        }
    }
    return best;
}

bool kd_accepts_coding(const char *accept_encoding, const char *coding)
{
    struct entry entry;
    int named = -1, any = -1;

    while (next_entry(&accept_encoding, &entry)) {
        if (equals(entry.name, coding))
            named = entry.weight;
        else if (equals(entry.name, "*"))
            any = entry.weight;
    }
    return (named >= 0 ? named : any) > 0;
}

bool kd_etag_listed(const char *if_none_match, const char *etag)
{
    while (if_none_match) {
        struct span tag = take(&if_none_match, ',');
        if (equals(tag, "*"))
            return true;
        if (tag.size > 2 && tag.at[0] == 'W' && tag.at[1] == '/')
            tag.at += 2, tag.size -= 2;
        if (tag.size == strlen(etag) && !memcmp(tag.at, etag, tag.size))
            return true;
    }
    return false;
}

bool kd_etag_matches(const char *if_match, const char *etag)
{
    while (if_match) {
        struct span tag = take(&if_match, ',');
        if (equals(tag, "*") || (etag && tag.size == strlen(etag) && !memcmp(tag.at, etag, tag.size)))
            return true;
    }
    return false;
}

bool kd_host_is_sound(const char *host)
{
    const bool literal = *host == '[';
    const char *end =
        literal ? strchr(host, ']')
                : host + strspn(host, "0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ-._~!$&'()*+,;=%");
    if (!end || end == host)
        return false;
    if (literal && strspn(host + 1, "0123456789abcdefABCDEF:.") != (size_t)(end - host - 1))
        return false;
    end += literal;
    return !*end || (*end == ':' && !end[1 + strspn(end + 1, "0123456789")]);
}

bool kd_media_type_is(const char *content_type, const char *type)
{
    return content_type && equals(take(&content_type, ';'), type);
}

bool kd_host_listed(const char *host, const char *const *names)
{
    size_t size = *host == '[' ? strcspn(host, "]") + 1 : strcspn(host, ":");
    if (*host == '[' && !strchr(host, ']'))
        return false;
    const char *port = host + size;
    if (*port && (*port != ':' || strlen(port) > 6 || port[1 + strspn(port + 1, "0123456789")]))
        return false;
    const size_t plain = size - (size > 1 && host[size - 1] == '.' &&
                                 /* a final dot is ignored: "localhost." is the same name as "localhost" (RFC 1034
                                  * 3.1) */
                                 !isdigit((unsigned char)host[size - 2]));
    for (; *names; names++)
        if (equals((struct span) { host, size }, *names) || equals((struct span) { host, plain }, *names))
            return true;
    return false;
}

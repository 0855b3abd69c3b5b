#include "server/http/target.h"

#include "base/utf8.h"
#include "document/text.h"

#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static int hex(char c)
{
    if (c >= '0' && c <= '9')
        return c - '0';
    c |= 0x20;
    return c >= 'a' && c <= 'f' ? c - 'a' + 10 : -1;
}

/* Decodes percent escapes in place, which is possible because the result is never longer. */
static enum kd_status decode(char *text, bool plus, struct kd_error *error)
{
    char *to = text;
    for (const char *from = text; *from; from++) {
        int c = (unsigned char)*from;
        if (c == '%') {
            int high = hex(from[1]), low = high < 0 ? -1 : hex(from[2]);
            if (low < 0)
                return kd_error_set(error, KD_EINVAL, "the request target has a %% without two hexadecimal digits");
            c = high << 4 | low;
            from += 2;
        } else if (c == '+' && plus) {
            c = ' ';
        }
        if (c < 0x20 || c == 0x7f)
            return kd_error_set(error, KD_EINVAL, "the request target has a control character");
        *to++ = (char)c;
    }
    *to = 0;
    if (!kd_utf8_valid(text))
        return kd_error_set(error, KD_EINVAL, "the request target is not UTF-8");
    return KD_OK;
}

static enum kd_status add_pair(struct kd_target *target, char *pair, struct kd_error *error)
{
    static char empty[1];

    if (!*pair)
        return KD_OK;
    if (target->n_pairs == KD_TARGET_PAIRS)
        return kd_error_set(error, KD_EINVAL, "the query must have at most %d parameters", KD_TARGET_PAIRS);
    char *value = strchr(pair, '=');
    if (value)
        *value++ = 0;
    else
        value = empty;
    enum kd_status status;
    KD_TRY(decode(pair, true, error));
    if (*value)
        KD_TRY(decode(value, true, error));
    target->pairs[target->n_pairs++] = (struct kd_target_pair) { pair, value };
done:
    return status;
}

enum kd_status kd_target_parse(struct kd_target *target, const char *raw, struct kd_error *error)
{
    *target = (struct kd_target) { .text = strdup(raw) };
    if (!target->text)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    target->path = target->text;
    char *query = strchr(target->text, '?');
    if (query)
        *query++ = 0;
    enum kd_status status = decode(target->text, false, error);
    while (!status && query) {
        char *next = strchr(query, '&');
        if (next)
            *next++ = 0;
        status = add_pair(target, query, error);
        query = next;
    }
    return status;
}

enum kd_status kd_target_origin(char *raw, char **authority)
{
    const size_t scheme = !strncasecmp(raw, "http://", 7) ? 7 : !strncasecmp(raw, "https://", 8) ? 8 : 0;
    if (!scheme)
        return KD_OK;
    const size_t host = strcspn(raw + scheme, "/?");
    *authority = strndup(raw + scheme, host);
    if (!*authority)
        return KD_ENOMEM;
    const char *rest = raw + scheme + host;
    const bool root = *rest != '/';
    *raw = '/';
    memmove(raw + root, rest, strlen(rest) + 1);
    return KD_OK;
}

void kd_target_finish(struct kd_target *target)
{
    free(target->text);
    *target = (struct kd_target) { 0 };
}

const char *kd_target_value(const struct kd_target *target, const char *name)
{
    for (size_t i = 0; i < target->n_pairs; i++)
        if (!strcmp(target->pairs[i].name, name))
            return target->pairs[i].value;
    return NULL;
}

enum kd_status kd_target_distinct(const struct kd_target *target, struct kd_error *error)
{
    for (size_t i = 1; i < target->n_pairs; i++)
        for (size_t k = 0; k < i; k++)
            if (!strcmp(target->pairs[k].name, target->pairs[i].name))
                return kd_error_field(error, "", "the query has %.100s twice", target->pairs[i].name);
    return KD_OK;
}

static bool lists(const char *const *names, const char *name)
{
    while (*names && strcmp(*names, name))
        names++;
    return *names;
}

enum kd_status kd_target_only(const struct kd_target *target, const char *const *known, const char *const *former,
                              struct kd_error *error)
{
    char list[100] = "", pointer[sizeof error->pointer] = "", given[60];
    for (size_t i = 0; known[i]; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? ", " : "", known[i]);
    for (size_t i = 0; i < target->n_pairs; i++) {
        const char *name = target->pairs[i].name;
        if (lists(known, name) || lists(former, name) || !strcmp(name, "token"))
            continue;
        kd_text_pointer(pointer, sizeof pointer, name);
        kd_text_clip(given, sizeof given, name);
        return kd_error_field(error, pointer, "there is no parameter %s here; the parameters are %s", given, list);
    }
    return kd_target_distinct(target, error);
}

bool kd_target_number(const char *text, uint64_t most, uint64_t *out)
{
    size_t n = strspn(text, "0123456789");
    if (!n || text[n] || n > 18)
        return false;
    *out = strtoull(text, NULL, 10);
    return *out <= most;
}

bool kd_target_whole(const struct kd_target *target, const char *name, uint64_t otherwise, uint64_t most, uint64_t *out)
{
    const char *text = kd_target_value(target, name);
    *out = otherwise;
    return !text || kd_target_number(text, most, out);
}

#include "render/rays/list.h"

#include "base/pause.h"
#include "render/rays/rays.h"
#include "document/mistake.h"
#include "document/number.h"
#include "document/text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define NUMBER_MAX 60 /* largest number of characters of a number, as anywhere in a document */

enum kd_status kd_rays_list_add(struct kd_rays_list *list, double alpha, double beta, struct kd_error *error)
{
    if (list->n == KD_RAYS_MAX)
        return kd_error_field(error, "/rays", "there are more than %d rays", KD_RAYS_MAX);
    if (list->n == list->capacity) {
        size_t capacity = list->capacity ? 2 * list->capacity : 64;
        double *grown = realloc(list->alpha_beta, capacity * 2 * sizeof *grown);
        if (!grown)
            return kd_error_set(error, KD_ENOMEM, "out of memory for %zu rays", capacity);
        list->alpha_beta = grown;
        list->capacity = capacity;
    }
    list->alpha_beta[2 * list->n] = alpha;
    list->alpha_beta[2 * list->n + 1] = beta;
    list->n++;
    return KD_OK;
}

static size_t skip_blanks(const char *text, size_t at) { return at + strspn(text + at, " \t\n\r"); }

static size_t skip_string(const char *text, size_t at, size_t length)
{
    for (at++; at < length && text[at] != '"'; at++)
        at += text[at] == '\\';
    return at < length ? at + 1 : length;
}

/* Finds the array. Errors are not reported here, but by the parser of the rest of the document. */
bool kd_rays_list_find(const char *text, size_t length, size_t *start)
{
    int depth = 0;
    bool key = false; /* true if a string at this place is the name of a member */
    for (size_t at = 0; at < length;) {
        char c = text[at];
        if (c == '"') {
            size_t end = skip_string(text, at, length), value = skip_blanks(text, end);
            if (key && depth == 1 && end - at == 6 && !memcmp(text + at, "\"rays\"", 6) && text[value] == ':') {
                *start = skip_blanks(text, value + 1);
                return text[*start] == '[';
            }
            key = false;
            at = end;
            continue;
        }
        depth += (c == '{' || c == '[') - (c == '}' || c == ']');
        key = c == '{' || c == ',' || (key && strchr(" \t\n\r", c));
        at++;
    }
    return false;
}

struct reader {
    const char *text;
    size_t length, at, ray;
    struct kd_error *error;
};

static enum kd_status not_json(struct reader *r, const char *what)
{
    struct kd_text_place place = kd_text_place_of(r->text, r->at);
    size_t before = r->at;
    while (before && strchr(" \t\r\n", r->text[before - 1]))
        before--;
    const char *mistake = kd_json_mistake(r->text, r->length, r->at, before ? r->text[before - 1] : 0);
    if (mistake)
        return kd_error_set(r->error, KD_EINVAL, "the document is not valid JSON at byte %zu, line %zu, column %zu: %s",
                            r->at, place.line, place.column, mistake);
    return kd_error_set(r->error, KD_EINVAL, "the document is not valid JSON: %s at byte %zu, line %zu, column %zu",
                        what, r->at, place.line, place.column);
}

static bool take(struct reader *r, char c)
{
    r->at = skip_blanks(r->text, r->at);
    if (r->text[r->at] != c)
        return false;
    r->at++;
    return true;
}

/* Describes the value that was found where a number was expected. Returns NULL if that value is not JSON. */
static const char *describe(const struct reader *r)
{
    static const char *const words[] = { "null", "true", "false" };
    const char *p = r->text + r->at;
    for (size_t i = 0; i < 3; i++)
        if (!strncmp(p, words[i], strlen(words[i])))
            return words[i];
    switch (*p) {
    case '"': return "a string";
    case '{': return "an object";
    case '[': return "an array";
    }
    return kd_number_span(p, r->length - r->at) ? "a number" : NULL;
}

/* component: 0 or 1, or -1 for the ray itself. */
static enum kd_status wrong(struct reader *r, int component, const char *given)
{
    char pointer[64];
    if (component < 0) {
        snprintf(pointer, sizeof pointer, "/rays/%zu", r->ray);
        return kd_error_field(r->error, pointer, "ray %zu is %s; it must be a pair of numbers [alpha, beta]", r->ray,
                              given);
    }
    snprintf(pointer, sizeof pointer, "/rays/%zu/%d", r->ray, component);
    return kd_error_field(r->error, pointer, "%s of ray %zu is %s; it must be a number", component ? "beta" : "alpha",
                          r->ray, given);
}

static enum kd_status number(struct reader *r, int component, double *out)
{
    r->at = skip_blanks(r->text, r->at);
    size_t n = kd_number_span(r->text + r->at, r->length - r->at);
    char next = r->text[r->at + n];
    if (!n) {
        const char *given = r->text[r->at] == ']' ? "missing" : describe(r);
        return given ? wrong(r, component, given) : not_json(r, "no value");
    }
    if (next && strchr("0123456789.+-eE", next))
        return not_json(r, "malformed number");
    if (n > NUMBER_MAX)
        return not_json(r, "a number of more than 60 characters");
    *out = strtod(r->text + r->at, NULL);
    if (!isfinite(*out))
        return wrong(r, component, "a number beyond 1e308");
    r->at += n;
    return KD_OK;
}

static enum kd_status pair(struct reader *r, struct kd_rays_list *list)
{
    double alpha, beta;
    if (!take(r, '[')) {
        const char *given = describe(r);
        return given ? wrong(r, -1, given) : not_json(r, "no value");
    }
    enum kd_status status;
    KD_TRY(number(r, 0, &alpha));
    if (!take(r, ','))
        KD_TRY(take(r, ']') ? wrong(r, -1, "an array of one number") : not_json(r, "neither , nor ]"));
    KD_TRY(number(r, 1, &beta));
    if (!take(r, ']'))
        KD_TRY(take(r, ',') ? wrong(r, -1, "an array of more than two values") : not_json(r, "neither , nor ]"));
    KD_TRY(kd_rays_list_add(list, alpha, beta, r->error));
done:
    return status;
}

enum kd_status kd_rays_list_read(struct kd_rays_list *list, const char *text, size_t length, size_t *at,
                                 struct kd_error *error)
{
    struct reader r = { .text = text, .length = length, .at = *at + 1, .error = error };
    enum kd_status status = KD_OK;
    if (!take(&r, ']')) {
        struct kd_number_locale locale = kd_number_locale_enter();
        do {
            kd_pause_every(r.ray, 1024);
            r.at = skip_blanks(text, r.at);
            status = pair(&r, list);
            r.ray++;
        } while (!status && take(&r, ','));
        kd_number_locale_leave(locale);
        if (!status && !take(&r, ']'))
            status = not_json(&r, "neither , nor ]");
    }
    *at = r.at;
    return status;
}

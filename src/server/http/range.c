#include "server/http/range.h"

#include <stdbool.h>
#include <string.h>
#include <strings.h>

#define BLANKS " \t"
#define DIGITS "0123456789"

/* Reads a number of at least one digit and moves *at past it. A number that does not fit into 64 bits becomes
 * UINT64_MAX. */
static bool number(const char **at, uint64_t *out)
{
    const size_t n = strspn(*at, DIGITS);
    *out = 0;
    for (size_t i = 0; i < n; i++) {
        const unsigned digit = (unsigned)((*at)[i] - '0');
        *out = *out > (UINT64_MAX - digit) / 10 ? UINT64_MAX : 10 * *out + digit;
    }
    *at += n;
    return n > 0;
}

/* Skips empty elements, which are permitted in a list (RFC 9110 5.6.1). */
static const char *skip_empty(const char *at) { return at + strspn(at, BLANKS ","); }

/* One range of a Range header, of the form first-last, first- or -suffix. */
struct spec {
    uint64_t first, last;
    bool suffix;
};

static bool read_spec(const char *at, struct spec *out)
{
    at = skip_empty(at);
    *out = (struct spec) { .last = UINT64_MAX };
    out->suffix = !number(&at, &out->first);
    if (*at++ != '-')
        return false;
    const bool bounded = number(&at, &out->last);
    if (!bounded)
        out->last = UINT64_MAX;
    return !*skip_empty(at) && (out->suffix ? bounded : out->first <= out->last);
}

enum kd_byte_range kd_range_read(const char *value, uint64_t size, uint64_t *first, uint64_t *count)
{
    static const char unit[] = "bytes=";
    struct spec spec;
    if (!value || strncasecmp(value, unit, strlen(unit)) || !read_spec(value + strlen(unit), &spec))
        return KD_RANGE_WHOLE;
    if (spec.suffix && spec.last && !size) /* for an empty file, RFC 9110 defines no Content-Range of this failure */
        return KD_RANGE_WHOLE;
    if (spec.suffix ? !spec.last : spec.first >= size)
        return KD_RANGE_BEYOND;
    *first = !spec.suffix ? spec.first : spec.last < size ? size - spec.last : 0;
    *count = spec.suffix || spec.last >= size ? size - *first : spec.last - *first + 1;
    return KD_RANGE_PART;
}

#include "server/http/trace.h"

#include <stdio.h>
#include <string.h>

#define HEX "0123456789abcdef" /* the standard permits only lower case */
enum { VERSION = 2, TRACE = 32, PARENT = 16, FLAGS = 2, ALL = VERSION + 1 + TRACE + 1 + PARENT + 1 + FLAGS };

/* True if n hexadecimal digits and a hyphen follow. After the last field, no hyphen is required. */
static bool is_field(const char *at, size_t n, bool last) { return strspn(at, HEX) == n && (last || at[n] == '-'); }

static bool is_zero(const char *at, size_t n) { return strspn(at, "0") >= n; }

bool kd_trace_read(const char *value, struct kd_traceparent *out)
{
    *out = (struct kd_traceparent) { 0 };
    if (!value || strlen(value) < ALL)
        return false;
    const char *trace = value + VERSION + 1, *parent = trace + TRACE + 1, *flags = parent + PARENT + 1;
    if (!is_field(value, VERSION, false) || !strncmp(value, "ff", VERSION) || !is_field(trace, TRACE, false) ||
        !is_field(parent, PARENT, false) || !is_field(flags, FLAGS, true) || is_zero(trace, TRACE) ||
        is_zero(parent, PARENT))
        return false;
    const bool first_version = !strncmp(value, "00", VERSION);
    /* Later versions of the standard may append more fields after a hyphen. */
    if (flags[FLAGS] && (first_version || flags[FLAGS] != '-'))
        return false;
    snprintf(out->trace_id, sizeof out->trace_id, "%.*s", TRACE, trace);
    snprintf(out->parent_id, sizeof out->parent_id, "%.*s", PARENT, parent);
    return true;
}

#include "base/error.h"

#include "base/utf8.h"

#include <stdio.h>
#include <string.h>

/* Repairs a pointer that was truncated within a character or within an escape ("~0", "~1"). */
static void mend_pointer(char *pointer)
{
    kd_utf8_sanitize(pointer);
    const size_t length = strlen(pointer);
    if (length && pointer[length - 1] == '~')
        pointer[length - 1] = '\0';
}

static void fill(struct kd_error *error, enum kd_status status, const char *pointer, const char *format, va_list args)
{
    if (!error)
        return;
    error->status = status;
    error->retry_s = 0;
    snprintf(error->pointer, sizeof error->pointer, "%s", pointer);
    vsnprintf(error->message, sizeof error->message, format, args);
    /* Message and pointer may quote text that is not valid UTF-8. The pointer keeps control characters, because
     * programs read it. */
    mend_pointer(error->pointer);
    kd_utf8_show(error->message);
}

enum kd_status kd_error_set(struct kd_error *error, enum kd_status status, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fill(error, status, "", format, args);
    va_end(args);
    return status;
}

enum kd_status kd_error_field(struct kd_error *error, const char *pointer, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    fill(error, KD_EINVAL, pointer, format, args);
    va_end(args);
    return KD_EINVAL;
}

void kd_error_inside(struct kd_error *error, const char *parent)
{
    char inner[sizeof error->pointer];
    if (!error)
        return;
    memcpy(inner, error->pointer, sizeof inner);
    snprintf(error->pointer, sizeof error->pointer, "%s%.*s", parent, (int)sizeof inner, inner);
    mend_pointer(error->pointer);
}

const char *kd_status_name(enum kd_status status)
{
    switch (status) {
    case KD_OK: return "ok";
    case KD_EINVAL: return "invalid input";
    case KD_ETOOBIG: return "too large";
    case KD_ENOMEM: return "out of memory";
    case KD_EIO: return "input or output failed";
    case KD_EFULL: return "disk full";
    case KD_EDEVICE: return "device failed";
    case KD_EBUSY: return "busy";
    case KD_EABSENT: return "not installed";
    case KD_EINTERNAL: return "internal error";
    case KD_ECANCELLED: return "cancelled";
    }
    return "unknown status";
}

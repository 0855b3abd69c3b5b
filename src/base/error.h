/* Errors consist of a status code for the kind of failure, and one sentence that explains it.
 *
 * A function that can fail returns enum kd_status and fills the caller's struct kd_error (which may be NULL). Only
 * the server maps a status to an HTTP code, and only main maps it to an exit code. No thread-local state. */
#ifndef KD_BASE_ERROR_H
#define KD_BASE_ERROR_H

#include <stdarg.h>

enum kd_status {
    KD_OK = 0,
    KD_EINVAL,     /* bad input, the caller's fault; the message names the field, its value and the valid range */
    KD_ETOOBIG,    /* the input is valid, but too large for this device or this server */
    KD_ENOMEM,     /* the host or the device has no memory left */
    KD_EIO,        /* reading or writing a file or socket failed */
    KD_EFULL,      /* the disk is full                                           */
    KD_EDEVICE,    /* there is no usable device, or the device failed or missed its deadline */
    KD_EBUSY,      /* the queue is full; retry later */
    KD_EABSENT,    /* a required external program is not installed */
    KD_EINTERNAL,  /* a defect of kerrd itself, not the caller's fault */
    KD_ECANCELLED, /* the caller's progress callback has cancelled the work */
};

struct kd_error {
    enum kd_status status;
    char pointer[160]; /* RFC 6901 JSON pointer to the offending field; "" if there is none */
    char message[480]; /* one sentence, without a full stop or a line feed */
    unsigned retry_s;  /* only with KD_EBUSY: number of seconds to wait before a retry; 0: unknown */
}; /* Both texts are valid UTF-8. The message has no control characters, even where it quotes input. */

/* Fills *error (unless it is NULL) and returns status, so that callers can write `return kd_error_set(...)`. */
enum kd_status kd_error_set(struct kd_error *error, enum kd_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Like kd_error_set, for one field of an input document. The status is KD_EINVAL, and the pointer is that of the
 * field. */
enum kd_status kd_error_field(struct kd_error *error, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Prepends the JSON pointer `parent` to the pointer of *error (which may be NULL). If the result is too long, it is
 * truncated between whole characters and escapes. */
void kd_error_inside(struct kd_error *error, const char *parent);

/* One step of a function that can fail. KD_TRY(f(...)) stores the result of f in the function's local `enum
 * kd_status status`. Unless the result is KD_OK, it jumps to the label `done`, where the function frees its
 * resources and returns status. The successful path also ends at `done`. Variables that are read after `done` must
 * therefore be set before the first step. A failing step inside a loop leaves the whole function. */
#define KD_TRY(step) \
    do { \
        if ((status = (step))) \
            goto done; \
    } while (0)

/* A word for a status ("invalid input", "out of memory", ...). Never NULL. */
const char *kd_status_name(enum kd_status status);

#endif

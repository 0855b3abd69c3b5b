/* A status code says what kind of failure it was, and one sentence explains it.
 *
 * A function that can fail returns enum kd_status and fills the caller's
 * struct kd_error (which may be NULL). Only the server maps a status to an
 * HTTP code and only main maps it to an exit code. No thread-local state. */
#ifndef KD_BASE_ERROR_H
#define KD_BASE_ERROR_H

#include <stdarg.h>

enum kd_status {
    KD_OK = 0,
    KD_EINVAL,     /* bad input: the caller's fault, names field, value and range  */
    KD_ETOOBIG,    /* well-formed, but larger than this device or this server holds */
    KD_ENOMEM,     /* allocation failed, host or device                             */
    KD_EIO,        /* a file or socket                                              */
    KD_EFULL,      /* no room on the disk                                           */
    KD_EDEVICE,    /* no usable device, or the device failed or missed its deadline */
    KD_EBUSY,      /* the queue is full                                             */
    KD_EABSENT,    /* a program that this takes is not installed                    */
    KD_EINTERNAL,  /* a defect of kerrd itself: never the fault of whoever asked     */
    KD_ECANCELLED, /* the caller's progress callback asked to stop                  */
};

struct kd_error {
    enum kd_status status;
    char pointer[160]; /* RFC 6901 JSON pointer to the offending field, "" if none */
    char message[480]; /* one sentence, no trailing newline or full stop needed    */
    unsigned retry_s;  /* with KD_EBUSY: in how many seconds another try will go better; 0: nobody knows */
}; /* both are UTF-8, the message without control characters, whatever they quote */

/* Fill *error (if not NULL) and return status, so that callers can `return kd_error_set(...)`. */
enum kd_status kd_error_set(struct kd_error *error, enum kd_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same for one field of an input document: status KD_EINVAL, with its JSON pointer. */
enum kd_status kd_error_field(struct kd_error *error, const char *pointer, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The field of *error (which may be NULL) lies within parent, a JSON pointer that comes before its own. What does
 * not fit is cut off, by whole characters and escapes. */
void kd_error_inside(struct kd_error *error, const char *parent);

/* One step of a function that can fail: KD_TRY(f(...)) keeps what f returned in the function's own `enum kd_status
 * status`, and unless that is KD_OK goes to the function's label `done`, where the good way ends too: there it lets
 * go of what it holds, and returns status. What is read after `done` must be set before the first step; a loop needs
 * no condition of its own, a step inside it leaves the function. */
#define KD_TRY(step) \
    do { \
        if ((status = (step))) \
            goto done; \
    } while (0)

/* A word for a status ("invalid input", "out of memory", ...). Never NULL. */
const char *kd_status_name(enum kd_status status);

#endif

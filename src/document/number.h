/* Reads and writes numbers as in JSON and on command lines, independent of the locale of the process. Any thread. */
#ifndef KD_DOCUMENT_NUMBER_H
#define KD_DOCUMENT_NUMBER_H

#include <locale.h>
#include <stddef.h>

/* Length in bytes of the JSON number at the beginning of text; 0 if there is none (RFC 8259, section 6). */
size_t kd_number_span(const char *text, size_t length);

/* Like kd_number_span, for a number that was typed on a command line or in a query. Such a number may also have the
 * form .5, -.5 or 5. */
size_t kd_number_span_typed(const char *text, size_t length);

/* Reads a number in either of the two forms above. Beyond the range of a double, the result is infinite. */
double kd_number_parse(const char *text);

/* Writes the number with 15, 16 or 17 digits: the smallest of these counts with which it reads back as the same
 * double. */
enum { KD_NUMBER_SIZE = 32 };
void kd_number_format(char out[KD_NUMBER_SIZE], double value);

/* Switch this thread to the C locale and back. Between the two calls, strtod reads numbers independently of the
 * process's locale. */
struct kd_number_locale { locale_t c, previous; };
struct kd_number_locale kd_number_locale_enter(void);
void kd_number_locale_leave(struct kd_number_locale state);

#endif

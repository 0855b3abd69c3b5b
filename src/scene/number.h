/* Reads and writes numbers of JSON and of command lines, whatever the locale of the process. Any thread. */
#ifndef KD_SCENE_NUMBER_H
#define KD_SCENE_NUMBER_H

#include <locale.h>
#include <stddef.h>

/* Length in bytes of the JSON number at the beginning of text, 0 if there is none (RFC 8259, section 6). */
size_t kd_number_span(const char *text, size_t length);

/* The same for a number typed on a command line or in a query: .5, -.5 and 5. too. */
size_t kd_number_span_typed(const char *text, size_t length);

/* Reads such a number. Beyond the range of a double the result is infinite. */
double kd_number_parse(const char *text);

/* Writes the shortest of 15, 16 or 17 digits that reads back as the same double. */
enum { KD_NUMBER_SIZE = 32 };
void kd_number_format(char out[KD_NUMBER_SIZE], double value);

/* Switches this thread to the C locale, around code that reads numbers with strtod. */
struct kd_number_locale { locale_t c, previous; };
struct kd_number_locale kd_number_locale_enter(void);
void kd_number_locale_leave(struct kd_number_locale state);

#endif

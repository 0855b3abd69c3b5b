/* Numbers as JSON writes them and as they are typed, whatever the locale of the process. Any thread. */
#ifndef KD_SCENE_NUMBER_H
#define KD_SCENE_NUMBER_H

#include <locale.h>
#include <stddef.h>

/* Bytes of the JSON number that text starts with, 0 if there is none (RFC 8259, section 6). */
size_t kd_number_span(const char *text, size_t length);

/* The same of one that is typed, on a command line or in a query: .5, -.5 and 5. too. */
size_t kd_number_span_typed(const char *text, size_t length);

/* text must be one of these; beyond the range of a double the result is infinite. */
double kd_number_parse(const char *text);

/* The shortest of 15, 16 or 17 digits that reads back as the same double. */
enum { KD_NUMBER_SIZE = 32 };
void kd_number_format(char out[KD_NUMBER_SIZE], double value);

/* The C locale for this thread alone, around code that reads numbers with strtod. */
struct kd_number_locale {
    locale_t c, previous;
};
struct kd_number_locale kd_number_locale_enter(void);
void kd_number_locale_leave(struct kd_number_locale state);

#endif

/* Formats numbers, values and lists for all forms of an answer. Private to src/quantity. */
#ifndef KD_QUANTITY_TEXT_H
#define KD_QUANTITY_TEXT_H

#include "quantity/quantity.h"
#include "document/writer.h"

/* Writes a number in the fewest digits, or the text `missing` if it is not finite. */
void kd_quantity_write_number(struct kd_writer *w, double value, const char *missing);
/* Writes a parameter's value, which is a number or a word in quotes. */
void kd_quantity_write_value(struct kd_writer *w, const struct kd_row *parameter, double value, const char *quote);
/* Writes a NULL-terminated list as ["...", ...]. */
void kd_quantity_write_sentences(struct kd_writer *w, const char *const *sentences);

#endif

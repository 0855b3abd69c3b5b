/* Converts doubles to decimal text: the fewest digits that read back as the same double, and of those the nearest.
 * Any thread.
 *
 * For bulk output: some fifty times as fast as trying printf at 15, 16 and 17 digits. Raffaello Giulietti, "The
 * Schubfach way to render doubles", 2020. */
#ifndef KD_BASE_DECIMAL_H
#define KD_BASE_DECIMAL_H

#include <stddef.h>

enum { KD_DECIMAL_SIZE = 32 };

/* Prints a finite value as a JSON number: 0.25, -12, 1.5e-7, 1e300. Writes a NUL too; returns the length without it. */
size_t kd_decimal_print(char out[KD_DECIMAL_SIZE], double value);

/* Rounds value to `digits` significant decimal digits: the result prints in no more. A tie may go either way.
 * Infinities, NAN, and 16 digits or more give value itself. */
enum { KD_DECIMAL_DIGITS = 17 }; /* the most that a double has */
double kd_decimal_round(double value, int digits);

#endif

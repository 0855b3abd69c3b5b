/* Converts doubles to decimal text. The text has the fewest digits that read back as the same double; among such
 * texts it is the one nearest to the value. Any thread. It is about fifty times as fast as trying printf with 15, 16
 * and 17 digits, which matters for bulk output. The algorithm is that of Raffaello Giulietti, "The Schubfach way to
 * render doubles", 2020. */
#ifndef KD_BASE_DECIMAL_H
#define KD_BASE_DECIMAL_H

#include <stddef.h>

enum { KD_DECIMAL_SIZE = 32 };

/* Prints a finite value as a JSON number: 0.25, -12, 1.5e-7, 1e300. Adds a NUL, and returns the length without the
 * NUL. */
size_t kd_decimal_print(char out[KD_DECIMAL_SIZE], double value);

/* Rounds a value to `digits` significant decimal digits, so that kd_decimal_print prints at most this number of
 * digits. A tie may be rounded either way. Infinities and NAN are returned unchanged. If digits is 16 or more, all
 * values are returned unchanged. */
enum { KD_DECIMAL_DIGITS = 17 }; /* maximum number of digits that a double needs */
double kd_decimal_round(double value, int digits);

#endif

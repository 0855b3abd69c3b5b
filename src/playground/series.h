/* Time series of a playground's numbers. Row k belongs to the time `begin` + k `interval`, and is interpolated linearly
 * between sub-steps. When the series is full, every second row is dropped and the interval doubled, so that the rows
 * cover all of the time. If the span is known beforehand, the last row is at the end of the span. One thread at a time.
 */
#ifndef KD_PLAYGROUND_SERIES_H
#define KD_PLAYGROUND_SERIES_H

#include "base/buffer.h"

#include <stdbool.h>
#include <stddef.h>

enum { KD_SERIES_ROWS = 4096 };

/* Columns of the series: X(name, unit, description) */
#define KD_SERIES_COLUMNS(X) \
    X(t, "M", "time") \
    X(bodies, "", "number of bodies") \
    X(energy, "M", "energy of the bodies: kinetic, in the hole's field, and of all pairs") \
    X(energy_balance, "M", \
      "energy of the bodies, corrected for all energy that has left or entered; it is constant except for the error " \
      "of the integration") \
    X(angular_momentum_x, "M^2", "of the bodies") \
    X(angular_momentum_y, "M^2", "of the bodies") \
    X(angular_momentum_z, "M^2", "of the bodies") \
    X(radiated, "M", "energy lost to gravitational waves") \
    X(separation, "M", \
      "separation of the closest bound pair of bodies; without a bound pair, of the innermost body and the hole") \
    X(wave_frequency, "1/M", "wave frequency: twice the orbital frequency of this pair") \
    X(h_plus, "M", "strain h+ times distance, seen along the hole's axis") \
    X(h_cross, "M", "strain hx times distance, seen along the hole's axis") \
    X(debris, "", "number of moving pieces of debris") \
    X(debris_back, "M", "mass of the debris that has returned")

#define KD_SERIES_COLUMN_(name, ...) KD_SERIES_##name,
enum { KD_SERIES_COLUMNS(KD_SERIES_COLUMN_) KD_SERIES_N };
#undef KD_SERIES_COLUMN_

struct kd_playground_series {
    double begin, interval; /* M */
    double span;            /* length of the series, M; 0 if it is open-ended */
    size_t n;               /* number of rows; 0 if the series has not begun */
    double rows[KD_SERIES_ROWS][KD_SERIES_N];
};

/* Begins a series with the row `now`. If span > 0, the series has KD_SERIES_ROWS rows over this time in M, and no later
 * rows. If span is 0, the series is open-ended, and begins with the given interval, which must be > 0. */
void kd_series_begin(struct kd_playground_series *series, const double now[KD_SERIES_N], double span, double interval);
/* time of the next row; INFINITY if there will be no more rows */
double kd_series_next(const struct kd_playground_series *series);
/* Adds the rows after the sub-step `before`, up to the sub-step `now`. */
void kd_series_add(struct kd_playground_series *series, const double before[KD_SERIES_N],
                   const double now[KD_SERIES_N]);
/* True if the present row `now` is later than the last row. Files then append it. */
bool kd_series_lacks(const struct kd_playground_series *series, const double now[KD_SERIES_N]);
const char *kd_series_column(int i);

/* Appends all rows to a file, and also `now` if it is later than the last row. The format is text/csv with a line of
 * names, or an NPY array of records. There are at most KD_SERIES_ROWS rows. Returns KD_ENOMEM if memory is short. */
enum kd_status kd_series_csv(const struct kd_playground_series *series, const double now[KD_SERIES_N],
                             struct kd_buffer *out);
enum kd_status kd_series_npy(const struct kd_playground_series *series, const double now[KD_SERIES_N],
                             struct kd_buffer *out);

#endif

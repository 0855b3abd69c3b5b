/* A playground's numbers over time are kept as rows: every `interval` M one, and when there are KD_SERIES_ROWS every
 * second one is left out and the interval doubled, so that they span all of it. One thread at a time. */
#ifndef KD_PLAYGROUND_SERIES_H
#define KD_PLAYGROUND_SERIES_H

#include "base/buffer.h"

#include <stddef.h>

enum { KD_SERIES_ROWS = 4096 };

/* X(name, unit, what it is) */
#define KD_SERIES_COLUMNS(X) \
    X(t, "M", "time") \
    X(bodies, "", "how many there are") \
    X(energy, "M", "of the bodies: kinetic, in the hole's field, and of all pairs") \
    X(energy_balance, "M", \
      "the same with all that has left and has been given: constant but for the error of the integration") \
    X(angular_momentum_x, "M^2", "of the bodies") \
    X(angular_momentum_y, "M^2", "of the bodies") \
    X(angular_momentum_z, "M^2", "of the bodies") \
    X(radiated, "M", "energy that gravitational waves have taken") \
    X(separation, "M", "of the closest bound pair of bodies, else of the innermost body and the hole") \
    X(wave_frequency, "1/M", "twice the rate at which these two go round") \
    X(h_plus, "M", "strain times distance, seen from the hole's axis") \
    X(h_cross, "M", "the same, of the other polarisation") \
    X(debris, "", "pieces under way") \
    X(debris_back, "M", "mass of those that have come back")

#define KD_SERIES_COLUMN_(name, ...) KD_SERIES_##name,
enum { KD_SERIES_COLUMNS(KD_SERIES_COLUMN_) KD_SERIES_N };
#undef KD_SERIES_COLUMN_

struct kd_playground_series {
    double interval; /* M; 0: nothing is recorded yet, the first row sets it */
    double next;     /* time of the next row */
    size_t n;
    double rows[KD_SERIES_ROWS][KD_SERIES_N];
};

void kd_series_add(struct kd_playground_series *series, const double row[KD_SERIES_N]);
const char *kd_series_column(int i);

/* All rows as text/csv with a line of names, or as an NPY array of records. KD_ENOMEM. */
enum kd_status kd_series_csv(const struct kd_playground_series *series, struct kd_buffer *out);
enum kd_status kd_series_npy(const struct kd_playground_series *series, struct kd_buffer *out);

#endif

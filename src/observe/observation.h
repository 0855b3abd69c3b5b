/* Observation by an interferometer, read from the EHT's CSV or from uvfits (random groups of FITS: E. W. Greisen 2020,
 * AIPS Memo 117). Only Stokes I is read. Any thread; there is no state between calls.
 *
 *     struct kd_observation o = { 0 };
 *     if (kd_observation_read(data, size, &o, &error)) ... KD_EINVAL: the error says what is wrong; KD_ENOMEM ...
 *     kd_observation_finish(&o);
 *
 * The visibility V(u, v) of the baseline from station 1 to station 2 is the sum of I exp(+2 pi i (u x + v y)). x points
 * to the east and y to the north, as in the EHT's files and in ehtim. */
#ifndef KD_OBSERVE_OBSERVATION_H
#define KD_OBSERVE_OBSERVATION_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_OBSERVATION_BYTES ((size_t)32 << 20) /* largest size of a file, bytes */
#define KD_OBSERVATION_ROWS (1u << 20)          /* largest number of visibilities in a file */
#define KD_OBSERVATION_STATIONS 64u
#define KD_STATION_NAME 12u /* size of a station's name in bytes, including NUL */

struct kd_measured {
    double hour;          /* time in hours UTC since 0 h of the day mjd */
    double u, v;          /* baseline in wavelengths */
    double re, im, sigma; /* real part, imaginary part and error of the visibility, Jy */
    uint8_t station[2];   /* indices of the two stations, in ascending order */
    bool turned;          /* true if the file has the baseline in the opposite direction */
    uint32_t source;      /* index of the visibility's group in the file */
};

struct kd_observation {
    char source[40];
    double mjd; /* modified Julian date of the day of the observation, at 0 h UTC */
    double frequency_hz;
    /* names of the stations; a minimal set of closures uses the stations in this order (observe/comparison.h) */
    char station[KD_OBSERVATION_STATIONS][KD_STATION_NAME];
    uint32_t stations;
    /* visibilities, malloc'd, sorted by time, then by stations; each time and baseline occurs once */
    struct kd_measured *at;
    size_t n;
    uint32_t flagged;   /* number of visibilities that were left out because their weight is not positive */
    uint32_t duplicate; /* number of visibilities that were left out because they repeat a time and baseline */
};

enum kd_observation_kind { KD_OBSERVATION_NONE, KD_OBSERVATION_CSV, KD_OBSERVATION_UVFITS };

/* Recognises the kind of a file by the file's first bytes. */
enum kd_observation_kind kd_observation_kind_of(const void *data, size_t size);
/* Reads a file. kd_observation_finish is needed only after success. */
enum kd_status kd_observation_read(const void *data, size_t size, struct kd_observation *out, struct kd_error *error);
void kd_observation_finish(struct kd_observation *observation);

#endif

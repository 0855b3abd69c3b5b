/* Observation by an interferometer, read from the EHT's CSV or from uvfits (random groups of FITS: E. W. Greisen 2020,
 * AIPS Memo 117). Stokes I only. Any thread; no state between calls.
 *
 *     struct kd_observation o = { 0 };
 *     if (kd_observation_read(data, size, &o, &error)) ... KD_EINVAL: the error says what is wrong; KD_ENOMEM ...
 *     kd_observation_finish(&o);
 *
 * V(u, v) of the baseline 1-2 is the sum of I exp(+2 pi i (u x + v y)). x points to the east and y to the north, as in
 * the EHT's files and in ehtim. */
#ifndef KD_OBSERVE_OBSERVATION_H
#define KD_OBSERVE_OBSERVATION_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_OBSERVATION_BYTES ((size_t)32 << 20) /* limit of a file's size */
#define KD_OBSERVATION_ROWS (1u << 20)          /* limit of the visibilities in a file */
#define KD_OBSERVATION_STATIONS 64u
#define KD_STATION_NAME 12u /* size of a station's name in bytes, including NUL */

struct kd_measured {
    double hour;          /* hours UTC since mjd */
    double u, v;          /* baseline in wavelengths */
    double re, im, sigma; /* visibility and its error in Jy */
    uint8_t station[2];   /* indices of the two stations; the first is lower than the second */
    bool turned;          /* in the file the baseline has the opposite direction */
    uint32_t source;      /* number of the file's group, from 0 */
};

struct kd_observation {
    char source[40];
    double mjd; /* modified Julian date of the observation, at 0 h UTC */
    double frequency_hz;
    /* names, in the order in which a minimal set of closures uses the stations (observe/comparison.h) */
    char station[KD_OBSERVATION_STATIONS][KD_STATION_NAME];
    uint32_t stations;
    struct kd_measured *at; /* malloc'd; sorted by time, then by stations; each time and baseline occurs once */
    size_t n;
    uint32_t flagged;   /* number of visibilities left out because their weight is not positive */
    uint32_t duplicate; /* number of visibilities left out as repetitions of the same time and baseline */
};

enum kd_observation_kind { KD_OBSERVATION_NONE, KD_OBSERVATION_CSV, KD_OBSERVATION_UVFITS };

/* Recognises a file by its first bytes. */
enum kd_observation_kind kd_observation_kind_of(const void *data, size_t size);
/* Reads a file. Call kd_observation_finish only after success. */
enum kd_status kd_observation_read(const void *data, size_t size, struct kd_observation *out, struct kd_error *error);
void kd_observation_finish(struct kd_observation *observation);

#endif

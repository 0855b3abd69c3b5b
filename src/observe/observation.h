/* An observation of an interferometer, as files of the field have it: the EHT's CSV, and uvfits (random groups of
 * FITS: E. W. Greisen 2020, AIPS Memo 117). Stokes I alone. Any thread; nothing is kept between calls.
 *
 *     struct kd_observation o = { 0 };
 *     if (kd_observation_read(data, size, &o, &error)) ... KD_EINVAL says what is wrong, KD_ENOMEM ...
 *     kd_observation_finish(&o);
 *
 * V(u, v) of baseline 1-2 is the sum of I exp(+2 pi i (u x + v y)), x to the east and y to the north, as files of the
 * EHT and ehtim have it. */
#ifndef KD_OBSERVE_OBSERVATION_H
#define KD_OBSERVE_OBSERVATION_H

#include "base/error.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define KD_OBSERVATION_BYTES ((size_t)32 << 20) /* of a file */
#define KD_OBSERVATION_ROWS (1u << 20)          /* visibilities of one */
#define KD_OBSERVATION_STATIONS 64u
#define KD_STATION_NAME 12u /* bytes, with the NUL */

struct kd_measured {
    double hour;          /* UTC, from mjd on */
    double u, v;          /* wavelengths */
    double re, im, sigma; /* Jy */
    uint8_t station[2];   /* by their place in the list, the first before the second */
};

struct kd_observation {
    char source[40];
    double mjd; /* of 0 h */
    double frequency_hz;
    char station[KD_OBSERVATION_STATIONS][KD_STATION_NAME]; /* in the order by which minimal sets are chosen */
    uint32_t stations;
    struct kd_measured *at; /* malloc'd; by time, then by stations; one of a time and baseline */
    size_t n;
    uint32_t flagged;   /* without a weight above 0 */
    uint32_t duplicate; /* of a time and baseline that had come before, left out */
};

enum kd_observation_kind { KD_OBSERVATION_NONE, KD_OBSERVATION_CSV, KD_OBSERVATION_UVFITS };

/* By how the bytes begin. */
enum kd_observation_kind kd_observation_kind_of(const void *data, size_t size);
/* *out is to be finished only where this succeeds. */
enum kd_status kd_observation_read(const void *data, size_t size, struct kd_observation *out, struct kd_error *error);
void kd_observation_finish(struct kd_observation *observation);

#endif

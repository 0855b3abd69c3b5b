/* The groups of a uvfits file. uvfits.c reads them, and simulate.c replaces their visibilities. */
#ifndef KD_OBSERVE_UVFITS_H
#define KD_OBSERVE_UVFITS_H

#include "observe/observe_internal.h"

struct hdu {
    const char *cards;
    size_t n_cards, begin, size; /* begin, size: position and size, without padding, of the HDU's data */
};

struct file {
    const uint8_t *data;
    size_t size;
    struct kd_error *error;
};

struct parameter {
    size_t at; /* index of the parameter in a group */
    double scale, zero;
    bool there;
};

struct groups {
    struct hdu hdu;
    size_t n, parameters, elements, bytes; /* bytes: size of a number in bytes */
    /* hands: number of polarizations in the axis STOKES. hand_step: distance between polarizations, counted in numbers
     */
    size_t hands, hand_step;
    size_t channels, channel_step, ifs, if_step;
    bool circular; /* true if the polarizations are RR and LL, false if the file has Stokes I */
    struct parameter u, v, baseline, date[2];
    double scale, zero; /* BSCALE and BZERO of the data: value = zero + scale * number */
};

/* Parses and checks the header of the groups. */
enum kd_status kd_uvfits_open(const struct file *file, struct groups *groups);
double kd_uvfits_number(const uint8_t *at, bool is_double);
double kd_uvfits_parameter(const struct groups *groups, const uint8_t *group, const struct parameter *parameter);
/* Reads Stokes I and its error from a group's data. Returns false if no weight is positive. */
bool kd_uvfits_light(const struct groups *groups, const uint8_t *data, struct kd_measured *out);

#endif

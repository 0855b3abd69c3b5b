/* Mutual gravity of bodies: all pairs, softened, in double precision. One thread at a time uses a struct
 * kd_playground_mutual.
 *
 * With Plummer's softening, a mass m at the distance d has the acceleration m d/(d^2 + e^2)^(3/2) and the potential
 * -m/(d^2 + e^2)^(1/2) (H. Plummer 1911, MNRAS 71, 460). */
#ifndef KD_PLAYGROUND_MUTUAL_H
#define KD_PLAYGROUND_MUTUAL_H

#include "playground/body.h"

#include "base/error.h"

#include <stddef.h>

/* Arrays of `room` numbers each, a multiple of eight, in one allocation. Input: position, mass and radius of the
 * bodies. The others are results. */
struct kd_playground_mutual {
    size_t room;
    double *x, *y, *z, *mass, *radius;
    double *ax, *ay, *az;
    double *potential; /* potential energy per unit mass */
    /* for each body: sum of (m_i + m_j)/s^3 over its pairs; the square root of this sum is at least the rate of the
     * fastest pair */
    double *rate;
    double *near; /* number of bodies at a distance below R_i + R_j + margin */
    void *block;
};

enum kd_status kd_playground_mutual_reserve(struct kd_playground_mutual *mutual, size_t n, struct kd_error *error);
void kd_playground_mutual_finish(struct kd_playground_mutual *mutual);

/* Computes the result arrays for these bodies. */
void kd_playground_mutual_fill(struct kd_playground_mutual *mutual, const struct kd_playground_body *bodies, size_t n,
                               double softening, double margin);

#endif

/* Counter-based random numbers: splitmix64 (Steele, Lea & Flood 2014). Pure. */
#ifndef KD_BASE_RANDOM_H
#define KD_BASE_RANDOM_H

#include <stdint.h>

#define KD_RANDOM_STEP 0x9e3779b97f4a7c15u

struct kd_random { uint64_t state; }; /* initialise with the seed */

/* Returns the next number, uniform in [0, 1). */
static inline double kd_random(struct kd_random *random)
{
    uint64_t x = random->state += KD_RANDOM_STEP;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

/* Returns random number *n, counted from 0, of the sequence of this seed. Increments *n. */
static inline double kd_random_drawn(uint64_t seed, uint64_t *n)
{
    struct kd_random random = { seed + (*n)++ * KD_RANDOM_STEP };
    return kd_random(&random);
}

#endif

/* Random numbers for a seed and a count: the same everywhere. M. O'Neill 2014, PCG; the output function RXS-M-XS of 32 bits as a hash. */
#ifndef KD_PLAYGROUND_RANDOM_H
#define KD_PLAYGROUND_RANDOM_H

#include <stdint.h>

static inline uint32_t kd_playground_hash(uint32_t x)
{
    const uint32_t state = x * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

/* The next one, in (0, 1). */
static inline double kd_playground_random(uint32_t seed, uint64_t *count)
{
    const uint64_t n = (*count)++;
    return (kd_playground_hash((uint32_t)n ^ kd_playground_hash(seed ^ kd_playground_hash((uint32_t)(n >> 32)))) + 0.5) * 0x1p-32;
}

#endif

/* A 32-bit hash (Chris Wellons, "Prospecting for hash functions", 2018: lowbias32), which turns counters into random
 * numbers. */
#ifndef KD_HASH_GLSL
#define KD_HASH_GLSL

uint kd_hash(uint x)
{
    x = (x ^ (x >> 16)) * 0x7feb352du;
    x = (x ^ (x >> 15)) * 0x846ca68bu;
    return x ^ (x >> 16);
}

#endif

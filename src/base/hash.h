/* The hash FNV-1a, 64 bits (Fowler, Noll & Vo 1991). It detects damage and changed versions, but not forgery. Pure. */
#ifndef KD_BASE_HASH_H
#define KD_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

#define KD_HASH_BEGIN UINT64_C(0xcbf29ce484222325)

/* Extends a hash by `size` bytes. KD_HASH_BEGIN is the hash of no bytes. */
static inline uint64_t kd_hash(uint64_t hash, const void *data, size_t size)
{
    const unsigned char *bytes = data;
    for (size_t i = 0; i < size; i++)
        hash = (hash ^ bytes[i]) * UINT64_C(0x100000001b3);
    return hash;
}

#endif

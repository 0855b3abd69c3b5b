#include "scene/sha256.h"

#include <nettle/sha2.h>
#include <stdint.h>
#include <stdio.h>

void kd_sha256(const void *data, size_t size, char out[65])
{
    uint8_t digest[SHA256_DIGEST_SIZE];
    struct sha256_ctx context;
    sha256_init(&context);
    sha256_update(&context, size, data);
    sha256_digest(&context, sizeof digest, digest);
    kd_sha256_text(digest, out);
}

void kd_sha256_text(const uint8_t digest[32], char out[65])
{
    for (size_t i = 0; i < SHA256_DIGEST_SIZE; i++)
        snprintf(out + 2 * i, 3, "%02x", digest[i]);
}

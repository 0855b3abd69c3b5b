/* The SHA-256 (FIPS 180-4) as text, computed by nettle. Any thread. */
#ifndef KD_SCENE_SHA256_H
#define KD_SCENE_SHA256_H

#include <stddef.h>
#include <stdint.h>

/* Writes 64 hexadecimal digits and a NUL. data may be NULL if size is 0. Takes some 3 ms per MiB. */
void kd_sha256(const void *data, size_t size, char out[65]);
/* Writes a digest that was computed by separate calls of nettle. */
void kd_sha256_text(const uint8_t digest[32], char out[65]);

#endif

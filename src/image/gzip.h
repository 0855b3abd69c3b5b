/* Compresses the contents of a buffer to a gzip stream (RFC 1952), in place. Any thread. */
#ifndef KD_IMAGE_GZIP_H
#define KD_IMAGE_GZIP_H

#include "base/buffer.h"

#include <stdbool.h>

/* ONCE: fast, for an answer that is sent once. KEPT: as small as possible, for a document that is sent many times. */
enum kd_gzip { KD_GZIP_ONCE, KD_GZIP_KEPT };

/* Returns false, with the buffer unchanged, if the stream would not be shorter or memory has run out. */
bool kd_gzip(struct kd_buffer *buffer, enum kd_gzip use);

#endif

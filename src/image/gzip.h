/* Replaces the contents of a buffer by a gzip stream of them (RFC 1952). Any thread. */
#ifndef KD_IMAGE_GZIP_H
#define KD_IMAGE_GZIP_H

#include "base/buffer.h"

#include <stdbool.h>

/* false: the buffer is as it was, because that is not shorter or memory ran out. */
bool kd_gzip(struct kd_buffer *buffer);

#endif

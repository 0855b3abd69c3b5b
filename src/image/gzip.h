/* This puts a gzip stream (RFC 1952) in place of what is in a buffer. Any thread. */
#ifndef KD_IMAGE_GZIP_H
#define KD_IMAGE_GZIP_H

#include "base/buffer.h"

#include <stdbool.h>

/* false: the buffer is as it was, because that is not shorter or memory ran out. */
bool kd_gzip(struct kd_buffer *buffer);

#endif

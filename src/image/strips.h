/* Encodes a picture in strips on as many cores as are idle, and joins the strips in order. The division into strips
 * depends on the picture only, so that the output is the same for any number of threads. Any thread. */
#ifndef KD_IMAGE_STRIPS_H
#define KD_IMAGE_STRIPS_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>

struct kd_strips {
    size_t n;
    /* Appends the bytes of a strip. Several threads call this at the same time. */
    enum kd_status (*encode)(void *user, size_t strip, struct kd_buffer *out);
    /* Joins a strip to the strips before it. It is called for one strip at a time, starting with strip 0. */
    enum kd_status (*join)(void *user, size_t strip, const struct kd_buffer *bytes);
    void *user;
};

/* The bytes of a strip are kept only until the strip is joined. If a call fails, no further strip is started, and
 * the status of that call is returned. KD_ENOMEM. */
enum kd_status kd_strips_encode(const struct kd_strips *strips);

#endif

/* Encodes a picture strip by strip on as many cores as are idle, and joins the strips in order. The strips depend on
 * the picture only, so that the bytes are the same on any number of threads. Any thread. */
#ifndef KD_IMAGE_STRIPS_H
#define KD_IMAGE_STRIPS_H

#include "base/buffer.h"
#include "base/error.h"

#include <stddef.h>

struct kd_strips {
    size_t n;
    /* Appends a strip's bytes. Called on several threads at once. */
    enum kd_status (*encode)(void *user, size_t strip, struct kd_buffer *out);
    /* Joins a strip to the strips before it: one call at a time, strip 0 first. */
    enum kd_status (*join)(void *user, size_t strip, const struct kd_buffer *bytes);
    void *user;
};

/* Bytes of strips are kept only until they are joined. If a call fails, no other strip begins, and the status of
 * that call is returned. KD_ENOMEM. */
enum kd_status kd_strips_encode(const struct kd_strips *strips);

#endif

#include "image/strips.h"

#include "base/parallel.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

struct bytes {
    struct kd_buffer buffer;
    bool there;
};

struct work {
    const struct kd_strips *strips;
    pthread_mutex_t lock;
    /* Guarded by the lock: */
    struct bytes *waiting; /* encoded bytes of the strips that are not joined yet, one entry for each strip */
    size_t joined;
    enum kd_status status;
};

static void join_those_there(struct work *w)
{
    for (; !w->status && w->joined < w->strips->n && w->waiting[w->joined].there; w->joined++) {
        struct kd_buffer *buffer = &w->waiting[w->joined].buffer;
        w->status = w->strips->join(w->strips->user, w->joined, buffer);
        kd_buffer_finish(buffer);
    }
}

static void one(void *user, size_t strip)
{
    struct work *w = user;
    struct kd_buffer buffer = { 0 };
    pthread_mutex_lock(&w->lock);
    const bool given_up = w->status;
    pthread_mutex_unlock(&w->lock);
    if (given_up)
        return;
    const enum kd_status status = w->strips->encode(w->strips->user, strip, &buffer);
    pthread_mutex_lock(&w->lock);
    w->waiting[strip] = (struct bytes) { buffer, true };
    w->status = w->status ? w->status : status;
    join_those_there(w);
    pthread_mutex_unlock(&w->lock);
}

enum kd_status kd_strips_encode(const struct kd_strips *strips)
{
    struct work work = { .strips = strips, .waiting = calloc(strips->n, sizeof *work.waiting) };
    if (!work.waiting)
        return KD_ENOMEM;
    pthread_mutex_init(&work.lock, NULL);
    kd_parallel_idle(strips->n, one, &work);
    pthread_mutex_destroy(&work.lock);
    for (size_t i = work.joined; i < strips->n; i++)
        kd_buffer_finish(&work.waiting[i].buffer);
    free(work.waiting);
    return work.status;
}

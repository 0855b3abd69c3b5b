/* A queue of requests for things that are made from assets and are too slow for the thread with the device: panoramas
 * and grids of matter. A thread makes them one after the other and ends when there is no request. The owner caches the
 * results. Any thread, unless stated otherwise. */
#ifndef KD_RENDER_DEVICE_ASSET_READER_H
#define KD_RENDER_DEVICE_ASSET_READER_H

#include "base/error.h"
#include "scene/asset.h"

#include <pthread.h>

/* What is requested. Two requests with the same name are one. */
struct kd_asset_request {
    char of[KD_ASSET_NAME]; /* the asset's hash, or another name that the owner gives */
    int32_t seed;           /* for the owner */
    bool ahead;             /* preloaded: nobody waits for it */
    bool whole;             /* for the owner: a description alone is not enough */
};

/* The owner's part. Only one call of `make` runs at a time, so the owner can keep its result until `keep`. */
struct kd_asset_maker {
    bool (*is_cached)(void *owner, const struct kd_asset_request *request); /* with the lock */
    void (*make_room)(void *owner);                                         /* evicts, before `make`; with the lock */
    /* Makes the thing; without the lock. *invalid (false before): the asset will never be valid, so it is not read
     * again. */
    enum kd_status (*make)(void *owner, const struct kd_asset_request *request, bool *invalid, struct kd_error *error);
    void (*keep)(void *owner, const struct kd_asset_request *request); /* caches what was made; with the lock */
    /* After each request, without the lock, in the thread alone; may be NULL. */
    void (*after)(void *owner, const struct kd_asset_request *request);
};

enum { KD_ASSET_REQUESTS = 16 };
struct kd_asset_reader {
    pthread_mutex_t lock; /* guards everything below, and the owner's cache */
    pthread_cond_t changed;
    struct kd_asset_request asked[KD_ASSET_REQUESTS]; /* the first one is in progress */
    unsigned n_asked;
    bool runs;                  /* the thread is running */
    char broken[KD_ASSET_NAME]; /* the last request that failed; "": none failed */
    bool invalid;               /* its asset is invalid */
    struct kd_error why;
    const struct kd_asset_maker *maker;
    void *owner;
    void (*made)(void *user); /* called by the thread, without the lock, after each request; may be NULL */
    void *user;
};

void kd_asset_reader_init(struct kd_asset_reader *reader, const struct kd_asset_maker *maker, void *owner,
                          void (*made)(void *user), void *user);
/* Stops first. */
void kd_asset_reader_finish(struct kd_asset_reader *reader);

/* With the lock: adds a request unless the thing is cached. A waiting client calls again, so that what was evicted
 * meanwhile is made once more. Does nothing if no thread can be created. Returns whether the request is in progress. */
bool kd_asset_reader_begin(struct kd_asset_reader *reader, const struct kd_asset_request *request);
/* With the lock: waits until the thing is cached, and makes it here if there is no thread. On failure returns the
 * error of `make`. */
enum kd_status kd_asset_reader_wait(struct kd_asset_reader *reader, const struct kd_asset_request *request,
                                    struct kd_error *error);
/* With the lock: whether nothing is requested or being made. */
bool kd_asset_reader_is_idle(const struct kd_asset_reader *reader);
/* Waits for the request in progress and drops the others: `made` is not called any more until a new request. */
void kd_asset_reader_stop(struct kd_asset_reader *reader);

/* Takes the bytes of a field's asset; the caller gives them back. KD_EINVAL at `pointer`: its file is missing. */
enum kd_status kd_asset_reader_take(const struct kd_assets *assets, const char *hash, const char *pointer,
                                    const char *field, struct kd_asset_bytes *out, struct kd_error *error);

#endif

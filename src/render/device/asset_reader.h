/* A queue of requests for panoramas and grids of matter. They are made from assets, which takes too long for the
 * thread that owns the device. So a thread of the queue makes them one after the other, and ends when there is no
 * request. The owner caches the results. Any thread, unless stated otherwise. */
#ifndef KD_RENDER_DEVICE_ASSET_READER_H
#define KD_RENDER_DEVICE_ASSET_READER_H

#include "base/error.h"
#include "scene/asset.h"

#include <pthread.h>

/* A request. Two requests with the same name count as one. */
struct kd_asset_request {
    char of[KD_ASSET_NAME]; /* the asset's hash, or another name that the owner chooses */
    int32_t seed;           /* used by the owner only */
    bool ahead;             /* true if the object is loaded in advance, so that nobody waits for it */
    bool whole;             /* true if the owner needs the object itself, and not only its description */
};

/* Callbacks of the owner. Only one call of `make` runs at a time, so the owner needs to store only one result between
 * `make` and `keep`. */
struct kd_asset_maker {
    bool (*is_cached)(void *owner, const struct kd_asset_request *request); /* called with the lock */
    /* evicts objects before `make`; called with the lock */
    void (*make_room)(void *owner);
    /* Makes the object; called without the lock. *invalid is false when the function is called. The function sets
     * *invalid if the asset can never be valid, so that the asset is not read again. */
    enum kd_status (*make)(void *owner, const struct kd_asset_request *request, bool *invalid, struct kd_error *error);
    /* caches what `make` made; called with the lock */
    void (*keep)(void *owner, const struct kd_asset_request *request);
    /* Called after each request, without the lock, and only by the queue's own thread; may be NULL. */
    void (*after)(void *owner, const struct kd_asset_request *request);
};

enum { KD_ASSET_REQUESTS = 16 };
struct kd_asset_reader {
    pthread_mutex_t lock; /* protects all members below, and the owner's cache */
    pthread_cond_t changed;
    struct kd_asset_request asked[KD_ASSET_REQUESTS]; /* requests, oldest first; the first one is in progress */
    unsigned n_asked;
    bool runs; /* true while a thread serves the queue: its own, or a caller of kd_asset_reader_wait */
    /* name of the last failed request that was not `ahead`; "": none, or it may be tried again */
    char broken[KD_ASSET_NAME];
    bool invalid; /* true if `broken` failed because its asset is invalid */
    struct kd_error why;
    const struct kd_asset_maker *maker;
    void *owner;
    void (*made)(void *user); /* called by the queue's own thread, without the lock, after each request; may be NULL */
    void *user;
};

void kd_asset_reader_init(struct kd_asset_reader *reader, const struct kd_asset_maker *maker, void *owner,
                          void (*made)(void *user), void *user);
/* Calls kd_asset_reader_stop first. */
void kd_asset_reader_finish(struct kd_asset_reader *reader);

/* Adds a request. Does nothing if the object is cached, if its asset is invalid, if the queue is full, or if no thread
 * can be created. A waiting client calls this function repeatedly; if the object was evicted meanwhile, it is made once
 * more. Returns true if the request is waiting or in progress. Called with the lock. */
bool kd_asset_reader_begin(struct kd_asset_reader *reader, const struct kd_asset_request *request);
/* Waits until the object is cached, and makes it on the calling thread if no thread can be created. On failure returns
 * the error of `make`. Called with the lock. */
enum kd_status kd_asset_reader_wait(struct kd_asset_reader *reader, const struct kd_asset_request *request,
                                    struct kd_error *error);
/* True if there is no request, waiting or in progress. Called with the lock. */
bool kd_asset_reader_is_idle(const struct kd_asset_reader *reader);
/* Waits for the request in progress and drops all others. `made` is not called again before a new request. */
void kd_asset_reader_stop(struct kd_asset_reader *reader);

/* Gets the bytes of a field's asset; the caller must give them back. Returns KD_EINVAL at `pointer` if the asset's
 * file is missing. */
enum kd_status kd_asset_reader_take(const struct kd_assets *assets, const char *hash, const char *pointer,
                                    const char *field, struct kd_asset_bytes *out, struct kd_error *error);

#endif

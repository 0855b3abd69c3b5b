/* Asset store: files that clients upload, and that scenes name by their SHA-256. Assets are kept in memory. If the
 * server has a state folder, they are also kept on disk, as DIRECTORY/assets/HASH.png, .npz, .uvfits or .csv, and
 * HASH.json. HASH.json is written last. Each file is written atomically. Any thread.
 *
 * Errors contain no path, because clients see them. */
#ifndef KD_SERVER_ASSET_STORE_H
#define KD_SERVER_ASSET_STORE_H

#include "observe/observation.h"
#include "scene/asset.h"
#include "server/http/secret.h"
#include "server/http/shares.h"
#include "server/http/task_scheduler.h"

#include <stdint.h>

struct kd_asset_store;
struct kd_asset;

#define KD_ASSET_BYTES ((size_t)32 << 20)   /* largest size of one asset */
#define KD_ASSET_PIXELS ((uint64_t)1 << 28) /* largest number of pixels of one picture */

struct kd_asset_limits {
    /* most: largest number of assets; client_most: the same for one client */
    unsigned most, client_most;
    uint64_t bytes,
        /* bytes: largest total size of all assets, including the unpacked bytes of grids that are being checked;
         * client_bytes: the same for one client */
        client_bytes;
    double keep_s; /* an asset that is unused for this long may be evicted for a new one */
};
/* Makes an empty store. */
enum kd_status kd_asset_store_create(const struct kd_asset_limits *limits, struct kd_asset_store **out,
                                     struct kd_error *error);
/* Loads the assets of the server's state folder. Assets that are added later are stored there. This process holds the
 * folder's lock (job/store.h). Unreadable assets are logged and left alone. Call it once, before any asset is added. */
enum kd_status kd_asset_store_open(struct kd_asset_store *store, const char *state, struct kd_error *error);
/* The store in the form that scenes and renderers use: assets by hash. */
const struct kd_assets *kd_asset_store_assets(const struct kd_asset_store *store);
/* Call it when no references are left. Accepts NULL. */
void kd_asset_store_close(struct kd_asset_store *store);
const struct kd_asset_limits *kd_asset_store_limits(const struct kd_asset_store *store);

/* Adds a copy of a client's bytes, in pieces (put.c). Runs in slices of workers, on one thread at a time.
 *
 *     kd_asset_put_begin(&put, store, data, size, client)        data must stay valid
 *     status = kd_asset_put_go_on(&put, until_ms, &how, &error) repeat until it is over or fails
 *     kd_asset_put_finish(&put)                                  may be called at any time
 *
 * put.asset: a reference for the caller; put.created: the bytes were not stored before. KD_EINVAL: the content is not
 * supported. KD_EBUSY with put.quota: the client's share is used up. KD_EFULL: the disk is full or, if put.full is
 * set, the store is full. */
struct kd_asset_put {
    struct kd_asset *asset;
    bool created, quota, full;
    /* set by the caller after kd_asset_put_begin: to make room, another asset may be evicted even if it was used
     * recently */
    bool any_age;
    struct kd_asset_putting *own; /* internal state; freed by kd_asset_put_finish */
};
enum kd_asset_progress {
    KD_ASSET_MORE, /* call again */
    KD_ASSET_WAIT, /* another thread is storing the same bytes or is making room: call again a little later */
    KD_ASSET_OVER,
};
enum kd_status kd_asset_put_begin(struct kd_asset_put *put, struct kd_asset_store *store, const void *data, size_t size,
                                  const char *client, struct kd_error *error);
enum kd_status kd_asset_put_go_on(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                                  struct kd_error *error);
void kd_asset_put_finish(struct kd_asset_put *put);
/* Finds an asset by its hash. Returns a reference, or NULL. The search counts as a use, so that the asset is not
 * evicted soon. */
struct kd_asset *kd_asset_store_find(struct kd_asset_store *store, const char *hash);
/* Removes an asset. When this returns, the asset cannot be found any more, and its files are deleted. Call it on
 * workers only, because it waits for the disk. The memory is freed with the last reference. Returns false if another
 * thread has removed the asset. */
bool kd_asset_store_remove(struct kd_asset_store *store, struct kd_asset *asset);
/* Like kd_asset_store_remove, but a worker removes the asset; for callers that must not wait. */
void kd_asset_store_remove_later(struct kd_asset_store *store, struct kd_asset *asset, struct kd_scheduler *workers);
void kd_asset_release(struct kd_asset_store *store, struct kd_asset *asset);
/* Counts the assets that can be found, and their bytes. Assets whose files are being written or removed are left
 * out. */
void kd_asset_store_count(struct kd_asset_store *store, unsigned *assets, uint64_t *bytes);

/* Description of an asset; immutable while a reference is held. */
struct kd_asset_about {
    char hash[KD_ASSET_NAME], token[KD_SECRET_TOKEN];
    uint32_t width, height; /* size of a picture */
    int bit_depth, channels;
    enum kd_observation_kind observation; /* NONE: not an observation */
    uint32_t visibilities, stations;      /* numbers of visibilities and stations of an observation */
    struct kd_asset_grid grid;
    double created; /* seconds since 1970 */
    size_t size;
    const uint8_t *data;
};
const struct kd_asset_about *kd_asset_about(const struct kd_asset *asset);

#endif

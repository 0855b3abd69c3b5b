/* The asset store holds files that clients upload, and that scenes refer to by SHA-256. Assets are kept in memory.
 * If the server has a state folder, they are also on disk, as DIRECTORY/assets/HASH.png, .npz, .uvfits or .csv, with
 * a record HASH.json. The record is written last, and each file is written atomically. Any thread. Error messages
 * contain no path, because clients see them. */
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

#define KD_ASSET_BYTES ((size_t)32 << 20)   /* maximum size of one asset in bytes */
#define KD_ASSET_PIXELS ((uint64_t)1 << 28) /* maximum number of pixels of one picture */

struct kd_asset_limits {
    /* most: maximum number of assets; client_most: maximum for one client */
    unsigned most, client_most;
    uint64_t bytes,
        /* bytes: maximum total size of all assets, including the unpacked bytes of grids that are being checked;
         * client_bytes: maximum for one client */
        client_bytes;
    double keep_s; /* an asset that is unused for this number of seconds may be evicted for a new one */
};
/* Makes an empty store. */
enum kd_status kd_asset_store_create(const struct kd_asset_limits *limits, struct kd_asset_store **out,
                                     struct kd_error *error);
/* Loads the assets from the server's state folder, in which assets that are added later are stored as well. This
 * process must hold the folder's lock (job/store.h). Unreadable assets are logged and left alone. Call this once,
 * before any asset is added. */
enum kd_status kd_asset_store_open(struct kd_asset_store *store, const char *state, struct kd_error *error);
/* The store in the form in which scenes and renderers use it: as a provider of assets by hash. */
const struct kd_assets *kd_asset_store_assets(const struct kd_asset_store *store);
/* Call this when there are no references left. Accepts NULL. */
void kd_asset_store_close(struct kd_asset_store *store);
const struct kd_asset_limits *kd_asset_store_limits(const struct kd_asset_store *store);

/* Adds a copy of a client's bytes, in steps (put.c). The steps run in slices of workers, on one thread at a time.
 *
 *     kd_asset_put_begin(&put, store, data, size, client)        data must stay valid
 *     status = kd_asset_put_go_on(&put, until_ms, &how, &error) repeat until it is over or fails
 *     kd_asset_put_finish(&put)                                  may be called at any time
 *
 * put.asset: a reference for the caller; put.created: the bytes were not stored before. KD_EINVAL: the content is
 * not supported. KD_EBUSY with put.quota: the client's share is used up. KD_EFULL: the disk is full or, if put.full
 * is set, the store is full. */
struct kd_asset_put {
    struct kd_asset *asset;
    bool created, quota, full;
    /* set by the caller after kd_asset_put_begin: true if another asset may be evicted to make room even if it was
     * used recently */
    bool any_age;
    struct kd_asset_putting *own; /* internal state, which kd_asset_put_finish frees */
};
enum kd_asset_progress {
    KD_ASSET_MORE, /* call again */
    KD_ASSET_WAIT, /* another thread is storing the same bytes or making room; call again a little later */
    KD_ASSET_OVER,
};
enum kd_status kd_asset_put_begin(struct kd_asset_put *put, struct kd_asset_store *store, const void *data, size_t size,
                                  const char *client, struct kd_error *error);
enum kd_status kd_asset_put_go_on(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                                  struct kd_error *error);
void kd_asset_put_finish(struct kd_asset_put *put);
/* Finds an asset by its hash. Returns a reference, or NULL. This counts as a use of the asset, so that it is not
 * evicted soon. */
struct kd_asset *kd_asset_store_find(struct kd_asset_store *store, const char *hash);
/* Removes an asset. Afterwards, searches no longer find the asset, and its files are deleted. Call this only on
 * workers, because it waits for the disk. The memory is freed with the last reference. Returns false if another
 * thread has removed the asset. */
bool kd_asset_store_remove(struct kd_asset_store *store, struct kd_asset *asset);
/* Like kd_asset_store_remove, but a worker does the removal; for callers that must not wait. */
void kd_asset_store_remove_later(struct kd_asset_store *store, struct kd_asset *asset, struct kd_scheduler *workers);
void kd_asset_release(struct kd_asset_store *store, struct kd_asset *asset);
/* Counts the assets that searches can find, and their bytes. Assets whose files are being written or removed do not
 * count. */
void kd_asset_store_count(struct kd_asset_store *store, unsigned *assets, uint64_t *bytes);

/* Description of an asset. It does not change while a reference is held. */
struct kd_asset_about {
    char hash[KD_ASSET_NAME], token[KD_SECRET_TOKEN];
    uint32_t width, height; /* size of a picture */
    int bit_depth, channels;
    enum kd_observation_kind observation; /* NONE if the asset is not an observation */
    uint32_t visibilities, stations;      /* number of visibilities and of stations of an observation */
    struct kd_asset_grid grid;
    double created; /* seconds since 1970 */
    size_t size;
    const uint8_t *data;
};
const struct kd_asset_about *kd_asset_about(const struct kd_asset *asset);

#endif

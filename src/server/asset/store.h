/* Assets: files that clients upload, and that scenes name by their SHA-256. They are kept in memory, and on disk if
 * the server has a state folder: DIRECTORY/assets/HASH.png, .npz, .uvfits or .csv, with HASH.json beside it, each
 * written atomically, the latter last. Any thread.
 *
 * Errors name no path, because clients see them. */
#ifndef KD_SERVER_ASSET_STORE_H
#define KD_SERVER_ASSET_STORE_H

#include "observe/observation.h"
#include "scene/asset.h"
#include "server/http/secret.h"
#include "server/http/shares.h"
#include "server/http/turns.h"

#include <stdint.h>

struct kd_asset_store;
struct kd_asset;

#define KD_ASSET_TYPE "image/png"                   /* pictures, */
#define KD_ASSET_GRID_TYPE "application/x-npz"      /* and grids of matter (render/emit/matter_grid.h) */
#define KD_ASSET_UVFITS_TYPE "application/x-uvfits" /* and observations (observe/observation.h) */
#define KD_ASSET_CSV_TYPE "text/csv"
#define KD_ASSET_BYTES ((size_t)32 << 20)   /* of one */
#define KD_ASSET_PIXELS ((uint64_t)1 << 28) /* of one */

struct kd_asset_limits {
    unsigned most, client_most; /* assets; of one client */
    uint64_t bytes,
        client_bytes; /* of all, what grids unpack while they are checked among them; of those of one client */
    double keep_s;    /* that one stays though nobody asks for it and others want its room */
};
/* Makes a store without assets. */
enum kd_status kd_asset_store_create(const struct kd_asset_limits *limits, struct kd_asset_store **out,
                                     struct kd_error *error);
/* Keeps assets in the server's folder from now on, of which this process holds the lock (job/store.h). Those in it
 * are read; what cannot be read is logged and left alone. To be called once, before anything is put here. */
enum kd_status kd_asset_store_open(struct kd_asset_store *store, const char *state, struct kd_error *error);
/* The store as scenes and renderers see it, by hashes alone. */
const struct kd_assets *kd_asset_store_assets(const struct kd_asset_store *store);
/* To be called when nobody holds a reference any more. Accepts NULL. */
void kd_asset_store_close(struct kd_asset_store *store);
const struct kd_asset_limits *kd_asset_store_limits(const struct kd_asset_store *store);

/* Keeps a copy of bytes that a client puts here, by pieces: put.c. Workers' turns, one at a time.
 *
 *     kd_asset_put_begin(&put, store, data, size, client)      data must stay
 *     status = kd_asset_put_go_on(&put, until_ms, &how, &error)  again until it is over or fails
 *     kd_asset_put_finish(&put)                                at any time
 *
 * put.asset: a reference, which is the caller's; put.created: its bytes were not here before. KD_EINVAL: they are
 * nothing that is taken; KD_EBUSY with put.quota: the client has its share; KD_EFULL: the disk is full, or with
 * put.full as much is kept as may be. */
struct kd_asset_put {
    struct kd_asset *asset;
    bool created, quota, full;
    struct kd_asset_putting *own; /* while it is under way */
};
enum kd_asset_progress {
    KD_ASSET_MORE, /* there is another piece */
    KD_ASSET_WAIT, /* not before somebody else is through: ask again a little later */
    KD_ASSET_OVER,
};
enum kd_status kd_asset_put_begin(struct kd_asset_put *put, struct kd_asset_store *store, const void *data, size_t size,
                                  const char *client, struct kd_error *error);
enum kd_status kd_asset_put_go_on(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                                  struct kd_error *error);
void kd_asset_put_finish(struct kd_asset_put *put);
/* Finds an asset by its hash: a reference, or NULL. Who asks for an asset keeps it from giving way. */
struct kd_asset *kd_asset_store_find(struct kd_asset_store *store, const char *hash);
/* Removes the asset: nobody finds it any more, and its files are gone when this returns, which takes as long as the
 * disk does: for workers. Its bytes go with the last reference. False: somebody else has removed it. */
bool kd_asset_store_remove(struct kd_asset_store *store, struct kd_asset *asset);
/* The same on a worker, for who must not wait. */
void kd_asset_store_remove_later(struct kd_asset_store *store, struct kd_asset *asset, struct kd_turns *workers);
void kd_asset_release(struct kd_asset_store *store, struct kd_asset *asset);
/* How many can be found, and their bytes: without those whose files are just being written or removed. */
void kd_asset_store_count(struct kd_asset_store *store, unsigned *assets, uint64_t *bytes);

/* What is known of an asset stays the same as long as it is held. */
struct kd_asset_about {
    char hash[KD_ASSET_NAME], token[KD_SECRET_TOKEN];
    uint32_t width, height; /* of a picture */
    int bit_depth, channels;
    enum kd_observation_kind observation; /* NONE: it is none */
    uint32_t visibilities, stations;      /* of an observation */
    uint32_t nodes[3];                    /* of a grid, in r, theta and phi; 0: it is none, but a picture */
    double spin;
    double created; /* seconds since 1970 */
    size_t size;
    const uint8_t *data;
};
const struct kd_asset_about *kd_asset_about(const struct kd_asset *asset);

#endif

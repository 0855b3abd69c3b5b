/* Internals of the asset store, shared by the files of this folder. */
#ifndef KD_SERVER_ASSET_INTERNAL_H
#define KD_SERVER_ASSET_INTERNAL_H

#include "server/asset/store.h"

#include <pthread.h>

enum kd_asset_state {
    KD_ASSET_WRITING, /* the asset's files are being written */
    KD_ASSET_READY,   /* the asset can be found */
    KD_ASSET_LEAVING, /* the asset's files are being removed */
};

struct kd_asset {
    struct kd_asset_about about;
    char client[KD_CLIENT];
    double used_ms;
    unsigned references; /* number of references, including that of the store */
    enum kd_asset_state state;
    struct kd_scheduler_job removal; /* the job that removes the asset's files later (kd_asset_store_remove_later) */
    struct kd_asset_store *store;
    struct kd_asset *next;
    uint8_t bytes[];
};

struct kd_asset_store {
    struct kd_asset_limits limits;
    struct kd_assets assets;
    pthread_mutex_t lock; /* protects all members below; it is never held while a file is written or removed */
    int folder;           /* descriptor of the folder; -1: there is none */
    struct kd_asset *first;
    uint64_t checking; /* memory in bytes that the checks in progress use */
    /* count and bytes are changed only with the lock held, but are also read without the lock */
    _Atomic unsigned count;
    _Atomic uint64_t bytes;
};

/* Makes an asset with a copy of the bytes. The asset is not in the list yet. Returns NULL when out of memory. */
struct kd_asset *kd_asset_make(struct kd_asset_store *store, const struct kd_asset_about *about, const void *data,
                               size_t size, const char *client);

/* Adds an asset to the list. Called with the lock held. */
void kd_asset_insert(struct kd_asset_store *store, struct kd_asset *asset);
/* Removes an asset from the list and drops the store's reference. */
void kd_asset_take_out(struct kd_asset_store *store, struct kd_asset *asset);
void kd_asset_unref(struct kd_asset *asset);
struct kd_asset *kd_asset_find(const struct kd_asset_store *store, const char *hash); /* finds an asset in any state */

/* Removes the files of an asset in the state KD_ASSET_LEAVING, and then the asset. Called without the lock. Waits
 * for the disk. */
void kd_asset_leave(struct kd_asset_store *store, struct kd_asset *asset);

#endif

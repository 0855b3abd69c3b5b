#include "server/asset/asset_internal.h"

#include "base/clock.h"
#include "base/log.h"
#include "server/asset/folder.h"

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

const struct kd_asset_about *kd_asset_about(const struct kd_asset *asset) { return &asset->about; }
const struct kd_asset_limits *kd_asset_store_limits(const struct kd_asset_store *store) { return &store->limits; }

struct kd_asset *kd_asset_make(struct kd_asset_store *store, const struct kd_asset_about *about, const void *data,
                               size_t size, const char *client)
{
    struct kd_asset *asset = calloc(1, sizeof *asset + size);
    if (!asset)
        return NULL;
    memcpy(asset->bytes, data, size);
    asset->store = store;
    asset->about = *about;
    asset->about.data = asset->bytes;
    asset->about.size = size;
    asset->used_ms = kd_clock_ms();
    asset->references = 1;
    snprintf(asset->client, sizeof asset->client, "%s", client);
    return asset;
}

void kd_asset_insert(struct kd_asset_store *store, struct kd_asset *asset)
{
    asset->next = store->first;
    store->first = asset;
    store->count++;
    store->bytes += asset->about.size;
}

void kd_asset_unref(struct kd_asset *asset)
{
    if (!--asset->references)
        free(asset);
}

void kd_asset_take_out(struct kd_asset_store *store, struct kd_asset *asset)
{
    struct kd_asset **at = &store->first;
    while (*at != asset)
        at = &(*at)->next;
    *at = asset->next;
    store->count--;
    store->bytes -= asset->about.size;
    kd_asset_unref(asset);
}

struct kd_asset *kd_asset_find(const struct kd_asset_store *store, const char *hash)
{
    for (struct kd_asset *asset = store->first; asset; asset = asset->next)
        if (!strcmp(asset->about.hash, hash))
            return asset;
    return NULL;
}

/* Adds an asset that is in the folder. The client that uploaded it is not recorded, so it counts towards no client's
 * share. */
static void load(void *user, const struct kd_asset_about *about, struct kd_buffer *bytes)
{
    struct kd_asset_store *store = user;
    struct kd_asset *asset = kd_asset_make(store, about, bytes->data, bytes->size, "");
    if (!asset) {
        kd_log(KD_LOG_WARN, "asset %.4s... is skipped: out of memory", about->hash);
        return;
    }
    asset->state = KD_ASSET_READY;
    kd_asset_insert(store, asset);
}

static bool find_for_scene(void *user, const char *name, struct kd_asset_found *out)
{
    struct kd_asset *asset = kd_asset_store_find(user, name);
    if (!asset)
        return false;
    memcpy(out->hash, asset->about.hash, sizeof out->hash);
    out->width = asset->about.width;
    out->height = asset->about.height;
    out->grid = asset->about.grid;
    kd_asset_release(user, asset);
    return true;
}

static bool take(void *user, const char *hash, struct kd_asset_bytes *out)
{
    struct kd_asset *asset = kd_asset_store_find(user, hash);
    if (asset)
        *out = (struct kd_asset_bytes) { asset->about.data, asset->about.size, asset };
    return asset;
}

static void give_back(void *user, struct kd_asset_bytes *bytes) { kd_asset_release(user, bytes->held); }

enum kd_status kd_asset_store_create(const struct kd_asset_limits *limits, struct kd_asset_store **out,
                                     struct kd_error *error)
{
    struct kd_asset_store *store = calloc(1, sizeof *store);
    if (!store)
        return kd_error_set(error, KD_ENOMEM, "out of memory");
    store->limits = *limits;
    store->assets = (struct kd_assets) { find_for_scene, take, give_back,
                                         "null, or the SHA-256 of an asset that PUT /v1/assets has stored", store };
    store->folder = -1;
    pthread_mutex_init(&store->lock, NULL);
    *out = store;
    return KD_OK;
}

enum kd_status kd_asset_store_open(struct kd_asset_store *store, const char *state, struct kd_error *error)
{
    enum kd_status status = kd_asset_folder_open(state, &store->folder, error);
    return status ? status : kd_asset_folder_load(store->folder, load, store, error);
}

const struct kd_assets *kd_asset_store_assets(const struct kd_asset_store *store) { return &store->assets; }

void kd_asset_store_close(struct kd_asset_store *store)
{
    if (!store)
        return;
    while (store->first) {
        /* removes the files of an asset whose removal was interrupted when the server ended */
        if (store->first->state == KD_ASSET_LEAVING && store->folder >= 0)
            kd_asset_folder_remove(store->folder, store->first->about.hash);
        kd_asset_take_out(store, store->first);
    }
    if (store->folder >= 0)
        close(store->folder);
    pthread_mutex_destroy(&store->lock);
    free(store);
}

struct kd_asset *kd_asset_store_find(struct kd_asset_store *store, const char *hash)
{
    pthread_mutex_lock(&store->lock);
    struct kd_asset *asset = kd_asset_find(store, hash);
    if (asset && asset->state != KD_ASSET_READY)
        asset = NULL;
    if (asset) {
        asset->references++;
        asset->used_ms = kd_clock_ms();
    }
    pthread_mutex_unlock(&store->lock);
    return asset;
}

void kd_asset_leave(struct kd_asset_store *store, struct kd_asset *asset)
{
    /* the files are deleted here, so that they are gone before the same bytes can be stored again */
    if (store->folder >= 0)
        kd_asset_folder_remove(store->folder, asset->about.hash);
    pthread_mutex_lock(&store->lock);
    kd_asset_take_out(store, asset);
    pthread_mutex_unlock(&store->lock);
}

/* Hides the asset from searches. Returns false if another thread is already removing it. */
static bool begin_to_leave(struct kd_asset_store *store, struct kd_asset *asset)
{
    pthread_mutex_lock(&store->lock);
    bool was = asset->state == KD_ASSET_READY;
    if (was)
        asset->state = KD_ASSET_LEAVING;
    pthread_mutex_unlock(&store->lock);
    return was;
}

bool kd_asset_store_remove(struct kd_asset_store *store, struct kd_asset *asset)
{
    bool was = begin_to_leave(store, asset);
    if (was)
        kd_asset_leave(store, asset);
    return was;
}

static enum kd_slice_result removal_turn(struct kd_scheduler_job *job)
{
    (void)job;
    return KD_SLICE_LAST;
}

/* Called after the removal. This may free the asset, and with it the job, which is a member of the asset. */
static void removal_done(struct kd_scheduler_job *job)
{
    struct kd_asset *asset = (struct kd_asset *)((char *)job - offsetof(struct kd_asset, removal));
    kd_asset_leave(asset->store, asset);
}

void kd_asset_store_remove_later(struct kd_asset_store *store, struct kd_asset *asset, struct kd_scheduler *workers)
{
    if (!begin_to_leave(store, asset))
        return;
    asset->removal = (struct kd_scheduler_job) { .turn = removal_turn, .done = removal_done };
    snprintf(asset->removal.client, sizeof asset->removal.client, "%s", asset->client);
    kd_scheduler_push(workers, &asset->removal);
}

void kd_asset_release(struct kd_asset_store *store, struct kd_asset *asset)
{
    pthread_mutex_lock(&store->lock);
    kd_asset_unref(asset);
    pthread_mutex_unlock(&store->lock);
}

void kd_asset_store_count(struct kd_asset_store *store, unsigned *assets, uint64_t *bytes)
{
    *assets = 0;
    *bytes = 0;
    pthread_mutex_lock(&store->lock);
    for (const struct kd_asset *asset = store->first; asset; asset = asset->next) {
        *assets += asset->state == KD_ASSET_READY;
        *bytes += asset->state == KD_ASSET_READY ? asset->about.size : 0;
    }
    pthread_mutex_unlock(&store->lock);
}

#include "server/asset/store.h"

#include "base/clock.h"
#include "base/log.h"
#include "scene/sha256.h"
#include "server/asset/folder.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct kd_asset {
    struct kd_asset_about about;
    char client[KD_CLIENT];
    double used_ms;
    unsigned references; /* the store's own among them */
    bool ready;          /* it is written */
    struct kd_asset *next;
    uint8_t bytes[];
};

struct kd_asset_store {
    struct kd_asset_limits limits;
    struct kd_assets assets;
    pthread_mutex_t lock; /* for what follows; never held while a file is written */
    int folder;           /* -1: none */
    struct kd_asset *first;
    _Atomic unsigned count; /* these two are written with the lock, and read without */
    _Atomic uint64_t bytes;
};

const struct kd_asset_about *kd_asset_about(const struct kd_asset *asset) { return &asset->about; }
const struct kd_asset_limits *kd_asset_store_limits(const struct kd_asset_store *store) { return &store->limits; }

static struct kd_asset *make(const struct kd_asset_about *about, const void *data, size_t size, const char *client)
{
    struct kd_asset *asset = calloc(1, sizeof *asset + size);
    if (!asset)
        return NULL;
    memcpy(asset->bytes, data, size);
    asset->about = *about;
    asset->about.data = asset->bytes;
    asset->about.size = size;
    asset->used_ms = kd_clock_ms();
    asset->references = 1;
    snprintf(asset->client, sizeof asset->client, "%s", client);
    return asset;
}

/* With the lock. */
static void insert(struct kd_asset_store *store, struct kd_asset *asset)
{
    asset->next = store->first;
    store->first = asset;
    store->count++;
    store->bytes += asset->about.size;
}

/* Takes the asset out of the list; false: it is not there any more. With the lock. */
static bool take_out(struct kd_asset_store *store, struct kd_asset *asset)
{
    struct kd_asset **at = &store->first;
    while (*at && *at != asset)
        at = &(*at)->next;
    if (!*at)
        return false;
    *at = asset->next;
    store->count--;
    store->bytes -= asset->about.size;
    return true;
}

/* With the lock. */
static void let_go(struct kd_asset *asset)
{
    if (!--asset->references)
        free(asset);
}

static struct kd_asset *find(const struct kd_asset_store *store, const char *hash)
{
    for (struct kd_asset *asset = store->first; asset; asset = asset->next)
        if (!strcmp(asset->about.hash, hash))
            return asset;
    return NULL;
}

/* Takes in an asset from the folder. Who put it there is not known any more, so it counts to no client. */
static void load(void *user, const struct kd_asset_about *about, struct kd_buffer *bytes)
{
    struct kd_asset_store *store = user;
    struct kd_asset *asset = make(about, bytes->data, bytes->size, "");
    if (!asset) {
        kd_log(KD_LOG_WARN, "asset %.4s... is left alone: there is no memory for it", about->hash);
        return;
    }
    asset->ready = true;
    insert(store, asset);
}

static bool find_for_scene(void *user, const char *name, struct kd_asset_found *out)
{
    struct kd_asset *asset = kd_asset_store_find(user, name);
    if (!asset)
        return false;
    memcpy(out->hash, asset->about.hash, sizeof out->hash);
    out->width = asset->about.width;
    out->height = asset->about.height;
    memcpy(out->nodes, asset->about.nodes, sizeof out->nodes);
    out->spin = asset->about.spin;
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
                                         "null and the SHA-256 of an asset that PUT /v1/assets has taken", store };
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
        struct kd_asset *asset = store->first;
        take_out(store, asset);
        let_go(asset);
    }
    if (store->folder >= 0)
        close(store->folder);
    pthread_mutex_destroy(&store->lock);
    free(store);
}

/* Finds the asset that nobody has asked for longest, if that is long enough to give way; NULL: none. With the lock. */
static struct kd_asset *oldest(const struct kd_asset_store *store)
{
    struct kd_asset *best = NULL;
    double before = kd_clock_ms() - 1e3 * store->limits.keep_s;
    for (struct kd_asset *asset = store->first; asset; asset = asset->next)
        if (asset->ready && asset->references == 1 && asset->used_ms < before &&
            (!best || asset->used_ms < best->used_ms))
            best = asset;
    return best;
}

static bool fits(const struct kd_asset_store *store, size_t size)
{
    return store->count < store->limits.most && store->bytes + size <= store->limits.bytes;
}

/* Says whether the client has its share already, or would have more with these bytes. With the lock. */
static bool has_share(const struct kd_asset_store *store, size_t size, const char *client)
{
    unsigned assets = 0;
    uint64_t bytes = size;
    for (const struct kd_asset *asset = store->first; asset; asset = asset->next)
        if (!strcmp(asset->client, client)) {
            assets++;
            bytes += asset->about.size;
        }
    return assets >= store->limits.client_most || bytes > store->limits.client_bytes;
}

/* With the lock. */
static bool make_room(struct kd_asset_store *store, size_t size)
{
    struct kd_asset *asset;
    while (!fits(store, size) && (asset = oldest(store))) {
        take_out(store, asset);
        if (store->folder >= 0)
            kd_asset_folder_remove(store->folder, asset->about.hash); /* before the same bytes can be put here again */
        let_go(asset);
    }
    return fits(store, size);
}

/* Finds the asset if it is here already, or makes place for a new one. With the lock. */
static enum kd_status place(struct kd_asset_store *store, struct kd_asset *fresh, struct kd_asset_put *put,
                            struct kd_error *error)
{
    const struct kd_asset_limits *limits = &store->limits;
    struct kd_asset *there = find(store, fresh->about.hash);
    if (there && !there->ready)
        return kd_error_set(error, KD_EBUSY, "these bytes are being written for somebody else");
    if (there) {
        there->references++;
        there->used_ms = kd_clock_ms();
        put->asset = there;
        return KD_OK;
    }
    put->quota = has_share(store, fresh->about.size, fresh->client);
    if (put->quota)
        return kd_error_set(error, KD_EBUSY,
                            "as many assets of yours are kept as may of one client: %u, of %llu bytes in all",
                            limits->client_most, (unsigned long long)limits->client_bytes);
    put->full = !make_room(store, fresh->about.size);
    if (put->full)
        return kd_error_set(error, KD_EFULL, "as many assets are kept as may: %u, of %llu bytes in all", limits->most,
                            (unsigned long long)limits->bytes);
    fresh->references = 2;
    insert(store, fresh);
    put->asset = fresh;
    put->created = true;
    return KD_OK;
}

/* Writes the file of an asset that has a place. From then on it can be found. */
static enum kd_status settle(struct kd_asset_store *store, struct kd_asset *asset, struct kd_error *error)
{
    enum kd_status status = store->folder >= 0 ? kd_asset_folder_write(store->folder, &asset->about, error) : KD_OK;
    pthread_mutex_lock(&store->lock);
    asset->ready = !status;
    if (status && take_out(store, asset))
        let_go(asset);
    pthread_mutex_unlock(&store->lock);
    return status;
}

enum kd_status kd_asset_store_put(struct kd_asset_store *store, const void *data, size_t size, const char *client,
                                  struct kd_asset_put *put, struct kd_error *error)
{
    struct kd_asset_about about = { .created = (double)time(NULL) };
    *put = (struct kd_asset_put) { 0 };
    enum kd_status status = kd_asset_look(data, size, &about, error);
    if (status)
        return status;
    kd_sha256(data, size, about.hash);
    if (!kd_secret_make(about.token, sizeof about.token))
        return kd_error_set(error, KD_EIO, "there are no random numbers for a token");
    struct kd_asset *fresh = make(&about, data, size, client);
    if (!fresh)
        return kd_error_set(error, KD_ENOMEM, "out of memory for an asset of %zu bytes", size);
    pthread_mutex_lock(&store->lock);
    status = place(store, fresh, put, error);
    pthread_mutex_unlock(&store->lock);
    if (!put->created)
        free(fresh);
    else if ((status = settle(store, fresh, error))) {
        kd_asset_release(store, fresh);
        *put = (struct kd_asset_put) { 0 };
    }
    return status;
}

struct kd_asset *kd_asset_store_find(struct kd_asset_store *store, const char *hash)
{
    pthread_mutex_lock(&store->lock);
    struct kd_asset *asset = find(store, hash);
    if (asset && !asset->ready)
        asset = NULL;
    if (asset) {
        asset->references++;
        asset->used_ms = kd_clock_ms();
    }
    pthread_mutex_unlock(&store->lock);
    return asset;
}

void kd_asset_store_remove(struct kd_asset_store *store, struct kd_asset *asset)
{
    char hash[KD_ASSET_NAME];
    snprintf(hash, sizeof hash, "%s", asset->about.hash);
    pthread_mutex_lock(&store->lock);
    bool was = take_out(store, asset);
    if (was && store->folder >= 0) /* before the same bytes can be put here again */
        kd_asset_folder_remove(store->folder, hash);
    if (was)
        let_go(asset);
    pthread_mutex_unlock(&store->lock);
}

void kd_asset_release(struct kd_asset_store *store, struct kd_asset *asset)
{
    pthread_mutex_lock(&store->lock);
    let_go(asset);
    pthread_mutex_unlock(&store->lock);
}

void kd_asset_store_count(const struct kd_asset_store *store, unsigned *assets, uint64_t *bytes)
{
    *assets = store->count;
    *bytes = store->bytes;
}

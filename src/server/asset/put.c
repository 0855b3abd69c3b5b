/* Stores an asset in steps, one per slice: hash the bytes, look for an asset with the same hash, check the bytes,
 * reserve room, write them. The same bytes are never checked twice. While a grid is checked, its unpacked bytes
 * count towards the limit, except that a single check may exceed the limit. No asset is evicted for a check, because
 * the bytes may turn out not to be a grid. */
#include "server/asset/asset_internal.h"

#include "base/clock.h"
#include "render/emit/matter_grid.h"
#include "scene/sha256.h"
#include "server/asset/folder.h"

#include <math.h>
#include <nettle/sha2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* number of bytes that are hashed between two reads of the clock; hashing them takes some 3 ms */
enum { STRETCH = 1 << 20 };

struct kd_asset_putting {
    struct kd_asset_store *store;
    const uint8_t *data;
    size_t size, hashed;
    char client[KD_CLIENT];
    struct sha256_ctx hash;
    struct kd_asset_about about;
    struct kd_matter_reader *grid;
    uint64_t reserved; /* the part of store->checking that this asset has reserved */
    enum kd_status (*step)(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                           struct kd_error *error);
};

/* Finds the asset that was not used for the longest time. Returns NULL if that asset may not be evicted. Called with
 * the lock held. */
static struct kd_asset *oldest(const struct kd_asset_store *store, bool any_age)
{
    struct kd_asset *best = NULL;
    double before = any_age ? INFINITY : kd_clock_ms() - 1e3 * store->limits.keep_s;
    for (struct kd_asset *asset = store->first; asset; asset = asset->next)
        if (asset->state == KD_ASSET_READY && asset->references == 1 && asset->used_ms < before &&
            (!best || asset->used_ms < best->used_ms))
            best = asset;
    return best;
}

static bool is_anyone_leaving(const struct kd_asset_store *store)
{
    for (const struct kd_asset *asset = store->first; asset; asset = asset->next)
        if (asset->state == KD_ASSET_LEAVING)
            return true;
    return false;
}

/* Result of a search for room. */
enum room { ROOM, ROOM_LATER, ROOM_NONE };

/* Looks for room for an asset. *leaves: an asset that the caller must remove first, without holding the lock. Called
 * with the lock held. */
static enum room find_room(struct kd_asset_store *store, uint64_t bytes, bool any_age, struct kd_asset **leaves)
{
    if (store->count < store->limits.most && store->bytes + bytes <= store->limits.bytes)
        return ROOM;
    *leaves = oldest(store, any_age);
    if (*leaves)
        (*leaves)->state = KD_ASSET_LEAVING;
    return *leaves || is_anyone_leaving(store) ? ROOM_LATER : ROOM_NONE;
}

/* True if these bytes would exceed the client's share. Called with the lock held. */
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

static enum kd_status is_full(struct kd_asset_put *put, struct kd_error *error)
{
    const struct kd_asset_limits *limits = &put->own->store->limits;
    put->full = true;
    return kd_error_set(error, KD_EFULL, "the store of assets is full (limits: %u assets, %llu bytes in all)",
                        limits->most, (unsigned long long)limits->bytes);
}

/* Removes the evicted asset, and returns what the caller must do next. Called without the lock. */
static enum kd_status after_room(struct kd_asset_put *put, enum room room, struct kd_asset *leaves,
                                 enum kd_asset_progress *how, struct kd_error *error)
{
    if (room == ROOM_NONE)
        return is_full(put, error);
    if (leaves)
        kd_asset_leave(put->own->store, leaves);
    else if (room == ROOM_LATER)
        *how = KD_ASSET_WAIT;
    return KD_OK;
}

/* True if the same bytes are already stored, or are being stored or removed. Called with the lock held. */
static bool is_here(struct kd_asset_put *put, enum kd_asset_progress *how)
{
    struct kd_asset *there = kd_asset_find(put->own->store, put->own->about.hash);
    if (!there)
        return false;
    *how = there->state == KD_ASSET_READY ? KD_ASSET_OVER : KD_ASSET_WAIT;
    if (there->state == KD_ASSET_READY) {
        there->references++;
        there->used_ms = kd_clock_ms();
        put->asset = there;
    }
    return true;
}

static void end_check(struct kd_asset_putting *p)
{
    kd_matter_reader_close(p->grid);
    p->grid = NULL;
    pthread_mutex_lock(&p->store->lock);
    p->store->checking -= p->reserved;
    pthread_mutex_unlock(&p->store->lock);
    p->reserved = 0;
}

/* Writes the files of an asset that is already in the list. After this, searches find the asset. */
static enum kd_status settle(struct kd_asset_store *store, struct kd_asset *asset, struct kd_error *error)
{
    enum kd_status status = store->folder >= 0 ? kd_asset_folder_write(store->folder, &asset->about, error) : KD_OK;
    pthread_mutex_lock(&store->lock);
    asset->state = KD_ASSET_READY;
    if (status) {
        kd_asset_take_out(store, asset);
        kd_asset_unref(asset);
    }
    pthread_mutex_unlock(&store->lock);
    return status;
}

/* Looks for room. If there is room, and the asset has been made, adds the asset to the list. Called with the lock
 * held. */
static enum room take_place(struct kd_asset_put *put, struct kd_asset *fresh, struct kd_asset **leaves,
                            enum kd_asset_progress *how, bool *here)
{
    struct kd_asset_putting *p = put->own;
    *here = is_here(put, how);
    put->quota = !*here && has_share(p->store, p->size, p->client);
    if (*here || put->quota)
        return ROOM_NONE;
    const enum room room = find_room(p->store, p->size, put->any_age, leaves);
    if (room == ROOM && fresh) {
        fresh->references = 2;
        kd_asset_insert(p->store, fresh);
    }
    return room;
}

static enum kd_status is_beyond_share(const struct kd_asset_store *store, struct kd_error *error)
{
    return kd_error_set(error, KD_EBUSY,
                        "you have stored too many assets (limits for one client: %u assets, %llu bytes in all)",
                        store->limits.client_most, (unsigned long long)store->limits.client_bytes);
}

/* Finds room and stores the asset. The bytes are copied without the lock, so the room must be checked again
 * afterwards. */
static enum kd_status place(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                            struct kd_error *error)
{
    struct kd_asset_putting *p = put->own;
    struct kd_asset_store *store = p->store;
    struct kd_asset *fresh = NULL, *leaves = NULL;
    enum room room;
    bool here;
    (void)until_ms;
    pthread_mutex_lock(&store->lock);
    room = take_place(put, NULL, &leaves, how, &here);
    pthread_mutex_unlock(&store->lock);
    if (room == ROOM) {
        if (!(fresh = kd_asset_make(store, &p->about, p->data, p->size, p->client)))
            return kd_error_set(error, KD_ENOMEM, "out of memory for an asset of %zu bytes", p->size);
        pthread_mutex_lock(&store->lock);
        room = take_place(put, fresh, &leaves, how, &here);
        pthread_mutex_unlock(&store->lock);
    }
    if (room == ROOM) {
        enum kd_status status = settle(store, fresh, error);
        put->asset = status ? NULL : fresh;
        put->created = !status;
        *how = KD_ASSET_OVER;
        return status;
    }
    free(fresh);
    if (put->quota)
        return is_beyond_share(store, error);
    return here ? KD_OK : after_room(put, room, leaves, how, error);
}

static enum kd_status check_grid(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                                 struct kd_error *error)
{
    struct kd_asset_putting *p = put->own;
    bool over;
    (void)how;
    enum kd_status status = kd_matter_reader_go_on(p->grid, until_ms, &over, error);
    if (status || !over)
        return status;
    p->about.grid = kd_matter_grid_told(kd_matter_reader_grid(p->grid));
    end_check(p);
    p->step = place;
    return KD_OK;
}

static enum kd_status reserve(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                              struct kd_error *error)
{
    struct kd_asset_putting *p = put->own;
    struct kd_asset_store *store = p->store;
    const uint64_t bytes = kd_matter_reader_bytes(p->grid);
    (void)until_ms, (void)error;
    pthread_mutex_lock(&store->lock);
    if (!store->checking || store->bytes + store->checking + bytes <= store->limits.bytes) {
        store->checking += p->reserved = bytes;
        p->step = check_grid;
    } else {
        *how = KD_ASSET_WAIT;
    }
    pthread_mutex_unlock(&store->lock);
    return KD_OK;
}

static enum kd_status open_bytes(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                                 struct kd_error *error)
{
    struct kd_asset_putting *p = put->own;
    (void)until_ms, (void)how;
    p->step = kd_matter_grid_is(p->data, p->size) ? reserve : place;
    return p->step == reserve ? kd_matter_reader_open(p->data, p->size, true, &p->grid, error)
                              : kd_asset_look(p->data, p->size, &p->about, error);
}

static enum kd_status look_up(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                              struct kd_error *error)
{
    struct kd_asset_store *store = put->own->store;
    (void)until_ms, (void)error;
    pthread_mutex_lock(&store->lock);
    if (!is_here(put, how))
        put->own->step = open_bytes;
    pthread_mutex_unlock(&store->lock);
    return KD_OK;
}

static enum kd_status hash(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                           struct kd_error *error)
{
    struct kd_asset_putting *p = put->own;
    uint8_t digest[SHA256_DIGEST_SIZE];
    (void)how, (void)error;
    do {
        const size_t left = p->size - p->hashed, n = left < STRETCH ? left : STRETCH;
        sha256_update(&p->hash, n, p->data + p->hashed);
        p->hashed += n;
    } while (p->hashed < p->size && kd_clock_ms() < until_ms);
    if (p->hashed < p->size)
        return KD_OK;
    sha256_digest(&p->hash, sizeof digest, digest);
    kd_sha256_text(digest, p->about.hash);
    p->step = look_up;
    return KD_OK;
}

enum kd_status kd_asset_put_begin(struct kd_asset_put *put, struct kd_asset_store *store, const void *data, size_t size,
                                  const char *client, struct kd_error *error)
{
    struct kd_asset_putting *p = calloc(1, sizeof *p);
    *put = (struct kd_asset_put) { .own = p };
    if (!p)
        return kd_error_set(error, KD_ENOMEM, "out of memory for an asset");
    p->store = store;
    p->data = data;
    p->size = size;
    p->step = hash;
    snprintf(p->client, sizeof p->client, "%s", client);
    p->about.created = (double)time(NULL);
    sha256_init(&p->hash);
    if (!kd_secret_make(p->about.token, sizeof p->about.token))
        return kd_error_set(error, KD_EIO, "no random numbers are available for a token");
    return size > KD_ASSET_BYTES
               ? kd_error_set(error, KD_EINVAL, "an asset must have at most %zu bytes; this one has %zu",
                              KD_ASSET_BYTES, size)
               : KD_OK;
}

enum kd_status kd_asset_put_go_on(struct kd_asset_put *put, double until_ms, enum kd_asset_progress *how,
                                  struct kd_error *error)
{
    enum kd_status status = KD_OK;
    *how = KD_ASSET_MORE;
    do
        status = put->own->step(put, until_ms, how, error);
    while (!status && *how == KD_ASSET_MORE && kd_clock_ms() < until_ms);
    return status;
}

void kd_asset_put_finish(struct kd_asset_put *put)
{
    if (!put->own)
        return;
    end_check(put->own);
    free(put->own);
    put->own = NULL;
}

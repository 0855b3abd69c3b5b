#include "render/device/panoramas.h"

#include "render/sky/milky_way_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* True if the request names an asset. The name of an asset is its hash, which contains no space. The name of a Milky
 * Way, "seed N", contains a space. */
static bool is_image(const struct kd_asset_request *request) { return !strchr(request->of, ' '); }

static enum kd_status fill(struct kd_panorama *p, struct kd_sky_picture *picture, struct kd_error *error)
{
    p->columns = picture->width;
    p->rows = picture->height;
    p->words = malloc(kd_panorama_words(p->columns, p->rows) * sizeof *p->words);
    return p->words ? kd_panorama_fill(picture, p->words, error)
                    : kd_error_set(error, KD_ENOMEM, "out of memory for a panorama");
}

/* Makes the picture of sky.image or of a Milky Way. */
static enum kd_status paint(const struct kd_assets *assets, const struct kd_asset_request *request,
                            struct kd_sky_picture *picture, char *credit, bool *invalid, struct kd_error *error)
{
    struct kd_asset_bytes bytes;
    if (!is_image(request))
        return kd_milky_way(request->seed, picture, error);
    enum kd_status status = kd_asset_reader_take(assets, request->of, "/sky/image", "sky.image", &bytes, error);
    if (status)
        return status;
    status = kd_sky_image(bytes.data, bytes.size, picture, credit, error);
    assets->give_back(assets->user, &bytes);
    *invalid = status == KD_EINVAL;
    return status;
}

/* Reads a cached Milky Way. */
static bool recall(const char *file, const struct kd_asset_request *request, struct kd_panorama *out)
{
    if (is_image(request) || !file)
        return false;
    out->columns = KD_MILKY_WAY_WIDTH;
    out->rows = KD_MILKY_WAY_HEIGHT;
    out->words = malloc(kd_panorama_words(out->columns, out->rows) * sizeof *out->words);
    if (out->words && kd_milky_way_recall(file, request->seed, out->words))
        return true;
    free(out->words);
    out->words = NULL;
    return false;
}

static enum kd_status make_blank(struct kd_panorama *out, struct kd_error *error)
{
    out->columns = KD_MILKY_WAY_WIDTH;
    out->rows = KD_MILKY_WAY_HEIGHT;
    out->words = calloc(kd_panorama_words(out->columns, out->rows), sizeof *out->words);
    return out->words ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for a panorama");
}

static enum kd_status make_new(const struct kd_assets *assets, const struct kd_asset_request *request,
                               struct kd_panorama *out, bool *invalid, struct kd_error *error)
{
    struct kd_sky_picture picture = { 0 };
    enum kd_status status = paint(assets, request, &picture, out->credit, invalid, error);
    if (!status)
        status = fill(out, &picture, error);
    kd_sky_picture_finish(&picture);
    if (status)
        free(out->words);
    return status;
}

static enum kd_status make(void *owner, const struct kd_asset_request *request, bool *invalid, struct kd_error *error)
{
    struct kd_panoramas *all = owner;
    struct kd_panorama *out = &all->made;
    *out = (struct kd_panorama) { 0 };
    all->fresh = NULL;
    all->recalled = recall(all->file, request, out);
    return all->recalled ? KD_OK
           : all->blank  ? make_blank(out, error)
                         : make_new(all->assets, request, out, invalid, error);
}

/* True if `a` is evicted before `b`. Panoramas that were not delivered yet are evicted last, because a client waits
 * for them. */
static bool goes_before(const struct kd_panorama *a, const struct kd_panorama *b)
{
    const bool promised = *a->of && !a->shown, other = *b->of && !b->shown;
    return promised != other ? !promised : a->used < b->used;
}

/* Evicts one panorama (goes_before) before a new one is made, so that there are never more than KD_PANORAMAS in
 * memory. */
static void make_room(void *owner)
{
    struct kd_panoramas *all = owner;
    struct kd_panorama *oldest = all->given == all->at ? all->at + 1 : all->at;
    for (struct kd_panorama *p = oldest; p < all->at + KD_PANORAMAS; p++)
        if (p != all->given && goes_before(p, oldest))
            oldest = p;
    free(oldest->words);
    *oldest = (struct kd_panorama) { 0 };
}

static struct kd_panorama *cached(struct kd_panoramas *all, const char *of)
{
    for (int i = 0; i < KD_PANORAMAS; i++)
        if (!strcmp(all->at[i].of, of))
            return &all->at[i];
    return NULL;
}

static bool is_cached(void *owner, const struct kd_asset_request *request) { return cached(owner, request->of); }

static void keep(void *owner, const struct kd_asset_request *request)
{
    struct kd_panoramas *all = owner;
    struct kd_panorama *place = cached(all, ""); /* the slot that make_room freed */
    *place = all->made;
    memcpy(place->of, request->of, sizeof place->of);
    place->used = ++all->used;
    place->shown = request->ahead;
    all->fresh = all->recalled || is_image(request) ? NULL : place;
}

/* Writes the new Milky Way to its file, without the lock. The panorama's words stay valid, because only this thread
 * evicts slots. */
static void write_file(void *owner, const struct kd_asset_request *request)
{
    struct kd_panoramas *all = owner;
    if (all->file && all->fresh) {
        kd_milky_way_keep(all->file, request->seed, all->fresh->words);
        free(all->file);
        all->file = NULL;
    }
    all->fresh = NULL;
}

static const struct kd_asset_maker maker = { is_cached, make_room, make, keep, write_file };

static bool has_one(const struct kd_scene *scene)
{
    return scene->sky.model != KD_SKY_NONE && scene->sky.model != KD_SKY_GRID && scene->sky.milky_way > 0;
}

static struct kd_asset_request request_of(const struct kd_scene *scene)
{
    struct kd_asset_request request = { .seed = scene->sky.seed };
    if (*scene->sky.image)
        snprintf(request.of, sizeof request.of, "%s", scene->sky.image);
    else
        snprintf(request.of, sizeof request.of, "seed %d", scene->sky.seed);
    return request;
}

bool kd_panorama_begin(struct kd_panoramas *all, const struct kd_scene *scene)
{
    const struct kd_asset_request request = request_of(scene);
    if (!has_one(scene))
        return false;
    pthread_mutex_lock(&all->reader.lock);
    const bool in_progress = kd_asset_reader_begin(&all->reader, &request);
    pthread_mutex_unlock(&all->reader.lock);
    return in_progress;
}

void kd_panorama_ahead(struct kd_panoramas *all, const char *hash)
{
    struct kd_asset_request request = { .ahead = true };
    snprintf(request.of, sizeof request.of, "%s", hash);
    pthread_mutex_lock(&all->reader.lock);
    if (!all->reader.n_asked && cached(all, "")) /* a free slot */
        kd_asset_reader_begin(&all->reader, &request);
    pthread_mutex_unlock(&all->reader.lock);
}

enum kd_status kd_panorama_of(struct kd_panoramas *all, const struct kd_scene *scene, const struct kd_panorama **out,
                              struct kd_error *error)
{
    const struct kd_asset_request request = request_of(scene);
    pthread_mutex_lock(&all->reader.lock);
    const enum kd_status status = kd_asset_reader_wait(&all->reader, &request, error);
    if (!status) {
        struct kd_panorama *p = cached(all, request.of);
        p->used = ++all->used;
        p->shown = true;
        *out = all->given = p;
    }
    pthread_mutex_unlock(&all->reader.lock);
    return status;
}

void kd_panoramas_init(struct kd_panoramas *all, const struct kd_assets *assets, void (*made)(void *user), void *user)
{
    *all = (struct kd_panoramas) { .assets = assets };
    kd_asset_reader_init(&all->reader, &maker, all, made, user);
}

void kd_panoramas_keep_at(struct kd_panoramas *all, char *path) { all->file = path; }

void kd_panoramas_stop(struct kd_panoramas *all) { kd_asset_reader_stop(&all->reader); }

void kd_panoramas_rest(struct kd_panoramas *all, unsigned n)
{
    pthread_mutex_lock(&all->reader.lock);
    while (kd_asset_reader_is_idle(&all->reader)) {
        struct kd_panorama *oldest = NULL;
        unsigned there = 0;
        for (struct kd_panorama *p = all->at; p < all->at + KD_PANORAMAS; p++) {
            there += p->words != NULL;
            oldest = p->words && (!oldest || p->used < oldest->used) ? p : oldest;
        }
        if (there <= n)
            break;
        free(oldest->words);
        *oldest = (struct kd_panorama) { 0 };
        all->given = all->given == oldest ? NULL : all->given;
    }
    pthread_mutex_unlock(&all->reader.lock);
}

uint64_t kd_panoramas_bytes(struct kd_panoramas *all)
{
    uint64_t sum = 0;
    pthread_mutex_lock(&all->reader.lock);
    for (const struct kd_panorama *p = all->at; p < all->at + KD_PANORAMAS; p++)
        sum += p->words ? sizeof *p->words * kd_panorama_words(p->columns, p->rows) : 0;
    pthread_mutex_unlock(&all->reader.lock);
    return sum;
}

void kd_panoramas_finish(struct kd_panoramas *all)
{
    kd_asset_reader_finish(&all->reader);
    for (int i = 0; i < KD_PANORAMAS; i++)
        free(all->at[i].words);
    free(all->file);
}

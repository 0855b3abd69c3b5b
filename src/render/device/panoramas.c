#include "render/device/panoramas.h"

#include "render/sky/milky_way_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Takes the bytes of an asset. */
static enum kd_status take(const struct kd_assets *assets, const char *hash, struct kd_asset_bytes *out,
                           struct kd_error *error)
{
    if (assets && assets->take(assets->user, hash, out))
        return KD_OK;
    return kd_error_field(error, "/sky/image", "sky.image is \"%s\", whose file is missing; it must be %s", hash,
                          assets ? assets->allowed : "null, because there are no assets");
}

static enum kd_status fill(struct kd_panorama *p, struct kd_sky_picture *picture, struct kd_error *error)
{
    p->columns = picture->width;
    p->rows = picture->height;
    p->words = malloc(kd_panorama_words(p->columns, p->rows) * sizeof *p->words);
    return p->words ? kd_panorama_fill(picture, p->words, error)
                    : kd_error_set(error, KD_ENOMEM, "out of memory for a panorama");
}

static enum kd_status paint(const struct kd_assets *assets, const struct kd_sky *sky, struct kd_sky_picture *picture,
                            char *credit, bool *invalid, struct kd_error *error)
{
    struct kd_asset_bytes bytes;
    *invalid = false;
    if (!*sky->image)
        return kd_milky_way(sky->seed, picture, error);
    enum kd_status status = take(assets, sky->image, &bytes, error);
    if (status)
        return status;
    status = kd_sky_image(bytes.data, bytes.size, picture, credit, error);
    assets->give_back(assets->user, &bytes);
    *invalid = status == KD_EINVAL;
    return status;
}

/* Reads a cached Milky Way. */
static bool recall(const char *file, const struct kd_panorama_key *key, struct kd_panorama *out)
{
    if (*key->sky.image || !file)
        return false;
    out->columns = KD_MILKY_WAY_WIDTH;
    out->rows = KD_MILKY_WAY_HEIGHT;
    out->words = malloc(kd_panorama_words(out->columns, out->rows) * sizeof *out->words);
    if (out->words && kd_milky_way_recall(file, key->sky.seed, out->words))
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

static enum kd_status make(const struct kd_assets *assets, const struct kd_panorama_key *key, struct kd_panorama *out,
                           bool *invalid, struct kd_error *error)
{
    struct kd_sky_picture picture = { 0 };
    enum kd_status status = paint(assets, &key->sky, &picture, out->credit, invalid, error);
    if (!status)
        status = fill(out, &picture, error);
    kd_sky_picture_finish(&picture);
    if (status)
        free(out->words);
    return status;
}

/* Whether `a` is evicted before `b`: panoramas that were not delivered go last, because somebody waits for them. */
static bool goes_before(const struct kd_panorama *a, const struct kd_panorama *b)
{
    const bool promised = *a->of && !a->shown, other = *b->of && !b->shown;
    return promised != other ? !promised : a->used < b->used;
}

/* Evicts the least recently used panorama and returns its slot. This precedes making a new one, so that memory never
 * holds more than KD_PANORAMAS. */
static struct kd_panorama *room(struct kd_panoramas *all)
{
    struct kd_panorama *oldest = all->given == all->at ? all->at + 1 : all->at;
    for (struct kd_panorama *p = oldest; p < all->at + KD_PANORAMAS; p++)
        if (p != all->given && goes_before(p, oldest))
            oldest = p;
    free(oldest->words);
    *oldest = (struct kd_panorama) { 0 };
    return oldest;
}

/* Makes the first requested panorama. Called with the lock, which is released meanwhile. Returns a newly made Milky
 * Way that should be written to the file, or NULL. */
static const struct kd_panorama *make_first(struct kd_panoramas *all)
{
    const struct kd_panorama_key key = all->asked[0];
    struct kd_panorama *place = room(all), made = { 0 };
    struct kd_error why = { 0 };
    bool invalid = false;
    memcpy(made.of, key.of, sizeof made.of);
    pthread_mutex_unlock(&all->lock);
    const bool recalled = recall(all->file, &key, &made);
    enum kd_status status = recalled     ? KD_OK
                            : all->blank ? make_blank(&made, &why)
                                         : make(all->assets, &key, &made, &invalid, &why);
    pthread_mutex_lock(&all->lock);
    const bool ahead = all->asked[0].ahead; /* the flag may have changed meanwhile */
    if (status && !ahead) {
        memcpy(all->broken, key.of, sizeof all->broken);
        all->invalid = invalid;
        all->why = why;
    } else if (!status) {
        *place = made;
        place->used = ++all->used;
        place->shown = ahead;
    }
    memmove(all->asked, all->asked + 1, --all->n_asked * sizeof *all->asked);
    pthread_cond_broadcast(&all->changed);
    return status || recalled || *key.sky.image ? NULL : place;
}

/* Writes the file without the lock. Only this thread evicts slots, so the words stay valid meanwhile. */
static void keep(struct kd_panoramas *all, int32_t seed, const struct kd_panorama *fresh)
{
    if (!all->file || !fresh)
        return;
    kd_milky_way_keep(all->file, seed, fresh->words);
    free(all->file);
    all->file = NULL;
}

static void *run(void *user)
{
    struct kd_panoramas *all = user;
    pthread_mutex_lock(&all->lock);
    while (all->n_asked) {
        const int32_t seed = all->asked[0].sky.seed;
        const struct kd_panorama *fresh = make_first(all);
        pthread_mutex_unlock(&all->lock);
        if (all->made)
            all->made(all->user);
        keep(all, seed, fresh);
        pthread_mutex_lock(&all->lock);
    }
    all->runs = false;
    pthread_cond_broadcast(&all->changed);
    pthread_mutex_unlock(&all->lock);
    return NULL;
}

static bool has_one(const struct kd_scene *scene)
{
    return scene->sky.model != KD_SKY_NONE && scene->sky.model != KD_SKY_GRID && scene->sky.milky_way > 0;
}

static struct kd_panorama_key key_of(const struct kd_scene *scene)
{
    struct kd_panorama_key key = { .sky = scene->sky };
    if (*scene->sky.image)
        snprintf(key.of, sizeof key.of, "%s", scene->sky.image);
    else
        snprintf(key.of, sizeof key.of, "seed %d", scene->sky.seed);
    return key;
}

static struct kd_panorama *cached(struct kd_panoramas *all, const char *of)
{
    for (int i = 0; i < KD_PANORAMAS; i++)
        if (!strcmp(all->at[i].of, of))
            return &all->at[i];
    return NULL;
}

static struct kd_panorama_key *asked(struct kd_panoramas *all, const char *of)
{
    for (unsigned i = 0; i < all->n_asked; i++)
        if (!strcmp(all->asked[i].of, of))
            return &all->asked[i];
    return NULL;
}

/* Whether a panorama failed because its picture is invalid. The bytes of a hash never change, so it stays invalid. A
 * missing file may come back. */
static bool is_broken(const struct kd_panoramas *all, const char *of)
{
    return all->invalid && !strcmp(all->broken, of);
}

/* With the lock. Does nothing if no thread can be created. */
static void begin(struct kd_panoramas *all, const struct kd_panorama_key *key)
{
    pthread_t thread;
    struct kd_panorama_key *same = asked(all, key->of);
    if (same)
        same->ahead &= key->ahead;
    if (cached(all, key->of) || same || is_broken(all, key->of) || all->n_asked == KD_PANORAMAS_ASKED)
        return;
    all->asked[all->n_asked++] = *key;
    if (all->runs)
        return;
    if (pthread_create(&thread, NULL, run, all)) {
        all->n_asked--;
        return;
    }
    pthread_detach(thread);
    all->runs = true;
}

bool kd_panorama_begin(struct kd_panoramas *all, const struct kd_scene *scene)
{
    const struct kd_panorama_key key = key_of(scene);
    if (!has_one(scene))
        return false;
    pthread_mutex_lock(&all->lock);
    begin(all, &key);
    const bool under_way = asked(all, key.of);
    pthread_mutex_unlock(&all->lock);
    return under_way;
}

void kd_panorama_ahead(struct kd_panoramas *all, const char *hash)
{
    struct kd_panorama_key key = { .ahead = true };
    snprintf(key.of, sizeof key.of, "%s", hash);
    snprintf(key.sky.image, sizeof key.sky.image, "%s", hash);
    pthread_mutex_lock(&all->lock);
    if (!all->n_asked && cached(all, "")) /* a free slot */
        begin(all, &key);
    pthread_mutex_unlock(&all->lock);
}

/* With the lock: waits for a panorama, or makes it here if there is no thread. NULL: the panorama has failed. */
static struct kd_panorama *wait_for(struct kd_panoramas *all, const struct kd_panorama_key *key)
{
    if (!is_broken(all, key->of) && !strcmp(all->broken, key->of)) /* other failures are tried again */
        *all->broken = 0;
    while (!cached(all, key->of) && strcmp(all->broken, key->of)) {
        begin(all, key);
        if (asked(all, key->of) || all->runs) {
            pthread_cond_wait(&all->changed, &all->lock);
            continue;
        }
        all->asked[all->n_asked++] = *key; /* there is no thread here, so the list is empty */
        all->runs = true;                  /* this call runs in place of the thread */
        while (all->n_asked)
            make_first(all);
        all->runs = false;
    }
    return cached(all, key->of);
}

enum kd_status kd_panorama_of(struct kd_panoramas *all, const struct kd_scene *scene, const struct kd_panorama **out,
                              struct kd_error *error)
{
    const struct kd_panorama_key key = key_of(scene);
    struct kd_error why = { 0 };
    pthread_mutex_lock(&all->lock);
    struct kd_panorama *p = wait_for(all, &key);
    if (p) {
        p->used = ++all->used;
        p->shown = true;
        all->given = p;
        *out = p;
    } else {
        why = all->why;
    }
    pthread_mutex_unlock(&all->lock);
    if (why.status && error)
        *error = why;
    return why.status;
}

void kd_panoramas_init(struct kd_panoramas *all, const struct kd_assets *assets, void (*made)(void *user), void *user)
{
    *all = (struct kd_panoramas) { .assets = assets, .made = made, .user = user };
    pthread_mutex_init(&all->lock, NULL);
    pthread_cond_init(&all->changed, NULL);
}

void kd_panoramas_keep_at(struct kd_panoramas *all, char *path) { all->file = path; }

void kd_panoramas_stop(struct kd_panoramas *all)
{
    pthread_mutex_lock(&all->lock);
    all->n_asked = all->n_asked ? 1 : 0;
    while (all->runs)
        pthread_cond_wait(&all->changed, &all->lock);
    pthread_mutex_unlock(&all->lock);
}

void kd_panoramas_rest(struct kd_panoramas *all, unsigned n)
{
    pthread_mutex_lock(&all->lock);
    while (!all->runs && !all->n_asked) {
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
    pthread_mutex_unlock(&all->lock);
}

uint64_t kd_panoramas_bytes(struct kd_panoramas *all)
{
    uint64_t sum = 0;
    pthread_mutex_lock(&all->lock);
    for (const struct kd_panorama *p = all->at; p < all->at + KD_PANORAMAS; p++)
        sum += p->words ? sizeof *p->words * kd_panorama_words(p->columns, p->rows) : 0;
    pthread_mutex_unlock(&all->lock);
    return sum;
}

void kd_panoramas_finish(struct kd_panoramas *all)
{
    kd_panoramas_stop(all);
    for (int i = 0; i < KD_PANORAMAS; i++)
        free(all->at[i].words);
    free(all->file);
    pthread_cond_destroy(&all->changed);
    pthread_mutex_destroy(&all->lock);
}

#include "render/device/asset_reader.h"

#include <string.h>

static struct kd_asset_request *asked(struct kd_asset_reader *reader, const char *of)
{
    for (unsigned i = 0; i < reader->n_asked; i++)
        if (!strcmp(reader->asked[i].of, of))
            return &reader->asked[i];
    return NULL;
}

/* The bytes of a hash never change, so an invalid asset stays invalid. A missing file may appear again. */
static bool is_invalid(const struct kd_asset_reader *reader, const char *of)
{
    return reader->invalid && !strcmp(reader->broken, of);
}

static bool is_cached(struct kd_asset_reader *reader, const struct kd_asset_request *request)
{
    return reader->maker->is_cached(reader->owner, request);
}

/* Makes the object of the first request. Called with the lock; the function releases the lock while it makes the
 * object. */
static void make_first(struct kd_asset_reader *reader)
{
    struct kd_asset_request request = reader->asked[0];
    struct kd_error why = { 0 };
    bool invalid = false;
    reader->maker->make_room(reader->owner);
    pthread_mutex_unlock(&reader->lock);
    const enum kd_status status = reader->maker->make(reader->owner, &request, &invalid, &why);
    pthread_mutex_lock(&reader->lock);
    request = reader->asked[0]; /* `ahead` may have changed while the lock was released */
    if (!status) {
        reader->maker->keep(reader->owner, &request);
    } else if (!request.ahead) {
        memcpy(reader->broken, request.of, sizeof reader->broken);
        reader->invalid = invalid;
        reader->why = why;
    }
    memmove(reader->asked, reader->asked + 1, --reader->n_asked * sizeof *reader->asked);
    pthread_cond_broadcast(&reader->changed);
}

static void *run(void *user)
{
    struct kd_asset_reader *reader = user;
    pthread_mutex_lock(&reader->lock);
    while (reader->n_asked) {
        const struct kd_asset_request request = reader->asked[0];
        make_first(reader);
        pthread_mutex_unlock(&reader->lock);
        if (reader->made)
            reader->made(reader->user);
        if (reader->maker->after)
            reader->maker->after(reader->owner, &request);
        pthread_mutex_lock(&reader->lock);
    }
    reader->runs = false;
    pthread_cond_broadcast(&reader->changed);
    pthread_mutex_unlock(&reader->lock);
    return NULL;
}

bool kd_asset_reader_begin(struct kd_asset_reader *reader, const struct kd_asset_request *request)
{
    pthread_t thread;
    struct kd_asset_request *same = asked(reader, request->of);
    if (same) {
        same->ahead &= request->ahead;
        return true;
    }
    if (is_cached(reader, request) || is_invalid(reader, request->of) || reader->n_asked == KD_ASSET_REQUESTS)
        return false;
    reader->asked[reader->n_asked++] = *request;
    if (reader->runs)
        return true;
    if (pthread_create(&thread, NULL, run, reader)) {
        reader->n_asked--;
        return false;
    }
    pthread_detach(thread);
    return reader->runs = true;
}

enum kd_status kd_asset_reader_wait(struct kd_asset_reader *reader, const struct kd_asset_request *request,
                                    struct kd_error *error)
{
    /* a request that failed may be tried again, unless its asset is invalid */
    if (!is_invalid(reader, request->of) && !strcmp(reader->broken, request->of))
        *reader->broken = 0;
    while (!is_cached(reader, request) && strcmp(reader->broken, request->of)) {
        if (kd_asset_reader_begin(reader, request) || reader->runs) {
            pthread_cond_wait(&reader->changed, &reader->lock);
            continue;
        }
        reader->asked[reader->n_asked++] = *request; /* no thread runs, so the list was empty before */
        reader->runs = true;                         /* the calling thread does the work of the missing thread */
        while (reader->n_asked)
            make_first(reader);
        reader->runs = false;
    }
    if (is_cached(reader, request))
        return KD_OK;
    if (error)
        *error = reader->why;
    return reader->why.status;
}

bool kd_asset_reader_is_idle(const struct kd_asset_reader *reader) { return !reader->runs && !reader->n_asked; }

void kd_asset_reader_stop(struct kd_asset_reader *reader)
{
    pthread_mutex_lock(&reader->lock);
    reader->n_asked = reader->n_asked ? 1 : 0;
    while (reader->runs)
        pthread_cond_wait(&reader->changed, &reader->lock);
    pthread_mutex_unlock(&reader->lock);
}

void kd_asset_reader_init(struct kd_asset_reader *reader, const struct kd_asset_maker *maker, void *owner,
                          void (*made)(void *user), void *user)
{
    *reader = (struct kd_asset_reader) { .maker = maker, .owner = owner, .made = made, .user = user };
    pthread_mutex_init(&reader->lock, NULL);
    pthread_cond_init(&reader->changed, NULL);
}

void kd_asset_reader_finish(struct kd_asset_reader *reader)
{
    kd_asset_reader_stop(reader);
    pthread_cond_destroy(&reader->changed);
    pthread_mutex_destroy(&reader->lock);
}

enum kd_status kd_asset_reader_take(const struct kd_assets *assets, const char *hash, const char *pointer,
                                    const char *field, struct kd_asset_bytes *out, struct kd_error *error)
{
    if (assets && assets->take(assets->user, hash, out))
        return KD_OK;
    return kd_error_field(error, pointer, "%s is \"%s\", whose file is missing; it must be %s", field, hash,
                          assets ? assets->allowed : "null, because there are no assets");
}

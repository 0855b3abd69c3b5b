#include "server/http/bytes.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct place {
    char client[KD_CLIENT];
    size_t bytes;
};

struct kd_bytes {
    struct kd_bytes_params params;
    pthread_mutex_t lock;
    _Atomic size_t bytes;
    struct place places[]; /* params.clients entries, and one more for all other clients together */
};

struct kd_bytes *kd_bytes_create(const struct kd_bytes_params *params)
{
    struct kd_bytes *b = calloc(1, sizeof *b + (params->clients + 1) * sizeof *b->places);
    if (!b)
        return NULL;
    b->params = *params;
    pthread_mutex_init(&b->lock, NULL);
    return b;
}

void kd_bytes_destroy(struct kd_bytes *b)
{
    if (!b)
        return;
    pthread_mutex_destroy(&b->lock);
    free(b);
}

/* Finds the entry of a client that holds bytes. Returns NULL if there is none. */
static struct place *find(struct kd_bytes *b, const char *client)
{
    for (unsigned i = 0; i < b->params.clients; i++)
        if (b->places[i].bytes && !strcmp(b->places[i].client, client))
            return &b->places[i];
    return NULL;
}

static struct place *find_or_make(struct kd_bytes *b, const char *client)
{
    struct place *place = find(b, client);
    for (unsigned i = 0; i < b->params.clients && !place; i++)
        if (!b->places[i].bytes) {
            place = &b->places[i];
            snprintf(place->client, sizeof place->client, "%s", client);
        }
    return place ? place : &b->places[b->params.clients];
}

/* Adds n bytes to the count of a client. Called with the lock held. */
static void add(struct kd_bytes *b, const char *client, size_t n)
{
    find_or_make(b, client)->bytes += n;
    b->bytes += n;
}

enum kd_status kd_bytes_take(struct kd_bytes *b, const char *client, size_t n, size_t size, bool *quota)
{
    pthread_mutex_lock(&b->lock);
    size_t own = find_or_make(b, client)->bytes;
    const struct kd_bytes_params *p = &b->params;
    /* One client may use the fraction share / max of the reserve, just as of `max`. */
    double room = size <= p->small ? 1 + (double)p->reserve / (double)p->max : 1;
    *quota = (double)(own + n) > room * (double)p->share && !(p->lone && !own);
    bool fits = !*quota && ((double)(b->bytes + n) <= room * (double)p->max || (p->lone && !b->bytes));
    if (fits)
        add(b, client, n);
    pthread_mutex_unlock(&b->lock);
    return fits ? KD_OK : KD_EBUSY;
}

void kd_bytes_add(struct kd_bytes *b, const char *client, size_t n)
{
    pthread_mutex_lock(&b->lock);
    add(b, client, n);
    pthread_mutex_unlock(&b->lock);
}

size_t kd_bytes_held(const struct kd_bytes *b) { return atomic_load(&b->bytes); }

void kd_bytes_give(struct kd_bytes *b, const char *client, size_t n)
{
    pthread_mutex_lock(&b->lock);
    struct place *place = find(b, client);
    /* The client had no entry of its own, so its bytes were counted together with those of other clients. */
    if (!place || place->bytes < n)
        place = &b->places[b->params.clients];
    place->bytes -= n < place->bytes ? n : place->bytes;
    b->bytes -= n;
    pthread_mutex_unlock(&b->lock);
}

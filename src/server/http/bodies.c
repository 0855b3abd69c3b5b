#include "server/http/bodies.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PLACES 64 /* clients told apart at once; what more of them send counts as that of one */

struct place {
    char client[KD_CLIENT];
    size_t bytes;
};

struct kd_bodies {
    struct kd_bodies_params params;
    pthread_mutex_t lock;
    _Atomic size_t bytes;
    struct place places[PLACES + 1]; /* the last one: of all others */
};

struct kd_bodies *kd_bodies_create(const struct kd_bodies_params *params)
{
    struct kd_bodies *b = calloc(1, sizeof *b);
    if (!b)
        return NULL;
    b->params = *params;
    pthread_mutex_init(&b->lock, NULL);
    return b;
}

void kd_bodies_destroy(struct kd_bodies *b)
{
    if (!b)
        return;
    pthread_mutex_destroy(&b->lock);
    free(b);
}

/* Of a client that has bytes here; NULL: it has none. */
static struct place *find(struct kd_bodies *b, const char *client)
{
    for (int i = 0; i < PLACES; i++)
        if (b->places[i].bytes && !strcmp(b->places[i].client, client))
            return &b->places[i];
    return NULL;
}

static struct place *find_or_make(struct kd_bodies *b, const char *client)
{
    struct place *place = find(b, client);
    for (int i = 0; i < PLACES && !place; i++)
        if (!b->places[i].bytes) {
            place = &b->places[i];
            snprintf(place->client, sizeof place->client, "%s", client);
        }
    return place ? place : &b->places[PLACES];
}

enum kd_status kd_bodies_take(struct kd_bodies *b, const char *client, size_t bytes, size_t size, bool *quota)
{
    pthread_mutex_lock(&b->lock);
    struct place *place = find_or_make(b, client);
    size_t max = b->params.max + (size <= b->params.small ? b->params.reserve : 0);
    *quota = place->bytes + bytes > b->params.share;
    bool fits = !*quota && b->bytes + bytes <= max;
    if (fits) {
        place->bytes += bytes;
        b->bytes += bytes;
    }
    pthread_mutex_unlock(&b->lock);
    return fits ? KD_OK : KD_EBUSY;
}

size_t kd_bodies_bytes(const struct kd_bodies *b) { return atomic_load(&b->bytes); }

void kd_bodies_give(struct kd_bodies *b, const char *client, size_t bytes)
{
    pthread_mutex_lock(&b->lock);
    struct place *place = find(b, client);
    if (!place || place->bytes < bytes) /* it came when all places were taken */
        place = &b->places[PLACES];
    place->bytes -= bytes < place->bytes ? bytes : place->bytes;
    b->bytes -= bytes;
    pthread_mutex_unlock(&b->lock);
}

#include "server/http/auth_throttle.h"

#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define REMEMBERED 16u /* number of wrong tokens that are remembered for each address */

struct place {
    char client[KD_CLIENT];
    double tries, at_ms; /* tries: number of tries left at the time at_ms; at_ms 0: the entry is unused */
    uint64_t wrong[REMEMBERED];
    const void *right[KD_GUESSES_NAMES];
    unsigned n_wrong, n_right; /* for each of the two ring buffers: number of tokens that were ever stored in it */
};

struct kd_auth_throttle {
    pthread_mutex_t lock;
    struct place places[KD_GUESSES_CLIENTS];
};

struct kd_auth_throttle *kd_auth_throttle_create(void)
{
    struct kd_auth_throttle *throttle = calloc(1, sizeof *throttle);
    if (throttle)
        pthread_mutex_init(&throttle->lock, NULL);
    return throttle;
}

void kd_auth_throttle_destroy(struct kd_auth_throttle *throttle)
{
    if (throttle)
        pthread_mutex_destroy(&throttle->lock);
    free(throttle);
}

static double tries_now(const struct place *p, double now_ms)
{
    return p->at_ms > 0 ? fmin(p->tries + fmax(now_ms - p->at_ms, 0) / (1e3 * KD_GUESSES_EACH_S), KD_GUESSES_MOST)
                        : KD_GUESSES_MOST;
}

/* True if the entry p should be evicted rather than the entry `than`. */
static bool gives_way(const struct place *p, const struct place *than, double now_ms)
{
    const double a = tries_now(p, now_ms), b = tries_now(than, now_ms);
    return a > b || (!(a < b) && p->at_ms < than->at_ms);
}

/* Finds the entry of an address. If there is none, evicts another entry and makes one. Brings the entry up to date. */
static struct place *place_of(struct kd_auth_throttle *throttle, const char *client, double now_ms)
{
    struct place *best = &throttle->places[0];
    for (struct place *p = throttle->places; p < throttle->places + KD_GUESSES_CLIENTS; p++) {
        if (p->at_ms > 0 && !strcmp(p->client, client)) {
            p->tries = tries_now(p, now_ms);
            p->at_ms = now_ms;
            return p;
        }
        if (gives_way(p, best, now_ms))
            best = p;
    }
    *best = (struct place) { .tries = KD_GUESSES_MOST, .at_ms = now_ms };
    snprintf(best->client, sizeof best->client, "%s", client);
    return best;
}

static unsigned wait_s(const struct place *p)
{
    return p->tries >= 1 ? 0 : 1 + (unsigned)((1 - p->tries) * KD_GUESSES_EACH_S);
}

static bool was_right(const struct place *p, const void *whose)
{
    for (unsigned i = 0; i < KD_GUESSES_NAMES && i < p->n_right; i++)
        if (p->right[i] == whose)
            return true;
    return false;
}

static bool was_wrong(const struct place *p, uint64_t hash)
{
    for (unsigned i = 0; i < REMEMBERED && i < p->n_wrong; i++)
        if (p->wrong[i] == hash)
            return true;
    return false;
}

unsigned kd_auth_throttle_right(struct kd_auth_throttle *throttle, const char *client, const void *whose, double now_ms)
{
    unsigned wait = 0;
    pthread_mutex_lock(&throttle->lock);
    struct place *p = place_of(throttle, client, now_ms);
    if (!was_right(p, whose)) {
        wait = wait_s(p);
        if (!wait)
            p->right[p->n_right++ % KD_GUESSES_NAMES] = whose;
    }
    pthread_mutex_unlock(&throttle->lock);
    return wait;
}

unsigned kd_auth_throttle_wrong(struct kd_auth_throttle *throttle, const char *client, uint64_t hash, double now_ms)
{
    pthread_mutex_lock(&throttle->lock);
    struct place *p = place_of(throttle, client, now_ms);
    const bool again = was_wrong(p, hash);
    const unsigned wait = again ? 0 : wait_s(p);
    if (!again && !wait) {
        p->tries -= 1;
        p->wrong[p->n_wrong++ % REMEMBERED] = hash;
    }
    pthread_mutex_unlock(&throttle->lock);
    return wait;
}

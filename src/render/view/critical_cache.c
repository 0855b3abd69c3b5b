#include "render/view/critical_cache.h"

#include <pthread.h>
#include <stdlib.h>
#include <string.h>

/* Everything that the list depends on. The camera's azimuth is not part of it because the hole is axisymmetric. */
struct key {
    struct kd_spacetime spacetime;
    struct kd_camera camera;
    int32_t width, height;
    struct kd_window window;
};

static struct entry {
    struct key key;
    struct kd_critical_pixels list; /* may be empty, with pixels NULL; an empty list is cached as well */
    uint64_t used;                  /* value of a counter at the last use; 0: the slot is free */
} all[KD_CRITICAL_KEPT];
static uint64_t now;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER; /* guards all of the above */

static struct key key_of(const struct kd_scene *scene)
{
    struct key key;
    memset(&key, 0, sizeof key); /* keys are compared byte by byte */
    key.spacetime = scene->spacetime;
    key.camera = scene->camera;
    key.camera.azimuth_deg = 0;
    key.width = scene->image.width;
    key.height = scene->image.height;
    key.window = kd_scene_window(scene);
    return key;
}

static enum kd_status copy(const struct kd_critical_pixels *from, struct kd_critical_pixels *to)
{
    *to = (struct kd_critical_pixels) { 0 };
    if (!from->n)
        return KD_OK;
    if (!(to->pixels = malloc(from->n * sizeof *to->pixels)))
        return KD_ENOMEM;
    memcpy(to->pixels, from->pixels, from->n * sizeof *to->pixels);
    to->n = from->n;
    return KD_OK;
}

/* The cached list of a key, or NULL. The lock must be held, also for the next three functions. */
static struct entry *find(const struct key *key)
{
    for (size_t i = 0; i < KD_CRITICAL_KEPT; i++)
        if (all[i].used && !memcmp(&all[i].key, key, sizeof *key))
            return &all[i];
    return NULL;
}

static void drop(struct entry *entry)
{
    kd_critical_pixels_finish(&entry->list);
    entry->used = 0;
}

/* A slot for a list of n pixels: the least recently used lists are evicted to make room. */
static struct entry *place_for(size_t n)
{
    for (;;) {
        struct entry *oldest = NULL, *place = NULL;
        size_t bytes = n * sizeof(struct kd_pixel);
        for (size_t i = 0; i < KD_CRITICAL_KEPT; i++) {
            bytes += all[i].list.n * sizeof(struct kd_pixel);
            if (!all[i].used)
                place = &all[i];
            else if (!oldest || all[i].used < oldest->used)
                oldest = &all[i];
        }
        if (place && bytes <= KD_CRITICAL_CACHE_BYTES)
            return place;
        drop(oldest);
    }
}

static void keep(const struct key *key, const struct kd_critical_pixels *list)
{
    struct kd_critical_pixels own;
    if (list->n > KD_CRITICAL_CACHE_BYTES / sizeof(struct kd_pixel) || find(key) || copy(list, &own))
        return; /* not cached: too long, already inserted by another thread, or out of memory */
    struct entry *place = place_for(own.n);
    *place = (struct entry) { .key = *key, .list = own, .used = ++now };
}

enum kd_status kd_critical_cache(const struct kd_scene *scene, struct kd_critical_pixels *out, struct kd_error *error)
{
    const struct key key = key_of(scene);
    pthread_mutex_lock(&lock);
    struct entry *entry = find(&key);
    bool found = entry && !copy(&entry->list, out);
    if (found)
        entry->used = ++now;
    pthread_mutex_unlock(&lock);
    if (found)
        return KD_OK;
    enum kd_status status = kd_critical_pixels_of(scene, out, error);
    if (status)
        return status;
    pthread_mutex_lock(&lock);
    keep(&key, out);
    pthread_mutex_unlock(&lock);
    return KD_OK;
}

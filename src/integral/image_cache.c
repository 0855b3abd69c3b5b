#include "integral/image_cache.h"

#include <math.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum { KEPT = 8 }; /* number of cached images, of 150 kB each */

static struct entry {
    double inclination_deg; /* inclination of the disk; the cache key is this and the image's hole */
    unsigned long used;     /* time of the last use; 0 if the entry is empty */
    struct kd_disk_image image;
} entries[KEPT];
static unsigned long uses;
static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static bool same(const struct kd_hole *a, const struct kd_hole *b) { return a->a == b->a && a->q == b->q; }

static bool look_up(const struct kd_hole *hole, double inclination_deg, struct kd_disk_image *out)
{
    bool found = false;
    pthread_mutex_lock(&lock);
    for (int i = 0; i < KEPT && !found; i++) {
        struct entry *e = &entries[i];
        found = e->used && same(&e->image.hole, hole) && e->inclination_deg == inclination_deg;
        if (found) {
            e->used = ++uses;
            *out = e->image;
        }
    }
    pthread_mutex_unlock(&lock);
    return found;
}

static void keep(double inclination_deg, const struct kd_disk_image *image)
{
    pthread_mutex_lock(&lock);
    struct entry *oldest = entries;
    for (int i = 1; i < KEPT; i++)
        if (entries[i].used < oldest->used)
            oldest = &entries[i];
    oldest->inclination_deg = inclination_deg, oldest->used = ++uses;
    oldest->image = *image;
    pthread_mutex_unlock(&lock);
}

enum kd_status kd_cached_disk_image(const struct kd_hole *hole, double inclination_deg, struct kd_disk_image **out,
                                    struct kd_error *error)
{
    const struct kd_hole_parameter largest = kd_hole_largest(hole);
    /* a disk looks the same from below as from above */
    inclination_deg = inclination_deg > 90 ? 180 - inclination_deg : inclination_deg;
    struct kd_disk_image *image = *out = malloc(sizeof *image);
    if (!image)
        return kd_error_set(error, KD_ENOMEM, "out of memory for the disk's image");
    if (look_up(hole, inclination_deg, image))
        return KD_OK;
    if (!kd_disk_image_init(image, hole, inclination_deg * (M_PI / 180))) {
        free(image);
        *out = NULL;
        return kd_error_field(error, largest.pointer,
                              "%s is %.17g, too close to an extremal hole for double precision to follow the disk's "
                              "image at inclination_deg %.9g",
                              largest.name, largest.value, inclination_deg);
    }
    keep(inclination_deg, image);
    return KD_OK;
}

/* Panoramas of the sky on the host: the procedural Milky Way, by its seed, or sky.image. The renderer caches the last
 * KD_PANORAMAS, up to 45 MB each. A thread of its own makes them one after the other, and ends when there is no
 * request, so that the thread with the device need not wait. The first Milky Way of a process is cached in a file for
 * later ones (render/sky/milky_way_file.h). Any thread, unless stated otherwise. */
#ifndef KD_RENDER_DEVICE_PANORAMAS_H
#define KD_RENDER_DEVICE_PANORAMAS_H

#include "base/error.h"
#include "render/sky/image.h"
#include "scene/asset.h"

#include <pthread.h>

struct kd_panorama {
    char of[KD_ASSET_NAME];     /* the asset's hash, or "seed N"; "": there is none here */
    uint32_t *words;            /* of all levels: render/sky/panorama.h */
    uint32_t columns, rows;     /* of the finest */
    char credit[KD_SKY_CREDIT]; /* whose picture it is; "": nobody says */
    uint64_t used;              /* the larger, the later */
    bool shown;                 /* it was given to who asked for it */
};
enum { KD_PANORAMAS = 3, KD_PANORAMAS_ASKED = 16 };

/* One that is to be made: as `of` above, and what it is made from. */
struct kd_panorama_key {
    char of[KD_ASSET_NAME];
    struct kd_sky sky;
    bool ahead; /* nobody waits for it */
};
struct kd_panoramas {
    pthread_mutex_t lock; /* guards all of it */
    pthread_cond_t changed;
    struct kd_panorama at[KD_PANORAMAS], *given; /* given: by kd_panorama_of, last; it stays */
    uint64_t used;
    struct kd_panorama_key asked[KD_PANORAMAS_ASKED]; /* the first one is being made */
    unsigned n_asked;
    bool runs;                  /* the thread */
    char broken[KD_ASSET_NAME]; /* the last one that could not be made; what is no sound picture is not looked at again.
                                   "": none was */
    struct kd_error why;
    const struct kd_assets *assets; /* NULL: there are none */
    char *file; /* where the first Milky Way that is made is kept for later processes; NULL: nowhere, or one was kept */
    bool blank; /* they are black, of a Milky Way's size, and take no time: nobody sees them */
    void (*made)(
        void *user); /* called by the thread, without the lock, whenever one is there or has failed; may be NULL */
    void *user;
};
void kd_panoramas_init(struct kd_panoramas *panoramas, const struct kd_assets *assets, void (*made)(void *user),
                       void *user);
/* Says where a Milky Way is kept, and looked for: a path that is freed with the panoramas; NULL: nowhere. Before the
 * first is begun. */
void kd_panoramas_keep_at(struct kd_panoramas *panoramas, char *path);

/* Begins to make the panorama of a scene, if that has one, and it is not there. Whether it is under way now. Places
 * of those that nobody has been given are the last to be given up; who waits for one asks again, so that it is made
 * again where it was. */
bool kd_panorama_begin(struct kd_panoramas *panoramas, const struct kd_scene *scene);
/* Begins to read an asset that may become a sky, where there is a free place for it and nothing else to be made: who
 * asks for it later waits less, or not at all. It is the first to be given up, and what is wrong with it is told to
 * who asks. */
void kd_panorama_ahead(struct kd_panoramas *panoramas, const char *hash);
/* Finds the panorama of a scene whose sky has one, or waits for it: some tenths of a second for a Milky Way, a
 * second for a large picture. It stays until the next call. Render thread only. KD_EINVAL at /sky/image: the asset
 * is not here any more, or is no sound picture; KD_ENOMEM. */
enum kd_status kd_panorama_of(struct kd_panoramas *panoramas, const struct kd_scene *scene,
                              const struct kd_panorama **out, struct kd_error *error);
/* Waits for the one that is being made, and forgets those that are asked for: nobody is called any more, unless
 * another is begun. */
void kd_panoramas_stop(struct kd_panoramas *panoramas);
/* Gives up all but the n that were asked for last, unless one is being made. Render thread only: nobody uses one. */
void kd_panoramas_rest(struct kd_panoramas *panoramas, unsigned n);
uint64_t kd_panoramas_bytes(struct kd_panoramas *panoramas); /* of their pixels. Any thread */
void kd_panoramas_finish(struct kd_panoramas *panoramas);

#endif

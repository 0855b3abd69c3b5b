/* Panoramas of the sky on the host. A panorama is sky.image, or the procedural Milky Way of some seed. The renderer
 * caches the last KD_PANORAMAS panoramas, up to 45 MB each. A thread makes them (asset_reader.h). The first Milky Way
 * of a process is stored in a file for later processes (render/sky/milky_way_file.h). Any thread, unless stated
 * otherwise. */
#ifndef KD_RENDER_DEVICE_PANORAMAS_H
#define KD_RENDER_DEVICE_PANORAMAS_H

#include "base/error.h"
#include "render/device/asset_reader.h"
#include "render/sky/image.h"
#include "scene/asset.h"

struct kd_panorama {
    char of[KD_ASSET_NAME];     /* the asset's hash, or "seed N"; "": the slot is free */
    uint32_t *words;            /* all levels: render/sky/panorama.h */
    uint32_t columns, rows;     /* columns and rows of the finest level */
    char credit[KD_SKY_CREDIT]; /* author of the picture; "": unknown */
    uint64_t used;              /* value of a counter at the last use */
    bool shown;                 /* true if it was delivered to a request, or read in advance */
};
enum { KD_PANORAMAS = 3 };

struct kd_panoramas {
    struct kd_asset_reader reader;               /* its lock protects all members below */
    struct kd_panorama at[KD_PANORAMAS], *given; /* given: last result of kd_panorama_of; not evicted for a new one */
    struct kd_panorama made;                     /* panorama made by the reader's thread, which then caches it */
    bool recalled;                               /* true if `made` was read from the file */
    const struct kd_panorama *fresh;             /* a new Milky Way that must be written to the file, or NULL */
    uint64_t used;
    const struct kd_assets *assets; /* NULL: there are no assets */
    char *file; /* file in which the first Milky Way is stored for later processes; NULL: none, or already written */
    /* true on a device that only compiles: panoramas are black, which takes no time to make, and have a Milky Way's
     * size */
    bool blank;
};
void kd_panoramas_init(struct kd_panoramas *panoramas, const struct kd_assets *assets, void (*made)(void *user),
                       void *user);
/* Sets the path of the file in which a Milky Way is cached. NULL: no file. The path is freed with the panoramas. Call
 * before the first request. */
void kd_panoramas_keep_at(struct kd_panoramas *panoramas, char *path);

/* Starts making the panorama of a scene, if the scene has one and it is not cached. Returns whether the panorama is
 * in progress. A waiting client calls this function repeatedly; if the panorama was evicted meanwhile, it is made
 * once more. Panoramas that were not delivered yet are evicted last. */
bool kd_panorama_begin(struct kd_panoramas *panoramas, const struct kd_scene *scene);
/* Starts reading an asset that may become a sky, so that later requests wait less. Does nothing if no slot is free or
 * if another request is in progress. A panorama read in advance may be evicted before it is used. An error is not
 * reported here, but to the caller that requests the panorama. */
void kd_panorama_ahead(struct kd_panoramas *panoramas, const char *hash);
/* Gets the panorama of a scene that has one. Waits until the panorama is made, some tenths of a second for a Milky
 * Way and a second for a large picture. The panorama is valid until the next call. Render thread only. Returns
 * KD_ENOMEM, or KD_EINVAL at /sky/image if the asset is gone or is not a valid picture. */
enum kd_status kd_panorama_of(struct kd_panoramas *panoramas, const struct kd_scene *scene,
                              const struct kd_panorama **out, struct kd_error *error);
/* Waits for the panorama in progress and drops all other requests. `made` is not called again before a new request. */
void kd_panoramas_stop(struct kd_panoramas *panoramas);
/* Evicts all but the n most recent panoramas, unless one is in progress. Render thread only, while no panorama is in
 * use. */
void kd_panoramas_rest(struct kd_panoramas *panoramas, unsigned n);
uint64_t kd_panoramas_bytes(struct kd_panoramas *panoramas); /* bytes of the cached panoramas' pixels; any thread */
void kd_panoramas_finish(struct kd_panoramas *panoramas);

#endif

/* Panoramas of skies on the host, as the device is given them: the Milky Way that is made up, by its seed, or sky.image. The renderer keeps the last
 * KD_PANORAMAS that were asked for, up to 45 MB each, as long as it lives. Render thread only. */
#ifndef KD_RENDER_DEVICE_PANORAMAS_H
#define KD_RENDER_DEVICE_PANORAMAS_H

#include "base/error.h"
#include "render/sky/image.h"
#include "scene/asset.h"

struct kd_panorama {
    char of[KD_ASSET_NAME];       /* the asset's hash, or "seed N"; "": there is none here */
    uint32_t *words;              /* of all levels: render/sky/panorama.h */
    uint32_t columns, rows;       /* of the finest */
    char credit[KD_SKY_CREDIT];   /* whose picture it is; "": nobody says */
    uint64_t used;                /* the larger, the later */
};
enum { KD_PANORAMAS = 3 };
struct kd_panoramas {
    struct kd_panorama at[KD_PANORAMAS];
    uint64_t used;
    char broken[KD_ASSET_NAME]; /* the last asset that was no sound picture, which is not looked at again; "": none was */
    struct kd_error why;
    const struct kd_assets *assets; /* NULL: there are none */
};

/* Finds, or makes, the panorama of a scene whose sky has one: some tenths of a second for a Milky Way, a second for a large picture. It stays until
 * others are asked for. KD_EINVAL at /sky/image: the asset is not here any more, or is no sound picture; KD_ENOMEM. */
enum kd_status kd_panorama_of(struct kd_panoramas *panoramas, const struct kd_scene *scene, const struct kd_panorama **out, struct kd_error *error);
void kd_panoramas_finish(struct kd_panoramas *panoramas);

#endif

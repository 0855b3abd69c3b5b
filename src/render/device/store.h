/* Device buffers of a renderer: the lens maps kept between frames, and the working set of a frame. Render thread
 * only. */
#ifndef KD_RENDER_DEVICE_STORE_H
#define KD_RENDER_DEVICE_STORE_H

#include "render/view/critical_pixels.h"
#include "render/view/rim_grid.h"
#include "render/plan/plan.h"
#include "render/device/renderer.h"
#include "vk/vk.h"
#include "render/emit/emitter.h"
#include "render/view/layout.h"

struct kd_emit_data;

/* One buffer for each band of the picture. */
struct kd_bands {
    struct kd_vk_buffer **buffers;
    uint32_t count;
    uint64_t band_bytes;
};

/* Everything that determines the light of stars, except the lens map. The light of stars stays valid while only time
 * advances. */
struct kd_star_key {
    char lens[65];
    bool visible; /* true if brightness is weighted by the eye's sensitivity */
    bool bright;  /* same meaning as kd_plan_light.bright */
    struct kd_sky sky;
    struct kd_sky_block block;
};

struct kd_lens_map {
    char key[65]; /* "": the map is empty or incomplete */
    struct kd_bands bands;
    struct kd_bands
        /* lens maps of the pixels at the critical curve, one buffer for each part of the pixels; each map is followed
         * by the list of its pixels */
        critical;
    struct kd_critical_pixels pixels;
    /* the light of stars seen through this map: KD_STAR_LIGHT words for each pixel of a band. No buffers: no frame of
     * this map had stars */
    struct kd_bands star_light;
    /* the rim of the map's camera, for images of stars of high orders; set if there is a rim and it was requested */
    struct kd_rim rim;
    struct kd_rim_grids rim_grids;
    bool rim_known; /* true if rim and rim_grids are set */
    bool rim_traced;
    struct kd_vk_buffer *rim_lens; /* directions and tables of the rim (frame/rim.c); NULL: never made */
    struct kd_star_key star_key;   /* key of the star light; lens "": the star light is missing or incomplete */
    struct kd_accuracy_report accuracy;
    uint64_t used;
};
#define KD_LENS_MAPS_KEPT 4

struct kd_store {
    struct kd_vk *vk;
    uint64_t memory_bytes; /* limit for all memory of the store; set for each frame */
    struct kd_lens_map maps[KD_LENS_MAPS_KEPT];
    uint64_t clock;
    struct kd_bands radiance;
    /* the layers of numbers, one after the other, of kd_plan_layer_bytes each; no buffers: no frame had layers */
    struct kd_bands layers;
    /* packed pixels of one band: `words` on the device, `readback` on the host */
    struct kd_vk_buffer *words, *readback;
    /* parameters and tables that are read at each crossing: in device memory, uploaded through `staging` */
    struct kd_vk_buffer *transfer, *staging;
    struct kd_emit_data *sent; /* the uploaded data; NULL: none yet */
    bool sent_whole;           /* true if the uploaded data are known; false after a frame was given up */
    /* cameras: KD_CAMERA_BYTES for each camera; cameras_host: staging buffer for the cameras. NULL: not made yet */
    struct kd_vk_buffer *cameras, *cameras_host;
    struct kd_camera_block sent_cameras[KD_CAMERAS];
    bool cameras_sent; /* true if the buffer holds sent_cameras */
    struct kd_vk_buffer *histogram, *counts;
    struct kd_vk_buffer *light, *light_host; /* sums of photometry; NULL: not measured yet */
    struct kd_vk_buffer *bloom;              /* grids of bloom; NULL: not made yet */
    struct kd_bands beamed;                  /* radiance after the telescope's beam; no buffers: the plan has no beam */
    /* beam_lines: intermediate rows of cells; beam_grids: grids of cells. NULL: not made yet */
    struct kd_vk_buffer *beam_lines, *beam_grids;
    /* colours of style.palette: KD_MAP_ENTRIES colours of four floats each; NULL: not made yet */
    struct kd_vk_buffer *palette;
    struct kd_vk_buffer *star_pairs; /* pairs of a ray and a star that the ray may see; NULL: no frame had stars */
    struct kd_vk_buffer *star_rays;  /* rays whose stars are searched one by one */
    struct kd_vk_buffer *listed;     /* lens map of listed pixels, overwritten part by part */
    /* buffers for a sampled map (frame/sample.c): its lists, its index and its nodes; NULL: no frame had such a map */
    struct kd_vk_buffer *sample, *sample_index, *nodes;
    uint32_t alone;                   /* offset in the lists at which the rays that are traced singly begin */
    int32_t alone_x, alone_y;         /* the ray relative to which the places of these rays are stored */
    struct kd_vk_buffer *sample_head; /* copy of the head of the lists on the host */
    /* rays that the kernels leave undecided (frame/settle.c): their number, then the places of at most
       kd_plan_open_most rays */
    struct kd_vk_buffer *undecided;
    struct kd_vk_buffer *undecided_host; /* copy of `undecided` on the host */
};

/* Finds the lens map of the plan. *reused: true if a complete map was found. Otherwise the map's buffers are ready to
 * be written, and after kd_store_commit later frames can find the map. Least recently used maps are evicted. */
enum kd_status kd_store_lens_map(struct kd_store *store, const struct kd_plan *plan, struct kd_lens_map **out,
                                 bool *reused, struct kd_error *error);
void kd_store_commit(struct kd_store *store, struct kd_lens_map *map, const struct kd_plan_lens *lens);

/* Allocates radiance, packed pixels, tables and histogram for a picture of this plan and bit depth. */
enum kd_status kd_store_frame(struct kd_store *store, const struct kd_plan *plan, int bit_depth,
                              struct kd_error *error);
/* Makes *buffer at least this large (NULL: there is none yet). A larger buffer is kept, unless it is much too large. */
enum kd_status kd_store_at_least(struct kd_vk *vk, struct kd_vk_buffer **buffer, uint64_t size,
                                 enum kd_vk_memory memory, const char *name, struct kd_error *error);
/* Records copies that update the transfer buffer. Parameters are copied if they have changed, and so are tables. */
enum kd_status kd_store_send(struct kd_store *store, const struct kd_emit_data *tables, struct kd_error *error);
/* Records copies that update the cameras, in a buffer that is made when first needed. */
enum kd_status kd_store_send_cameras(struct kd_store *store, const struct kd_camera_block cameras[KD_CAMERAS],
                                     struct kd_error *error);
/* Call when a frame is given up: its uploads may not have happened. */
void kd_store_give_up(struct kd_store *store);
/* Approximate device memory of the store, bytes. */
uint64_t kd_store_bytes(const struct kd_store *store);
/* Bytes of the store's lens maps. */
uint64_t kd_store_map_bytes(const struct kd_store *store);
/* Keeps only the latest lens maps, up to `bytes`. */
void kd_store_rest(struct kd_store *store, uint64_t bytes);
/* True if kd_store_lens_map would find the plan's lens map. */
bool kd_store_has(const struct kd_store *store, const struct kd_plan *plan);
/* Moves the plan's lens map from `from` to `to`, if `from` has it. */
void kd_store_hand_over(struct kd_store *from, struct kd_store *to, const struct kd_plan *plan);
/* Frees everything: the store is then as after creation. */
void kd_store_empty(struct kd_store *store);
void kd_store_finish(struct kd_store *store);

#endif

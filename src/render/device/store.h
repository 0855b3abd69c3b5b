/* Device buffers of a renderer: the lens maps kept between frames, and the working set of a frame. Render thread only.
 */
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

/* There is one buffer a band of the picture. */
struct kd_bands {
    struct kd_vk_buffer **buffers;
    uint32_t count;
    uint64_t band_bytes;
};

/* Light of points depends on this beside the lens map: it stays while only time runs. */
struct kd_star_key {
    char lens[65];
    bool visible; /* brightness as the eye weighs it */
    bool bright;  /* as in a plan */
    struct kd_sky sky;
    struct kd_sky_block block;
};

struct kd_lens_map {
    char key[65]; /* "" while empty or half made */
    struct kd_bands bands;
    struct kd_bands
        critical; /* the same of the pixels at the critical curve, part by part, each with their list behind it */
    struct kd_critical_pixels pixels;
    struct kd_bands star_light; /* of the pixels of a band, KD_STAR_LIGHT words each, as the map shows points of light;
                                   none: no frame had any */
    struct kd_rim
        rim; /* where stars have images of high orders, of the map's camera, if there is any, and it was asked for, */
    struct kd_rim_grids rim_grids;
    bool rim_known; /* if not */
    bool rim_traced;
    struct kd_vk_buffer *rim_lens; /* where its rays come from, and its tables (frame/rim.c); NULL: never was any */
    struct kd_star_key star_key;   /* what that was made of, "" lens: it was not, or not to its end */
    struct kd_accuracy_report accuracy;
    uint64_t used;
};
#define KD_LENS_MAPS_KEPT 4

struct kd_store {
    struct kd_vk *vk;
    uint64_t memory_bytes; /* most that all of this may hold; of each frame anew */
    struct kd_lens_map maps[KD_LENS_MAPS_KEPT];
    uint64_t clock;
    struct kd_bands radiance;
    struct kd_bands layers; /* maps of numbers, kd_plan_layer_bytes each, one after the other; none: no frame had any */
    struct kd_vk_buffer *words, *readback; /* packed pixels of one band, on the device and on the host */
    struct kd_vk_buffer *transfer,
        *staging;              /* parameters and tables: read at each crossing, so on the device, by way of the other */
    struct kd_emit_data *sent; /* what is there; NULL: nothing yet */
    bool sent_whole;           /* false: nothing of it, a frame was given up */
    struct kd_vk_buffer *cameras, *cameras_host; /* KD_CAMERA_BYTES each, by way of the other; NULL: none yet */
    struct kd_camera_block sent_cameras[KD_CAMERAS];
    bool cameras_sent; /* that is what is there */
    struct kd_vk_buffer *histogram, *counts;
    struct kd_vk_buffer *light, *light_host; /* its sums; NULL: never measured */
    struct kd_vk_buffer *bloom;              /* grids of light that a lens spreads; NULL: never was any */
    struct kd_bands beamed;                  /* radiance as a telescope's beam sees it; none: the plan has no beam */
    struct kd_vk_buffer *beam_lines,
        *beam_grids;                 /* rows of cells, and grids of them, on the way there; NULL: never was any */
    struct kd_vk_buffer *palette;    /* colours of style.palette, KD_MAP_ENTRIES of four floats; NULL: never was any */
    struct kd_vk_buffer *star_pairs; /* rays, and stars that they may see; NULL: no frame had points of light */
    struct kd_vk_buffer *star_rays;  /* rays whose stars are sought one by one */
    struct kd_vk_buffer *listed;     /* lens map of listed pixels, part by part: nothing is kept in it */
    struct kd_vk_buffer *sample, *sample_index, *nodes; /* of a sampled map (frame/sample.c): its lists, index and
                                                           nodes; NULL: no frame had any */
    uint32_t alone;                   /* where the lists have the places of rays that are followed alone, */
    int32_t alone_x, alone_y;         /* and the ray that these are counted from */
    struct kd_vk_buffer *sample_head; /* the lists' head on the host */
    struct kd_vk_buffer
        *undecided; /* rays that the kernels leave open: a counter, then the places of kd_plan_open_most; and */
    struct kd_vk_buffer *undecided_host; /* both on the host */
};

/* The lens map of the plan: *reused says that it is complete. Otherwise its buffers are there to be written, and
 * kd_store_commit makes it findable. Least recently used maps make room. */
enum kd_status kd_store_lens_map(struct kd_store *store, const struct kd_plan *plan, struct kd_lens_map **out,
                                 bool *reused, struct kd_error *error);
void kd_store_commit(struct kd_store *store, struct kd_lens_map *map, const struct kd_plan *plan);

/* Radiance, packed pixels, tables and histogram for a picture of this plan and bit depth. */
enum kd_status kd_store_frame(struct kd_store *store, const struct kd_plan *plan, int bit_depth,
                              struct kd_error *error);
/* *buffer (NULL: none yet) becomes one of at least this size; a larger one is kept unless it is much too large. */
enum kd_status kd_store_at_least(struct kd_vk *vk, struct kd_vk_buffer **buffer, uint64_t size,
                                 enum kd_vk_memory memory, const char *name, struct kd_error *error);
/* Record copies that bring the transfer buffer up to date: of the parameters and of the tables, each if it has
 * changed. */
enum kd_status kd_store_send(struct kd_store *store, const struct kd_emit_data *tables, struct kd_error *error);
/* It does the same for the cameras, in a buffer that is made when first there are any. */
enum kd_status kd_store_send_cameras(struct kd_store *store, const struct kd_camera_block cameras[KD_CAMERAS],
                                     struct kd_error *error);
/* A frame is given up: what it was to bring may be lost. */
void kd_store_give_up(struct kd_store *store);
/* Counts the bytes that it holds of the device's memory, about. */
uint64_t kd_store_bytes(const struct kd_store *store);
/* Of that, what its lens maps take. */
uint64_t kd_store_map_bytes(const struct kd_store *store);
/* Keeps the latest lens maps, up to so many bytes, and nothing else. */
void kd_store_rest(struct kd_store *store, uint64_t bytes);
/* Says whether kd_store_lens_map would find the plan's lens map. */
bool kd_store_has(const struct kd_store *store, const struct kd_plan *plan);
/* The plan's lens map, if `from` has it, becomes one of `to`. */
void kd_store_hand_over(struct kd_store *from, struct kd_store *to, const struct kd_plan *plan);
/* It is then as it was made. */
void kd_store_empty(struct kd_store *store);
void kd_store_finish(struct kd_store *store);

#endif

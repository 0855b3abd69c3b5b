/* The picture of a plan: its size, its parts, its layers, and the operations on its light before display. Plain data
 * and pure functions; any thread. */
#ifndef KD_RENDER_PLAN_PICTURE_H
#define KD_RENDER_PLAN_PICTURE_H

#include "render/plan/beam.h"
#include "render/plan/bloom.h"
#include "render/plan/layer_kinds.h"
#include "scene/scene.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct kd_plan_picture {
    uint32_t width, height; /* pixels */
    struct kd_window
        cut; /* for a tile: its place within the size above, which includes its margin (tile.h); width 0: not a tile */
    /* number of strips of a picture that does not fit in one piece; each is a tile with a margin. The plan's passes,
     * times and cost.host_bytes are for all strips, cost.device_bytes for the largest strip. 0: the picture is made
     * in one piece */
    uint32_t strips;
    /* 2: a pair, with a picture for each eye, side by side. The plan's passes, times and cost.host_bytes are then
     * for both pictures, cost.device_bytes for the larger one, and all other members for the left one. 0: a single
     * picture */
    uint32_t eyes;
    /* band_rows: rows of pixels for which one set of buffers has room; bands: number of such sets */
    uint32_t band_rows, bands;
    bool no_image; /* true if no picture is made from the radiance */
    /* true if the frame is for a file of numbers, so that it contains the light without later processing */
    bool numbers;
    bool rgb;                                   /* true if image.layers contains the picture */
    bool radiance;                              /* true if linear light is copied to the host, too */
    struct kd_plan_layer layers[KD_WORDS_MOST]; /* layers besides the picture */
    size_t n_layers;
    struct kd_beam_grid beam; /* the telescope's beam with which light is convolved */
    struct kd_bloom bloom;    /* glare of the lens */
    /* The remaining settings come from the caller and not from the scene. exposure_from and exposure_share are for
     * showing successive frames. If style.exposure is "auto", the exposure moves by the fraction exposure_share from
     * exposure_from towards the picture's own exposure. With exposure_share 0, which kd_plan_make sets, the picture has
     * its own exposure. */
    double exposure_from, exposure_share;
    struct {
        unsigned samples;
        double shutter;
        /* motion blur (frame/blur.h): light is the mean of `samples` pictures within the fraction `shutter` of a
         * frame's time; samples 0: no blur */
    } blur;
};

/* Size of the delivered picture in pixels: a tile without its margin, a pair with both eyes' pictures. */
static inline uint32_t kd_plan_shown_width(const struct kd_plan_picture *picture)
{
    return picture->cut.width ? picture->cut.width : picture->width * (picture->eyes ? picture->eyes : 1);
}
static inline uint32_t kd_plan_shown_height(const struct kd_plan_picture *picture)
{
    return picture->cut.width ? picture->cut.height : picture->height;
}

/* Bytes of one layer for a band of pixels: a multiple of the alignment of bindings. */
static inline uint64_t kd_plan_layer_bytes(const struct kd_plan_picture *picture)
{
    return (4ull * picture->width * picture->band_rows + 255) / 256 * 256;
}

/* Bytes for reading layers back a band at a time. */
static inline uint64_t kd_plan_readback_bytes(const struct kd_plan_picture *picture)
{
    return (picture->radiance ? 12ull : picture->n_layers ? 4ull : 0) * picture->width * picture->band_rows;
}

/* True if the only requested layer is a map: the picture then shows it in false colour. */
static inline bool kd_plan_is_map(const struct kd_plan_picture *picture)
{
    return picture->n_layers == 1 && !picture->rgb;
}

/* Bytes of the fixed-point numbers of a band of pixels, in which the light of stars is summed (frame/stars.c). */
static inline uint64_t kd_plan_star_bytes(const struct kd_plan_picture *picture)
{
    return 24ull * picture->width * picture->band_rows;
}

/* The exposure in stops to apply where the picture by itself would have `stops`. */
static inline double kd_plan_exposure(const struct kd_plan_picture *picture, double stops)
{
    const double share = picture->exposure_share;
    return share > 0 ? picture->exposure_from + share * (stops - picture->exposure_from) : stops;
}

#endif

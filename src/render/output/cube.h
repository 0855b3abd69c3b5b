/* A cube: for each layer an array over all scenes of a sweep, made from the scenes' FITS files. Shared by cube_fits.c
 * and cube_npz.c. All files are scanned before anything is written, because checksums and sentences come before the
 * numbers in a cube.
 *
 * In FITS a layer is an image. Its first axes are those of the picture, followed for "rgb" by the three colours. Then
 * come the axes of the sweep, from the last to the first. In NumPy the array's shape is (axes of the sweep, height,
 * width[, 3]). Internal to render/output. */
#ifndef KD_RENDER_OUTPUT_CUBE_H
#define KD_RENDER_OUTPUT_CUBE_H

#include "render/output/gather.h"
#include "render/output/wcs.h"
#include "render/plan/layer_kinds.h"
#include "scene/sweep.h"

#define KD_CUBE_TEXTS 128
/* Bytes stored for each scene: hash and accuracy, padded with NULs, then the flux as a big-endian double. The flux is
 * NAN if the picture has none. */
enum {
    KD_CUBE_HASH = 64,
    KD_CUBE_ACCURACY = 384,
    KD_CUBE_TEXT = KD_CUBE_HASH + KD_CUBE_ACCURACY,
    KD_CUBE_FLUX = 8,
    KD_CUBE_ROW = KD_CUBE_TEXT + KD_CUBE_FLUX
};

struct kd_cube_layer {
    char name[KD_LAYER_NAME], unit[24];
    unsigned channels;
    uint32_t sum; /* kd_fits_sum of the numbers of all scenes */
};

struct kd_cube {
    const struct kd_gather_source *source;
    unsigned width, height;
    struct kd_cube_layer layers[KD_WORDS_MOST];
    size_t n_layers;
    unsigned seen;     /* number of scenes scanned so far */
    uint64_t *places;  /* offsets of the layers' numbers in the scenes' files: n_layers for each scene */
    struct kd_wcs wcs; /* world coordinates of the first scene */
    bool wcs_differ;   /* true if any scene has other world coordinates */
    struct kd_cube_texts {
        char *at[KD_CUBE_TEXTS];
        size_t n;
    } sentences, credits, devices; /* each different text once: approximations, credits and devices of all scenes */
    char *rows;                    /* KD_CUBE_ROW bytes for each scene */
    /* texts_sum: kd_fits_sum of the scenes' hashes and accuracies; fluxes_sum: kd_fits_sum of their fluxes */
    uint32_t texts_sum, fluxes_sum;
    bool flux;      /* true if any scene has a flux; the file then contains fluxes */
    uint8_t *piece; /* buffer of at least KD_GATHER_PIECE bytes, with room for a row of numbers */
    size_t piece_bytes;
};

enum kd_status kd_cube_open(const struct kd_gather_source *source, struct kd_cube *out, struct kd_error *error);
void kd_cube_finish(struct kd_cube *cube);
/* Scans some more scenes. *over: true if all scenes were scanned. */
enum kd_status kd_cube_look(struct kd_cube *cube, bool *over, struct kd_error *error);
/* The bytes stored for a scene: hash, accuracy of its picture, and flux. */
static inline const char *kd_cube_row(const struct kd_cube *cube, unsigned scene)
{
    return cube->rows + (size_t)scene * KD_CUBE_ROW;
}
/* Joins all texts into one: "a; b". */
enum kd_status kd_cube_join(const struct kd_cube_texts *texts, struct kd_buffer *out);
/* Bytes of a layer's numbers in one scene. */
static inline uint64_t kd_cube_slice(const struct kd_cube *cube, size_t layer)
{
    return 4ull * cube->layers[layer].channels * cube->width * cube->height;
}
enum kd_status kd_cube_read(struct kd_cube *cube, unsigned scene, size_t layer, uint64_t at, void *to, size_t size,
                            struct kd_error *error);
/* Write and read a big-endian double, as FITS stores it. */
void kd_cube_put_double(uint8_t to[8], double value);
double kd_cube_get_double(const uint8_t from[8]);
/* Size of the longest text among an axis' values, in bytes; at least 1. */
size_t kd_cube_longest(const struct kd_sweep_axis *axis);

#endif

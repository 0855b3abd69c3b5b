/* A cube is an array of each layer with all scenes of a sweep, made of the FITS files of the scenes: what
 * cube_fits.c and cube_npz.c share. It is looked through before anything is written, since sums and sentences stand
 * before the numbers.
 *
 * In FITS an image of each layer has the picture's axes, of "rgb" the three colours, then the axes of the sweep from
 * the last to the first; in NumPy the shape is (axes of the sweep, height, width[, 3]). Internal to render/output. */
#ifndef KD_RENDER_OUTPUT_CUBE_H
#define KD_RENDER_OUTPUT_CUBE_H

#include "render/output/gather.h"
#include "render/output/wcs.h"
#include "render/plan/layer_kinds.h"
#include "scene/sweep.h"

#define KD_CUBE_TEXTS 128
/* Bytes told of each scene: hash and accuracy, with NULs behind each, and the flux, a double with its first byte
 * first; NAN: the picture has none. */
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
    unsigned seen;     /* scenes that it has been through */
    uint64_t *places;  /* of the numbers in the files: n_layers a scene */
    struct kd_wcs wcs; /* of the first; */
    bool wcs_differ;   /* not of all */
    struct kd_cube_texts {
        char *at[KD_CUBE_TEXTS];
        size_t n;
    } sentences, credits, devices;  /* approximations that are in force in some scene, whose work is in
                                     * some, and what made them: each once */
    char *rows;                     /* of all scenes: KD_CUBE_ROW each */
    uint32_t texts_sum, fluxes_sum; /* kd_fits_sum of their hashes and accuracies, and of their fluxes */
    bool flux;                      /* some scene has one: then files have them */
    uint8_t *piece;                 /* KD_GATHER_PIECE bytes and more: a row of numbers fits */
    size_t piece_bytes;
};

enum kd_status kd_cube_open(const struct kd_gather_source *source, struct kd_cube *out, struct kd_error *error);
void kd_cube_finish(struct kd_cube *cube);
/* Looks through some more scenes. *over: through all. */
enum kd_status kd_cube_look(struct kd_cube *cube, bool *over, struct kd_error *error);
/* What is told of a scene: its hash, its picture's accuracy, and its flux. */
static inline const char *kd_cube_row(const struct kd_cube *cube, unsigned scene)
{
    return cube->rows + (size_t)scene * KD_CUBE_ROW;
}
/* All of these, one after the other: "a; b". */
enum kd_status kd_cube_join(const struct kd_cube_texts *texts, struct kd_buffer *out);
/* Bytes of a layer's numbers in one scene. */
static inline uint64_t kd_cube_slice(const struct kd_cube *cube, size_t layer)
{
    return 4ull * cube->layers[layer].channels * cube->width * cube->height;
}
enum kd_status kd_cube_read(struct kd_cube *cube, unsigned scene, size_t layer, uint64_t at, void *to, size_t size,
                            struct kd_error *error);
/* Writes a double as FITS has it, its first byte first; and reads one. */
void kd_cube_put_double(uint8_t to[8], double value);
double kd_cube_get_double(const uint8_t from[8]);
/* The longest text of an axis' values, in bytes; at least 1. */
size_t kd_cube_longest(const struct kd_sweep_axis *axis);

#endif

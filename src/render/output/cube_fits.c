/* Writes a cube as FITS: kd_gather_fits. Each layer is an image with the layer's name; the first image has the common
 * metadata. Each axis has a table named by its field, with its values in the column "value". The table SCENES has,
 * for each scene in order, the hash, the accuracy and the flux (if pictures have one). Axes are world coordinates as
 * well (cube_axes.h). */
#include "render/output/cube.h"

#include "image/fits.h"
#include "render/output/cube_axes.h"
#include "render/output/fits_cards.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct writer {
    struct kd_cube cube;
    size_t unit;    /* index of the current HDU, in the order layers, axes, scenes */
    bool begun;     /* true if the header of the current HDU is written */
    unsigned scene; /* next scene of the current HDU */
    uint64_t at, written;
};

static enum kd_status no_memory(struct kd_error *error)
{
    return kd_error_set(error, KD_ENOMEM, "out of memory for a FITS cube");
}

static enum kd_status open_cube(const struct kd_gather_source *source, void **state, struct kd_error *error)
{
    struct writer *w = calloc(1, sizeof *w);
    *state = w;
    return w ? kd_cube_open(source, &w->cube, error) : no_memory(error);
}

static void close_cube(void *state)
{
    struct writer *w = state;
    kd_cube_finish(&w->cube);
    free(w);
}

static enum kd_status put_json(struct kd_buffer *cards, const struct kd_sweep *sweep)
{
    struct kd_buffer axes = { 0 }, scene = { 0 };
    struct kd_json json = kd_json_begin(&axes);
    kd_sweep_axes_json(sweep, &json, NULL);
    enum kd_status status;
    KD_TRY(kd_json_finish(&json));
    KD_TRY(kd_fits_text(cards, "KDAXES", (const char *)axes.data, NULL));
    KD_TRY(kd_scene_to_json(&sweep->base, &scene));
    KD_TRY(kd_fits_text(cards, "KDSCENE", (const char *)scene.data, NULL));
done:
    kd_buffer_finish(&axes);
    kd_buffer_finish(&scene);
    return status;
}

static enum kd_status put_notes(struct kd_buffer *cards, const struct kd_cube *cube)
{
    const struct kd_sweep *sweep = cube->source->sweep;
    struct kd_buffer devices = { 0 }, credits = { 0 };
    char key[32];
    enum kd_status status;
    KD_TRY(kd_cube_join(&cube->devices, &devices));
    KD_TRY(kd_cube_join(&cube->credits, &credits));
    KD_TRY(kd_fits_text(cards, "ORIGIN", "kerrd " KD_VERSION, NULL));
    KD_TRY(kd_fits_put_scene(cards, &sweep->base, sweep));
    KD_TRY(kd_fits_text(cards, "LONGSTRN", "OGIP 1.0", "texts may go on: CONTINUE"));
    KD_TRY(kd_fits_text(cards, "KDDEVICE", (const char *)devices.data, NULL));
    for (size_t i = 0; i < cube->sentences.n; i++) {
        snprintf(key, sizeof key, "KDAPPR%zu", i + 1);
        KD_TRY(kd_fits_text(cards, key, cube->sentences.at[i], NULL));
    }
    if (credits.size)
        KD_TRY(kd_fits_text(cards, "KDCREDIT", (const char *)credits.data, NULL));
    KD_TRY(kd_fits_comment(cards, "KDSCENE is the scene; the fields in KDAXES vary along the axes"));
    KD_TRY(put_json(cards, sweep));
done:
    kd_buffer_finish(&devices);
    kd_buffer_finish(&credits);
    return status;
}

static enum kd_status begin_layer(struct writer *w, struct kd_buffer *out)
{
    const struct kd_cube *cube = &w->cube;
    const struct kd_cube_layer *layer = &cube->layers[w->unit];
    const struct kd_sweep *sweep = cube->source->sweep;
    const struct kd_wcs *wcs = cube->wcs_differ ? NULL : &cube->wcs;
    struct kd_fits_shape shape = { .primary = w->unit == 0, .n_axes = 2, .axes = { cube->width, cube->height } };
    struct kd_buffer cards = { 0 };
    enum kd_status status;
    if (layer->channels > 1)
        shape.axes[shape.n_axes++] = layer->channels;
    KD_TRY(kd_fits_put_layer(&cards, layer->name, layer->unit, layer->channels > 1, wcs));
    if (layer->channels > 1)
        KD_TRY(kd_cube_put_line(&cards, 3, "", 1, 1));
    for (size_t i = sweep->n_axes; i-- > 0;) {
        shape.axes[shape.n_axes++] = sweep->axes[i].n;
        KD_TRY(kd_cube_put_axis(&cards, &sweep->axes[i], shape.n_axes, wcs));
    }
    if (shape.primary)
        KD_TRY(put_notes(&cards, cube));
    KD_TRY(kd_fits_head(out, &shape, &cards, layer->sum));
done:
    kd_buffer_finish(&cards);
    return status;
}

static enum kd_status end_unit(struct writer *w, struct kd_buffer *out)
{
    static const uint8_t zeros[KD_FITS_BLOCK];
    enum kd_status status = kd_buffer_append(out, zeros, kd_fits_padding(w->written));
    w->unit++;
    w->begun = false;
    w->scene = 0;
    w->at = w->written = 0;
    return status;
}

/* The numbers in a scene's file are in the cube's byte order and are copied unchanged. */
static enum kd_status go_on_with_layer(struct writer *w, struct kd_buffer *out, struct kd_error *error)
{
    uint64_t slice = kd_cube_slice(&w->cube, w->unit);
    size_t n = slice - w->at < w->cube.piece_bytes ? (size_t)(slice - w->at) : w->cube.piece_bytes;
    enum kd_status status = kd_cube_read(&w->cube, w->scene, w->unit, w->at, w->cube.piece, n, error);
    if (status)
        return status;
    w->at += n;
    w->written += n;
    if (w->at == slice) {
        w->at = 0;
        w->scene++;
    }
    if (kd_buffer_append(out, w->cube.piece, n) || (w->scene == w->cube.source->n && end_unit(w, out)))
        return no_memory(error);
    return KD_OK;
}

/* Bytes of a scene's row; they do not include the flux if no scene has one. */
static size_t row_bytes(const struct kd_cube *cube) { return cube->flux ? KD_CUBE_ROW : KD_CUBE_TEXT; }

static enum kd_status put_column(struct kd_buffer *cards, unsigned number, const char *name, unsigned count,
                                 char letter)
{
    char key[16], form[24];
    enum kd_status status;
    snprintf(key, sizeof key, "TTYPE%u", number);
    KD_TRY(kd_fits_text(cards, key, name, NULL));
    snprintf(key, sizeof key, "TFORM%u", number);
    snprintf(form, sizeof form, "%u%c", count, letter);
    KD_TRY(kd_fits_text(cards, key, form, NULL));
done:
    return status;
}

static enum kd_status begin_scenes(const struct kd_cube *cube, struct kd_buffer *out)
{
    const struct kd_fits_shape shape = {
        .table = true, .columns = cube->flux ? 3 : 2, .n_axes = 2, .axes = { row_bytes(cube), cube->source->n }
    };
    struct kd_buffer cards = { 0 };
    enum kd_status status;
    KD_TRY(kd_fits_text(&cards, "EXTNAME", "SCENES", "in the order of the cube"));
    KD_TRY(put_column(&cards, 1, "hash", KD_CUBE_HASH, 'A'));
    KD_TRY(put_column(&cards, 2, "accuracy", KD_CUBE_ACCURACY, 'A'));
    if (cube->flux) {
        KD_TRY(put_column(&cards, 3, "flux_jy", 1, 'D'));
        KD_TRY(kd_fits_text(&cards, "TUNIT3", "Jy", NULL));
    }
    KD_TRY(kd_fits_head(out, &shape, &cards,
                        cube->flux ? kd_fits_add_sums(cube->texts_sum, cube->fluxes_sum) : cube->texts_sum));
done:
    kd_buffer_finish(&cards);
    return status;
}

static enum kd_status put_scenes(struct writer *w, struct kd_buffer *out)
{
    const unsigned left = w->cube.source->n - w->scene, fit = KD_GATHER_PIECE / KD_CUBE_ROW,
                   n = left < fit ? left : fit;
    const size_t row = row_bytes(&w->cube);
    enum kd_status status = KD_OK;
    for (unsigned i = 0; i < n && !status; i++)
        status = kd_buffer_append(out, kd_cube_row(&w->cube, w->scene + i), row);
    w->written += n * row;
    w->scene += n;
    return status || w->scene < w->cube.source->n ? status : end_unit(w, out);
}

static enum kd_status put_axis(const struct kd_sweep_axis *axis, struct kd_buffer *out)
{
    const enum kd_status status = kd_cube_put_values(axis, out);
    return status || !kd_cube_has_frequencies(axis) ? status : kd_cube_put_frequencies(axis, out);
}

static enum kd_status next_piece(void *state, struct kd_buffer *out, bool *over, struct kd_error *error)
{
    struct writer *w = state;
    const struct kd_sweep *sweep = w->cube.source->sweep;
    bool looked;
    enum kd_status status = kd_cube_look(&w->cube, &looked, error);
    if (status || !looked)
        return status;
    const bool layer = w->unit < w->cube.n_layers, axis = !layer && w->unit < w->cube.n_layers + sweep->n_axes;
    if (axis)
        return put_axis(&sweep->axes[w->unit++ - w->cube.n_layers], out) ? no_memory(error) : KD_OK;
    *over = w->unit > w->cube.n_layers + sweep->n_axes;
    if (*over)
        return KD_OK;
    if (!w->begun) {
        w->begun = true;
        return (layer ? begin_layer(w, out) : begin_scenes(&w->cube, out)) ? no_memory(error) : KD_OK;
    }
    if (layer)
        return go_on_with_layer(w, out, error);
    return put_scenes(w, out) ? no_memory(error) : KD_OK;
}

const struct kd_gather_format kd_gather_fits = {
    .name = "fits",
    .media_type = KD_FITS_TYPE,
    .of = &kd_format_cubed,
    .holds = kd_cube_holds,
    .open = open_cube,
    .next = next_piece,
    .close = close_cube,
};

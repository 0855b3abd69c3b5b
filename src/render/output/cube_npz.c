/* Writes a cube as numpy.savez does: kd_gather_npz. The file has an array for each axis of the sweep, float64 or
 * text, named by the axis' field. It has an array for each layer, float32, of the shape (axes..., height, width[,
 * 3]). The arrays scene_hash, scene_accuracy and (if pictures have a flux) scene_flux_jy have the shape (axes...).
 * The last member is notes.json. */
#include "render/output/cube.h"

#include "image/npy.h"
#include "image/zip.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct writer {
    struct kd_cube cube;
    struct kd_zip *zip;     /* NULL: not started */
    struct kd_buffer bytes; /* output of the ZIP so far */
    /* index of the current member in the order axes, layers, scene_hash, scene_accuracy, scene_flux_jy, notes.json */
    size_t member;
    bool begun;
    unsigned scene, row; /* next scene and next row of the current member; rows are counted from the top */
    float *rows;         /* room for the rows of a piece */
};

static enum kd_status no_memory(struct kd_error *error)
{
    return kd_error_set(error, KD_ENOMEM, "out of memory for an NPZ cube");
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
    kd_zip_destroy(w->zip);
    kd_buffer_finish(&w->bytes);
    kd_cube_finish(&w->cube);
    free(w->rows);
    free(w);
}

/* An array of plain elements whose first axes are those of the sweep. */
static struct kd_npy array_of(const struct writer *w, enum kd_npy_type type, uint32_t count)
{
    const struct kd_sweep *sweep = w->cube.source->sweep;
    struct kd_npy array = { .n_fields = 1,
                            .fields = { { .type = type, .count = count } },
                            .n_dimensions = sweep->n_axes };
    for (size_t i = 0; i < sweep->n_axes; i++)
        array.shape[i] = sweep->axes[i].n;
    return array;
}

static enum kd_status begin_array(struct writer *w, const char *name, const struct kd_npy *array)
{
    struct kd_buffer head = { 0 };
    char member[96];
    uint64_t size = kd_npy_item_size(array);
    enum kd_status status;
    for (size_t i = 0; i < array->n_dimensions; i++)
        size *= array->shape[i];
    snprintf(member, sizeof member, "%s.npy", name);
    KD_TRY(kd_npy_write_header(array, &head));
    KD_TRY(kd_zip_begin(w->zip, member, head.size + size));
    KD_TRY(kd_zip_append(w->zip, head.data, head.size));
    w->begun = true;
done:
    kd_buffer_finish(&head);
    return status;
}

static void end_member(struct writer *w)
{
    w->member++;
    w->begun = false;
    w->scene = w->row = 0;
}

/* Writes ASCII as UTF-32. */
static enum kd_status put_text(struct writer *w, const char *text, size_t room)
{
    enum kd_status status = KD_OK;
    size_t length = strlen(text);
    for (size_t i = 0; i < room && !status; i++)
        status = kd_zip_append(w->zip, (const uint8_t[4]) { i < length ? (uint8_t)text[i] : 0 }, 4);
    return status;
}

static enum kd_status put_axis(struct writer *w, const struct kd_sweep_axis *axis)
{
    const size_t longest = axis->numeric ? 0 : kd_cube_longest(axis);
    const struct kd_npy array = { .n_fields = 1,
                                  .fields = { { .type = axis->numeric ? KD_NPY_F8 : KD_NPY_TEXT,
                                                .count = (uint32_t)longest } },
                                  .shape = { axis->n },
                                  .n_dimensions = 1 };
    enum kd_status status = begin_array(w, axis->path, &array);
    for (size_t i = 0; i < axis->n && !status; i++)
        status = axis->numeric ? kd_zip_append(w->zip, &axis->values[i].number, 8)
                               : put_text(w, axis->values[i].text, longest);
    end_member(w);
    return status;
}

/* Reads some rows of a scene, and converts from FITS, which has the lowest row first, big-endian numbers, and each
 * channel separately. */
static enum kd_status read_rows(struct writer *w, size_t layer, unsigned rows, struct kd_error *error)
{
    struct kd_cube *cube = &w->cube;
    const unsigned width = cube->width, channels = cube->layers[layer].channels, from = cube->height - w->row - rows;
    enum kd_status status = KD_OK;
    for (unsigned c = 0; c < channels && !status; c++) {
        status = kd_cube_read(cube, w->scene, layer, 4ull * width * ((uint64_t)c * cube->height + from), cube->piece,
                              4ull * width * rows, error);
        for (size_t i = 0; i < (size_t)width * rows && !status; i++) {
            const uint8_t *b = cube->piece + 4 * i;
            const uint32_t bits = (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
            const size_t x = i % width, y = rows - 1 - i / width;
            memcpy(&w->rows[(y * width + x) * channels + c], &bits, 4);
        }
    }
    return status;
}

static enum kd_status go_on_with_layer(struct writer *w, size_t layer, struct kd_error *error)
{
    const struct kd_cube *cube = &w->cube;
    const struct kd_cube_layer *l = &cube->layers[layer];
    if (!w->begun) {
        struct kd_npy array = array_of(w, KD_NPY_F4, 0);
        array.shape[array.n_dimensions++] = cube->height;
        array.shape[array.n_dimensions++] = cube->width;
        if (l->channels > 1)
            array.shape[array.n_dimensions++] = l->channels;
        return begin_array(w, l->name, &array) ? no_memory(error) : KD_OK;
    }
    const unsigned fit = (unsigned)(cube->piece_bytes / (16ull * cube->width)), left = cube->height - w->row,
                   rows = left < fit ? left : fit;
    enum kd_status status = read_rows(w, layer, rows, error);
    if (!status && kd_zip_append(w->zip, w->rows, 4ull * l->channels * cube->width * rows))
        return no_memory(error);
    w->row += rows;
    if (w->row == cube->height) {
        w->row = 0;
        w->scene++;
    }
    if (w->scene == cube->source->n)
        end_member(w);
    return status;
}

static enum kd_status put_flux(struct writer *w, const char *row)
{
    const double flux = kd_cube_get_double((const uint8_t *)row + KD_CUBE_TEXT);
    return kd_zip_append(w->zip, &flux, sizeof flux);
}

/* Writes the array of an item that is stored for each scene. size: bytes of a text; 0: the item is the flux. */
static enum kd_status put_scenes(struct writer *w, const char *name, size_t from, uint32_t size)
{
    const struct kd_npy array = array_of(w, size ? KD_NPY_BYTES : KD_NPY_F8, size);
    enum kd_status status = w->begun ? KD_OK : begin_array(w, name, &array);
    for (unsigned i = 0; i < KD_GATHER_PIECE / KD_CUBE_ROW && w->scene < w->cube.source->n && !status; i++) {
        const char *row = kd_cube_row(&w->cube, w->scene++);
        status = size ? kd_zip_append(w->zip, row + from, size) : put_flux(w, row);
    }
    if (w->scene == w->cube.source->n)
        end_member(w);
    return status;
}

static enum kd_status put_notes(struct writer *w)
{
    const struct kd_cube *cube = &w->cube;
    struct kd_buffer text = { 0 }, scene = { 0 }, devices = { 0 }, credits = { 0 };
    enum kd_status status;
    KD_TRY(kd_cube_join(&cube->devices, &devices));
    KD_TRY(kd_cube_join(&cube->credits, &credits));
    KD_TRY(kd_scene_to_json(&cube->source->sweep->base, &scene));
    struct kd_json json = kd_json_begin(&text);
    kd_json_object(&json, NULL);
    kd_json_raw(&json, "scene", (const char *)scene.data, scene.size);
    kd_sweep_axes_json(cube->source->sweep, &json, "axes");
    kd_json_string(&json, "version", KD_VERSION);
    kd_json_string(&json, "device", (const char *)devices.data);
    kd_json_array(&json, "approximations");
    for (size_t i = 0; i < cube->sentences.n; i++)
        kd_json_string(&json, NULL, cube->sentences.at[i]);
    kd_json_end(&json);
    kd_json_object(&json, "units");
    for (size_t i = 0; i < cube->n_layers; i++)
        kd_json_string(&json, cube->layers[i].name, cube->layers[i].unit);
    for (size_t i = 0; i < cube->source->sweep->n_axes; i++)
        kd_json_string(&json, cube->source->sweep->axes[i].path, cube->source->sweep->axes[i].unit);
    kd_json_end(&json);
    if (credits.size)
        kd_json_string(&json, "credit", (const char *)credits.data);
    kd_json_end(&json);
    KD_TRY(kd_json_finish(&json));
    KD_TRY(kd_zip_add(w->zip, "notes.json", text.data, text.size));
    w->member++;
done:
    kd_buffer_finish(&text);
    kd_buffer_finish(&scene);
    kd_buffer_finish(&devices);
    kd_buffer_finish(&credits);
    return status;
}

static enum kd_status advance(struct writer *w, bool *over, struct kd_error *error)
{
    const struct kd_sweep *sweep = w->cube.source->sweep;
    const size_t axes = sweep->n_axes, layers = axes + w->cube.n_layers, notes = layers + 2 + w->cube.flux;
    if (!w->zip) {
        w->rows = malloc(w->cube.piece_bytes);
        return !w->rows || kd_zip_create(&w->bytes, false, &w->zip) ? no_memory(error) : KD_OK;
    }
    if (w->member < axes)
        return put_axis(w, &sweep->axes[w->member]) ? no_memory(error) : KD_OK;
    if (w->member < layers)
        return go_on_with_layer(w, w->member - axes, error);
    if (w->member == layers)
        return put_scenes(w, "scene_hash", 0, KD_CUBE_HASH) ? no_memory(error) : KD_OK;
    if (w->member == layers + 1)
        return put_scenes(w, "scene_accuracy", KD_CUBE_HASH, KD_CUBE_ACCURACY) ? no_memory(error) : KD_OK;
    if (w->member < notes)
        return put_scenes(w, "scene_flux_jy", 0, 0) ? no_memory(error) : KD_OK;
    if (w->member == notes)
        return put_notes(w) ? no_memory(error) : KD_OK;
    *over = true;
    return kd_zip_close(w->zip) ? no_memory(error) : KD_OK;
}

static enum kd_status next_piece(void *state, struct kd_buffer *out, bool *over, struct kd_error *error)
{
    struct writer *w = state;
    bool looked;
    enum kd_status status = kd_cube_look(&w->cube, &looked, error);
    if (status || !looked)
        return status;
    status = advance(w, over, error);
    if (!status && kd_buffer_append(out, w->bytes.data, w->bytes.size))
        status = no_memory(error);
    w->bytes.size = 0;
    return status;
}

const struct kd_gather_format kd_gather_npz = {
    .name = "npz",
    .media_type = KD_NPZ_TYPE,
    .of = &kd_format_cubed,
    .holds = kd_cube_holds,
    .open = open_cube,
    .next = next_piece,
    .close = close_cube,
};

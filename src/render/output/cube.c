#include "render/output/cube.h"

#include "image/fits.h"
#include "render/output/fits_cards.h"
#include "render/output/notes.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HEAD_MOST (1u << 20) /* largest size of a header in bytes; the scene in a header takes about 20000 */
#define AT_ONCE 32           /* scenes scanned in one call, which takes some milliseconds */

_Static_assert(KD_CUBE_ACCURACY >= KD_ACCURACY_TEXT, "all of it");

static enum kd_status unreadable(unsigned scene, struct kd_error *error)
{
    return kd_error_set(error, KD_EIO, "the file of scene %u cannot be read, or differs in its form from the others",
                        scene);
}

static enum kd_status no_memory(struct kd_error *error)
{
    return kd_error_set(error, KD_ENOMEM, "out of memory for a cube");
}

enum kd_status kd_cube_check(const struct kd_sweep *sweep, struct kd_error *error)
{
    static const char *const shapes[] = { "image.width",       "image.height", "image.tile.width",
                                          "image.tile.height", "image.layers", "camera.stereo" };
    char pointer[100];
    for (size_t i = 0; i < sweep->n_axes; i++)
        for (size_t k = 0; k < sizeof shapes / sizeof *shapes; k++)
            if (kd_scene_same_path(sweep->axes[i].path, shapes[k])) {
                snprintf(pointer, sizeof pointer, "/axes/%s", shapes[k]);
                return kd_error_field(error, pointer,
                                      "%s cannot be an axis of a cube, because a cube has one size and one set of "
                                      "layers: use separate files, with output \"pictures\" or \"fits\"",
                                      shapes[k]);
            }
    return KD_OK;
}

enum kd_status kd_cube_compare(struct kd_cube_shape *shape, unsigned number, const struct kd_scene *scene,
                               const struct kd_plan_picture *picture, struct kd_error *error)
{
    const struct kd_words *layers = &scene->image.layers;
    const unsigned width = kd_plan_shown_width(picture), height = kd_plan_shown_height(picture);
    if (!number)
        *shape = (struct kd_cube_shape) { width, height, *layers };
    if (shape->width != width || shape->height != height)
        return kd_error_field(
            error, "/axes",
            "scene %u has %u x %u pixels and scene 0 has %u x %u; all pictures of a cube must have one size", number,
            width, height, shape->width, shape->height);
    bool same = layers->count == shape->layers.count;
    for (int i = 0; i < layers->count && same; i++)
        same = layers->at[i].word == shape->layers.at[i].word && layers->at[i].number == shape->layers.at[i].number;
    return same ? KD_OK
                : kd_error_field(
                      error, "/axes",
                      "scene %u has other layers than scene 0; all pictures of a cube must have the same layers",
                      number);
}

size_t kd_cube_holds(const struct kd_gather_source *source)
{
    const struct kd_sweep *sweep = source->sweep;
    return sweep->scenes *
           (KD_CUBE_ROW + sizeof *(struct kd_cube) { 0 }.places * (size_t)sweep->base.image.layers.count);
}

enum kd_status kd_cube_open(const struct kd_gather_source *source, struct kd_cube *out, struct kd_error *error)
{
    *out = (struct kd_cube) { .source = source };
    return source->sweep && source->n == source->sweep->scenes
               ? KD_OK
               : kd_error_set(error, KD_EINVAL, "a cube needs the scenes of a sweep");
}

void kd_cube_finish(struct kd_cube *cube)
{
    struct kd_cube_texts *const texts[] = { &cube->sentences, &cube->credits, &cube->devices };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        for (size_t k = 0; k < texts[i]->n; k++)
            free(texts[i]->at[k]);
    free(cube->rows);
    free(cube->places);
    free(cube->piece);
    *cube = (struct kd_cube) { 0 };
}

/* Reads the header of the HDU at an offset of a scene's file. */
static enum kd_status read_head(struct kd_cube *cube, unsigned scene, uint64_t at, struct kd_buffer *head, size_t *size,
                                struct kd_error *error)
{
    const struct kd_gather_source *s = cube->source;
    uint8_t block[8 * KD_FITS_BLOCK];
    uint64_t whole;
    head->size = 0;
    *size = 0;
    if (!s->size(s->user, scene, &whole))
        return unreadable(scene, error);
    while (!(*size = kd_fits_head_size(head->data, head->size))) {
        uint64_t left = whole > at + head->size ? whole - at - head->size : 0;
        size_t n = left < sizeof block ? (size_t)left : sizeof block;
        if (!n || head->size > HEAD_MOST || !s->read(s->user, scene, at + head->size, block, n))
            return unreadable(scene, error);
        if (kd_buffer_append(head, block, n))
            return no_memory(error);
    }
    return KD_OK;
}

/* Text value of a card; "" if the card is missing. */
static void text_of(const struct kd_buffer *head, size_t size, const char *key, char *out, size_t room)
{
    struct kd_buffer text = { 0 };
    bool there = !kd_fits_find(head->data, size, key, &text) && text.size < room;
    snprintf(out, room, "%.*s", there ? (int)text.size : 0, there ? (const char *)text.data : "");
    for (size_t n = strlen(out); n && out[n - 1] == ' ';) /* trailing spaces are padding by the standard */
        out[--n] = 0;
    kd_buffer_finish(&text);
}

struct unit {
    struct kd_cube_layer layer;
    long long width, height;
};

static bool read_unit(const struct kd_buffer *head, size_t size, struct unit *out)
{
    char sum[24];
    long long axes = 0, channels = 1;
    bool good = kd_fits_number(head->data, size, "NAXIS", &axes) && (axes == 2 || axes == 3) &&
                kd_fits_number(head->data, size, "NAXIS1", &out->width) &&
                kd_fits_number(head->data, size, "NAXIS2", &out->height) &&
                (axes == 2 || kd_fits_number(head->data, size, "NAXIS3", &channels));
    text_of(head, size, "EXTNAME", out->layer.name, sizeof out->layer.name);
    text_of(head, size, "BUNIT", out->layer.unit, sizeof out->layer.unit);
    text_of(head, size, "DATASUM", sum, sizeof sum);
    out->layer.channels = (unsigned)channels;
    out->layer.sum = (uint32_t)strtoul(sum, NULL, 10);
    return good && *sum && out->width > 0 && out->width <= 1 << 20 && out->height > 0 && out->height <= 1 << 20 &&
           channels > 0 && channels <= 4;
}

/* Checks one layer of a scene. Its properties must be those of the same layer of the first scene. */
static enum kd_status enter(struct kd_cube *cube, size_t layer, const struct unit *unit, unsigned scene,
                            struct kd_error *error)
{
    if (scene == 0 && layer < KD_WORDS_MOST) {
        cube->layers[layer] = unit->layer;
        cube->n_layers = layer + 1;
        cube->width = layer ? cube->width : (unsigned)unit->width;
        cube->height = layer ? cube->height : (unsigned)unit->height;
    }
    struct kd_cube_layer *known = &cube->layers[layer];
    if (layer >= cube->n_layers || strcmp(known->name, unit->layer.name) || known->channels != unit->layer.channels ||
        cube->width != (unsigned)unit->width || cube->height != (unsigned)unit->height)
        return unreadable(scene, error);
    if (scene)
        known->sum = kd_fits_add_sums(known->sum, unit->layer.sum);
    return KD_OK;
}

/* Adds the text of a card unless the list already has that text. *there: true if the card exists. */
static enum kd_status keep_text(struct kd_cube_texts *texts, const struct kd_buffer *head, size_t size, const char *key,
                                bool *there, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_fits_find(head->data, size, key, &text);
    while (!status && text.size && text.data[text.size - 1] == ' ') /* trailing spaces are padding by the standard */
        text.size--;
    *there = !status && text.size;
    if (status == KD_ENOMEM || (*there && kd_buffer_append(&text, "", 1))) /* including the NUL */
        KD_TRY(no_memory(error));
    status = KD_OK;
    for (size_t i = 0; i < texts->n && *there; i++)
        if (!strcmp(texts->at[i], (const char *)text.data))
            goto done;
    if (*there && texts->n == KD_CUBE_TEXTS)
        KD_TRY(kd_error_set(error, KD_ETOOBIG, "the scenes have too many different texts in %.6s (limit %d)", key,
                            KD_CUBE_TEXTS));
    char *copy = *there ? strdup((const char *)text.data) : NULL;
    if (*there && !copy)
        KD_TRY(no_memory(error));
    if (*there)
        texts->at[texts->n++] = copy;
done:
    kd_buffer_finish(&text);
    return status;
}

enum kd_status kd_cube_join(const struct kd_cube_texts *texts, struct kd_buffer *out)
{
    enum kd_status status = kd_buffer_append(out, "", 0);
    for (size_t i = 0; i < texts->n && !status; i++)
        status = kd_buffer_printf(out, "%s%s", i ? "; " : "", texts->at[i]);
    return status;
}

static bool same_axes(const struct kd_wcs_axis a[2], const struct kd_wcs_axis b[2])
{
    bool same = true;
    for (int i = 0; i < 2; i++)
        same = same && a[i].type == b[i].type && a[i].pixel == b[i].pixel && a[i].value == b[i].value &&
               a[i].step == b[i].step;
    return same;
}

static bool same_world(const struct kd_wcs *a, const struct kd_wcs *b)
{
    return a->known == b->known && a->far == b->far && same_axes(a->at, b->at) &&
           (!a->far || same_axes(a->impact, b->impact)) && !memcmp(a->turn, b->turn, sizeof a->turn);
}

static enum kd_status compare_worlds(struct kd_cube *cube, unsigned number, struct kd_error *error)
{
    struct kd_scene scene;
    enum kd_status status = kd_sweep_scene(cube->source->sweep, number, &scene, error);
    const struct kd_wcs wcs = status ? cube->wcs : kd_wcs_of(&scene);
    if (!number)
        cube->wcs = wcs;
    cube->wcs_differ = cube->wcs_differ || !same_world(&wcs, &cube->wcs);
    return status;
}

static enum kd_status look_at_notes(struct kd_cube *cube, unsigned scene, const struct kd_buffer *head, size_t size,
                                    struct kd_error *error)
{
    char key[16], hash[KD_CUBE_HASH + 1], accuracy[KD_CUBE_ACCURACY + 1],
        *row = cube->rows + (size_t)scene * KD_CUBE_ROW;
    bool there = true;
    enum kd_status status;
    KD_TRY(compare_worlds(cube, scene, error));
    KD_TRY(keep_text(&cube->devices, head, size, "KDDEVICE", &there, error));
    KD_TRY(keep_text(&cube->credits, head, size, "KDCREDIT", &there, error));
    there = true;
    for (unsigned i = 1; there; i++) {
        snprintf(key, sizeof key, "KDAPPR%u", i);
        KD_TRY(keep_text(&cube->sentences, head, size, key, &there, error));
    }
    const double flux = kd_fits_find_real(head->data, size, KD_FITS_FLUX);
    text_of(head, size, "KDHASH", hash, sizeof hash);
    text_of(head, size, "KDACCUR", accuracy, sizeof accuracy);
    memcpy(row, hash, strlen(hash)); /* the rest of the row is NULs */
    memcpy(row + KD_CUBE_HASH, accuracy, strlen(accuracy));
    kd_cube_put_double((uint8_t *)row + KD_CUBE_TEXT, flux);
    cube->flux = cube->flux || !isnan(flux);
    cube->texts_sum = kd_fits_sum(cube->texts_sum, row, KD_CUBE_TEXT);
    cube->fluxes_sum = kd_fits_sum(cube->fluxes_sum, row + KD_CUBE_TEXT, KD_CUBE_FLUX);
done:
    return status;
}

static enum kd_status look_at(struct kd_cube *cube, unsigned scene, struct kd_error *error)
{
    const struct kd_gather_source *s = cube->source;
    uint64_t places[KD_WORDS_MOST], whole = 0, at = 0;
    struct kd_buffer head = { 0 };
    size_t layer = 0, size;
    enum kd_status status = s->size(s->user, scene, &whole) ? KD_OK : unreadable(scene, error);
    if (!cube->rows && !(cube->rows = calloc(s->n, KD_CUBE_ROW)))
        KD_TRY(no_memory(error));
    for (; !status && at < whole; layer++) {
        struct unit unit;
        KD_TRY(read_head(cube, scene, at, &head, &size, error));
        if (layer == KD_WORDS_MOST || !read_unit(&head, size, &unit))
            KD_TRY(unreadable(scene, error));
        KD_TRY(enter(cube, layer, &unit, scene, error));
        if (!layer)
            KD_TRY(look_at_notes(cube, scene, &head, size, error));
        places[layer] = at + size;
        at += size + kd_cube_slice(cube, layer);
        at += kd_fits_padding(kd_cube_slice(cube, layer));
    }
    if (!status && layer != cube->n_layers)
        KD_TRY(unreadable(scene, error));
    if (!status && !scene)
        cube->places = calloc((size_t)s->n * cube->n_layers, sizeof *cube->places);
    if (!status && !cube->places)
        KD_TRY(no_memory(error));
    if (!status)
        memcpy(cube->places + scene * cube->n_layers, places, cube->n_layers * sizeof *places);
done:
    kd_buffer_finish(&head);
    return status;
}

enum kd_status kd_cube_look(struct kd_cube *cube, bool *over, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (unsigned i = 0; i < AT_ONCE && cube->seen < cube->source->n && !status; i++)
        status = look_at(cube, cube->seen++, error);
    *over = cube->seen == cube->source->n;
    if (status || !*over || cube->piece)
        return status;
    size_t row = 4ull * 4 * cube->width;
    cube->piece_bytes = row > KD_GATHER_PIECE ? row : KD_GATHER_PIECE;
    cube->piece = malloc(cube->piece_bytes);
    return cube->piece ? KD_OK : no_memory(error);
}

enum kd_status kd_cube_read(struct kd_cube *cube, unsigned scene, size_t layer, uint64_t at, void *to, size_t size,
                            struct kd_error *error)
{
    const struct kd_gather_source *s = cube->source;
    return s->read(s->user, scene, cube->places[scene * cube->n_layers + layer] + at, to, size)
               ? KD_OK
               : unreadable(scene, error);
}

void kd_cube_put_double(uint8_t to[8], double value)
{
    uint64_t bits;
    memcpy(&bits, &value, 8);
    for (int i = 0; i < 8; i++)
        to[i] = (uint8_t)(bits >> (56 - 8 * i));
}

double kd_cube_get_double(const uint8_t from[8])
{
    uint64_t bits = 0;
    double value;
    for (int i = 0; i < 8; i++)
        bits = bits << 8 | from[i];
    memcpy(&value, &bits, 8);
    return value;
}

size_t kd_cube_longest(const struct kd_sweep_axis *axis)
{
    size_t longest = 1;
    for (size_t i = 0; i < axis->n; i++)
        longest = strlen(axis->values[i].text) > longest ? strlen(axis->values[i].text) : longest;
    return longest;
}

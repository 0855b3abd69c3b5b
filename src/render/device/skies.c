#include "render/device/skies.h"

#include "render/device/device_internal.h"
#include "faces.h"
#include "render/emit/emission.h"
#include "render/device/panoramas.h"
#include "render/sky/star.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Uploads the bytes to a buffer, which is made again if it is too small or much too large. */
static enum kd_status upload(struct kd_renderer *r, struct kd_vk_buffer **to, const void *data, size_t bytes,
                             const char *name, struct kd_error *error)
{
    struct kd_vk_buffer *staging = NULL;
    enum kd_status status;
    KD_TRY(kd_store_at_least(r->vk, to, bytes, KD_VK_DEVICE, name, error));
    KD_TRY(kd_vk_buffer_create(r->vk, bytes, KD_VK_UPLOAD, name, &staging, error));
    memcpy(kd_vk_buffer_map(staging), data, bytes);
    KD_TRY(kd_vk_copy(r->vk, "upload", *to, 0, staging, 0, bytes, error));
done:
    kd_vk_buffer_destroy(r->vk, staging);
    return status;
}

/* Cell of a star on a face of side x side cells; -1: the star lies beyond the face's edge. */
static int64_t cell_on(const struct kd_star *s, int face, int side)
{
    const float n[] = { s->x, s->y, s->z, s->x, s->y }, *axis = &n[face / 2], along = face % 2 ? -*axis : *axis;
    const float p = axis[1] / along, q = axis[2] / along, unit = (float)(side / (2 * KD_FACE_EDGE));
    if (!(along > 0) || !(fabsf(p) < (float)KD_FACE_EDGE) || !(fabsf(q) < (float)KD_FACE_EDGE))
        return -1;
    int x = (int)((p + (float)KD_FACE_EDGE) * unit), y = (int)((q + (float)KD_FACE_EDGE) * unit);
    x = x < side ? x : side - 1;
    y = y < side ? y : side - 1;
    return ((int64_t)face * side + y) * side + x;
}

/* Computes where each cell begins in the list of entries, whose first index is `from`. The start of cell c is stored in
 * cells[c + 1], because `sort` advances it to the end of the cell. The last number is the end of the last cell. */
static void count(const struct kd_stars *stars, int side, uint32_t from, uint32_t *cells)
{
    const size_t n = (size_t)KD_FACE_TABLE(side) - 2;
    memset(cells, 0, (n + 2) * sizeof *cells);
    cells[0] = cells[1] = from;
    for (size_t i = 0; i < stars->n; i++)
        for (int face = 0; face < KD_FACES; face++) {
            int64_t cell = cell_on(&stars->at[i], face, side);
            if (cell >= 0)
                cells[cell + 2]++;
        }
    for (size_t i = 2; i < n + 2; i++)
        cells[i] += cells[i - 1];
}

/* Sorts stars into cells. Within a cell the stars keep their order, so that the brightest is first. During the sort,
 * cells[c + 1] advances from the start of cell c to its end, which is the start of the next cell. all: number of
 * entries; the temperatures are stored after all entries. */
static void sort(const struct kd_stars *stars, int side, uint32_t *cells, size_t all, float *rows)
{
    for (size_t i = 0; i < stars->n; i++)
        for (int face = 0; face < KD_FACES; face++) {
            const struct kd_star *s = &stars->at[i];
            const float row[] = { s->x, s->y, s->z, s->flux };
            int64_t cell = cell_on(s, face, side);
            if (cell < 0)
                continue;
            const size_t k = cells[cell + 1]++;
            memcpy(rows + 4 * k, row, sizeof row);
            rows[4 * all + k] = s->kelvin;
        }
}

/* Uploads the stars. The table of coarse cells follows the table of fine cells, and the places of stars in coarse cells
 * follow those in fine cells. */
static enum kd_status send_stars(struct kd_renderer *r, struct kd_sky_buffers *b, const struct kd_scene *scene,
                                 struct kd_error *error)
{
    const size_t words = KD_FACE_TABLE(KD_FACE_FINE) + KD_FACE_TABLE(KD_FACE_COARSE);
    struct kd_stars stars = { 0 };
    uint32_t *cells = malloc(words * sizeof *cells), *coarse = cells ? cells + KD_FACE_TABLE(KD_FACE_FINE) : NULL;
    float *rows = NULL;
    enum kd_status status;
    KD_TRY(kd_stars_make(scene, &stars, error));
    if (!cells)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for stars"));
    count(&stars, KD_FACE_FINE, 0, cells);
    count(&stars, KD_FACE_COARSE, coarse[-1], coarse);
    b->n = cells[words - 1];
    rows = calloc(5 * (size_t)b->n + 4, sizeof *rows);
    if (!rows)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for stars"));
    sort(&stars, KD_FACE_FINE, cells, b->n, rows);
    sort(&stars, KD_FACE_COARSE, coarse, b->n, rows);
    KD_TRY(upload(r, &b->cells, cells, words * sizeof *cells, "cells of stars", error));
    KD_TRY(upload(r, &b->stars, rows, (5 * (size_t)b->n + 4) * sizeof *rows, "stars", error));
done:
    kd_stars_finish(&stars);
    free(cells);
    free(rows);
    return status;
}

static bool is_spread(const struct kd_scene *scene)
{
    return scene->sky.model != KD_SKY_GRID && scene->sky.milky_way > 0;
}

static bool is_current(const struct kd_sky_buffers *b, const struct kd_scene *scene)
{
    return b->there && b->of.model == scene->sky.model && b->of.seed == scene->sky.seed &&
           b->of.limit_mag == scene->sky.limit_mag && (b->of.milky_way > 0) == (scene->sky.milky_way > 0) &&
           !strcmp(b->of.image, scene->sky.image);
}

static enum kd_status prepare(const struct kd_emitter_buffers_work *work, const struct kd_scene *scene,
                              struct kd_error *error)
{
    struct kd_renderer *r = work->renderer;
    struct kd_sky_buffers *b = work->own;
    enum kd_status status = KD_OK;
    if (scene->sky.model == KD_SKY_GRID || is_current(b, scene))
        return KD_OK;
    b->there = false;
    if (kd_stars_most(scene))
        KD_TRY(send_stars(r, b, scene, error));
    if (is_spread(scene)) {
        const struct kd_panorama *p;
        KD_TRY(kd_panorama_of(&r->panoramas, scene, &p, error));
        KD_TRY(upload(r, &b->panorama, p->words, kd_panorama_words(p->columns, p->rows) * sizeof *p->words, "panorama",
                      error));
    }
    KD_TRY(kd_vk_submit(r->vk, NULL, error));
    b->of = scene->sky;
    b->there = true;
done:
    return status;
}

static void begin(struct kd_renderer *r, const struct kd_scene *scene) { kd_panorama_begin(&r->panoramas, scene); }

/* Sets the panorama's size, and credits the panorama's author. */
static enum kd_status tell(struct kd_renderer *r, const struct kd_scene *scene, struct kd_emission *out, char *credit,
                           size_t size, struct kd_error *error)
{
    const struct kd_panorama *p;
    if (!is_spread(scene))
        return KD_OK;
    enum kd_status status = kd_panorama_of(&r->panoramas, scene, &p, error);
    if (status)
        return status;
    out->sky.columns = p->columns;
    out->sky.rows = p->rows;
    out->sky.texel = (float)log2(M_PI / p->rows);
    if (*p->credit)
        snprintf(credit, size, "sky: %s", p->credit);
    return KD_OK;
}

static void buffers(const void *own, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    out[KD_OWN_panorama] = ((const struct kd_sky_buffers *)own)->panorama;
}

static void forget(void *own) { ((struct kd_sky_buffers *)own)->there = false; }

static void finish(void *own, struct kd_vk *vk)
{
    struct kd_sky_buffers *b = own;
    kd_vk_buffer_destroy(vk, b->panorama);
    kd_vk_buffer_destroy(vk, b->stars);
    kd_vk_buffer_destroy(vk, b->cells);
    *b = (struct kd_sky_buffers) { 0 };
}

const struct kd_emitter_buffers kd_emitter_buffers_sky = {
    sizeof(struct kd_sky_buffers), prepare, buffers, forget, finish, begin, tell
};

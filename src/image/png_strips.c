#include "image/png_strips.h"

#include "image/png_filter.h"
#include "image/strips.h"

#include <libdeflate.h>
#include <pthread.h>
#include <stdlib.h>
#include <string.h>

enum {
    STRIP = 512 << 10,
    MIB = 1 << 20,
    ROW_ROOM = 7 /* ROW_ROOM: number of rows in the working memory: two rows, and five for the filters */
};

/* Working memory of one thread. It is kept in a list while it is not used. */
struct workspace {
    struct workspace *next;
    struct kd_deflate *deflate;
    uint8_t *rows; /* filtered */
    uint8_t *room; /* ROW_ROOM rows */
    size_t rows_size, room_size;
};

struct kd_png_strips {
    enum kd_deflate_engine engine;
    pthread_mutex_t lock;
    struct workspace *idle; /* the list of unused workspaces, guarded by the lock */
};

/* State of one picture. */
struct work {
    struct kd_png_strips *strips;
    const struct kd_png_params *p;
    size_t step, stride, n; /* step: bytes per pixel; stride: bytes per row; n: number of strips */
    uint32_t rows;          /* rows in a strip; the last strip may have fewer */
    uint32_t *sums;         /* checksum of each strip */
    uint32_t sum;           /* checksum of all strips that are joined so far */
    struct kd_buffer *out;
};

static void big_endian(uint8_t to[4], uint32_t value)
{
    for (int i = 0; i < 4; i++)
        to[i] = (uint8_t)(value >> (24 - 8 * i));
}

/* Writes a chunk whose data consist of up to three parts. */
static enum kd_status put_chunk(struct kd_buffer *out, const char type[5], const void *const parts[3],
                                const size_t sizes[3])
{
    uint8_t head[8], tail[4];
    const size_t length = sizes[0] + sizes[1] + sizes[2], start = out->size;
    enum kd_status status;
    big_endian(head, (uint32_t)length);
    memcpy(head + 4, type, 4);
    KD_TRY(kd_buffer_append(out, head, sizeof head));
    for (int i = 0; i < 3; i++)
        KD_TRY(kd_buffer_append(out, parts[i], sizes[i]));
    big_endian(tail, libdeflate_crc32(0, out->data + start + 4, length + 4));
    KD_TRY(kd_buffer_append(out, tail, sizeof tail));
done:
    return status;
}

enum kd_status kd_png_chunk(struct kd_buffer *out, const char type[5], const void *data, size_t size)
{
    return put_chunk(out, type, (const void *const[3]) { data }, (const size_t[3]) { size });
}

static void workspace_destroy(struct workspace *workspace)
{
    kd_deflate_destroy(workspace->deflate);
    free(workspace->rows);
    free(workspace->room);
    free(workspace);
}

/* Takes an unused workspace, or makes one. Returns NULL when out of memory. */
static struct workspace *workspace_take(struct kd_png_strips *strips, int level)
{
    pthread_mutex_lock(&strips->lock);
    struct workspace *workspace = strips->idle;
    if (workspace)
        strips->idle = workspace->next;
    pthread_mutex_unlock(&strips->lock);
    if (workspace || !(workspace = calloc(1, sizeof *workspace)) ||
        !kd_deflate_create(strips->engine, level, &workspace->deflate, NULL))
        return workspace;
    workspace_destroy(workspace);
    return NULL;
}

static void workspace_put_back(struct kd_png_strips *strips, struct workspace *workspace)
{
    pthread_mutex_lock(&strips->lock);
    workspace->next = strips->idle;
    strips->idle = workspace;
    pthread_mutex_unlock(&strips->lock);
}

static bool make_room(uint8_t **memory, size_t *size, size_t wanted)
{
    if (wanted <= *size)
        return true;
    /* The buffer is freed first, because its contents are not needed and realloc would copy them. */
    free(*memory);
    *memory = malloc(wanted);
    *size = *memory ? wanted : 0;
    return *memory;
}

/* Returns a row with its 16-bit samples converted to big-endian. */
static const uint8_t *row_at(const struct work *w, uint32_t y, uint8_t *room)
{
    const uint8_t *from = (const uint8_t *)w->p->pixels + y * w->stride;
    if (w->p->bit_depth == 8)
        return from;
    for (size_t i = 0; i < w->stride / 2; i++) {
        uint16_t sample;
        memcpy(&sample, from + 2 * i, 2);
        room[2 * i] = (uint8_t)(sample >> 8);
        room[2 * i + 1] = (uint8_t)sample;
    }
    return room;
}

/* At the lowest levels, trying all filters costs more time than it is worth. Of the filters that are cheap compared
 * with deflate, Sub makes the smallest files of kerrd's pictures (docs/decisions/0004-live-png.md). */
static void filter(const struct work *w, uint32_t first, uint32_t end, struct workspace *workspace)
{
    const size_t stride = w->stride;
    uint8_t *to = workspace->rows, *room[2] = { workspace->room, workspace->room + stride };
    memset(room[1], 0, stride); /* zeros stand for the row above the first row of a picture */
    const uint8_t *above = first ? row_at(w, first - 1, room[1]) : room[1];
    for (uint32_t y = first; y < end; y++, to += stride + 1) {
        const uint8_t *row = row_at(w, y, room[(y - first) % 2]);
        if (w->p->compression > 1) {
            kd_png_filter_least(to, row, above, stride, w->step, workspace->room + 2 * stride);
        } else if (w->p->compression == 1) {
            kd_png_filter_sub(to, row, stride, w->step);
        } else {
            to[0] = 0;
            memcpy(to + 1, row, stride);
        }
        above = row;
    }
}

static enum kd_status encode(void *user, size_t strip, struct kd_buffer *out)
{
    struct work *w = user;
    const uint32_t first = (uint32_t)strip * w->rows, rest = w->p->height - first;
    const uint32_t rows = rest < w->rows ? rest : w->rows;
    const size_t size = (w->stride + 1) * rows;
    struct workspace *workspace = workspace_take(w->strips, w->p->compression);
    if (!workspace)
        return KD_ENOMEM;
    enum kd_status status = KD_ENOMEM;
    if (make_room(&workspace->rows, &workspace->rows_size, size) &&
        make_room(&workspace->room, &workspace->room_size, ROW_ROOM * w->stride)) {
        filter(w, first, first + rows, workspace);
        w->sums[strip] = kd_zlib_sum(workspace->rows, size);
        status = kd_deflate_piece(workspace->deflate, workspace->rows, size, strip + 1 == w->n, out);
    }
    workspace_put_back(w->strips, workspace);
    return status;
}

static enum kd_status join(void *user, size_t strip, const struct kd_buffer *bytes)
{
    struct work *w = user;
    const size_t first = strip * w->rows, rest = w->p->height - first, rows = rest < w->rows ? rest : w->rows;
    const bool last = strip + 1 == w->n;
    uint8_t head[2], tail[4];
    w->sum = kd_zlib_sum_join(w->sum, w->sums[strip], rows * (w->stride + 1));
    kd_zlib_head(w->p->compression, head);
    big_endian(tail, w->sum);
    return put_chunk(w->out, "IDAT", (const void *const[3]) { head, bytes->data, tail },
                     (const size_t[3]) { strip ? 0 : sizeof head, bytes->size, last ? sizeof tail : 0 });
}

enum kd_status kd_png_strips_create(enum kd_deflate_engine engine, struct kd_png_strips **out, struct kd_error *error)
{
    *out = NULL;
    if (!kd_deflate_has(engine))
        return kd_error_set(error, KD_EINVAL, "this kerrd was built without the deflate engine %s",
                            kd_deflate_name(engine));
    *out = calloc(1, sizeof **out);
    if (!*out)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a PNG encoder");
    (*out)->engine = engine;
    pthread_mutex_init(&(*out)->lock, NULL);
    return KD_OK;
}

void kd_png_strips_destroy(struct kd_png_strips *strips)
{
    if (!strips)
        return;
    for (struct workspace *next, *workspace = strips->idle; workspace; workspace = next) {
        next = workspace->next;
        workspace_destroy(workspace);
    }
    pthread_mutex_destroy(&strips->lock);
    free(strips);
}

/* A picture smaller than this is not divided, because one core encodes it in some ten milliseconds, and libdeflate
 * takes a quarter longer for a piece than for a whole stream (deflate_walk.h). */
static size_t least_in_strips(enum kd_deflate_engine engine) { return engine == KD_DEFLATE_ISAL ? MIB : 4 * MIB; }

enum kd_status kd_png_strips_append(struct kd_png_strips *strips, const struct kd_png_params *params,
                                    struct kd_buffer *out, struct kd_error *error)
{
    struct work w = {
        .strips = strips, .p = params, .sum = 1, .out = out, .step = 3 * ((size_t)params->bit_depth / 8)
    };
    const size_t start = out->size;
    w.stride = params->width * w.step;
    const size_t size = (w.stride + 1) * params->height,
                 most = size >= least_in_strips(strips->engine) ? size / STRIP : 1;
    w.rows = (uint32_t)((params->height + most - 1) / most);
    w.n = (params->height + w.rows - 1) / w.rows;
    w.sums = malloc(w.n * sizeof *w.sums);
    const enum kd_status status = w.sums ? kd_strips_encode(&(struct kd_strips) { w.n, encode, join, &w }) : KD_ENOMEM;
    free(w.sums);
    if (status) {
        out->size = start;
        kd_error_set(error, status, "%s for a PNG of %u x %u pixels",
                     status == KD_ENOMEM ? "out of memory" : "a damaged deflate stream", params->width, params->height);
    }
    return status;
}

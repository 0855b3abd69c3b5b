#include "render/frame/choose.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CHANNELS = 3, WHITE = 65535, BINS = 1024 };

void kd_choice_finish(struct kd_choice *choice)
{
    kd_critical_pixels_finish(&choice->list);
    free(choice->scores);
    *choice = (struct kd_choice) { 0 };
}

enum kd_status kd_choice_add(struct kd_choice *c, struct kd_pixel pixel, uint32_t score, struct kd_error *error)
{
    if (c->list.n == c->room) {
        const size_t room = c->room ? 2 * c->room : 4096;
        struct kd_pixel *pixels = realloc(c->list.pixels, room * sizeof *pixels);
        c->list.pixels = pixels ? pixels : c->list.pixels;
        uint32_t *scores = pixels ? realloc(c->scores, room * sizeof *scores) : NULL;
        if (!scores)
            return kd_error_set(error, KD_ENOMEM, "out of memory for the pixels that need more rays");
        c->scores = scores;
        c->room = room;
    }
    c->list.pixels[c->list.n] = pixel;
    c->scores[c->list.n++] = score;
    return KD_OK;
}

/* The largest second difference through a pixel. above, below: the adjacent rows. Pixels beyond the edge count as
 * dark. */
static int bend(const uint16_t *above, const uint16_t *row, const uint16_t *below, uint32_t x, uint32_t width)
{
    const int left = x > 0 ? -CHANNELS : 0, right = x + 1 < width ? CHANNELS : 0;
    int most = 0;
    for (size_t c = CHANNELS * (size_t)x; c < CHANNELS * (size_t)x + CHANNELS; c++) {
#define AT(line, side) ((side) ? (line)[(ptrdiff_t)c + (side)] : 0)
        const int twice = 2 * row[c];
        const int ends[] = { AT(row, left) + AT(row, right), above[c] + below[c], AT(above, left) + AT(below, right),
                             AT(above, right) + AT(below, left) };
        for (int k = 0; k < 4; k++)
            most = abs(ends[k] - twice) > most ? abs(ends[k] - twice) : most;
    }
    return most;
}

/* Collects pixels with a second difference of at least `floor`. *sum: sum of the squared second differences of all
 * pixels that may be chosen. */
static enum kd_status bends(const struct kd_shown *now, int floor, struct kd_choice *out, double *sum,
                            struct kd_error *error)
{
    const size_t row = CHANNELS * (size_t)now->width;
    uint16_t *dark = calloc(row, sizeof *dark);
    enum kd_status status = dark ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for a row of pixels");
    for (uint32_t y = 0; y < now->height && !status; y++) {
        const uint16_t *own = now->pixels + y * row, *above = y ? own - row : dark,
                       *below = y + 1 < now->height ? own + row : dark;
        for (uint32_t x = 0; x < now->width && !status; x++) {
            if (now->kinds[y * (size_t)now->width + x] >= now->done)
                continue;
            const int b = bend(above, own, below, x, now->width);
            *sum += (double)b * b;
            if (b >= floor)
                status = kd_choice_add(out, (struct kd_pixel) { x, y }, (uint32_t)b, error);
        }
    }
    free(dark);
    return status;
}

/* The threshold of second differences. It is at most `least`. It is low enough that the pixels below it have at most
 * KD_CHOOSE_LEFT of the sum of squares. */
static double threshold(const struct kd_choice *c, double floor, double least, double sum)
{
    double squares[BINS] = { 0 }, left = sum;
    for (size_t i = 0; i < c->list.n; i++) {
        const double b = c->scores[i];
        left -= b * b;
        if (b < least)
            squares[(int)((b - floor) / (least - floor) * BINS)] += b * b;
    }
    int bin = 0;
    while (bin < BINS && left + squares[bin] <= KD_CHOOSE_LEFT * sum)
        left += squares[bin++];
    return floor + (least - floor) * bin / BINS;
}

enum kd_status kd_choose_bent(const struct kd_shown *now, double pixel_error, struct kd_choice *out,
                              struct kd_error *error)
{
    const double least = fmax(ceil(2 * pixel_error * WHITE), 1), floor = fmax(ceil(least * KD_CHOOSE_FLOOR), 1);
    double sum = 0;
    size_t n = 0;
    *out = (struct kd_choice) { 0 };
    enum kd_status status = bends(now, (int)floor, out, &sum, error);
    if (status) {
        kd_choice_finish(out);
        return status;
    }
    const double from = threshold(out, floor, least, sum);
    for (size_t i = 0; i < out->list.n; i++) {
        if (out->scores[i] < from)
            continue;
        out->list.pixels[n] = out->list.pixels[i];
        out->scores[n++] = out->scores[i];
    }
    out->list.n = n;
    return KD_OK;
}

static uint32_t changed(const uint16_t *a, const uint16_t *b, size_t pixel)
{
    int most = 0;
    for (size_t c = CHANNELS * pixel; c < CHANNELS * (pixel + 1); c++)
        most = abs(a[c] - b[c]) > most ? abs(a[c] - b[c]) : most;
    return (uint32_t)most;
}

/* Raises the marks of a pixel's neighbours to the amount by which the pixel has changed. */
static void mark_round(const struct kd_shown *now, struct kd_pixel p, uint32_t score, uint16_t *marks)
{
    for (uint32_t y = p.y ? p.y - 1 : 0; y <= p.y + 1 && y < now->height; y++)
        for (uint32_t x = p.x ? p.x - 1 : 0; x <= p.x + 1 && x < now->width; x++) {
            const size_t at = y * (size_t)now->width + x;
            if (now->kinds[at] < now->done && marks[at] < score)
                marks[at] = (uint16_t)score;
        }
}

enum kd_status kd_choose_beside(const struct kd_shown *now, const uint16_t *before,
                                const struct kd_critical_pixels *lists, size_t n, double pixel_error,
                                struct kd_choice *out, struct kd_error *error)
{
    const uint32_t least = (uint32_t)fmax(ceil(pixel_error * WHITE), 1);
    uint16_t *marks = calloc((size_t)now->width * now->height, sizeof *marks);
    enum kd_status status =
        marks ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for the pixels that need more rays");
    *out = (struct kd_choice) { 0 };
    for (const struct kd_critical_pixels *list = lists; list < lists + n && !status; list++)
        for (size_t i = 0; i < list->n; i++) {
            const struct kd_pixel p = list->pixels[i];
            const uint32_t score = changed(now->pixels, before, p.y * (size_t)now->width + p.x);
            if (score >= least)
                mark_round(now, p, score, marks);
        }
    for (size_t at = 0; !status && at < (size_t)now->width * now->height; at++)
        if (marks[at])
            status = kd_choice_add(out, (struct kd_pixel) { (uint32_t)(at % now->width), (uint32_t)(at / now->width) },
                                   marks[at], error);
    free(marks);
    if (status)
        kd_choice_finish(out);
    return status;
}

static uint32_t bin_of(uint32_t score) { return score / (2 * WHITE / (BINS - 1)); }

void kd_choose_largest(struct kd_choice *choice, uint64_t most)
{
    uint64_t counts[BINS] = { 0 }, sum = 0;
    if (choice->list.n <= most)
        return;
    for (size_t i = 0; i < choice->list.n; i++)
        counts[bin_of(choice->scores[i])]++;
    uint32_t bin = BINS;
    while (bin > 0 && sum + counts[bin - 1] <= most)
        sum += counts[--bin];
    uint64_t of_next = most - sum; /* number of pixels to take from the next lower bin, starting at the top of the
                                    * picture */
    size_t n = 0;
    for (size_t i = 0; i < choice->list.n; i++) {
        const uint32_t b = bin_of(choice->scores[i]);
        if (b + 1 < bin || (b + 1 == bin && !of_next))
            continue;
        of_next -= b + 1 == bin;
        choice->list.pixels[n] = choice->list.pixels[i];
        choice->scores[n++] = choice->scores[i];
    }
    choice->list.n = n;
}

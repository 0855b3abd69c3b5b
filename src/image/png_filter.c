#include "image/png_filter.h"

#include <stdlib.h>
#include <string.h>

enum { NONE, SUB, UP, AVERAGE, PAETH, FILTERS };

void kd_png_filter_sub(uint8_t *restrict to, const uint8_t *restrict row, size_t stride, size_t step)
{
    to[0] = SUB;
    memcpy(to + 1, row, step);
    for (size_t i = step; i < stride; i++)
        to[1 + i] = (uint8_t)(row[i] - row[i - step]);
}

/* Returns the one of left, above and corner that is closest to left + above - corner. */
static int paeth(int left, int above, int corner)
{
    const int l = abs(above - corner), a = abs(left - corner), c = abs(left + above - 2 * corner);
    return l <= a && l <= c ? left : a <= c ? above : corner;
}

/* Computes the results of all filters for the bytes from `first` to `end`. left: 1 if the pixels of these bytes have
 * a left neighbour; otherwise the neighbour counts as 0. */
static void all_of(const uint8_t *row, const uint8_t *above, size_t first, size_t end, size_t step, int left,
                   uint8_t *restrict room[FILTERS])
{
    for (size_t i = first; i < end; i++) {
        const int x = row[i], a = left ? row[i - step] : 0, b = above[i], c = left ? above[i - step] : 0;
        room[SUB][i] = (uint8_t)(x - a);
        room[UP][i] = (uint8_t)(x - b);
        room[AVERAGE][i] = (uint8_t)(x - (a + b) / 2);
        room[PAETH][i] = (uint8_t)(x - paeth(a, b, c));
    }
}

static uint64_t size_of(const uint8_t *bytes, size_t n)
{
    uint64_t sum = 0;
    for (size_t i = 0; i < n; i++)
        sum += (uint64_t)abs((int8_t)bytes[i]);
    return sum;
}

void kd_png_filter_least(uint8_t *restrict to, const uint8_t *row, const uint8_t *above, size_t stride, size_t step,
                         uint8_t *restrict room)
{
    uint8_t *filtered[FILTERS] = { room, room + stride, room + 2 * stride, room + 3 * stride, room + 4 * stride };
    memcpy(filtered[NONE], row, stride);
    all_of(row, above, 0, step, step, 0, filtered);
    all_of(row, above, step, stride, step, 1, filtered);
    uint64_t least = size_of(filtered[NONE], stride);
    int best = NONE;
    for (int f = SUB; f < FILTERS; f++) {
        const uint64_t size = size_of(filtered[f], stride);
        if (size < least) {
            least = size;
            best = f;
        }
    }
    to[0] = (uint8_t)best;
    memcpy(to + 1, filtered[best], stride);
}

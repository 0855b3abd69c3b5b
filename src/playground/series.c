#include "playground/series.h"

#include "image/npy.h"
#include "document/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NAME(name, ...) #name,
static const char *const names[KD_SERIES_N] = { KD_SERIES_COLUMNS(NAME) };

const char *kd_series_column(int i) { return names[i]; }

void kd_series_begin(struct kd_playground_series *series, const double now[KD_SERIES_N], double span, double interval)
{
    series->begin = now[KD_SERIES_t];
    series->span = span;
    series->interval = span > 0 ? span / (KD_SERIES_ROWS - 1) : interval;
    memcpy(series->rows[0], now, sizeof series->rows[0]);
    series->n = 1;
}

/* Time of the next row. An open-ended series does not use its last row, so that a file has room for the present row. */
double kd_series_next(const struct kd_playground_series *series)
{
    if (series->span > 0 && series->n == KD_SERIES_ROWS)
        return INFINITY;
    if (series->span > 0 && series->n == KD_SERIES_ROWS - 1)
        return series->begin + series->span;
    return series->begin + (double)series->n * series->interval;
}

static void thin(struct kd_playground_series *series)
{
    series->n = (series->n + 1) / 2;
    for (size_t i = 1; i < series->n; i++)
        memcpy(series->rows[i], series->rows[2 * i], sizeof series->rows[i]);
    series->interval *= 2;
}

/* Interpolates linearly between two rows. Counts are those of the first row. If the number of bodies differs, all
 * values are those of the first row. */
static void between(const double before[KD_SERIES_N], const double now[KD_SERIES_N], double t, double row[KD_SERIES_N])
{
    const double share = (t - before[KD_SERIES_t]) / (now[KD_SERIES_t] - before[KD_SERIES_t]);
    const bool same = before[KD_SERIES_bodies] == now[KD_SERIES_bodies];
    for (int i = 0; i < KD_SERIES_N; i++)
        row[i] = before[i] + (same && i != KD_SERIES_debris ? share * (now[i] - before[i]) : 0);
    row[KD_SERIES_t] = t;
}

void kd_series_add(struct kd_playground_series *series, const double before[KD_SERIES_N], const double now[KD_SERIES_N])
{
    double t;
    while ((t = kd_series_next(series)) <= now[KD_SERIES_t]) {
        if (series->n == KD_SERIES_ROWS - 1 && !(series->span > 0)) {
            thin(series);
            continue;
        }
        if (t < now[KD_SERIES_t])
            between(before, now, t, series->rows[series->n]);
        else
            memcpy(series->rows[series->n], now, sizeof series->rows[0]);
        series->n++;
    }
}

bool kd_series_lacks(const struct kd_playground_series *series, const double now[KD_SERIES_N])
{
    return !series->n || (series->n < KD_SERIES_ROWS && now[KD_SERIES_t] > series->rows[series->n - 1][KD_SERIES_t]);
}

static enum kd_status add_line(const double row[KD_SERIES_N], struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < KD_SERIES_N; i++) {
        char number[KD_NUMBER_SIZE] = "";
        if (isfinite(row[i]))
            kd_number_format(number, row[i]);
        KD_TRY(kd_buffer_printf(out, "%s%s", number, i + 1 < KD_SERIES_N ? "," : "\n"));
    }
done:
    return status;
}

enum kd_status kd_series_csv(const struct kd_playground_series *series, const double now[KD_SERIES_N],
                             struct kd_buffer *out)
{
    enum kd_status status;
    for (int i = 0; i < KD_SERIES_N; i++)
        KD_TRY(kd_buffer_printf(out, "%s%s", names[i], i + 1 < KD_SERIES_N ? "," : "\n"));
    for (size_t k = 0; k < series->n; k++)
        KD_TRY(add_line(series->rows[k], out));
    if (kd_series_lacks(series, now))
        KD_TRY(add_line(now, out));
done:
    return status;
}

enum kd_status kd_series_npy(const struct kd_playground_series *series, const double now[KD_SERIES_N],
                             struct kd_buffer *out)
{
    const size_t more = kd_series_lacks(series, now);
    struct kd_npy array = { .n_fields = KD_SERIES_N, .shape = { series->n + more }, .n_dimensions = 1 };
    enum kd_status status;
    for (int i = 0; i < KD_SERIES_N; i++) {
        snprintf(array.fields[i].name, sizeof array.fields[i].name, "%s", names[i]);
        array.fields[i].type = KD_NPY_F8;
    }
    KD_TRY(kd_npy_write_header(&array, out));
    KD_TRY(kd_buffer_append(out, series->rows, series->n * sizeof series->rows[0]));
    KD_TRY(kd_buffer_append(out, now, more * sizeof series->rows[0]));
done:
    return status;
}

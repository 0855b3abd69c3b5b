#include "playground/series.h"

#include "image/npy.h"
#include "scene/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define NAME(name, ...) #name,
static const char *const names[KD_SERIES_N] = { KD_SERIES_COLUMNS(NAME) };

const char *kd_series_column(int i) { return names[i]; }

void kd_series_add(struct kd_playground_series *series, const double row[KD_SERIES_N])
{
    if (series->n == KD_SERIES_ROWS) {
        for (size_t i = 0; i < KD_SERIES_ROWS / 2; i++)
            memcpy(series->rows[i], series->rows[2 * i], sizeof series->rows[i]);
        series->n = KD_SERIES_ROWS / 2;
        series->interval *= 2;
    }
    memcpy(series->rows[series->n++], row, sizeof series->rows[0]);
    series->next = row[KD_SERIES_t] + series->interval;
}

enum kd_status kd_series_csv(const struct kd_playground_series *series, struct kd_buffer *out)
{
    enum kd_status status;
    for (int i = 0; i < KD_SERIES_N; i++)
        KD_TRY(kd_buffer_printf(out, "%s%s", names[i], i + 1 < KD_SERIES_N ? "," : "\n"));
    for (size_t k = 0; k < series->n; k++)
        for (int i = 0; i < KD_SERIES_N; i++) {
            char number[KD_NUMBER_SIZE] = "";
            if (isfinite(series->rows[k][i]))
                kd_number_format(number, series->rows[k][i]);
            KD_TRY(kd_buffer_printf(out, "%s%s", number, i + 1 < KD_SERIES_N ? "," : "\n"));
        }
done:
    return status;
}

enum kd_status kd_series_npy(const struct kd_playground_series *series, struct kd_buffer *out)
{
    struct kd_npy array = { .n_fields = KD_SERIES_N, .shape = { series->n }, .n_dimensions = 1 };
    enum kd_status status;
    for (int i = 0; i < KD_SERIES_N; i++) {
        snprintf(array.fields[i].name, sizeof array.fields[i].name, "%s", names[i]);
        array.fields[i].type = KD_NPY_F8;
    }
    KD_TRY(kd_npy_write_header(&array, out));
    KD_TRY(kd_buffer_append(out, series->rows, series->n * sizeof series->rows[0]));
done:
    return status;
}

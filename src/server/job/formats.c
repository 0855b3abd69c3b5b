#include "server/job/formats.h"

#include <string.h>

const struct kd_job_format kd_job_as_stream = { "stream", KD_FRAMES_TYPE };

/* Gets entry i of the list of formats of one series. If the frames of the series are rows, its formats are those of
 * tables. Otherwise they are the archives, followed by the formats of single frames and the stream. */
static bool of_series(const struct kd_series *series, size_t i, struct kd_job_format *out)
{
    size_t wholes = 0;
    while (!series->row_bytes && series->wholes[wholes])
        wholes++;
    const struct kd_job_format others[] = { { series->frame->name, series->frame->media_type }, kd_job_as_stream };
    size_t n = series->row_bytes ? series->n_tables : wholes + sizeof others / sizeof *others;
    if (i >= n)
        return false;
    if (series->row_bytes)
        *out = (struct kd_job_format) { series->tables[i].name, series->tables[i].media_type };
    else
        *out = i < wholes ? (struct kd_job_format) { series->wholes[i]->name, series->wholes[i]->media_type }
                          : others[i - wholes];
    return true;
}

/* True if a format with this name exists before entry i of series k. */
static bool again(size_t k, size_t i, const char *name)
{
    struct kd_job_format other;
    for (size_t before = 0; before <= k; before++)
        for (size_t j = 0; (before < k || j < i) && of_series(kd_series_all[before], j, &other); j++)
            if (!strcmp(other.name, name))
                return true;
    return false;
}

bool kd_job_format(size_t number, struct kd_job_format *out)
{
    for (size_t k = 0; k < kd_n_series; k++)
        for (size_t i = 0; of_series(kd_series_all[k], i, out); i++)
            if (!again(k, i, out->name) && !number--)
                return true;
    return false;
}

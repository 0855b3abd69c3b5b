#include "render/output/series.h"

#include "render/output/curve.h"

#include <string.h>

static const struct kd_gather_format *const films[] = { &kd_gather_zip, &kd_gather_mp4, &kd_gather_webm, NULL },
                                            *const files[] = { &kd_gather_zip, NULL },
                                            *const cubes[] = { &kd_gather_fits, &kd_gather_npz, &kd_gather_zip, NULL };

static const struct kd_series pictures = {
    .name = "pictures", .noun = "picture", .each = "pictures", .frame = &kd_format_png, .wholes = films
};
static const struct kd_series layers = {
    .name = "layers", .noun = "array", .each = "arrays of numbers", .frame = &kd_format_npy, .wholes = files
};
static const struct kd_series npy = {
    .name = "npy", .noun = "array", .each = "arrays of numbers", .frame = &kd_format_npy, .wholes = files
}; /* the same series as "layers", under its older name */
static const struct kd_series npz = {
    .name = "npz", .noun = "NPZ file", .each = "NPZ files", .frame = &kd_format_npz, .wholes = files
};
static const struct kd_series fits = {
    .name = "fits", .noun = "FITS file", .each = "FITS files", .frame = &kd_format_fits, .wholes = files
};
static const struct kd_series exr = {
    .name = "exr", .noun = "EXR file", .each = "EXR files", .frame = &kd_format_exr, .wholes = files
};
static const struct kd_series cube = {
    .name = "cube",
    .noun = "cube",
    .each = "FITS files of a cube",
    .frame = &kd_format_cubed,
    .wholes = cubes,
    .swept = true,
};

const struct kd_series *const kd_series_all[] = { &pictures, &layers, &npy, &npz, &fits, &exr, &cube, &kd_light_curve };
const size_t kd_n_series = sizeof kd_series_all / sizeof *kd_series_all;

const struct kd_series *kd_series_named(const char *name)
{
    for (size_t i = 0; i < kd_n_series; i++)
        if (!strcmp(kd_series_all[i]->name, name))
            return kd_series_all[i];
    return NULL;
}

const struct kd_table_format *kd_series_table(const struct kd_series *series, const char *name)
{
    for (size_t i = 0; i < series->n_tables; i++)
        if (!strcmp(series->tables[i].name, name))
            return &series->tables[i];
    return NULL;
}

#include "render/output/cube_axes.h"

#include "image/fits.h"
#include "render/output/cube.h"
#include "render/output/fits_cards.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FREQUENCY "volume.frequency_ghz"
#define DISK_FREQUENCY "disk.frequency_ghz"
#define SECOND "F" /* letter of the alternate description */
#define TABLE "FREQ"
#define COLUMN "hz"

static bool is_frequency(const struct kd_sweep_axis *axis)
{
    return axis->numeric &&
           (kd_scene_same_path(axis->path, FREQUENCY) || kd_scene_same_path(axis->path, DISK_FREQUENCY));
}

bool kd_cube_has_frequencies(const struct kd_sweep_axis *axis) { return is_frequency(axis) && !axis->even; }

/* Value of an axis in world coordinates. Frequencies become Hz, because the unit of their field is GHz. */
static double world_of(const struct kd_sweep_axis *axis, size_t i)
{
    return axis->values[i].number * (is_frequency(axis) ? 1e9 : 1);
}

/* The unit as the standard spells it (section 4.3). The standard has no unit for M = G m/c^2, and none for stops. */
static const char *unit_of(const struct kd_sweep_axis *axis)
{
    return !strcmp(axis->unit, "degrees")        ? "deg"
           : !strcmp(axis->unit, "solar masses") ? "solMass"
           : strcmp(axis->unit, "1")             ? axis->unit
                                                 : "";
}

enum kd_status kd_cube_put_line(struct kd_buffer *cards, unsigned number, const char *alternate, double first,
                                double step)
{
    const struct {
        const char *key;
        double value;
    } lines[] = { { "CRPIX", 1 }, { "CRVAL", first }, { "CDELT", step } };
    char key[16];
    enum kd_status status;
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        snprintf(key, sizeof key, "%s%u%s", lines[i].key, number, alternate);
        KD_TRY(kd_fits_real(cards, key, lines[i].value, NULL));
    }
    return KD_OK;
done:
    return status;
}

static enum kd_status put_text(struct kd_buffer *cards, const char *name, unsigned number, const char *rest,
                               const char *value, const char *comment)
{
    char key[16];
    snprintf(key, sizeof key, "%s%u%s", name, number, rest);
    return kd_fits_text(cards, key, value, comment);
}

/* The alternate description: the sky's axes as in the primary description, and the frequencies by a table. */
static enum kd_status put_second(struct kd_buffer *cards, unsigned number, const struct kd_wcs *wcs)
{
    enum kd_status status;
    if (wcs && wcs->known)
        KD_TRY(kd_fits_put_world_axes(cards, wcs, wcs->at, SECOND));
    KD_TRY(put_text(cards, "CTYPE", number, SECOND, "FREQ-TAB", NULL));
    KD_TRY(kd_cube_put_line(cards, number, SECOND, 1, 1));
    KD_TRY(put_text(cards, "CUNIT", number, SECOND, "Hz", NULL));
    KD_TRY(put_text(cards, "PS", number, "_0" SECOND, TABLE, "table with the frequencies, in one row"));
    KD_TRY(put_text(cards, "PS", number, "_1" SECOND, COLUMN, "its column"));
    KD_TRY(kd_fits_text(cards, "WCSNAME" SECOND, "frequencies", NULL));
done:
    return status;
}

enum kd_status kd_cube_put_axis(struct kd_buffer *cards, const struct kd_sweep_axis *axis, unsigned number,
                                const struct kd_wcs *wcs)
{
    const double first = axis->even ? world_of(axis, 0) : 1;
    const double step = axis->even && axis->n > 1 ? (world_of(axis, axis->n - 1) - first) / (double)(axis->n - 1)
                        : axis->even && is_frequency(axis) ? 1e9
                                                           : 1;
    const bool hz = is_frequency(axis) && axis->even;
    enum kd_status status;
    KD_TRY(put_text(cards, "CTYPE", number, "",
                    hz           ? "FREQ"
                    : axis->even ? axis->path
                                 : "INDEX",
                    axis->even ? NULL : "of the values in the table of that name"));
    KD_TRY(put_text(cards, "CNAME", number, "", axis->path, NULL));
    KD_TRY(kd_cube_put_line(cards, number, "", first, step));
    if (hz || (axis->even && !strcmp(unit_of(axis), "deg")))
        KD_TRY(put_text(cards, "CUNIT", number, "", hz ? "Hz" : "deg", NULL));
    if (kd_cube_has_frequencies(axis))
        KD_TRY(put_second(cards, number, wcs));
done:
    return status;
}

/* Appends a table of one column. Its data are whole words, so zero padding does not change the checksum. */
static enum kd_status put_table(const char *name, const char *comment, const char *column, const char *form,
                                const char *unit, uint64_t row, uint64_t rows, const struct kd_buffer *more,
                                struct kd_buffer *data, struct kd_buffer *out)
{
    static const uint8_t zeros[KD_FITS_BLOCK];
    const struct kd_fits_shape shape = { .table = true, .columns = 1, .n_axes = 2, .axes = { row, rows } };
    struct kd_buffer cards = { 0 };
    enum kd_status status;
    KD_TRY(kd_fits_text(&cards, "EXTNAME", name, comment));
    KD_TRY(kd_fits_text(&cards, "TTYPE1", column, NULL));
    KD_TRY(kd_fits_text(&cards, "TFORM1", form, NULL));
    if (*unit)
        KD_TRY(kd_fits_text(&cards, "TUNIT1", unit, NULL));
    KD_TRY(kd_buffer_append(&cards, more->data, more->size));
    KD_TRY(kd_buffer_append(data, zeros, kd_fits_padding(data->size)));
    KD_TRY(kd_fits_head(out, &shape, &cards, kd_fits_sum(0, data->data, data->size)));
    KD_TRY(kd_buffer_append(out, data->data, data->size));
done:
    kd_buffer_finish(&cards);
    return status;
}

/* Appends the values of an axis as rows of its table. */
static enum kd_status put_rows(const struct kd_sweep_axis *axis, size_t row, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    uint8_t number[8];
    char *text = calloc(1, row + 1);
    for (size_t i = 0; i < axis->n && !status; i++) {
        kd_cube_put_double(number, axis->values[i].number);
        if (text && !axis->numeric)
            strncpy(text, axis->values[i].text, row + 1);
        status = !text ? KD_ENOMEM : kd_buffer_append(out, axis->numeric ? (void *)number : text, row);
    }
    free(text);
    return status;
}

enum kd_status kd_cube_put_values(const struct kd_sweep_axis *axis, struct kd_buffer *out)
{
    const size_t row = axis->numeric ? 8 : kd_cube_longest(axis);
    struct kd_buffer values = { 0 };
    char form[24] = "1D";
    if (!axis->numeric)
        snprintf(form, sizeof form, "%zuA", row);
    enum kd_status status = put_rows(axis, row, &values);
    if (!status)
        status = put_table(axis->path, "field of the scene", "value", form, axis->numeric ? unit_of(axis) : "", row,
                           axis->n, &(struct kd_buffer) { 0 }, &values, out);
    kd_buffer_finish(&values);
    return status;
}

/* The table has one row, which is an array of the shape (1, n). Section 6 of the paper requires this for coordinates
 * of one axis. */
enum kd_status kd_cube_put_frequencies(const struct kd_sweep_axis *axis, struct kd_buffer *out)
{
    struct kd_buffer values = { 0 }, shape = { 0 };
    char form[24], dimensions[32];
    uint8_t number[8];
    enum kd_status status = KD_OK;
    snprintf(form, sizeof form, "%zuD", axis->n);
    snprintf(dimensions, sizeof dimensions, "(1,%zu)", axis->n);
    for (size_t i = 0; i < axis->n && !status; i++) {
        kd_cube_put_double(number, world_of(axis, i));
        status = kd_buffer_append(&values, number, sizeof number);
    }
    if (!status)
        status = kd_fits_text(&shape, "TDIM1", dimensions, NULL);
    if (!status)
        status = put_table(TABLE, "of the axes F", COLUMN, form, "Hz", 8 * axis->n, 1, &shape, &values, out);
    kd_buffer_finish(&values);
    kd_buffer_finish(&shape);
    return status;
}

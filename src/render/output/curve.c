#include "render/output/curve.h"

#include "scene/number.h"

struct kd_curve_row kd_curve_row_of(unsigned number, const struct kd_scene *scene, const struct kd_frame *frame)
{
    const struct kd_light *all = &frame->light.all, *spots = &frame->light.spots;
    return (struct kd_curve_row) {
        .frame = number, .t = scene->top.time, .flux = all->flux, .centroid_x = all->x, .centroid_y = all->y,
        .spots_flux = spots->flux, .spots_centroid_x = spots->x, .spots_centroid_y = spots->y,
        .width = frame->width, .height = frame->height,
    };
}

#define NAME(name) #name,
static const char *const names[] = { KD_CURVE_COLUMNS_(NAME) };
enum { COLUMNS = sizeof names / sizeof *names };
_Static_assert(sizeof(struct kd_curve_row) == COLUMNS * sizeof(double), "a row is its columns");

static enum kd_status write_row(const double *values, bool csv, bool last, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < COLUMNS; i++) {
        char number[KD_NUMBER_SIZE] = "";
        if (!isnan(values[i]))
            kd_number_format(number, values[i] == 0 ? 0 : values[i]); /* no -0 */
        KD_TRY(csv ? kd_buffer_printf(out, "%s%s", i ? "," : "", number)
                   : kd_buffer_printf(out, "%s\"%s\":%s", i ? "," : "{", names[i], *number ? number : "null"));
    }
    KD_TRY(kd_buffer_printf(out, "%s", csv ? "\n" : last ? "}" : "},\n"));
done:
    return status;
}

static enum kd_status write_csv(const void *rows, size_t n, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < COLUMNS; i++)
        KD_TRY(kd_buffer_printf(out, "%s%s", names[i], i + 1 < COLUMNS ? "," : "\n"));
    for (size_t i = 0; i < n; i++)
        KD_TRY(write_row((const double *)rows + i * COLUMNS, true, i + 1 == n, out));
done:
    return status;
}

static enum kd_status write_json(const void *rows, size_t n, struct kd_buffer *out)
{
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "{\"frames\":[\n"));
    for (size_t i = 0; i < n; i++)
        KD_TRY(write_row((const double *)rows + i * COLUMNS, false, i + 1 == n, out));
    KD_TRY(kd_buffer_printf(out, "]}\n"));
done:
    return status;
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory, struct kd_buffer *out,
                             struct kd_error *error)
{
    const struct kd_curve_row row = kd_curve_row_of(picture->number, picture->scene, picture->frame);
    (void)effort, (void)memory;
    return kd_buffer_append(out, &row, sizeof row) ? kd_error_set(error, KD_ENOMEM, "out of memory for a row") : KD_OK;
}

static const struct kd_format one_row = {
    .name = "row", .media_type = "application/octet-stream", .magic = "", .carries = KD_CARRIES_LIGHT, .encode = encode,
};

static const struct kd_table_format tables[] = {
    { "json", "application/json", NULL, write_json },
    { "csv", "text/csv", "light-curve.csv", write_csv },
};

const struct kd_series kd_light_curve = {
    .name = "light-curve", .noun = "light curve", .each = "the rows of a light curve", .frame = &one_row, .row_bytes = sizeof(struct kd_curve_row), .tables = tables,
    .n_tables = sizeof tables / sizeof *tables,
};

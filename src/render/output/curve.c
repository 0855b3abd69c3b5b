#include "render/output/curve.h"

#include "base/json.h"
#include "document/number.h"

#include <string.h>

struct kd_curve_row kd_curve_row_of(unsigned number, const struct kd_scene *scene, const struct kd_frame *frame)
{
    const struct kd_light *all = &frame->light.all, *spots = &frame->light.spots;
    const bool linear = frame->light.polarized, circular = frame->light.circular,
               apart = linear && !circular; /* circularly polarised light comes from volumes only */
    return (struct kd_curve_row) {
        .frame = number,
        .t = scene->top.time,
        .flux = all->flux,
        .centroid_x = all->x,
        .centroid_y = all->y,
        .spots_flux = spots->flux,
        .spots_centroid_x = spots->x,
        .spots_centroid_y = spots->y,
        .width = frame->width,
        .height = frame->height,
        .stokes_q = linear ? all->q : NAN,
        .stokes_u = linear ? all->u : NAN,
        .stokes_v = circular ? all->v : NAN,
        .polarization_fraction = linear ? kd_light_fraction(all) : NAN,
        .evpa = linear ? kd_light_evpa(all) : NAN,
        .spots_stokes_q = apart ? spots->q : NAN,
        .spots_stokes_u = apart ? spots->u : NAN,
        .spots_polarization_fraction = apart ? kd_light_fraction(spots) : NAN,
        .spots_evpa = apart ? kd_light_evpa(spots) : NAN,
    };
}

#define NAME(name) #name,
#define ONE(name) +1
static const char *const names[] = { KD_CURVE_COLUMNS_(NAME) KD_CURVE_STOKES_(NAME) KD_CURVE_CIRCULAR_(NAME)
                                         KD_CURVE_SPOTS_(NAME) };
enum {
    ALWAYS = KD_CURVE_COLUMNS_(ONE),
    CIRCULAR = ALWAYS KD_CURVE_STOKES_(ONE),
    OF_SPOTS = CIRCULAR KD_CURVE_CIRCULAR_(ONE),
    COLUMNS = sizeof names / sizeof *names
};
_Static_assert(sizeof(struct kd_curve_row) == COLUMNS * sizeof(double), "a row is its columns");

/* The columns of a table. A group for polarised light is present if its first column is a number in any row. */
struct columns { bool has[COLUMNS]; };
static struct columns columns_of(const double *rows, size_t n)
{
    struct columns out = { { false } };
    for (int i = 0; i < COLUMNS; i++) {
        const int first = i < ALWAYS ? 0 : i < CIRCULAR ? ALWAYS : i < OF_SPOTS ? CIRCULAR : OF_SPOTS;
        out.has[i] = !first;
        for (size_t k = 0; k < n && !out.has[i]; k++)
            out.has[i] = !isnan(rows[k * COLUMNS + first]);
    }
    return out;
}

/* Writes a field of CSV (RFC 4180). */
static enum kd_status put_field(const char *text, struct kd_buffer *out)
{
    enum kd_status status;
    if (!strpbrk(text, ",\"\n"))
        return kd_buffer_printf(out, "%s", text);
    KD_TRY(kd_buffer_printf(out, "\""));
    for (; *text; text++)
        KD_TRY(kd_buffer_printf(out, "%s%c", *text == '"' ? "\"" : "", *text));
    KD_TRY(kd_buffer_printf(out, "\""));
done:
    return status;
}

/* Writes the values of the axes in a row. */
static enum kd_status write_values(const struct kd_sweep *sweep, unsigned scene, bool csv, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; sweep && i < sweep->n_axes; i++) {
        const struct kd_sweep_value *value = kd_sweep_at(sweep, scene, i);
        KD_TRY(csv ? kd_buffer_printf(out, ",") : kd_buffer_printf(out, ",\"%s\":", sweep->axes[i].path));
        if (csv)
            KD_TRY(put_field(value->text, out));
        else
            KD_TRY(kd_sweep_value_json(value, out));
    }
done:
    return status;
}

static enum kd_status write_row(const double *values, const struct columns *columns, const struct kd_sweep *sweep,
                                bool csv, bool last, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < COLUMNS; i++) {
        if (!columns->has[i])
            continue;
        char number[KD_NUMBER_SIZE] = "";
        if (!isnan(values[i]))
            kd_number_format(number, values[i] == 0 ? 0 : values[i]); /* avoids -0 */
        KD_TRY(csv ? kd_buffer_printf(out, "%s%s", i ? "," : "", number)
                   : kd_buffer_printf(out, "%s\"%s\":%s", i ? "," : "{", names[i], *number ? number : "null"));
        if (!i)
            KD_TRY(write_values(sweep, (unsigned)values[0], csv, out));
    }
    KD_TRY(kd_buffer_printf(out, "%s", csv ? "\n" : last ? "}" : "},\n"));
done:
    return status;
}

static enum kd_status write_csv(const void *rows, size_t n, const struct kd_sweep *sweep, struct kd_buffer *out)
{
    const struct columns columns = columns_of(rows, n);
    enum kd_status status = KD_OK;
    for (int i = 0; i < COLUMNS; i++) {
        if (!columns.has[i])
            continue;
        KD_TRY(kd_buffer_printf(out, "%s%s", i ? "," : "", names[i]));
        for (size_t k = 0; !i && sweep && k < sweep->n_axes; k++)
            KD_TRY(kd_buffer_printf(out, ",%s", sweep->axes[k].path));
    }
    KD_TRY(kd_buffer_printf(out, "\n"));
    for (size_t i = 0; i < n; i++)
        KD_TRY(write_row((const double *)rows + i * COLUMNS, &columns, sweep, true, i + 1 == n, out));
done:
    return status;
}

static enum kd_status write_json(const void *rows, size_t n, const struct kd_sweep *sweep, struct kd_buffer *out)
{
    const struct columns columns = columns_of(rows, n);
    enum kd_status status;
    KD_TRY(kd_buffer_printf(out, "{\"frames\":[\n"));
    for (size_t i = 0; i < n; i++)
        KD_TRY(write_row((const double *)rows + i * COLUMNS, &columns, sweep, false, i + 1 == n, out));
    KD_TRY(kd_buffer_printf(out, "]}\n"));
done:
    return status;
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_curve_row row = kd_curve_row_of(picture->number, picture->scene, picture->frame);
    (void)effort, (void)memory;
    return kd_buffer_append(out, &row, sizeof row) ? kd_error_set(error, KD_ENOMEM, "out of memory for a row") : KD_OK;
}

static const struct kd_format one_row = {
    .name = "row",
    .media_type = KD_BYTES_TYPE,
    .magic = "",
    .carries = KD_CARRIES_LIGHT,
    .encode = encode,
};

static const struct kd_table_format tables[] = {
    { "json", KD_JSON_TYPE, NULL, write_json },
    { "csv", KD_CSV_TYPE, "light-curve.csv", write_csv },
};

const struct kd_series kd_light_curve = {
    .name = "light-curve",
    .noun = "light curve",
    .each = "the rows of a light curve",
    .frame = &one_row,
    .row_bytes = sizeof(struct kd_curve_row),
    .tables = tables,
    .n_tables = sizeof tables / sizeof *tables,
};

#include "render/output/curve.h"

#include "scene/number.h"

enum kd_status kd_curve_plan(struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_plan *out,
                             struct kd_error *error)
{
    struct kd_needs needs = kd_needs_of(scene);
    needs.light = true;
    if (isinf(scene->style.exposure))
        scene->style.exposure = 0;
    return kd_plan_make_for(scene, &needs, capacity, out, error);
}

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
    for (int i = 0; i < COLUMNS && !status; i++) {
        char number[KD_NUMBER_SIZE] = "";
        if (!isnan(values[i]))
            kd_number_format(number, values[i] == 0 ? 0 : values[i]); /* no -0 */
        status = csv ? kd_buffer_printf(out, "%s%s", i ? "," : "", number)
                     : kd_buffer_printf(out, "%s\"%s\":%s", i ? "," : "{", names[i], *number ? number : "null");
    }
    return status ? status : kd_buffer_printf(out, "%s", csv ? "\n" : last ? "}" : "},\n");
}

enum kd_status kd_curve_text(const struct kd_curve_row *rows, size_t n, bool csv, struct kd_buffer *out)
{
    enum kd_status status = csv ? KD_OK : kd_buffer_printf(out, "{\"frames\":[\n");
    for (int i = 0; i < COLUMNS && csv && !status; i++)
        status = kd_buffer_printf(out, "%s%s", names[i], i + 1 < COLUMNS ? "," : "\n");
    for (size_t i = 0; i < n && !status; i++)
        status = write_row((const double *)&rows[i], csv, i + 1 == n, out);
    return status || csv ? status : kd_buffer_printf(out, "]}\n");
}

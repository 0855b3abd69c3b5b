#include "cli/stats.h"

#include "render/output/notes.h"
#include "scene/table.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Writes the section `accuracy` of the scene, with the values that the plan has chosen. */
static void add_setting(struct kd_json *json, const struct kd_stats *stats)
{
    const struct kd_section *section = kd_section_find("accuracy");
    const struct kd_setting *by = &stats->plan->lens.setting;
    for (size_t i = 0; i < section->count; i++) {
        const struct kd_row *field = &kd_fields[section->first + i];
        if (!strcmp(field->name, "engine"))
            kd_json_string(json, "engine", kd_engine_name(by->engine));
        else if (!strcmp(field->name, "precision"))
            kd_json_string(json, "precision", kd_precision_name(by->precision));
        else if (!strcmp(field->name, "steps"))
            /* steps is 0 if the result is in closed form */
            kd_json_number(json, "steps", by->steps);
        else
            kd_row_write(json, field, stats->scene);
    }
}

static void add_accuracy(struct kd_json *json, const struct kd_stats *stats)
{
    kd_json_object(json, "accuracy");
    add_setting(json, stats);
    kd_accuracy_members(json, &stats->frame->accuracy, "radius_error_median", "radius_error_worst");
    kd_json_end(json);
}

static void add_times(struct kd_json *json, const struct kd_stats *stats)
{
    kd_json_object(json, "device_ms");
    for (size_t i = 0; i < stats->frame->n_timings; i++)
        kd_json_number(json, stats->frame->timings[i].name, stats->frame->timings[i].ms);
    kd_json_end(json);
    kd_json_number(json, "render_ms", stats->render_ms);
    kd_json_number(json, "encode_ms", stats->encode_ms);
    kd_json_number(json, "estimate_ms", stats->plan->cost.estimate_ms);
}

enum kd_status kd_stats_json(const struct kd_stats *stats, struct kd_buffer *out)
{
    struct kd_json whole = kd_json_begin(out), *json = &whole;
    char hash[65] = "";
    enum kd_status status = kd_scene_hash(stats->scene, hash);
    if (status)
        return status;
    kd_json_object(json, NULL);
    kd_json_string(json, "kerrd", KD_VERSION);
    kd_json_string(json, "device", stats->device);
    kd_json_string(json, "hash", hash);
    kd_json_number(json, "width", stats->frame->width);
    kd_json_number(json, "height", stats->frame->height);
    kd_json_number(json, "rays", (double)stats->plan->lens.rays);
    kd_json_number(json, "critical_rays", (double)(kd_plan_rays(&stats->plan->lens) - stats->plan->lens.rays));
    kd_json_number(json, "exposure", stats->frame->exposure);
    kd_json_number(json, "bytes", (double)stats->bytes);
    if (!isnan(kd_flux_jy(stats->scene, stats->frame)))
        kd_json_number(json, "flux_jy", kd_flux_jy(stats->scene, stats->frame));
    if (stats->scene->volume.normalise_to_jy > 0)
        kd_json_number(json, "density_scale", stats->frame->density_scale);
    add_times(json, stats);
    add_accuracy(json, stats);
    kd_json_array(json, "approximations");
    struct kd_approximation one;
    for (size_t i = 0; kd_picture_approximation(&stats->plan->report, &stats->frame->accuracy, i, &one); i++)
        kd_json_string(json, NULL, one.text);
    kd_json_end(json);
    kd_json_end(json);
    return kd_json_finish_line(json);
}

enum kd_status kd_stats_print(struct kd_json *json, struct kd_buffer *line, struct kd_error *error)
{
    enum kd_status status = kd_json_finish(json);
    if (status)
        kd_error_set(error, status, "out of memory for the output of --stats");
    else
        fprintf(stderr, "%s\n", (const char *)line->data);
    kd_buffer_finish(line);
    return status;
}

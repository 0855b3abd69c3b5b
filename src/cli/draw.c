#include "cli/draw.h"

#include "cli/cli.h"
#include "cli/ending.h"
#include "cli/progress.h"

const struct kd_format *kd_cli_picture_format(const struct argp_state *state, const char *option, const char *path,
                                              bool required)
{
#define NAME(name) #name,
    static const char *const names[] = { KD_FORMATS(NAME) NULL };
#undef NAME
    return kd_format_named((required ? kd_cli_ending_required : kd_cli_ending)(state, option, path, names));
}

enum kd_status kd_cli_draw_planned(struct kd_renderer *renderer, const struct kd_scene *scene,
                                   const struct kd_plan *plan, struct kd_frame *frame, double *ms,
                                   struct kd_error *error)
{
    struct kd_progress progress;
    kd_progress_begin(&progress, 1);
    const enum kd_status status = kd_render(renderer, scene, plan, kd_progress_update, &progress, frame, error);
    *ms = 1e3 * (kd_progress_clock() - progress.started);
    return kd_progress_end(&progress, status, error);
}

enum kd_status kd_cli_draw(struct kd_renderer *renderer, const struct kd_format *format, struct kd_scene *scene,
                           struct kd_plan *plan, struct kd_frame *frame, double *ms, struct kd_error *error)
{
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    const enum kd_status status = kd_format_plan(format, scene, &capacity, plan, error);
    return status ? status : kd_cli_draw_planned(renderer, scene, plan, frame, ms, error);
}

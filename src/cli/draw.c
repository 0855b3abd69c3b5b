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

enum kd_status kd_cli_draw(struct kd_renderer *renderer, const struct kd_format *format, struct kd_scene *scene,
                           struct kd_plan *plan, struct kd_frame *frame, double *ms, struct kd_error *error)
{
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    enum kd_status status = kd_format_plan(format, scene, &capacity, plan, error);
    if (status)
        return status;
    struct kd_progress progress;
    kd_progress_init(&progress);
    kd_progress_catch_signals();
    status = kd_render(renderer, scene, plan, kd_progress_update, &progress, frame, error);
    kd_progress_finish(&progress);
    *ms = 1e3 * (kd_progress_clock() - progress.started);
    if (status == KD_EDEVICE)
        kd_cli_device_lost(error);
    return status;
}

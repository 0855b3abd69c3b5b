#include "render/frame/parts.h"

#include <math.h>
#include <string.h>

static void add_timings(struct kd_frame *to, const struct kd_frame *from)
{
    for (size_t i = 0; i < from->n_timings; i++) {
        size_t k = 0;
        while (k < to->n_timings && strcmp(to->timings[k].name, from->timings[i].name))
            k++;
        if (k < to->n_timings)
            to->timings[k].ms += from->timings[i].ms;
        else if (k < KD_FRAME_MAX_TIMINGS)
            to->timings[to->n_timings++] = from->timings[i];
    }
}

static struct kd_accuracy_report both(const struct kd_accuracy_report *l, const struct kd_accuracy_report *r)
{
    return (struct kd_accuracy_report) {
        l->undecided + r->undecided,
        l->traced + r->traced,
        l->interpolated + r->interpolated,
        l->sampled + r->sampled,
        l->crossings + r->crossings,
        l->differ + r->differ,
        fmax(l->median, r->median),
        fmax(l->worst, r->worst),
        l->followed + r->followed,
        l->refined + r->refined,
        l->between + r->between,
        l->pixel_sampled + r->pixel_sampled,
        fmax(l->pixel_error, r->pixel_error),
        fmax(l->pixel_error_worst, r->pixel_error_worst),
        l->volume_sampled + r->volume_sampled,
        fmax(l->volume_error, r->volume_error),
        fmax(l->volume_error_worst, r->volume_error_worst),
        l->lost + r->lost,
    };
}

void kd_frame_probe_both(struct kd_frame *to, const struct kd_frame *from)
{
    to->lens_reused = to->lens_reused && from->lens_reused;
    to->accuracy = both(&to->accuracy, &from->accuracy);
    add_timings(to, from);
}

enum kd_status kd_frame_render_part(const struct kd_parted *p, const struct kd_scene *scene, const struct kd_plan *plan,
                                    kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error)
{
    return p->background ? kd_render_in_background(p->renderer, scene, plan, progress, NULL, user, out, error)
                         : kd_render(p->renderer, scene, plan, progress, user, out, error);
}

enum kd_status kd_frame_parted(const struct kd_parted *p, struct kd_frame *out, struct kd_error *error)
{
    return (p->plan->picture.eyes == 2 ? kd_frame_pair
            : p->plan->picture.strips  ? kd_frame_strips
                                       : kd_frame_tile)(p, out, error);
}

/* This renders a pair of pictures, one for each eye, side by side. */
#include "render/frame/pair.h"

#include <math.h>
#include <string.h>

struct half {
    kd_progress_fn progress;
    void *user;
    double done;
};

static bool go_on(void *user, double fraction)
{
    const struct half *h = user;
    return !h->progress || h->progress(h->user, h->done + 0.5 * fraction);
}

/* The right eye has the exposure of the left one. */
static enum kd_status render_eye(const struct kd_pair *pair, int side, double exposure, struct kd_frame *out, struct kd_error *error)
{
    struct kd_scene eye = kd_scene_eye(pair->scene, side);
    struct kd_needs needs = kd_needs_of(&eye);
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct half half = { pair->progress, pair->user, side < 0 ? 0 : 0.5 };
    enum kd_status status;
    if (side > 0 && isinf(eye.style.exposure))
        eye.style.exposure = exposure;
    needs.quantities |= pair->plan->quantities;
    needs.light |= pair->plan->light;
    needs.radiance = pair->plan->radiance;
    kd_renderer_capacity(pair->renderer, &capacity);
    KD_TRY(kd_plan_make_for(&eye, &needs, &capacity, &plan, error));
    plan.audit = plan.audit < pair->plan->audit ? plan.audit : pair->plan->audit;
    plan.exposure_from = pair->plan->exposure_from;
    plan.exposure_share = pair->plan->exposure_share;
    if (pair->plan->told.on && (pair->plan->told.x < plan.width) == (side < 0)) {
        plan.told = pair->plan->told;
        plan.told.x -= side < 0 ? 0 : plan.width;
    }
    status = pair->aside ? kd_render_aside(pair->renderer, &eye, &plan, go_on, NULL, &half, out, error)
                         : kd_render(pair->renderer, &eye, &plan, go_on, &half, out, error);
done:
    return status;
}

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

/* Counts of both, and of errors the larger one. */
static struct kd_accuracy_report both(const struct kd_accuracy_report *l, const struct kd_accuracy_report *r)
{
    return (struct kd_accuracy_report) {
        l->undecided + r->undecided, l->sampled + r->sampled, l->crossings + r->crossings, l->differ + r->differ, fmax(l->median, r->median),
        fmax(l->worst, r->worst), l->followed + r->followed, l->refined + r->refined, l->between + r->between, l->pixel_sampled + r->pixel_sampled,
        fmax(l->pixel_error, r->pixel_error), fmax(l->pixel_error_worst, r->pixel_error_worst),
        l->volume_sampled + r->volume_sampled, fmax(l->volume_error, r->volume_error), fmax(l->volume_error_worst, r->volume_error_worst),
    };
}

static void copy_rows(const struct kd_layer *from, const struct kd_frame *of, size_t side, struct kd_layer *to)
{
    const size_t row = of->width * kd_layer_pixel_bytes(from);
    for (size_t y = 0; y < of->height; y++)
        memcpy((char *)to->data + (2 * y + side) * row, (const char *)from->data + y * row, row);
}

static enum kd_status join(const struct kd_frame eyes[2], struct kd_frame *out, struct kd_error *error)
{
    struct kd_frame frame = eyes[0];
    enum kd_status status = KD_OK;
    frame.width = 2 * eyes[0].width;
    frame.n_layers = 0;
    memset(frame.layers, 0, sizeof frame.layers);
    frame.lens_reused = eyes[0].lens_reused && eyes[1].lens_reused;
    frame.accuracy = both(&eyes[0].accuracy, &eyes[1].accuracy);
    frame.light = (struct kd_light_report) { 0 }; /* it would be that of neither */
    frame.told = NULL;
    add_timings(&frame, &eyes[1]);
    for (size_t i = 0; i < eyes[0].n_layers; i++) {
        const struct kd_layer *l = &eyes[0].layers[i];
        KD_TRY(kd_frame_add_layer(&frame, l->name, l->channels, l->type, error));
        for (size_t side = 0; side < 2; side++)
            copy_rows(&eyes[side].layers[i], &eyes[side], side, &frame.layers[i]);
    }
done:
    if (status)
        kd_frame_finish(&frame);
    else
        *out = frame;
    return status;
}

/* Only one eye has any. */
static void hand_over_told(struct kd_frame eyes[2], struct kd_frame *to)
{
    for (int i = 0; i < 2; i++)
        if (eyes[i].told) {
            to->told = eyes[i].told;
            eyes[i].told = NULL;
        }
}

enum kd_status kd_frame_pair(const struct kd_pair *pair, struct kd_frame *out, struct kd_error *error)
{
    struct kd_frame eyes[2] = { 0 };
    enum kd_status status;
    KD_TRY(render_eye(pair, -1, 0, &eyes[0], error));
    KD_TRY(render_eye(pair, 1, eyes[0].exposure, &eyes[1], error));
    KD_TRY(join(eyes, out, error));
    hand_over_told(eyes, out);
done:
    for (int i = 0; i < 2; i++)
        kd_frame_finish(&eyes[i]);
    return status;
}

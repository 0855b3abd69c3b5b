/* Renders a pair of pictures, one for each eye, side by side. */
#include "render/frame/parts.h"

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

/* Renders one eye's picture. The right eye's picture has the exposure of the left eye's. */
static enum kd_status render_eye(const struct kd_parted *pair, int side, double exposure, struct kd_frame *out,
                                 struct kd_error *error)
{
    struct kd_scene eye = kd_scene_eye(pair->scene, side);
    struct kd_needs needs = kd_needs_of(&eye);
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct half half = { pair->progress, pair->user, side < 0 ? 0 : 0.5 };
    enum kd_status status;
    if (side > 0 && isinf(eye.style.exposure))
        eye.style.exposure = exposure;
    needs.quantities |= pair->plan->lens.quantities;
    needs.light |= pair->plan->light.photometry;
    needs.radiance = pair->plan->picture.radiance;
    kd_renderer_capacity(pair->renderer, &capacity);
    KD_TRY(kd_plan_make_for(&eye, &needs, &capacity, &plan, error));
    plan.lens.audit = plan.lens.audit < pair->plan->lens.audit ? plan.lens.audit : pair->plan->lens.audit;
    plan.picture.exposure_from = pair->plan->picture.exposure_from;
    plan.picture.exposure_share = pair->plan->picture.exposure_share;
    if (pair->plan->report.probe.on && (pair->plan->report.probe.x < plan.picture.width) == (side < 0)) {
        plan.report.probe = pair->plan->report.probe;
        plan.report.probe.x -= side < 0 ? 0 : plan.picture.width;
    }
    status = kd_frame_render_part(pair, &eye, &plan, go_on, &half, out, error);
done:
    return status;
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
    /* cleared, because flux and centroid of the two pictures together have no meaning */
    frame.light = (struct kd_light_report) { 0 };
    frame.told = NULL;
    kd_frame_probe_both(&frame, &eyes[1]);
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

/* Moves the description of the plan's pixel to the result. Only one eye's picture contains that pixel. */
static void hand_over_told(struct kd_frame eyes[2], struct kd_frame *to)
{
    for (int i = 0; i < 2; i++)
        if (eyes[i].told) {
            to->told = eyes[i].told;
            eyes[i].told = NULL;
        }
}

enum kd_status kd_frame_pair(const struct kd_parted *pair, struct kd_frame *out, struct kd_error *error)
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

#include "render/frame/blur.h"

#include <stdlib.h>
#include <string.h>

/* Bytes of host memory for each pixel: SUM for the sum, LIGHT for the light of one picture. */
enum { SUM = 3 * sizeof(double), LIGHT = 3 * sizeof(float) };

/* Requests that the linear light be copied to the host. */
static void bring_light(struct kd_plan *plan)
{
    plan->picture.radiance = true;
    plan->cost.device_bytes += 2 * kd_plan_readback_bytes(&plan->picture);
}

enum kd_status kd_blur_plan(unsigned samples, double shutter, const struct kd_capacity *capacity, struct kd_plan *plan,
                            struct kd_error *error)
{
    if (plan->picture.eyes == 2)
        return kd_error_field(error, "/camera/stereo",
                              "camera.stereo is \"pair\"; with motion_blur it must be \"none\"");
    if (plan->picture.cut.width)
        return kd_error_field(error, "/image/tile/width",
                              "image.tile.width is %u; with motion_blur it must be 0: the whole picture",
                              plan->picture.cut.width);
    if (plan->picture.strips)
        return kd_error_set(error, KD_ETOOBIG,
                            "the picture fits on the device only in %u strips, but motion_blur needs one piece: lower "
                            "image.width and image.height",
                            plan->picture.strips);
    if (!plan->picture.rgb || plan->picture.n_layers)
        return kd_error_field(error, "/image/layers",
                              "image.layers names maps of numbers; with motion_blur it must be \"rgb\", because only "
                              "light can be averaged");
    bring_light(plan);
    plan->picture.blur.samples = samples;
    plan->picture.blur.shutter = shutter;
    plan->cost.host_bytes += (uint64_t)(SUM + LIGHT) * plan->picture.width * plan->picture.height;
    plan->cost.estimate_ms *= samples;
    if (capacity->host_bytes && plan->cost.host_bytes > capacity->host_bytes)
        return kd_error_set(
            error, KD_ETOOBIG,
            "the picture with motion blur needs %.3g GB of this machine's memory; only %.3g GB are free",
            1e-9 * (double)plan->cost.host_bytes, 1e-9 * (double)capacity->host_bytes);
    return KD_OK;
}

/* Progress of one picture as a fraction of the whole work. */
struct part {
    const struct kd_blurred *blurred;
    unsigned done;
};

static bool go_on(void *user, double fraction)
{
    const struct part *part = user;
    const struct kd_blurred *b = part->blurred;
    return !b->progress || b->progress(b->user, (part->done + fraction) / b->blur->samples);
}

static bool wanted(void *user)
{
    return ((const struct part *)user)->blurred->preview->wanted(((const struct part *)user)->blurred->user);
}

static void seen(void *user, const struct kd_frame *frame, uint32_t rows)
{
    const struct kd_blurred *b = ((const struct part *)user)->blurred;
    b->preview->seen(b->user, frame, rows);
}

static enum kd_status add(const struct kd_blurred *b, struct part *part, unsigned sample, struct kd_light_sum *sum,
                          struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    enum kd_status status;
    kd_renderer_capacity(b->renderer, &capacity);
    KD_TRY(b->blur->scene(b->blur, sample, &scene, error));
    KD_TRY(kd_plan_make(&scene, &capacity, &plan, error));
    if (plan.picture.width != b->plan->picture.width || plan.picture.height != b->plan->picture.height ||
        plan.picture.eyes != b->plan->picture.eyes || !plan.picture.rgb || plan.picture.n_layers)
        KD_TRY(kd_error_field(error, "/image",
                              "the picture changes its size or kind while the shutter is open; with motion_blur both "
                              "must stay the same"));
    if (plan.picture.strips || plan.picture.cut.width)
        KD_TRY(kd_error_set(error, KD_ETOOBIG,
                            "a picture of the blurred frame no longer fits on the device in one piece"));
    bring_light(&plan);
    KD_TRY(b->background ? kd_render_in_background(b->renderer, &scene, &plan, go_on, NULL, part, &frame, error)
                         : kd_render(b->renderer, &scene, &plan, go_on, part, &frame, error));
    const float *light = frame.layers[1].data;
    for (size_t i = 0; i < (size_t)3 * frame.width * frame.height; i++)
        sum->sum[i] += light[i];
    sum->n++;
    sum->traced += !frame.lens_reused && plan.lens.planes;
done:
    kd_frame_finish(&frame);
    return status;
}

enum kd_status kd_render_blurred(const struct kd_blurred *b, struct kd_frame *out, struct kd_error *error)
{
    static const struct kd_preview_hook looks = { wanted, seen };
    struct part part = { b, 0 };
    const unsigned n = b->blur->samples;
    struct kd_light_sum others = { calloc((size_t)b->plan->picture.width * b->plan->picture.height, SUM) };
    enum kd_status status =
        others.sum ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for the light of a blurred picture");
    for (; part.done < n - 1 && !status; part.done++)
        status = add(b, &part, n - 1 - part.done, &others, error);
    if (!status)
        status = kd_render_mean(b->renderer, b->scene, b->plan, &others, b->background, go_on,
                                b->preview ? &looks : NULL, &part, out, error);
    if (!status)
        out->others_traced = others.traced;
    free(others.sum);
    return status;
}

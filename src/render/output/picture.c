#include "render/output/picture.h"

#include "image/png.h"

#include <stdio.h>
#include <string.h>

void kd_accuracy_text(const struct kd_accuracy_report *report, const struct kd_plan *plan, char out[KD_ACCURACY_TEXT])
{
    int n = snprintf(out, KD_ACCURACY_TEXT, "rays=%llu engine=%s precision=%s steps=%u critical_rays=%llu undecided=%llu sampled=%u",
                     (unsigned long long)plan->rays, kd_engine_name(plan->setting.engine),
                     kd_precision_name(plan->setting.precision), plan->setting.steps, (unsigned long long)(kd_plan_rays(plan) - plan->rays),
                     (unsigned long long)report->undecided,
                     report->sampled);
    if (report->sampled)
        snprintf(out + n, KD_ACCURACY_TEXT - (size_t)n, " crossings=%u differ=%u median=%.1e worst=%.1e", report->crossings,
                 report->differ, report->median, report->worst);
}

/* One sentence a line, as a reader of the file's properties sees them. */
static enum kd_status join_approximations(const struct kd_plan *plan, struct kd_buffer *out)
{
    enum kd_status status = kd_buffer_append(out, "", 0); /* a plan without any still gives a string */
    for (size_t i = 0; i < plan->n_approximations && !status; i++)
        status = kd_buffer_printf(out, "%s%s", i ? "\n" : "", plan->approximations[i]);
    return status;
}

enum kd_status kd_picture_encode(const struct kd_frame *frame, const struct kd_scene *scene,
                                 const struct kd_plan *plan, const char *device, int compression,
                                 struct kd_buffer *png, struct kd_error *error)
{
    struct kd_buffer document = { 0 }, approximations = { 0 };
    char hash[65], accuracy[KD_ACCURACY_TEXT];
    kd_accuracy_text(&frame->accuracy, plan, accuracy);
    enum kd_status status = kd_scene_to_json(scene, &document);
    if (!status)
        status = kd_scene_hash(scene, hash);
    if (!status)
        status = join_approximations(plan, &approximations);
    if (status) {
        kd_error_set(error, status, "cannot describe the scene inside its picture: %s",
                     kd_status_name(status));
        goto done;
    }
    const struct kd_png_text text[] = {
        { "kerrd:scene", (const char *)document.data },
        { "kerrd:hash", hash },
        { "kerrd:version", KD_VERSION },
        { "kerrd:approximations", (const char *)approximations.data },
        { "kerrd:accuracy", accuracy },
        { "kerrd:device", device },
        { "Software", "kerrd " KD_VERSION },
    };
    const struct kd_png_params params = {
        .width = frame->width,
        .height = frame->height,
        .bit_depth = kd_frame_bit_depth(frame),
        .compression = compression,
        .pixels = kd_frame_pixels(frame),
        .text = text,
        .n_text = sizeof text / sizeof *text,
    };
    status = kd_png_encode(&params, png, error);
done:
    kd_buffer_finish(&document);
    kd_buffer_finish(&approximations);
    return status;
}

enum kd_status kd_picture_scene(const void *png, size_t size, struct kd_scene *out, struct kd_error *error)
{
    struct kd_png picture;
    enum kd_status status = kd_png_decode(png, size, &picture, error);
    if (status)
        return status;
    const char *text = kd_png_text_find(&picture, "kerrd:scene");
    if (text) {
        struct kd_scene scene; /* *out stays as it was when the document is refused */
        kd_scene_defaults(&scene);
        status = kd_scene_from_json(&scene, text, strlen(text), error);
        if (!status)
            *out = scene;
    } else {
        status = kd_error_set(error, KD_EINVAL,
                              "the picture holds no scene: it was not made by kerrd, or its text "
                              "was stripped");
    }
    kd_png_finish(&picture);
    return status;
}

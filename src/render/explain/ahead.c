#include "render/explain/ahead.h"

#include "render/device/renderer.h"
#include "render/explain/explain.h"
#include "render/view/critical_cache.h"

/* The scene that the web page requests for a pixel (clients/web/over/pixel.js), in which the pixel is rendered by
 * itself. */
static struct kd_scene alone(const struct kd_scene *scene)
{
    struct kd_scene s = *scene;
    s.image.samples = 1;
    s.style.exposure = 0;
    s.style.bloom = 0;
    s.style.beam_uas = 0;
    s.style.colour_bar = false;
    return s;
}

/* Finds a pixel at the critical curve. Such a pixel needs all kernels that other pixels need, and the kernels for
 * denser rays. If the picture has no pixel at the curve, takes the first pixel. The only error is KD_ENOMEM. */
static enum kd_status pixel_at_curve(const struct kd_scene *scene, struct kd_pixel *out, struct kd_error *error)
{
    struct kd_critical_pixels list = { 0 };
    const enum kd_status status = kd_critical_cache(scene, &list, error);
    *out = !status && list.n ? list.pixels[list.n / 2] : (struct kd_pixel) { 0 };
    kd_critical_pixels_finish(&list);
    return status;
}

struct kd_compilation *kd_explain_ahead(struct kd_renderer *renderer, const struct kd_scene *scene)
{
    struct kd_scene s = alone(scene);
    struct kd_capacity capacity;
    struct kd_pixel at;
    struct kd_plan plan;
    struct kd_error ignored; /* an error of a kernel is reported to the request that needs the kernel */
    kd_renderer_capacity(renderer, &capacity);
    if (pixel_at_curve(&s, &at, &ignored) || kd_plan_make(&s, &capacity, &plan, &ignored))
        return NULL;
    plan.report.probe.on = true;
    plan.report.probe.x = (uint32_t)at.x;
    plan.report.probe.y = (uint32_t)at.y;
    return kd_explain_narrow(&capacity, &s, &plan, &ignored) ? NULL : kd_compilation_begin(renderer, &s, &plan);
}

/* Renders a tile of a picture with a margin that is then cropped. Also renders, in strips, a picture that does not
 * fit in memory as a whole (render/plan/tile.h). */
#include "render/frame/parts.h"

#include "render/plan/tile.h"

#include <string.h>

/* Moves the kept rows to the front. Each row is copied before its source is overwritten. */
static void cut_layer(const struct kd_layer *layer, uint32_t width, const struct kd_window *cut)
{
    const size_t pixel = kd_layer_pixel_bytes(layer), row = cut->width * pixel;
    char *data = layer->data;
    for (size_t y = 0; y < cut->height; y++)
        memmove(data + y * row, data + ((cut->top + y) * width + cut->left) * pixel, row);
}

enum kd_status kd_frame_tile(const struct kd_parted *p, struct kd_frame *out, struct kd_error *error)
{
    const struct kd_scene wide = kd_tile_with_margin(p->scene, NULL);
    struct kd_plan all = *p->plan;
    all.picture.cut = (struct kd_window) { 0 };
    all.report.probe.x += p->plan->picture.cut.left;
    all.report.probe.y += p->plan->picture.cut.top;
    const enum kd_status status = kd_frame_render_part(p, &wide, &all, p->progress, p->user, out, error);
    if (status)
        return status;
    for (size_t i = 0; i < out->n_layers; i++)
        cut_layer(&out->layers[i], out->width, &p->plan->picture.cut);
    out->width = p->plan->picture.cut.width;
    out->height = p->plan->picture.cut.height;
    return KD_OK;
}

struct share {
    const struct kd_parted *of;
    /* done: fraction of the whole picture that was done before this strip; part: this strip's fraction of the whole
     * picture */
    double done, part;
};

static bool go_on(void *user, double fraction)
{
    const struct share *s = user;
    return !s->of->progress || s->of->progress(s->of->user, s->done + s->part * fraction);
}

/* first: the strip's first row in the picture. */
static enum kd_status render_strip(const struct kd_parted *p, const struct kd_scene *strip, uint32_t first,
                                   const struct share *share, struct kd_frame *out, struct kd_error *error)
{
    struct kd_needs needs = kd_needs_of(strip);
    struct kd_capacity capacity;
    struct kd_plan plan;
    enum kd_status status;
    needs.quantities |= p->plan->lens.quantities;
    needs.radiance = p->plan->picture.numbers;
    kd_renderer_capacity(p->renderer, &capacity);
    KD_TRY(kd_plan_make_for(strip, &needs, &capacity, &plan, error));
    plan.light.shape = p->plan->light.shape;
    if (p->plan->report.probe.on && p->plan->report.probe.y >= first &&
        p->plan->report.probe.y - first < (uint32_t)strip->tile.height) {
        plan.report.probe = p->plan->report.probe;
        plan.report.probe.y -= first;
    }
    status = kd_frame_render_part(p, strip, &plan, go_on, (void *)share, out, error);
done:
    return status;
}

/* Makes the whole frame with the first strip's report. The frame has room for all rows, which are still empty. */
static enum kd_status begin(const struct kd_frame *strip, uint32_t height, struct kd_frame *out, struct kd_error *error)
{
    struct kd_frame frame = *strip;
    enum kd_status status = KD_OK;
    frame.height = height;
    frame.n_layers = 0;
    frame.told = NULL;
    memset(frame.layers, 0, sizeof frame.layers);
    for (size_t i = 0; i < strip->n_layers && !status; i++)
        status =
            kd_frame_add_layer(&frame, strip->layers[i].name, strip->layers[i].channels, strip->layers[i].type, error);
    *out = frame;
    return status;
}

static void put_rows(const struct kd_frame *strip, uint32_t first, struct kd_frame *to)
{
    for (size_t i = 0; i < strip->n_layers; i++) {
        const size_t row = strip->width * kd_layer_pixel_bytes(&strip->layers[i]);
        memcpy((char *)to->layers[i].data + first * row, strip->layers[i].data, strip->height * row);
    }
}

enum kd_status kd_frame_strips(const struct kd_parted *p, struct kd_frame *out, struct kd_error *error)
{
    const uint32_t n = p->plan->picture.strips, strips = kd_tile_strips(p->scene, n);
    struct kd_frame frame = { 0 }, part = { 0 };
    uint32_t rows = 0;
    enum kd_status status = KD_OK;
    for (uint32_t i = 0; i < strips; i++) {
        const struct kd_scene strip = kd_tile_strip(p->scene, n, i);
        const struct share share = { p, (double)rows / p->plan->picture.height,
                                     (double)strip.tile.height / p->plan->picture.height };
        KD_TRY(render_strip(p, &strip, rows, &share, &part, error));
        if (i)
            kd_frame_probe_both(&frame, &part);
        else
            KD_TRY(begin(&part, p->plan->picture.height, &frame, error));
        put_rows(&part, rows, &frame);
        rows += part.height;
        if (part.told) { /* only one strip contains the plan's pixel */
            frame.told = part.told;
            part.told = NULL;
        }
        kd_frame_finish(&part);
        part = (struct kd_frame) { 0 };
    }
    *out = frame;
done:
    kd_frame_finish(&part);
    if (status)
        kd_frame_finish(&frame);
    return status;
}

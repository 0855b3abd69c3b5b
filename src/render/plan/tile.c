#include "render/plan/tile.h"

#include "render/emit/emitter.h"
#include "render/plan/plan.h"
#include "interface.h"

#include <math.h>

/* Width of the margin in pixels. A footprint is a difference between two rays that are two steps apart. Points of
 * light are searched in tiles of KD_STAR_TILE rays, aligned to the whole picture. The search uses rays up to three
 * beyond the tiles. A point lights two pixels round its image. */
#define MARGIN 4u
#define MARGIN_OF_POINTS (KD_STAR_TILE + 7u)

static enum kd_status picture(const struct kd_scene *scene, bool map, struct kd_error *error)
{
    const struct kd_style *style = &scene->style;
    if (map && (isinf(scene->image.layer_min) || isinf(scene->image.layer_max)))
        return kd_error_field(
            error, isinf(scene->image.layer_min) ? "/image/layer_min" : "/image/layer_max",
            "image.layer_%s is \"auto\"; in a tile it must be a number, because \"auto\" depends on the whole picture",
            isinf(scene->image.layer_min) ? "min" : "max");
    if (map && scene->image.legend)
        return kd_error_field(
            error, "/image/legend",
            "image.legend is true; in a tile it must be false, because the bar is in a corner of the whole picture");
    if (map)
        return KD_OK;
    if (isinf(style->exposure))
        return kd_error_field(error, "/style/exposure",
                              "style.exposure is \"auto\"; in a tile it must be a number, because \"auto\" depends on "
                              "the whole picture; a small picture of the same scene gives one");
    if (style->bloom > 0)
        return kd_error_field(
            error, "/style/bloom",
            "style.bloom is %.9g; in a tile it must be 0, because a lens spreads light over the whole picture",
            style->bloom);
    if (style->beam_uas > 0)
        return kd_error_field(
            error, "/style/beam_uas",
            "style.beam_uas is %.9g; in a tile it must be 0, because a beam spreads light over the whole picture",
            style->beam_uas);
    if (style->colour_bar)
        return kd_error_field(error, "/style/colour_bar",
                              "style.colour_bar is true; in a tile it must be false, because the bar is in a corner of "
                              "the whole picture");
    return KD_OK;
}

enum kd_status kd_tile_check(const struct kd_scene *scene, const struct kd_needs *needs, struct kd_error *error)
{
    struct kd_plan_layer layers[KD_WORDS_MOST];
    bool shown;
    if (scene->camera.stereo != KD_STEREO_NONE)
        return kd_error_field(error, "/camera/stereo", "camera.stereo is \"pair\"; in a tile it must be \"none\"");
    if (scene->camera.projection == KD_PROJECTION_RING)
        return kd_error_field(error, "/camera/projection",
                              "camera.projection is \"ring\"; in a tile it must be another");
    if (kd_scene_adapts(scene))
        return kd_error_field(
            error, "/image/samples",
            "image.samples is \"auto\"; in a tile it must be 1 to 8, because \"auto\" depends on the whole picture");
    if (needs->no_image)
        return kd_error_field(error, "/image/tile/width",
                              "image.tile.width is %d; for a measurement of light it must be 0, because the light is "
                              "that of the whole picture",
                              scene->tile.width);
    const size_t n = kd_layers_of(scene, layers, &shown);
    return needs->radiance ? KD_OK : picture(scene, n == 1 && !shown, error);
}

/* The rows or columns from `from` to `to` - 1, out of `all`. They are widened by a margin, and then up to a
 * multiple of `by`. */
struct range { uint32_t from, to; };
static struct range widen(uint32_t from, uint32_t to, int32_t all, uint32_t margin, uint32_t by)
{
    const uint32_t end = (to + margin + by - 1) / by * by;
    return (struct range) { from > margin ? (from - margin) / by * by : 0, end < (uint32_t)all ? end : (uint32_t)all };
}

/* True if the tile needs rows or columns from the opposite side of the picture. A picture of all directions continues
 * beyond each edge at the opposite edge (shaders/ray/around.glsl), and so does the light of points. */
static bool needs_all_round(const struct kd_scene *scene, const struct range *x, const struct range *y)
{
    return scene->camera.projection == KD_PROJECTION_EQUIRECTANGULAR &&
           (!x->from || !y->from || x->to == (uint32_t)scene->image.width || y->to == (uint32_t)scene->image.height);
}

struct kd_scene kd_tile_with_margin(const struct kd_scene *scene, struct kd_window *cut)
{
    const struct kd_window t = kd_scene_window(scene);
    const bool points = kd_emit_points(scene);
    const uint32_t margin = points ? MARGIN_OF_POINTS : MARGIN, by = points ? KD_STAR_TILE : 1;
    const struct range y = widen(t.top, t.top + t.height, scene->image.height, margin, by);
    struct range x = widen(t.left, t.left + t.width, scene->image.width, margin, by);
    if (points && needs_all_round(scene, &x, &y))
        x = (struct range) { 0, (uint32_t)scene->image.width };
    if (cut)
        *cut = (struct kd_window) { t.left - x.from, t.top - y.from, t.width, t.height };
    return kd_scene_tile(scene, (struct kd_window) { x.from, y.from, x.to - x.from, y.to - y.from });
}

static uint32_t rows_of(const struct kd_window *window, uint32_t n) { return (window->height + n - 1) / n; }

uint32_t kd_tile_strips(const struct kd_scene *scene, uint32_t n)
{
    const struct kd_window window = kd_scene_window(scene);
    const uint32_t rows = rows_of(&window, n);
    return (window.height + rows - 1) / rows;
}

struct kd_scene kd_tile_strip(const struct kd_scene *scene, uint32_t n, uint32_t i)
{
    struct kd_window window = kd_scene_window(scene);
    const uint32_t rows = rows_of(&window, n), first = i * rows, left = window.height - first;
    window.top += first;
    window.height = left < rows ? left : rows;
    return kd_scene_tile(scene, window);
}

/* Copies layers from the device to the frame, and shows one of them in false colour. */
#include "render/frame/job.h"

#include "image/legend.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum kd_status kd_frame_add_layers(struct kd_frame *frame, const struct kd_plan_picture *picture,
                                   struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (picture->radiance)
        status = kd_frame_add_layer(frame, "radiance", 3, KD_LAYER_F32, error);
    for (size_t i = 0; i < picture->n_layers && !status; i++) {
        char name[KD_LAYER_NAME];
        kd_layer_name(picture->layers[i], name);
        status = kd_frame_add_layer(frame, name, 1, KD_LAYER_F32, error);
    }
    return status;
}

/* Reads one band of a layer, up to the last row whose light is complete. */
static enum kd_status read_band(struct kd_frame_job *j, uint32_t band, struct kd_vk_buffer *from, uint64_t offset,
                                const struct kd_layer *to)
{
    struct kd_vk *vk = j->r->vk;
    size_t pixel = kd_layer_pixel_bytes(to), bytes = pixel * j->plan->picture.width * kd_frame_band_lit(j, band);
    size_t first = pixel * j->plan->picture.width * kd_frame_band_first(j, band);
    enum kd_status status;
    KD_TRY(kd_vk_copy(vk, "readback", j->store->readback, 0, from, offset, bytes, j->error));
    KD_TRY(kd_vk_submit(vk, NULL, j->error));
    KD_TRY(kd_vk_wait(vk, 0, j->error));
    memcpy((char *)to->data + first, kd_vk_buffer_map(j->store->readback), bytes);
done:
    return status;
}

static enum kd_status read_all(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    struct kd_layer *layer = &j->frame->layers[1];
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < p->picture.bands && kd_frame_band_lit(j, band) && !status; band++) {
        if (p->picture.radiance)
            status = read_band(j, band, j->store->radiance.buffers[band], 0, layer);
        for (size_t i = 0; i < p->picture.n_layers && !status; i++)
            status = read_band(j, band, j->store->layers.buffers[band], i * kd_plan_layer_bytes(&p->picture),
                               &layer[i + (p->picture.radiance ? 1 : 0)]);
    }
    return status;
}

/* Returns the least and the largest value. On a logarithmic scale only values above 0 count. If there are no values,
 * returns 0 and 1, or 1 and 10 if the scale is logarithmic. */
static struct kd_map_scale extent_of(const float *values, size_t n, bool logarithmic)
{
    struct kd_map_scale extent = { INFINITY, -INFINITY, false };
    for (size_t i = 0; i < n; i++) {
        if (isinf(values[i]) || (logarithmic && values[i] <= 0))
            continue;
        extent.low = values[i] < extent.low ? values[i] : extent.low; /* the comparison is false for NaN */
        extent.high = values[i] > extent.high ? values[i] : extent.high;
    }
    return extent.low <= extent.high ? extent : (struct kd_map_scale) { logarithmic, logarithmic ? 10 : 1, false };
}

/* Ends of the colour scale. An end comes from the scene's field if that is set. Otherwise it comes from the kind of
 * layer, or from the values if the kind has no ends. A diverging map is centred at 0, or at 1 if it is logarithmic,
 * with both ends equally far from the centre. */
static struct kd_map_scale scale_of(const struct kd_scene *scene, const struct kd_layer_kind *kind, const float *values,
                                    size_t n)
{
    const struct kd_map_scale extent = extent_of(values, n, kind->scale.logarithmic);
    struct kd_map_scale scale = kind->scale;
    double most = fmax(extent.high, 1 / fmax(extent.low, 1e-3));
    bool about_one = kind->map == KD_MAP_DIVERGING && scale.logarithmic,
         about_zero = kind->map == KD_MAP_DIVERGING && !scale.logarithmic;
    double far = fmax(fmax(extent.high, -extent.low), 1e-30);
    scale.low = !isnan(scale.low) ? scale.low : about_one ? 1 / fmax(most, 1.01) : about_zero ? -far : extent.low;
    scale.high = !isnan(scale.high) ? scale.high : about_one ? fmax(most, 1.01) : about_zero ? far : extent.high;
    scale.low = isfinite(scene->image.layer_min) ? scene->image.layer_min : scale.low;
    scale.high = isfinite(scene->image.layer_max) ? scene->image.layer_max : scale.high;
    /* An end that the scene sets may be beyond all values. In that case all values have the colour of that end, and
     * the scale is not reversed. */
    if (scale.low > scale.high && isfinite(scene->image.layer_min))
        scale.high = scale.low + fabs(scale.low) + 1;
    else if (scale.low > scale.high)
        scale.low = scale.logarithmic ? scale.high / 2 : scale.high - fabs(scale.high) - 1;
    return scale;
}

static void paint(const struct kd_canvas *to, uint32_t rows, const float *values, const struct kd_legend *legend,
                  const struct kd_map_table *table)
{
    for (uint32_t y = 0; y < rows; y++)
        for (uint32_t x = 0; x < to->width; x++) {
            double value = values[(size_t)y * to->width + x];
            struct kd_map_colour c = { 0, 0, 0 };
            if (!isnan(value))
                c = legend->map == KD_MAP_CATEGORICAL
                        ? table->at[(size_t)fmin(value, KD_MAP_ENTRIES - 1)]
                        : kd_map_table_at(table, kd_map_scale_place(&legend->scale, value));
            kd_canvas_put(to, x, y, c);
        }
}

static enum kd_status show(struct kd_frame_job *j)
{
    const struct kd_layer *layer = &j->frame->layers[1];
    const struct kd_layer_kind *kind = &kd_layer_kinds[j->plan->picture.layers[0].kind];
    const struct kd_canvas canvas = { kd_frame_pixels(j->frame), j->frame->width, j->frame->height,
                                      kd_frame_bit_depth(j->frame) };
    struct kd_map_table *table = malloc(sizeof *table);
    char title[KD_LAYER_NAME + 16];
    size_t n = (size_t)canvas.width * j->lit;
    if (!table)
        return kd_error_set(j->error, KD_ENOMEM, "out of memory for the colours of a layer");
    snprintf(title, sizeof title, *kind->unit ? "%s (%s)" : "%s", layer->name, kind->unit);
    const struct kd_legend legend = {
        .title = title,
        .map = kind->map,
        .scale = scale_of(j->scene, kind, layer->data, n),
        .names = kind->classes,
        .classes = kind->n_classes ? kind->n_classes : (uint32_t)extent_of(layer->data, n, false).high + 1,
    };
    kd_colour_map_fill(table, kind->map);
    paint(&canvas, j->lit, layer->data, &legend, table);
    if (j->scene->image.legend)
        kd_legend_draw(&canvas, &legend);
    free(table);
    return KD_OK;
}

/* Checks that a layer's values are finite, as light must be. An infinite value has overflowed; no 32-bit number
 * would be right, so the layer is refused. */
static enum kd_status check_light(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const size_t all = (size_t)p->picture.width * j->lit;
    for (size_t i = 0; i < p->picture.n_layers; i++) {
        const struct kd_layer *layer = &j->frame->layers[1 + i + (p->picture.radiance ? 1 : 0)];
        const struct kd_layer_kind *kind = &kd_layer_kinds[p->picture.layers[i].kind];
        size_t n = 0;
        for (size_t k = 0; k < all && kind->of == KD_OF_LIGHT; k++)
            n += isinf(((const float *)layer->data)[k]) != 0;
        if (n)
            return kd_error_field(
                j->error, "/image/layers",
                "image.layers has %s, which exceeds 3.4e38%s%s, the largest number of 32 bits, in %zu of %zu pixels: "
                "the matter must be dimmer, with a smaller density, temperature or emissivity of `volume`",
                layer->name, *kind->unit ? " " : "", kind->unit, n, all);
    }
    return KD_OK;
}

enum kd_status kd_frame_layers(struct kd_frame_job *j)
{
    enum kd_status status = kd_frame_gather(j);
    if (!status && (j->plan->picture.n_layers || j->plan->picture.radiance))
        status = read_all(j);
    if (!status)
        status = check_light(j);
    return !status && kd_plan_is_map(&j->plan->picture) ? show(j) : status;
}

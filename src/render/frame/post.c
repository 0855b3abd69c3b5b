/* The post pass: converts light to pixels, and copies them to the host. */
#include "render/frame/job.h"

#include "image/legend.h"
#include "image/sky_scale.h"
#include "render/emit/radio.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Makes the buffer with the colours of style.palette. */
static enum kd_status make_palette(struct kd_frame_job *j)
{
    struct kd_map_table *table = malloc(sizeof *table);
    enum kd_status status =
        table ? KD_OK : kd_error_set(j->error, KD_ENOMEM, "out of memory for the colours of a palette");
    if (!status)
        status =
            kd_vk_buffer_create(j->r->vk, 16 * KD_MAP_ENTRIES, KD_VK_UPLOAD, "palette", &j->store->palette, j->error);
    if (!status) {
        float *to = kd_vk_buffer_map(j->store->palette);
        kd_colour_map_fill(table, KD_MAP_HEAT);
        for (size_t i = 0; i < KD_MAP_ENTRIES; i++) {
            const float colour[] = { (float)table->at[i].r, (float)table->at[i].g, (float)table->at[i].b, 0 };
            memcpy(to + 4 * i, colour, sizeof colour);
        }
    }
    free(table);
    return status;
}

/* Draws scales for brightness and for size on the sky. */
static void draw_scales(struct kd_frame_job *j)
{
    const struct kd_frame *frame = j->frame;
    const struct kd_canvas canvas = { kd_frame_pixels(frame), frame->width, frame->height, kd_frame_bit_depth(frame) };
    /* the light of a volume has a temperature; the light of a disk is relative to its hottest place, even at one
     * frequency */
    const bool kelvin = j->scene->disk.model == KD_DISK_NONE && kd_scene_is_radio_alone(j->scene);
    const struct kd_legend legend = {
        .title = kelvin ? "brightness, 1e9 K" : "I / I_max of the disk",
        .map = KD_MAP_HEAT,
        .scale = { 0, exp2(-frame->exposure) * (kelvin ? kd_radio_kelvin(j->scene) / 1e9 : 1), false },
    };
    const double width = kd_scene_width_uas(j->scene);
    kd_legend_draw(&canvas, &legend);
    if (!isnan(width))
        kd_sky_scale_draw(&canvas, &(struct kd_sky_scale) { width / frame->width, j->scene->style.beam_uas });
}

/* The conversion of light to pixels of 8 or 16 bits, with or without dither and bloom. bare: true for the completed
 * light without beam and palette, false for the light as requested. */
struct look {
    bool wide, dither, bare;
    const struct kd_bloom *bloom;
    void *to;
};

static bool has_heat(const struct kd_frame_job *j, const struct look *look)
{
    return !look->bare && j->scene->style.palette == KD_PALETTE_HEAT;
}

static enum kd_status kernel_of(struct kd_frame_job *j, const struct look *look, const struct kd_vk_pipeline **out)
{
    struct kd_vk *vk = j->r->vk;
    const struct kd_spec_post spec = {
        .ACES = j->scene->style.tone_map == KD_TONE_ACES,
        .NEUTRAL = j->scene->style.tone_map == KD_TONE_NEUTRAL,
        .WIDE = look->wide,
        .COLUMNS = kd_bloom_together(look->bloom, j->plan->picture.width),
        .AROUND = look->bloom->around,
    };
    const uint64_t band_pixels = (uint64_t)j->plan->picture.width * j->plan->picture.band_rows;
    const enum kd_kernel kernel =
        kd_kernel_post(kd_kernels_texels(vk, band_pixels) && kd_kernels_cells_as_texels(vk, look->bloom),
                       look->bloom->levels, has_heat(j, look));
    return kd_kernels_get(&j->r->kernels, vk, kernel, &spec.ACES, sizeof spec / 4, out, j->error);
}

/* Copies the counts of a band, which are stored after the band's pixels (KD_POST_COUNTS). The light before the beam
 * has the count of rays that were given up. */
static enum kd_status count(struct kd_frame_job *j, uint32_t band, uint64_t at)
{
    struct kd_vk_buffer *light = j->store->radiance.buffers[band];
    const char *pass = kd_passes[KD_PASS_READBACK].name;
    enum kd_status status;
    KD_TRY(kd_vk_copy(j->r->vk, pass, j->store->readback, at, light, kd_vk_buffer_size(light) - 4, 4, j->error));
    KD_TRY(kd_vk_copy(j->r->vk, pass, j->store->readback, at + 4, j->store->words, at, 4, j->error));
done:
    return status;
}

static uint64_t counted(const struct kd_store *s, uint64_t at)
{
    const uint32_t *two = (const uint32_t *)kd_vk_buffer_map(s->readback) + at / 4;
    return (uint64_t)two[0] + two[1];
}

/* Runs the post pass on completed light and reads the pixels back, one band at a time. */
static enum kd_status post_as(struct kd_frame_job *j, const struct look *look)
{
    struct kd_frame *frame = j->frame;
    struct kd_vk *vk = j->r->vk;
    struct kd_store *s = j->store;
    const struct kd_scene *scene = j->scene;
    const struct kd_window window = kd_scene_window(scene);
    const struct kd_vk_pipeline *post;
    const size_t pixel_bytes = look->wide ? 6 : 3;
    const struct kd_bloom *bloom = look->bloom;
    const struct kd_vk_binding cells = { s->bloom, bloom->sums[0], 16ull * kd_bloom_cells(bloom, 0), false };
    const uint64_t band_pixels = (uint64_t)j->plan->picture.width * j->plan->picture.band_rows;
    const uint64_t counts = kd_post_bytes(band_pixels, look->wide ? 16 : 8);
    enum kd_status status = KD_OK;
    if (has_heat(j, look) && !s->palette)
        KD_TRY(make_palette(j));
    if (!look->bare)
        frame->accuracy.lost = 0;
    for (uint32_t band = 0; band < j->plan->picture.bands && kd_frame_band_lit(j, band); band++) {
        KD_TRY(kernel_of(j, look, &post));
        uint32_t pixels = frame->width * kd_frame_band_lit(j, band);
        uint32_t first = frame->width * kd_frame_band_first(j, band);
        struct kd_post_push push = {
            .gain = (float)exp2(frame->exposure),
            .dither = look->dither,
            .pixels = pixels,
            .first = first,
            .pixels_x = frame->width,
            .left = (float)window.left,
            .top = (float)window.top,
            .counter = look->bare ? 0 : (uint32_t)(counts / 4),
            .bloom = (float)bloom->strength,
            .scale_x = (float)bloom->columns / (float)frame->width,
            .scale_y = (float)bloom->rows / (float)frame->height,
            .cells_x = bloom->columns,
            .cells_y = bloom->rows,
        };
        const struct kd_vk_binding colours = { s->palette, 0, 0, false };
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_POST].name,
            post,
            { { look->bare ? s->radiance.buffers[band] : kd_frame_band_light(j, band), 0,
                kd_post_radiance_bytes(band_pixels), false },
              { s->words, 0, 0, true },
              bloom->levels ? cells : colours,
              colours },
            &push,
            { kd_post_groups(pixels) },
        };
        KD_TRY(kd_vk_fill(vk, d.pass, s->words, counts, 4, 0, j->error));
        KD_TRY(kd_vk_dispatch(vk, &d, j->error));
        KD_TRY(kd_vk_copy(vk, kd_passes[KD_PASS_READBACK].name, s->readback, 0, s->words, 0,
                          (pixels * pixel_bytes + 3) / 4 * 4, j->error));
        KD_TRY(count(j, band, counts));
        KD_TRY(kd_vk_submit(vk, NULL, j->error));
        KD_TRY(kd_vk_wait(vk, 0, j->error));
        memcpy((char *)look->to + first * pixel_bytes, kd_vk_buffer_map(s->readback), pixels * pixel_bytes);
        if (!look->bare)
            frame->accuracy.lost += counted(s, counts);
        KD_TRY(kd_frame_report(j, look->bare ? 0 : kd_frame_band_rows(j, band)));
    }
    if (!look->bare && scene->style.colour_bar && !kd_plan_is_map(&j->plan->picture))
        draw_scales(j);
done:
    return status;
}

enum kd_status kd_frame_post(struct kd_frame_job *j)
{
    const struct look look = { kd_frame_bit_depth(j->frame) == 16, j->scene->style.dither, false,
                               &j->plan->picture.bloom, kd_frame_pixels(j->frame) };
    return post_as(j, &look);
}

enum kd_status kd_frame_post_kernel(struct kd_frame_job *j, const struct kd_vk_pipeline **out)
{
    const struct look look = { .wide = j->scene->image.bit_depth == 16, .bloom = &j->plan->picture.bloom };
    return kernel_of(j, &look, out);
}

enum kd_status kd_frame_bare(struct kd_frame_job *j, uint16_t *to)
{
    static const struct kd_bloom none;
    const struct look look = { .wide = true, .bare = true, .bloom = &none, .to = to };
    return post_as(j, &look);
}

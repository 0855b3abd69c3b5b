/* The pass that makes pixels of light, and their way to the host. */
#include "render/frame/job.h"

#include <math.h>
#include <string.h>

/* Post and read back what is lit, one band at a time. */
enum kd_status kd_frame_post(struct kd_frame_job *j)
{
    struct kd_frame *frame = j->frame;
    struct kd_vk *vk = j->r->vk;
    struct kd_store *s = j->store;
    const struct kd_scene *scene = j->scene;
    const struct kd_vk_pipeline *post;
    bool wide = kd_frame_bit_depth(frame) == 16;
    size_t pixel_bytes = kd_layer_pixel_bytes(&frame->layers[0]);
    const struct kd_bloom *bloom = &j->plan->bloom;
    const struct kd_spec_post spec = {
        .ACES = scene->style.tone_map == KD_TONE_ACES, .NEUTRAL = scene->style.tone_map == KD_TONE_NEUTRAL, .WIDE = wide,
        .TOGETHER = kd_bloom_together(bloom, j->plan->width),
    };
    const uint64_t band_pixels = (uint64_t)j->plan->width * j->plan->band_rows;
    const enum kd_kernel kernel = kd_kernel_post(kd_kernels_texels(vk, band_pixels) && kd_kernels_cells_as_texels(vk, bloom), bloom->levels);
    enum kd_status status = KD_OK;
    for (uint32_t band = 0; band < j->plan->bands && kd_frame_band_lit(j, band); band++) {
        KD_TRY(kd_kernels_get(&j->r->kernels, vk, kernel, &spec.ACES, sizeof spec / 4, &post, j->error));
        uint32_t pixels = frame->width * kd_frame_band_lit(j, band);
        uint32_t first = frame->width * kd_frame_band_first(j, band);
        struct kd_post_push push = {
            .gain = (float)exp2(frame->exposure),
            .dither = scene->style.dither,
            .pixels = pixels,
            .first = first,
            .pixels_x = frame->width,
            .bloom = (float)bloom->strength,
            .scale_x = (float)bloom->columns / (float)frame->width,
            .scale_y = (float)bloom->rows / (float)frame->height,
            .cells_x = bloom->columns,
            .cells_y = bloom->rows,
        };
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_POST].name, post,
            { { s->radiance.buffers[band], 0, kd_post_radiance_bytes(band_pixels), false },
              { s->words, 0, 0, true },
              { s->bloom, bloom->sums[0], 16ull * kd_bloom_cells(bloom, 0), false } },
            &push, { kd_post_groups(pixels) },
        };
        KD_TRY(kd_vk_dispatch(vk, &d, j->error));
        KD_TRY(kd_vk_copy(vk, kd_passes[KD_PASS_READBACK].name, s->readback, 0, s->words, 0, (pixels * pixel_bytes + 3) / 4 * 4, j->error));
        KD_TRY(kd_vk_submit(vk, NULL, j->error));
        KD_TRY(kd_vk_wait(vk, 0, j->error));
        memcpy((char *)kd_frame_pixels(frame) + first * pixel_bytes, kd_vk_buffer_map(s->readback), pixels * pixel_bytes);
        KD_TRY(kd_frame_report(j, kd_frame_band_rows(j, band)));
    }
done:
    return status;
}

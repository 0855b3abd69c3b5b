/* Synthetic light for tests of the passes that follow light: beam, expose, bloom and post. */
#ifndef KD_TEST_MADE_UP_LIGHT_H
#define KD_TEST_MADE_UP_LIGHT_H

#include "render_support.h"

#include "render/frame/job.h"

enum { MOST = 640 * 360 };
static float light[3 * MOST]; /* light in linear sRGB, for each pixel of the plan */
static uint16_t pixels[3 * MOST], others[3 * MOST];

/* Shows the light as pixels of 16 bits. lit: number of rows, from the top, whose light is complete. Returns the
 * exposure that was used. */
static inline double show_light(const struct kd_scene *scene, const struct kd_plan *plan, uint32_t lit, uint16_t *out)
{
    struct kd_vk *vk = renderer->vk;
    struct kd_vk_buffer *staging;
    struct kd_error why = { 0 };
    struct kd_frame frame = { .width = plan->picture.width, .height = plan->picture.height };
    struct kd_frame_job job = { .r = renderer,
                                .store = &renderer->store,
                                .scene = scene,
                                .plan = plan,
                                .frame = &frame,
                                .weight = 1,
                                .lit = lit,
                                .error = &why };
    OK(kd_frame_add_layer(&frame, "rgb", 3, KD_LAYER_U16, &error));
    memset(kd_frame_pixels(&frame), 0, 6ull * plan->picture.width * plan->picture.height);
    OK(kd_store_frame(&renderer->store, plan, 16, &error));
    OK(kd_vk_buffer_create(vk, 12ull * plan->picture.width * plan->picture.height, KD_VK_UPLOAD, "light", &staging,
                           &error));
    memcpy(kd_vk_buffer_map(staging), light, 12ull * plan->picture.width * plan->picture.height);
    for (uint32_t band = 0; band < plan->picture.bands; band++)
        OK(kd_vk_copy(vk, "upload", renderer->store.radiance.buffers[band], 0, staging,
                      12ull * plan->picture.width * kd_frame_band_first(&job, band),
                      12ull * plan->picture.width * kd_frame_band_rows(&job, band), &error));
    OK(kd_frame_beam(&job));
    OK(kd_frame_expose(&job));
    OK(kd_frame_bloom(&job));
    OK(kd_frame_post(&job));
    memcpy(out, kd_frame_pixels(&frame), 6ull * plan->picture.width * plan->picture.height);
    kd_vk_buffer_destroy(vk, staging);
    kd_frame_finish(&frame);
    return frame.exposure;
}

#endif

/* Replaces the light of a picture by the mean of its light and that of other pictures, before any later pass. */
#include "render/frame/job.h"

#include <string.h>

static void mix(float *light, const double *sum, size_t n, unsigned pictures)
{
    for (size_t i = 0; i < n; i++)
        light[i] = (float)((sum[i] + light[i]) / pictures);
}

enum kd_status kd_frame_mean(struct kd_frame_job *j)
{
    struct kd_vk *vk = j->r->vk;
    struct kd_vk_buffer *staging = NULL;
    const uint64_t row = (uint64_t)3 * j->plan->picture.width,
                   band_bytes = sizeof(float) * row * j->plan->picture.band_rows;
    enum kd_status status;
    KD_TRY(kd_vk_buffer_create(vk, band_bytes, KD_VK_UPLOAD, "mean light on the host", &staging, j->error));
    for (uint32_t band = 0; band < j->plan->picture.bands; band++) {
        const uint64_t n = row * kd_frame_band_rows(j, band);
        float *light = kd_vk_buffer_map(staging);
        KD_TRY(kd_vk_copy(vk, "readback", j->store->readback, 0, j->store->radiance.buffers[band], 0, sizeof(float) * n,
                          j->error));
        KD_TRY(kd_vk_submit(vk, NULL, j->error));
        KD_TRY(kd_vk_wait(vk, 0, j->error));
        memcpy(light, kd_vk_buffer_map(j->store->readback), sizeof(float) * n);
        mix(light, j->others->sum + row * kd_frame_band_first(j, band), n, j->others->n + 1);
        KD_TRY(kd_vk_copy(vk, "upload", j->store->radiance.buffers[band], 0, staging, 0, sizeof(float) * n, j->error));
        KD_TRY(kd_vk_submit(vk, NULL, j->error));
        KD_TRY(kd_vk_wait(vk, 0, j->error));
    }
done:
    kd_vk_buffer_destroy(vk, staging);
    return status;
}

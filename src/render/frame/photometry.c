/* The light pass: sums the light of a picture to flux and centroid (render/plan/photometry.h). */
#include "render/frame/job.h"

#include "render/view/camera.h"

#include <math.h>

/* Sums the light of all bands and copies the sums to the host. */
enum kd_status kd_frame_add_light(struct kd_frame_job *j)
{
    const struct kd_plan *p = j->plan;
    const struct kd_vk_pipeline *light;
    bool finite = !isinf(j->scene->camera.r);
    const uint64_t sums = kd_light_bytes(p) / p->picture.bands; /* the sums are bound band by band, because together
                                                                 * they may exceed one binding */
    const struct kd_spec_photometry spec = { .SEPARATE_PHOTOMETRY = p->light.apart,
                                             .FINITE = finite,
                                             .STOKES = p->light.stokes_words > 0,
                                             .STOKES_APART = kd_plan_stokes_apart(&p->light) };
    const uint32_t per_band = kd_light_groups(p->picture.width * p->picture.band_rows);
    enum kd_status status;
    KD_TRY(kd_kernels_get(&j->r->kernels, j->r->vk, KD_KERNEL_PHOTOMETRY, &spec.SEPARATE_PHOTOMETRY, sizeof spec / 4,
                          &light, j->error));
    for (uint32_t band = 0; band < p->picture.bands; band++) {
        const struct kd_light_push push = {
            .pixels_x = p->picture.width,
            .pixels = p->picture.width * kd_frame_band_rows(j, band),
            .row0 = kd_frame_band_first(j, band),
            .spots = 3 * p->picture.width * p->picture.band_rows,
            .stokes = (p->light.apart ? 4 : 3) * p->picture.width * p->picture.band_rows,
            .plane = p->picture.width * p->picture.band_rows,
            .middle_x = (float)(0.5 * (p->picture.width - 1)),
            .middle_y = (float)(0.5 * (p->picture.height - 1)),
            .step_ = (float)(finite ? kd_camera_pixel(j->scene) : 0),
        };
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_LIGHT].name,
            light,
            { { j->store->radiance.buffers[band], 0, 0, false }, { j->store->light, band * sums, sums, true } },
            &push,
            { per_band }, /* the last band is smaller but also has this size: its surplus groups write zeros */
        };
        KD_TRY(kd_vk_dispatch(j->r->vk, &d, j->error));
    }
    KD_TRY(kd_vk_copy(j->r->vk, kd_passes[KD_PASS_LIGHT].name, j->store->light_host, 0, j->store->light, 0,
                      kd_light_bytes(p), j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
done:
    return status;
}

enum kd_status kd_frame_read_light(struct kd_frame_job *j)
{
    enum kd_status status = kd_vk_wait(j->r->vk, 0, j->error);
    if (status)
        return status;
    j->frame->light = kd_light_of(j->scene, j->plan, kd_vk_buffer_map(j->store->light_host));
    return KD_OK;
}

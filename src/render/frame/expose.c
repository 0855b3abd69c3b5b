/* The expose pass: histogram of a picture's brightness, and the exposure if that is "auto". */
#include "render/frame/job.h"

#include <math.h>

/* Copies the histogram of the completed light to the host. */
static enum kd_status measure(struct kd_frame_job *j)
{
    struct kd_vk *vk = j->r->vk;
    struct kd_store *s = j->store;
    const struct kd_vk_pipeline *expose;
    enum kd_status status;
    KD_TRY(kd_kernels_get(&j->r->kernels, vk, KD_KERNEL_EXPOSE, NULL, 0, &expose, j->error));
    KD_TRY(kd_vk_fill(vk, kd_passes[KD_PASS_EXPOSE].name, s->histogram, 0, 4 * KD_HISTOGRAM_BINS, 0, j->error));
    for (uint32_t band = 0; band < j->plan->picture.bands && kd_frame_band_lit(j, band); band++) {
        uint32_t pixels = j->plan->picture.width * kd_frame_band_lit(j, band);
        const uint32_t push[] = { pixels, pixels > 1 << 17 ? 7 : 1 };
        uint32_t n = kd_frame_groups(pixels / push[1] / 64 + 1); /* each invocation counts about 64 pixels */
        const struct kd_vk_dispatch d = {
            kd_passes[KD_PASS_EXPOSE].name,
            expose,
            { { kd_frame_band_light(j, band), 0, 0, false }, { s->histogram, 0, 0, true } },
            push,
            { n },
        };
        KD_TRY(kd_vk_dispatch(vk, &d, j->error));
    }
    KD_TRY(
        kd_vk_copy(vk, kd_passes[KD_PASS_EXPOSE].name, s->counts, 0, s->histogram, 0, 4 * KD_HISTOGRAM_BINS, j->error));
    KD_TRY(kd_vk_submit(vk, NULL, j->error));
    KD_TRY(kd_vk_wait(vk, 0, j->error));
done:
    return status;
}

/* The log2 luminance that only the brightest pixels exceed. `share` is the number of these pixels, as a fraction of
 * the pixels with light. */
static double luminance_quantile(const uint32_t *counts, double share)
{
    uint64_t lit = 0, above = 0;
    for (int i = 1; i < KD_HISTOGRAM_BINS; i++)
        lit += counts[i];
    int bin = KD_HISTOGRAM_BINS - 1;
    for (; bin > 1; bin--) {
        above += counts[bin];
        if ((double)above > share * (double)lit)
            break;
    }
    int code = KD_HISTOGRAM_FIRST + bin + 1;
    return log2(ldexp(1 + (code & 7) / 8.0, (code >> 3) - 127));
}

/* Computes the exposure for "auto". sRGB clips at 1, so the brightest pixels are exposed to 1. The top four in a
 * thousand of the pixels with light are ignored. The film-like curve has a long shoulder, so with it the brightest
 * pixels may be above white. The larger the range from the median to these pixels, the further above white they may
 * be. The dim side of a beamed disk thus stays visible. all: if true, no pixels are ignored, because light smoothed
 * by a beam reaches its true maximum in a pixel. */
static double auto_exposure(const uint32_t *counts, int tone_map, bool all)
{
    double white = luminance_quantile(counts, all ? 0 : 0.004), median = luminance_quantile(counts, 0.5);
    double over = tone_map != KD_TONE_SRGB ? fmin(fmax(0.45 * (white - median), 0.75), 2.75) : 0;
    return over - white;
}

enum kd_status kd_frame_expose(struct kd_frame_job *j)
{
    const struct kd_scene *scene = j->scene;
    j->frame->exposure = scene->style.exposure;
    if (!isinf(scene->style.exposure))
        return KD_OK;
    enum kd_status status = measure(j);
    if (!status) {
        const double stops =
            auto_exposure(kd_vk_buffer_map(j->store->counts), scene->style.tone_map, j->plan->picture.beam.cell);
        j->frame->exposure = kd_plan_exposure(&j->plan->picture, fmin(stops, kd_scene_exposure_most(scene)));
    }
    return status;
}

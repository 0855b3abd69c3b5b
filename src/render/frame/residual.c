/* Measures the remaining error of a picture's pixels, by comparing a sample of pixels with 64 rays each. It is the last
 * pass, because it overwrites the light of the sample.
 *
 * Every kind of pixel has a sample of KD_PLAN_SAMPLED_OF_EACH pixels, or all its pixels if there are fewer. A sampled
 * pixel is weighted by the number of pixels that it represents. At the critical curve the reference may have more than
 * 64 rays; pixels that refinement has given this number of rays count as exact. */
#include "render/frame/residual.h"

#include "render/frame/lens.h"

#include <math.h>
#include <stdlib.h>

enum { AT_CURVE, ELSEWHERE, PLACES };
enum { OF_EACH = KD_PLAN_SAMPLED_OF_EACH, KINDS = KD_REFINED_KINDS };

/* Sampled pixels, either at the critical curve or elsewhere, row by row, and the number of pixels that each
 * represents. */
struct sample {
    struct kd_pixel pixels[KINDS * OF_EACH];
    double weights[KINDS * OF_EACH];
    size_t n;
};

static void film(double c[3])
{
    static const double into[3][3] = { { 0.59719, 0.35458, 0.04823 },
                                       { 0.07600, 0.90834, 0.01566 },
                                       { 0.02840, 0.13383, 0.83777 } };
    static const double outof[3][3] = { { 1.60475, -0.53108, -0.07367 },
                                        { -0.10208, 1.10813, -0.00605 },
                                        { -0.00327, -0.07276, 1.07602 } };
    double d[3];
    for (int i = 0; i < 3; i++) {
        double x = into[i][0] * fmin(c[0], 1e6) + into[i][1] * fmin(c[1], 1e6) + into[i][2] * fmin(c[2], 1e6);
        d[i] = (x * (x + 0.0245786) - 0.000090537) / (x * (0.983729 * x + 0.4329510) + 0.238081);
    }
    for (int i = 0; i < 3; i++)
        c[i] = outof[i][0] * d[0] + outof[i][1] * d[1] + outof[i][2] * d[2];
}

static void neutral(double c[3])
{
    const double start = 0.8 - 0.04, d = 1 - start;
    double least = fmin(fmin(c[0], 1e6), fmin(c[1], c[2])), peak = 0, shown;
    for (int i = 0; i < 3; i++) {
        c[i] = fmin(c[i], 1e6) - (least < 0.08 ? least - 6.25 * least * least : 0.04);
        peak = fmax(peak, c[i]);
    }
    if (peak < start)
        return;
    shown = 1 - d * d / (peak + d - start);
    double white = 1 - 1 / (0.15 * (peak - shown) + 1);
    for (int i = 0; i < 3; i++)
        c[i] = (1 - white) * c[i] * shown / peak + white * shown;
}

/* The conversion of post.comp in double precision; post.comp cites the sources. */
void kd_frame_shown(const float light[3], double gain, int32_t tone_map, double out[3])
{
    double c[3] = { gain * light[0], gain * light[1], gain * light[2] };
    if (tone_map == KD_TONE_ACES)
        film(c);
    else if (tone_map == KD_TONE_NEUTRAL)
        neutral(c);
    for (int i = 0; i < 3; i++) {
        double x = fmin(fmax(c[i], 0), 1);
        out[i] = x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
    }
}

static int by_size(const void *a, const void *b)
{
    const uint64_t p = *(const uint64_t *)a, q = *(const uint64_t *)b;
    return (p > q) - (p < q);
}

/* Chooses some of n pixels, in order. The chosen indices form a lattice with the golden ratio as its step. Such a
 * lattice coincides with no regular grid. */
static size_t chosen(uint64_t n, uint64_t at[OF_EACH])
{
    const size_t k = n < OF_EACH ? (size_t)n : OF_EACH;
    for (size_t i = 0; i < k; i++)
        at[i] = k == n ? i : (uint64_t)(fmod(0.5 + (double)i * 0.61803398874989485, 1) * (double)n);
    qsort(at, k, sizeof *at, by_size);
    return k;
}

static void draw(const struct kd_frame_job *j, struct sample of_place[PLACES])
{
    const size_t width = j->plan->picture.width, pixels = width * j->plan->picture.height;
    uint64_t of[KINDS] = { 0 }, seen[KINDS] = { 0 }, at[KINDS][OF_EACH];
    size_t k[KINDS] = { 0 }, next[KINDS] = { 0 };
    for (size_t i = 0; i < pixels; i++)
        of[j->kinds[i]]++;
    for (int kind = 0; kind < KINDS; kind++)
        k[kind] = kind == KD_REFINED_AT_CURVE ? 0 : chosen(of[kind], at[kind]);
    of_place[AT_CURVE].n = of_place[ELSEWHERE].n = 0;
    for (size_t i = 0; i < pixels; i++) {
        const uint8_t kind = j->kinds[i];
        struct sample *s = &of_place[kind == KD_REFINED_NOT_AT_CURVE ? AT_CURVE : ELSEWHERE];
        const uint64_t here = seen[kind]++;
        if (next[kind] == k[kind] || at[kind][next[kind]] != here)
            continue;
        while (next[kind] < k[kind] && at[kind][next[kind]] == here)
            next[kind]++;
        s->pixels[s->n] = (struct kd_pixel) { (uint32_t)(i % width), (uint32_t)(i / width) };
        s->weights[s->n++] = (double)of[kind] / (double)k[kind];
    }
}

/* Copies the light of the sample to the host. */
static enum kd_status read_sample(struct kd_frame_job *j, const struct sample *s, struct kd_vk_buffer *host)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < s->n && !status; i++) {
        const uint32_t band = s->pixels[i].y / j->plan->picture.band_rows;
        const uint64_t at =
            12 * ((uint64_t)(s->pixels[i].y - kd_frame_band_first(j, band)) * j->plan->picture.width + s->pixels[i].x);
        status = kd_vk_copy(j->r->vk, kd_passes[KD_PASS_REFINE].name, host, 12 * i, j->store->radiance.buffers[band],
                            at, 12, j->error);
    }
    if (!status)
        status = kd_vk_submit(j->r->vk, NULL, j->error);
    return status ? status : kd_vk_wait(j->r->vk, 0, j->error);
}

static enum kd_status light_sample(struct kd_frame_job *j, const struct sample *s, int place)
{
    const struct kd_critical_pixels pixels = { (struct kd_pixel *)(uintptr_t)s->pixels, s->n };
    struct kd_frame_list truth = {
        .pixels = &pixels,
        .lattice = kd_critical_grid(KD_PLAN_TRUTH_SIDE),
        .camera = KD_CAMERA_TRUTH,
        .buffers = &j->store->listed,
        .again = true,
        .pass = kd_passes[KD_PASS_REFINE].name,
    };
    if (place == AT_CURVE) {
        truth.lattice = kd_critical_lattice(j->plan->lens.critical_dense);
        truth.camera = KD_CAMERA_DENSE_CRITICAL;
    }
    truth.most = kd_plan_listed_most(&j->plan->lens, truth.lattice.rays);
    return kd_frame_light_list(j, &truth, true);
}

/* Weighted sum of squared differences. */
static double compare(const struct kd_frame_job *j, const struct sample *s, const float *had, const float *truth,
                      double *worst)
{
    double gain = exp2(j->frame->exposure), sum = 0;
    const int32_t tone_map = j->scene->style.tone_map;
    for (size_t i = 0; i < s->n; i++) {
        double a[3], b[3];
        kd_frame_shown(had + 3 * i, gain, tone_map, a);
        kd_frame_shown(truth + 3 * i, gain, tone_map, b);
        for (int c = 0; c < 3; c++) {
            sum += s->weights[i] * (a[c] - b[c]) * (a[c] - b[c]) / 3;
            *worst = fmax(*worst, fabs(a[c] - b[c]));
        }
    }
    return sum;
}

enum kd_status kd_frame_residual(struct kd_frame_job *j)
{
    struct sample samples[PLACES];
    struct kd_vk_buffer *host[2] = { NULL, NULL };
    struct kd_accuracy_report *to = &j->frame->accuracy;
    double sum = 0;
    enum kd_status status = KD_OK;
    draw(j, samples);
    for (int i = 0; i < 2; i++)
        KD_TRY(kd_vk_buffer_create(j->r->vk, sizeof(float[3]) * KINDS * OF_EACH, KD_VK_READBACK,
                                   "a sample of the light", &host[i], j->error));
    for (int place = 0; place < PLACES; place++) {
        const struct sample *s = &samples[place];
        if (!s->n)
            continue;
        KD_TRY(read_sample(j, s, host[0]));
        KD_TRY(light_sample(j, s, place));
        KD_TRY(read_sample(j, s, host[1]));
        sum += compare(j, s, kd_vk_buffer_map(host[0]), kd_vk_buffer_map(host[1]), &to->pixel_error_worst);
        to->pixel_sampled += (uint32_t)s->n;
    }
    to->pixel_error = sqrt(sum / ((double)j->plan->picture.width * j->plan->picture.height));
done:
    kd_vk_buffer_destroy(j->r->vk, host[0]);
    kd_vk_buffer_destroy(j->r->vk, host[1]);
    return status;
}

/* Self-test of brightness, from a ray to the numbers of a file. */
#include "render/selftest/parts.h"

#include "interface.h"
#include "render/device/device_internal.h"
#include "render/view/layout.h"

#include <float.h>
#include <math.h>

#define LEVELS 65535.0

/* Inverse of the curve of IEC 61966-2-1. */
static double decode(double v) { return v <= 0.04045 ? v / 12.92 : pow((v + 0.055) / 1.055, 2.4); }

/* A scene of one pixel with this ray, exposed to a luminance of 0.2, at which the deepest red of the gamut has a
 * red channel of 0.94. */
static struct kd_scene pixel_scene(const struct kd_selftest_ray *ray, double brightness)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = ray->spin;
    scene.camera.inclination_deg = ray->inclination_deg;
    scene.camera.centre_alpha = ray->alpha;
    scene.camera.centre_beta = ray->beta;
    scene.disk.outer = 1000;
    scene.disk.taper = 0;
    scene.image.width = scene.image.height = 1;
    scene.image.critical_factor = 1;
    scene.image.bit_depth = 16;
    scene.style.tone_map = KD_TONE_SRGB;
    scene.style.dither = false;
    scene.style.exposure = log2(0.2 / brightness);
    scene.accuracy.orders = 1;
    return scene;
}

/* Luminance of the pixel, by the weights of the primaries in IEC 61966-2-1. */
static enum kd_status luminance(const struct kd_selftest *test, const struct kd_scene *scene, double *out)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(test->renderer, &capacity);
    enum kd_status status;
    KD_TRY(kd_scene_validate(scene, test->error));
    KD_TRY(kd_plan_make(scene, &capacity, &plan, test->error));
    KD_TRY(kd_render(test->renderer, scene, &plan, NULL, NULL, &frame, test->error));
    const uint16_t *rgb = kd_frame_pixels(&frame);
    *out = (0.2126 * decode(rgb[0] / LEVELS) + 0.7152 * decode(rgb[1] / LEVELS) + 0.0722 * decode(rgb[2] / LEVELS)) *
           exp2(-scene->style.exposure);
    kd_frame_finish(&frame);
done:
    return status;
}

/* Compares g^4 F/F_max. A file rounds a luminance of 0.2 to 16 bits, with a relative error of 0.9 (1/2)/65535 / 0.2 =
 * 3.4e-5. The tables from which T is interpolated have errors of 1e-6, which is 4e-6 for T^4. Roundoff is multiplied
 * by the gain of r for F and by four times that of g. */
static enum kd_status brightness(const struct kd_selftest *test)
{
    struct kd_selftest_row row;
    kd_selftest_begin(&row, "metric, Page & Thorne by quadrature, ray by Taylor series", "transfer, post f32",
                      "brightness of a pixel, g^4 F (relative)");
    for (size_t i = 0; i < test->reference->n_pixels; i++) {
        const struct kd_selftest_pixel *p = &test->reference->pixels[i];
        const struct kd_selftest_ray *ray = &test->reference->rays[p->ray];
        const struct kd_selftest_crossing *k = &ray->crossing[0];
        const struct kd_scene scene = pixel_scene(ray, p->brightness);
        double found;
        enum kd_status status = luminance(test, &scene, &found);
        if (status)
            return status;
        double roundoff = KD_SELFTEST_OPERATIONS * (double)(FLT_EPSILON / 2);
        kd_selftest_compare(&row, found / p->brightness - 1, 4e-5 + roundoff * (1 + 3 * k->r_gain + 4 * k->g_gain));
    }
    return kd_selftest_end(test, &row);
}

/* Encodes greys by the post kernel alone, each grey four times because an invocation makes four pixels. words[6 i]
 * starts grey i. */
static enum kd_status encode(const struct kd_selftest *test, bool film, struct kd_vk_buffer *radiance,
                             struct kd_vk_buffer *words)
{
    struct kd_renderer *r = test->renderer;
    const struct kd_vk_pipeline *post;
    uint32_t pixels = 4 * (uint32_t)test->reference->n_greys;
    const struct kd_post_push push = { .gain = 1, .pixels = pixels, .pixels_x = pixels };
    float *at = kd_vk_buffer_map(radiance);
    for (uint32_t i = 0; i < 3 * pixels; i++)
        at[i] = (float)test->reference->greys[i / 12].linear;
    const enum kd_kernel kernel = kd_kernel_post(kd_kernels_texels(r->vk, pixels), false, false);
    enum kd_status status;
    KD_TRY(kd_kernels_get(&r->kernels, r->vk, kernel, (uint32_t[]) { film, true }, 2, &post, test->error));
    const struct kd_vk_dispatch d = {
        "post", post, { { radiance, 0, 0, false }, { words, 0, 0, true } }, &push, { kd_post_groups(pixels) },
    };
    KD_TRY(kd_vk_dispatch(r->vk, &d, test->error));
    KD_TRY(kd_vk_submit(r->vk, NULL, test->error));
    KD_TRY(kd_vk_wait(r->vk, 0, test->error));
done:
    return status;
}

/* Errors are in steps of 1/65535: rounding adds half a step. The kernel's polynomial for the power (5.4e-7) and
 * Vulkan's square roots (three units in the last place) together add a fifteenth of a step. */
static enum kd_status greys(const struct kd_selftest *test, bool film, struct kd_vk_buffer *radiance,
                            struct kd_vk_buffer *words)
{
    struct kd_selftest_row row;
    kd_selftest_begin(&row, film ? "S. Hill 2016, in 38 digits" : "IEC 61966-2-1", "post f32",
                      film ? "film-like curve of greys (1/65535)" : "sRGB of greys (1/65535)");
    enum kd_status status;
    KD_TRY(encode(test, film, radiance, words));
    const uint16_t *found = kd_vk_buffer_map(words);
    for (size_t i = 0; i < test->reference->n_greys; i++) {
        const struct kd_selftest_grey *g = &test->reference->greys[i];
        for (int k = 0; k < 12; k++)
            kd_selftest_compare(&row, found[12 * i + k] - LEVELS * (film ? g->film[k % 3] : g->srgb), 1);
    }
    KD_TRY(kd_selftest_end(test, &row));
done:
    return status;
}

static enum kd_status encoding(const struct kd_selftest *test)
{
    struct kd_vk *vk = test->renderer->vk;
    struct kd_vk_buffer *radiance = NULL, *words = NULL;
    uint64_t pixels = 4 * test->reference->n_greys;
    enum kd_status status;
    KD_TRY(kd_vk_buffer_create(vk, 12 * pixels, KD_VK_UPLOAD, "greys", &radiance, test->error));
    KD_TRY(kd_vk_buffer_create(vk, kd_post_bytes(pixels, 16), KD_VK_READBACK, "encoded greys", &words, test->error));
    for (int film = 0; film < 2; film++)
        KD_TRY(greys(test, film, radiance, words));
done:
    if (status)
        kd_vk_discard(vk);
    kd_vk_buffer_destroy(vk, radiance);
    kd_vk_buffer_destroy(vk, words);
    return status;
}

enum kd_status kd_selftest_light(const struct kd_selftest *test)
{
    enum kd_status status = brightness(test);
    return status ? status : encoding(test);
}

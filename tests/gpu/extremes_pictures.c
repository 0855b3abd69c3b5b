/* Tests of whole pictures at the extremes, from JSON to pixels: one pixel, one row or column, many bands, odd shapes;
 * denormal numbers and zeros of either sign; next to the horizon. Radiance and the report must be finite, radiance must
 * not be negative, nothing may be written beyond the last pixel, and light must be where it is expected. */
#include "extremes.h"

#include "render/device/device_internal.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct picture {
    const char *what, *json;
    bool lit;         /* at least one pixel must shine */
    uint64_t binding; /* largest size of a buffer in bytes, which forces many bands; 0: the device's own */
};

#define SMALL "\"image\":{\"width\":48,\"height\":27}"
#define NEAR_EXTREMAL "\"spacetime\":{\"spin\":0.999999999999}"

static const struct picture pictures[] = {
    { "1 x 1", "{\"image\":{\"width\":1,\"height\":1},\"camera\":{\"centre_alpha\":-6}}", true, 0 },
    { "1 x 1, black", "{\"image\":{\"width\":1,\"height\":1},\"camera\":{\"inclination_deg\":0}}", false, 0 },
    { "1 x 500", "{\"image\":{\"width\":1,\"height\":500},\"camera\":{\"field_m\":0.05,\"centre_alpha\":4}}", true, 0 },
    { "500 x 1", "{\"image\":{\"width\":500,\"height\":1},\"sky\":{\"model\":\"grid\"}}", true, 0 },
    { "32768 x 1", "{\"image\":{\"width\":32768,\"height\":1}}", true, 0 },
    { "1 x 32768, sky",
      "{\"image\":{\"width\":1,\"height\":32768},\"camera\":{\"field_m\":1e-3},\"sky\":{\"model\":\"grid\"}}", true,
      0 },
    { "3 x 2, 64 rays a pixel", "{\"image\":{\"width\":3,\"height\":2,\"samples\":8}}", true, 0 },
    { "700 x 500 in bands", "{\"image\":{\"width\":700,\"height\":500}}", true, 1 << 20 },
    { "700 x 500 in bands, sky", "{\"image\":{\"width\":700,\"height\":500},\"sky\":{\"model\":\"grid\"}}", true,
      1 << 20 },
    { "denormal spin", "{\"spacetime\":{\"spin\":1e-310}," SMALL "}", true, 0 },
    { "least spin", "{\"spacetime\":{\"spin\":-5e-324},\"sky\":{\"model\":\"grid\"}," SMALL "}", true, 0 },
    { "spin -0",
      "{\"spacetime\":{\"spin\":-0.0},\"camera\":{\"inclination_deg\":-0.0,\"azimuth_deg\":-0.0},\"time\":-0.0," SMALL
      "}",
      true, 0 },
    { "denormal angles and time",
      "{\"camera\":{\"inclination_deg\":4e-320,\"azimuth_deg\":-5e-324,\"roll_deg\":1e-310,"
      "\"centre_alpha\":1e-315,\"centre_beta\":-1e-40},\"time\":5e-324," SMALL "}",
      true, 0 },
    { "an ulp above the plane", "{\"camera\":{\"inclination_deg\":89.99999999999999}," SMALL "}", true, 0 },
    { "an ulp below the plane, sky",
      "{\"camera\":{\"inclination_deg\":90.00000000000001},\"sky\":{\"model\":\"grid\"}," SMALL "}", true, 0 },
    { "the plane, a middle row",
      "{\"camera\":{\"inclination_deg\":90},\"sky\":{\"model\":\"grid\"},\"image\":{\"width\":49,\"height\":27}}", true,
      0 },
    { "the axis, a middle pixel",
      "{\"camera\":{\"inclination_deg\":180},\"sky\":{\"model\":\"grid\"},\"image\":{\"width\":49,\"height\":27}}",
      true, 0 },
    { "field 1e-6 M", "{\"camera\":{\"field_m\":1e-6,\"centre_alpha\":-8}," SMALL "}", true, 0 },
    { "field 1e7 M", "{\"camera\":{\"field_m\":1e7},\"disk\":{\"outer\":1e6},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      true, 0 },
    { "opacity denormal", "{\"disk\":{\"opacity\":1e-310}," SMALL "}", false, 0 },
    { "opacity 1e-40", "{\"disk\":{\"opacity\":1e-40}," SMALL "}", false, 0 },
    { "opacity 1e-30", "{\"disk\":{\"opacity\":1e-30}," SMALL "}", true, 0 },
    { "sky 1e-310 bright", "{\"sky\":{\"model\":\"grid\",\"brightness\":1e-310}," SMALL "}", true, 0 },
    { "exposure -40", "{\"style\":{\"exposure\":-40}," SMALL "}", true, 0 },
    { "exposure 40, 16 bits", "{\"style\":{\"exposure\":40},\"image\":{\"width\":48,\"height\":27,\"bit_depth\":16}}",
      true, 0 },
    { "1e9 K, visible", "{\"disk\":{\"peak_temperature_k\":1e9,\"hardening\":3,\"band\":\"visible\"}," SMALL "}", true,
      0 },
    { "300 K, visible", "{\"disk\":{\"peak_temperature_k\":300,\"band\":\"visible\"}," SMALL "}", true, 0 },
    { "accretion, 1e-12 of 1e12 suns",
      "{\"spacetime\":{\"mass_msun\":1e12},\"disk\":{\"colour\":\"accretion\",\"mdot_edd\":1e-12}," SMALL "}", true,
      0 },
    { "accretion, 1e3 of 1e-3 suns",
      "{\"spacetime\":{\"mass_msun\":1e-3},\"disk\":{\"colour\":\"accretion\",\"mdot_edd\":1e3}," SMALL "}", true, 0 },
    { "a 1-1e-12", "{" NEAR_EXTREMAL ",\"sky\":{\"model\":\"grid\"},\"accuracy\":{\"orders\":8}," SMALL "}", true, 0 },
    { "a -1+1e-12, 1e6 M away",
      "{\"spacetime\":{\"spin\":-0.999999999999},\"camera\":{\"r\":1e6,\"fov_deg\":2e-3}," SMALL "}", true, 0 },
    { "a 1-1e-12, at 1.0001 r+",
      "{" NEAR_EXTREMAL ",\"camera\":{\"r\":1.000101414,\"observer\":\"zamo\",\"yaw_deg\":180,\"fov_deg\":150,"
      "\"inclination_deg\":60},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      true, 0 },
    { "a 1-1e-12, next to the horizon",
      "{" NEAR_EXTREMAL ",\"camera\":{\"r\":1.0000014143,\"observer\":\"zamo\",\"yaw_deg\":180,"
      "\"inclination_deg\":90},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      false, 0 },
    { "charge 1e-300", "{\"spacetime\":{\"charge\":1e-300},\"sky\":{\"model\":\"grid\"}," SMALL "}", true, 0 },
    { "charge 1-1e-12", "{\"spacetime\":{\"spin\":0,\"charge\":0.999999999999},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      true, 0 },
    { "spin 1-1e-12, charge 1e-300",
      "{\"spacetime\":{\"spin\":0.999999999999,\"charge\":1e-300},\"sky\":{\"model\":\"grid\"}," SMALL "}", true, 0 },
    { "spin 1-1e-12, charge 1e-6",
      "{\"spacetime\":{\"spin\":0.999999999999,\"charge\":1e-6},\"sky\":{\"model\":\"grid\"}," SMALL "}", true, 0 },
    { "spin 0.8, charge 0.6-1e-12",
      "{\"spacetime\":{\"spin\":0.8,\"charge\":0.599999999999},\"sky\":{\"model\":\"grid\"}," SMALL "}", true, 0 },
    { "charge 1-1e-12, particles that plunge",
      "{\"spacetime\":{\"spin\":0,\"charge\":0.999999999999},\"disk\":{\"model\":\"particles\",\"plunging\":0.3,"
      "\"plunging_temperature\":1}," SMALL "}",
      true, 0 },
    { "spin 0.8, charge 0.6-1e-12, particles that plunge",
      "{\"spacetime\":{\"spin\":0.8,\"charge\":0.599999999999},\"disk\":{\"model\":\"particles\",\"plunging\":0.3,"
      "\"plunging_temperature\":1}," SMALL "}",
      true, 0 },
    { "spin 0.8, charge 0.6-1e-12, at 1.000003",
      "{\"spacetime\":{\"spin\":0.8,\"charge\":0.599999999999},\"camera\":{\"r\":1.000003,\"observer\":\"zamo\",\"yaw_"
      "deg\":180,\"inclination_deg\":60},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      false, 0 },
    { "spin 0.8, charge 0.6-1e-12, falling at 1.0000001",
      "{\"spacetime\":{\"spin\":0.8,\"charge\":0.599999999999},\"camera\":{\"r\":1.0000001,\"observer\":\"infall\"},"
      "\"sky\":{\"model\":\"grid\"}," SMALL "}",
      false, 0 },
    { "charge 0.9, falling between the horizons",
      "{\"spacetime\":{\"spin\":0.1,\"charge\":0.9},\"camera\":{\"r\":0.8,\"observer\":\"infall\",\"projection\":"
      "\"equirectangular\"},\"sky\":{\"model\":"
      "\"grid\"}," SMALL "}",
      true, 0 },
    { "a 0, next to the horizon",
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":2.0000000000000004,\"observer\":\"zamo\",\"yaw_deg\":180},"
      "\"sky\":{\"model\":\"grid\"}," SMALL "}",
      false, 0 },
    { "a 0.9, at the photon orbit",
      "{\"spacetime\":{\"spin\":0.9},\"camera\":{\"r\":1.5578546274,\"observer\":\"zamo\",\"yaw_deg\":90,\"inclination_"
      "deg\":90,"
      "\"fov_deg\":179},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      true, 0 },
    /* For a = 0 and r = L^(2/3) = 2.4957 M, the divisor in g of a circular orbit, E (r^(3/2) + a) - L, is 0 in single
     * precision in some thirty pixels. */
    { "inside the photon orbit, E = Omega L",
      "{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":80,\"centre_alpha\":-4,\"centre_beta\":2.2892487,"
      "\"field_m\":5e-5},"
      "\"image\":{\"width\":96,\"height\":96}}",
      false, 0 },
    { "1e7 M away, a millionth of a degree",
      "{\"camera\":{\"r\":1e7,\"fov_deg\":1e-6},\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"grid\"}," SMALL "}",
      false, 0 },
};

/* Reads the first n floats of a device buffer. */
static enum kd_status read_back(struct kd_vk *vk, struct kd_vk_buffer *from, uint64_t bytes, float *to,
                                struct kd_error *error)
{
    struct kd_vk_buffer *host = NULL;
    enum kd_status status = kd_vk_buffer_create(vk, bytes, KD_VK_READBACK, "radiance on the host", &host, error);
    if (!status)
        status = kd_vk_copy(vk, "readback", host, 0, from, 0, bytes, error);
    if (!status)
        status = kd_vk_submit(vk, NULL, error);
    if (!status)
        status = kd_vk_wait(vk, 0, error);
    if (!status)
        memcpy(to, kd_vk_buffer_map(host), bytes);
    kd_vk_buffer_destroy(vk, host);
    return status;
}

/* Number of pixels whose radiance is negative or not a number. *lit: true if some pixels are bright. */
static size_t wrong_light(struct kd_renderer *renderer, const struct kd_plan *plan, bool *lit, struct kd_error *error)
{
    size_t wrong = 0;
    for (uint32_t band = 0, row = 0; band < plan->picture.bands; band++, row += plan->picture.band_rows) {
        uint64_t rows = plan->picture.height - row < plan->picture.band_rows ? plan->picture.height - row
                                                                             : plan->picture.band_rows,
                 n = 3 * rows * plan->picture.width;
        float *light = malloc(n * sizeof *light);
        if (!light ||
            read_back(renderer->vk, renderer->store.radiance.buffers[band], n * sizeof *light, light, error)) {
            free(light);
            return plan->picture.width * plan->picture.height;
        }
        for (uint64_t i = 0; i < n; i++) {
            wrong += !isfinite(light[i]) || light[i] < 0;
            *lit = *lit || light[i] > 0;
        }
        free(light);
    }
    return wrong;
}

static void draw(struct kd_renderer *renderer, const struct picture *picture)
{
    struct extreme_row row = {
        .engine = "picture", .median = NAN, .most = NAN, .worst = NAN, .phi = NAN, .bound = NAN, .phi_bound = NAN
    };
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_error error = { 0 };
    bool lit = false;
    snprintf(row.what, sizeof row.what, "%s", picture->what);
    kd_scene_smooth(&scene);
    kd_renderer_capacity(renderer, &capacity);
    if (picture->binding)
        capacity.max_binding_bytes = picture->binding;
    if (kd_scene_from_json(&scene, picture->json, strlen(picture->json), &error) || kd_scene_validate(&scene, &error) ||
        kd_plan_make(&scene, &capacity, &plan, &error) ||
        kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error)) {
        printf("%s: %s\n", picture->what, error.message);
        row.broken = 1;
        extreme_row(&row);
        return;
    }
    row.rays = plan.lens.rays;
    row.broken = wrong_light(renderer, &plan, &lit, &error);
    row.broken += !isfinite(frame.exposure) + !isfinite(frame.accuracy.median) + !isfinite(frame.accuracy.worst);
    row.broken += (picture->lit && !lit) + (picture->binding && plan.picture.bands < 2);
    if (frame.accuracy.crossings)
        row.median = frame.accuracy.median, row.worst = frame.accuracy.worst;
    kd_frame_finish(&frame);
    extreme_row(&row);
}

void extreme_pictures(struct kd_renderer *renderer)
{
    for (size_t k = 0; k < sizeof pictures / sizeof *pictures; k++)
        draw(renderer, &pictures[k]);
}

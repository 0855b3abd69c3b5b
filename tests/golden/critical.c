/* Compares pixels at the critical curve, which get additional rays, with pixels of pictures that have 8 x 8 rays in
 * each pixel. */
#include "studio.h"

#include "render/view/critical_pixels.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { WIDTH = 200, HEIGHT = 150 };

static struct kd_frame shot(const struct kd_scene *base, int samples, int critical)
{
    struct kd_scene scene = *base;
    scene.image.samples = samples;
    scene.image.critical_factor = critical;
    return studio_render(&scene);
}

/* largest errors: of pixels at the curve, and of all other pixels */
struct distance { double rms, mean, elsewhere; };

/* Compares the linear light of a picture with that of another. */
static struct distance distance(const struct kd_frame *a, const struct kd_frame *b,
                                const struct kd_critical_pixels *list)
{
    struct distance d = { 0 };
    size_t next = 0;
    for (uint32_t y = 0; y < a->height; y++)
        for (uint32_t x = 0; x < a->width; x++) {
            bool listed = next < list->n && list->pixels[next].x == x && list->pixels[next].y == y;
            next += listed;
            for (int c = 0; c < 3; c++) {
                double off = studio_light(a, x, y, c) - studio_light(b, x, y, c);
                if (!listed) {
                    d.elsewhere = fmax(d.elsewhere, fabs(off));
                    continue;
                }
                d.rms += off * off;
                d.mean += off;
            }
        }
    d.rms = sqrt(d.rms / (3 * (double)list->n));
    d.mean /= 3 * (double)list->n;
    return d;
}

static struct kd_scene view(const char *json, double exposure)
{
    char text[1024];
    snprintf(text, sizeof text,
             "{%s,\"image\":{\"width\":%d,\"height\":%d,\"bit_depth\":16},"
             "\"style\":{\"exposure\":%g,\"tone_map\":\"srgb\",\"dither\":false}}",
             json, WIDTH, HEIGHT, exposure);
    return studio_scene(NULL, text);
}

#define NEAR \
    "\"camera\":{\"r\":25,\"inclination_deg\":75,\"fov_deg\":60,\"yaw_deg\":4,\"pitch_deg\":-3,\"roll_deg\":20}"
#define FAST "\"spacetime\":{\"spin\":0.998}"

/* Tests each way of making a lens map. Where the curve is the rim of light, the rays of a pixel have many different
 * distances from it. The pixel's error is therefore proportional to 1/n for n rays, instead of 1/sqrt(n). */
static void against_many_rays(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        double exposure;
        const char *json;
    } views[] = {
        { "radii", -1.5, "\"camera\":{\"inclination_deg\":80,\"field_m\":30}" },
        { "radii, fast", 4, FAST ",\"camera\":{\"inclination_deg\":70,\"field_m\":24,\"roll_deg\":30}" },
        { "rolled a quarter, glass", -1,
          "\"camera\":{\"inclination_deg\":40,\"field_m\":24,\"roll_deg\":90},\"disk\":{\"opacity\":0.6}" },
        { "near", -1, NEAR },
        { "before a sky", 3, FAST "," NEAR ",\"sky\":{\"model\":\"grid\",\"brightness\":1}" },
        { "particles", -1, NEAR ",\"disk\":{\"model\":\"particles\",\"plunging\":0.3}" },
        { "a spot and slow light", -1.5,
          "\"camera\":{\"inclination_deg\":60,\"field_m\":30},\"disk\":{\"slow_light\":true},"
          "\"spots\":[{\"brightness\":2,\"r\":8,\"size\":2}]" },
        { "double precision", -1, NEAR ",\"accuracy\":{\"precision\":\"f64\",\"engine\":\"closed\"}" },
    };
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        struct kd_scene scene = view(views[i].json, views[i].exposure);
        struct kd_critical_pixels list;
        struct kd_error error;
        assert_int_equal(kd_critical_pixels_of(&scene, &list, &error), KD_OK);
        struct kd_frame many = shot(&scene, 8, 1), one = shot(&scene, 1, 1), four = shot(&scene, 1, 4),
                        all = shot(&scene, 1, 16);
        struct distance d1 = distance(&one, &many, &list), d4 = distance(&four, &many, &list),
                        d16 = distance(&all, &many, &list);
        printf("%-24s %4zu pixels at the curve: one ray off by %.4f rms, 16 by %.4f, 256 by %.4f; on average %+.5f, "
               "%+.5f, %+.5f\n",
               views[i].what, list.n, d1.rms, d4.rms, d16.rms, d1.mean, d4.mean, d16.mean);
        if (!(d1.rms > 0.005 && d4.rms < 0.4 * d1.rms && d16.rms < 0.12 * d1.rms && fabs(d16.mean) < 5e-4))
            fail_msg("%s: one ray is off by %g, 16 by %g, 256 by %g, on average %g", views[i].what, d1.rms, d4.rms,
                     d16.rms, d16.mean);
        if (distance(&four, &one, &list).elsewhere != 0)
            fail_msg("%s: other pixels than those at the curve differ", views[i].what);
        kd_frame_finish(&many);
        kd_frame_finish(&one);
        kd_frame_finish(&four);
        kd_frame_finish(&all);
        kd_critical_pixels_finish(&list);
    }
}

/* When the additional rays are switched off, none is traced, and the picture is the same to the byte. */
static void off(void **state)
{
    (void)state;
    static const struct {
        const char *what, *json;
        int samples, critical;
    } views[] = {
        { "none asked", "\"camera\":{\"field_m\":30}", 2, 1 },
        { "the direct image alone", "\"camera\":{\"field_m\":30},\"accuracy\":{\"orders\":1}", 1, 4 },
        { "no hole in the picture", "\"camera\":{\"field_m\":3,\"centre_alpha\":12}", 1, 4 },
        { "the ring projection", "\"camera\":{\"projection\":\"ring\"}", 1, 4 },
    };
    for (size_t i = 0; i < sizeof views / sizeof *views; i++) {
        struct kd_scene scene = view(views[i].json, 0);
        scene.image.width = 40, scene.image.height = 30;
        struct kd_frame with = shot(&scene, views[i].samples, views[i].critical),
                        without = shot(&scene, views[i].samples, 1);
        if (memcmp(kd_frame_pixels(&with), kd_frame_pixels(&without), 40 * 30 * 6) != 0)
            fail_msg("%s: the picture is another one", views[i].what);
        kd_frame_finish(&with);
        kd_frame_finish(&without);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(against_many_rays),
        cmocka_unit_test(off),
    };
    int status = studio_open();
    if (status)
        return status;
    status = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return status;
}

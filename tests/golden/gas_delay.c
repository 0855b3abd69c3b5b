/* Tests of slow light of gas: each pixel shows the turbulence at the time at which the pixel's light was emitted.
 * Kerr-Schild geodesics give the delays. */
#include "photon.h"
#include "studio.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

enum { WIDTH = 96, HEIGHT = 64, LOOKED_AT = 24 };
#define TIME 5000.0

static struct kd_scene view(double spin, double inclination_deg, double r)
{
    char json[700];
    snprintf(json, sizeof json,
             "{\"time\":%g,\"spacetime\":{\"spin\":%g},\"camera\":{%s\"inclination_deg\":%g,\"field_m\":40,\"fov_deg\":"
             "70},\"style\":{\"exposure\":-1,"
             "\"tone_map\":\"srgb\",\"dither\":false},\"disk\":{\"outer\":16,\"slow_light\":true,\"gas\":{"
             "\"amplitude\":0.8,\"octaves\":3}},"
             "\"accuracy\":{\"profile\":\"high\"},\"image\":{\"width\":%d,\"height\":%d,\"bit_depth\":16,\"critical_"
             "factor\":1}}",
             TIME, spin, isinf(r) ? "" : "\"r\":25,", inclination_deg, WIDTH, HEIGHT);
    return studio_scene(NULL, json);
}

/* The disk is opaque, so that a pixel shows its first crossing. The dimmest pixels that are compared have a resolution
 * of 1e-3 in 16 bits. */
static void pixels_show_when_their_light_left(void **state)
{
    (void)state;
    static const struct { double spin, inclination_deg, r; } views[] = { { 0.9, 70, INFINITY }, { -0.4, 65, 25 } };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = view(views[v].spin, views[v].inclination_deg, views[v].r);
        struct kd_frame slow = studio_render(&scene);
        scene.disk.slow_light = false;
        struct kd_frame now = studio_render(&scene);
        double worst = 0, of_now = 0, least = INFINITY, most = -INFINITY;
        int n = 0;
        for (uint32_t at = 500; at < WIDTH * HEIGHT && n < LOOKED_AT; at += 41) {
            uint32_t x = at % WIDTH, y = at / WIDTH;
            double seen = studio_luminance(&slow, x, y);
            if (seen < 0.01)
                continue;
            struct ks_path path = ks_trace(photon_of(&scene, x, y), 1);
            assert_true(path.crossings == 1);
            scene.top.time = TIME - path.delay[0];
            struct kd_frame then = studio_render(&scene);
            double off = fabs(seen / studio_luminance(&then, x, y) - 1);
            kd_frame_finish(&then);
            if (!(off < 3e-3))
                fail_msg("view %zu, (%u, %u), delay %g: light is off by %g of it", v, x, y, path.delay[0], off);
            worst = fmax(worst, off);
            of_now += fabs(seen / studio_luminance(&now, x, y) - 1);
            least = fmin(least, path.delay[0]);
            most = fmax(most, path.delay[0]);
            n++;
        }
        printf("view %zu: %d pixels off by %.1e at most, by %.2f in the mean from the picture of one time; delays from "
               "%.1f to %.1f\n",
               v, n, worst, of_now / n, least, most);
        assert_true(n == LOOKED_AT && of_now / n > 0.05 && most - least > 10);
        kd_frame_finish(&slow);
        kd_frame_finish(&now);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(pixels_show_when_their_light_left) };
    int status = studio_open();
    if (status)
        return status;
    status = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return status;
}

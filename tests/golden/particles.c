/* Tests that a disk of particles equals the smooth disk on average. The pictures are seen from the pole. Their rings
 * are compared for each image order. */
#include "studio.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

#define FIELD 32.0
#define PIXELS 480

/* Sum of linear light between two distances from the middle of the picture, in M. */
static double ring(const struct kd_frame *f, double from, double to)
{
    double sum = 0;
    for (uint32_t y = 0; y < PIXELS; y++)
        for (uint32_t x = 0; x < PIXELS; x++) {
            double b = hypot(x + 0.5 - PIXELS / 2, y + 0.5 - PIXELS / 2) * FIELD / PIXELS;
            if (b >= from && b < to)
                sum += studio_light(f, x, y, 0) + studio_light(f, x, y, 1) + studio_light(f, x, y, 2);
        }
    return sum;
}

static struct kd_frame shoot(const char *model, int seed, double epicycles, double index)
{
    return studio_shoot("{\"time\":2000,\"spacetime\":{\"spin\":0.9},\"camera\":{\"inclination_deg\":0,\"field_m\":%g},"
                        "\"disk\":{\"model\":\"%s\",\"inner\":8,\"outer\":14,\"taper\":0,\"seed\":%d,\"epicycles\":%g,"
                        "\"density_index\":%g},"
                        "\"image\":{\"width\":%d,\"height\":%d,\"samples\":4,\"bit_depth\":16},"
                        "\"style\":{\"exposure\":-2,\"tone_map\":\"srgb\",\"dither\":false}}",
                        FIELD, model, seed, epicycles, index, PIXELS, PIXELS);
}

/* The disk from 8 to 14 M appears directly at 9 to 15 M, and by light that goes round the back of the hole at 5.2 to
 * 6.5 M. A ring with the fraction s of 300 000 particles has a Poisson error of 1/sqrt(300 000 s). This is 0.4 % for
 * the quarters of the direct image, and 0.2 % for order 1, whose ring shows the whole disk. The bound is three times
 * this error. (Order 1 is eight pixels wide, and sixteen rays a pixel are enough to see all particles. For order 2
 * sixteen are too few.) */
static void the_mean_is_the_smooth_disk(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        double from, to, share;
    } rings[] = {
        { "order 0, first quarter", 9.5, 10.5, 0.2 },
        { "order 0, second quarter", 10.5, 12, 0.2 },
        { "order 0, third quarter", 12, 13.5, 0.2 },
        { "order 0, last quarter", 13.5, 14.8, 0.15 },
        { "order 1", 5.2, 8, 1 },
    };
    struct kd_frame smooth = shoot("novikov-thorne", 0, 0, 0);
    double worst = 0;
    for (int k = 0; k < 6; k++) {
        struct kd_frame f = shoot("particles", k, k & 1 ? 0.05 : 0, k % 3);
        for (size_t i = 0; i < sizeof rings / sizeof *rings; i++) {
            double want = ring(&smooth, rings[i].from, rings[i].to), got = ring(&f, rings[i].from, rings[i].to);
            double poisson = 1 / sqrt(3e5 * rings[i].share), off = (got / want - 1) / poisson;
            if (!(want > 0 && fabs(off) < 3))
                fail_msg("seed %d, %s: %g, not %g: %g times the Poisson error", k, rings[i].what, got, want, off);
            worst = fmax(worst, fabs(off));
        }
        kd_frame_finish(&f);
    }
    printf("rings of particles: within %.2f Poisson errors of the smooth disk\n", worst);
    kd_frame_finish(&smooth);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(the_mean_is_the_smooth_disk) };
    int code = studio_open();
    if (code)
        return code;
    code = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return code;
}

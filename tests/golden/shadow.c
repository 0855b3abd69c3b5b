/* Tests that the shadow has the outline of the closed form, and is black inside. */
#include "studio.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

#define SIZE(w, h) "\"image\":{\"width\":" #w ",\"height\":" #h ",\"bit_depth\":16,\"critical_factor\":1}"

/* Outline of the shadow for an observer at infinity, as (alpha, beta) of the spherical photon orbits (Bardeen 1973). It
 * does not use the code under test. Only the upper half, beta >= 0, is computed, from left to right. For a = 0 the
 * outline is a circle. */
#define OUTLINE 400
static int outline(double a, double inclination, double alpha[OUTLINE], double beta[OUTLINE])
{
    int n = 0;
    double s = sin(inclination), c = cos(inclination);
    for (int i = 0; i < OUTLINE; i++) {
        double al, be2;
        if (a == 0) {
            al = -sqrt(27) * cos(M_PI * i / (OUTLINE - 1));
            be2 = 27 - al * al;
        } else { /* radius between those of the two equatorial photon orbits */
            double low = 2 + 2 * cos(2.0 / 3 * acos(-fabs(a))), high = 2 + 2 * cos(2.0 / 3 * acos(fabs(a)));
            double r = 0.5 * (low + high) - 0.5 * (high - low) * cos(M_PI * i / (OUTLINE - 1));
            double xi = (r * r * (3 - r) - a * a * (r + 1)) / (a * (r - 1));
            double eta = r * r * r * (4 * a * a - r * (r - 3) * (r - 3)) / (a * a * (r - 1) * (r - 1));
            al = -xi / s;
            be2 = eta + a * a * c * c - xi * xi * c * c / (s * s);
        }
        if (be2 >= -1e-9)
            alpha[n] = al, beta[n++] = sqrt(fmax(be2, 0));
    }
    return n;
}

/* Half height of the outline at this alpha; -1 if alpha is outside the outline. */
static double half_height(const double *alpha, const double *beta, int n, double at)
{
    for (int i = 0; i + 1 < n; i++) {
        double t = (at - alpha[i]) / (alpha[i + 1] - alpha[i]);
        if (t >= 0 && t <= 1)
            return beta[i] + t * (beta[i + 1] - beta[i]);
    }
    return -1;
}

/* Every ray inside the outline is black; every ray outside sees the sky, which is nowhere black. Pixels within 0.05 M
 * of the outline are not tested. The errors of the polygon and of single precision are about 1e-4 M. */
static void the_shadow_has_bardeens_outline(void **state)
{
    (void)state;
    const double spins[] = { 0, 0.5, 0.9, 0.998, -0.9 }, inclinations[] = { 15, 60, 90, 140 };
    const double margin = 0.05, field = 16;
    for (int k = 0; k < 20; k++) {
        double a = spins[k % 5], i = inclinations[k / 5], alpha[OUTLINE], beta[OUTLINE];
        int n = outline(a, i * M_PI / 180, alpha, beta), inside = 0;
        struct kd_frame f =
            studio_shoot("{\"spacetime\":{\"spin\":%g},\"camera\":{\"inclination_deg\":%g,\"field_m\":%g},"
                         "\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"grid\",\"brightness\":1},"
                         "\"style\":{\"exposure\":0}," SIZE(128, 128) "}",
                         a, i, field);
        for (uint32_t y = 0; y < 128; y++)
            for (uint32_t x = 0; x < 128; x++) {
                double al = (x + 0.5 - 64) * field / 128, be = fabs((63.5 - y) * field / 128);
                double left = half_height(alpha, beta, n, al - margin),
                       right = half_height(alpha, beta, n, al + margin);
                double low = fmin(left, right) - margin, high = fmax(left, right) + margin;
                bool black = studio_black(&f, x, y);
                inside += black;
                if ((be < low && !black) || (be > high + margin && black))
                    fail_msg("a = %g, i = %g: (%g, %g) is %s", a, i, al, be, black ? "black" : "not black");
            }
        assert_in_range(inside, 4000, 6000); /* the shadow's area is 80 to 85 M^2, and a pixel's 1/64 M^2 */
        kd_frame_finish(&f);
    }
}

/* Synge 1966: an observer at rest at r sees the hole with an angular radius given by sin(angle) = sqrt(27 (1 - 2/r))/r.
 * Inside r = 3 this is more than a right angle. The camera looking away (yaw 180) sees the rest of the sky. */
static void the_shadow_has_synges_angle(void **state)
{
    (void)state;
    const struct {
        double r, fov;
        int yaw;
        const char *observer;
    } cases[] = {
        { 6, 120, 0, "static" },   { 6, 120, 0, "zamo" },       { 20, 40, 0, "static" },   { 1000, 1, 0, "static" },
        { 3.5, 160, 0, "static" }, { 2.5, 150, 180, "static" }, { 2.1, 120, 180, "zamo" },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        /* angle from the direction to the hole; inside r = 3, from the opposite direction */
        double r = cases[k].r, edge = asin(sqrt(27 * (1 - 2 / r)) / r);
        bool away = cases[k].yaw;
        int seen[2] = { 0 };
        struct kd_frame f =
            studio_shoot("{\"spacetime\":{\"spin\":0},\"camera\":{\"r\":%g,\"observer\":\"%s\",\"fov_deg\":%g,"
                         "\"yaw_deg\":%d,\"inclination_deg\":50},\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":"
                         "\"grid\",\"brightness\":1},\"style\":{\"exposure\":0}," SIZE(101, 101) "}",
                         r, cases[k].observer, cases[k].fov, cases[k].yaw);
        for (uint32_t y = 0; y < 101; y++)
            for (uint32_t x = 0; x < 101; x++) {
                double angle = atan(hypot(x - 50.0, y - 50.0) / 50.5 * tan(0.5 * cases[k].fov * M_PI / 180));
                bool black = studio_black(&f, x, y);
                seen[black]++;
                if (fabs(angle / edge - 1) > 0.005 && black != (away ? angle > edge : angle < edge))
                    fail_msg("r = %g: %g degrees off the axis, edge at %g, is %s", r, angle * 180 / M_PI,
                             edge * 180 / M_PI, black ? "black" : "not black");
            }
        assert_true(seen[0] > 200 && seen[1] > 200);
        kd_frame_finish(&f);
    }
}

/* Face-on and without spin, the direct image of radius r is at about b = r + 1, and that of the ISCO at 7. A ray within
 * b = 5.2 falls in after one crossing. Tone curve and dither must leave black at 0. */
static void the_hole_in_the_disk_is_black(void **state)
{
    (void)state;
    struct kd_frame f = studio_shoot("{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":0,\"field_m\":24},"
                                     "\"image\":{\"width\":120,\"height\":120},\"style\":{\"exposure\":8}}");
    for (uint32_t y = 0; y < 120; y++)
        for (uint32_t x = 0; x < 120; x++) {
            double b = hypot(x - 59.5, y - 59.5) * 0.2;
            if (b < 4.9 ? !studio_black(&f, x, y) : b > 8 && b < 11 && studio_black(&f, x, y))
                fail_msg("b = %g is %s", b, b < 4.9 ? "not black" : "black");
        }
    kd_frame_finish(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_shadow_has_bardeens_outline),
        cmocka_unit_test(the_shadow_has_synges_angle),
        cmocka_unit_test(the_hole_in_the_disk_is_black),
    };
    int code = studio_open();
    if (code)
        return code;
    code = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return code;
}

/* Tests of cosines and sines of angles in degrees, compared with values of 40 digits (mpmath), especially near
 * multiples of 90 degrees. */
#include "physics/math/angle.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void check(double degrees, const char *what, double is, double wanted)
{
    if (!(fabs(is - wanted) <= 2 * DBL_EPSILON * fabs(wanted)) || (wanted == 0 && signbit(is) != signbit(wanted)))
        fail_msg("%s of %.17g degrees is %.17g, not %.17g", what, degrees, is, wanted);
}

static void against_forty_digits(void **state)
{
    (void)state;
    static const struct {
        double degrees, c, s;
    } rows[] = {
        { 0.0, 1.0, 0 },
        { 30.0, 0.86602540378443864676, 0.5 },
        { 45.0, 0.7071067811865475244, 0.7071067811865475244 },
        { 60.0, 0.5, 0.86602540378443864676 },
        { 89.0, 1.7452406437283512819e-2, 0.99984769515639123916 },
        { 89.9, 1.7453283658982096254e-3, 0.99999847691328769898 },
        { 89.999, 1.7453292519140536418e-5, 0.99999999984769129011 },
        { 89.99999999, 1.7453281562724978883e-10, 0.99999999999999999998 },
        { 90.0, 0, 1.0 },
        { 90.00000001, -1.7453281562724978883e-10, 0.99999999999999999998 },
        { 90.1, -1.7453283658982096254e-3, 0.99999847691328769898 },
        { 135.0, -0.7071067811865475244, 0.7071067811865475244 },
        { 150.0, -0.86602540378443864676, 0.5 },
        { 179.999, -0.99999999984769129011, 1.7453292519140536418e-5 },
        { 180.0, -1.0, 0 },
        { 180.00000001, -0.99999999999999999998, -1.7453306365345409167e-10 },
        { 270.0, 0, -1.0 },
        { 269.9999, -1.7453292515553299935e-6, -0.9999999999984769129 },
        { 360.0, 1.0, 0 },
        { 359.9999999, 0.99999999999999999848, -1.7453296444297237044e-9 },
        { -90.001, -1.7453292519140536418e-5, -0.99999999984769129011 },
        { -0.001, 0.99999999984769129011, -1.7453292519057199977e-5 },
        { 720.25, 0.99999048072073448332, 4.3633092847465708069e-3 },
        { 1e-300, 1.0, 1.7453292519943296207e-302 },
        { 89.99999999999999, 2.4802620430283604619e-16, 1.0 },
        { 123456789.125, -0.98734470328297122591, -0.1585888927354671611 },
    };
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        check(rows[i].degrees, "the cosine", kd_cos_deg(rows[i].degrees), rows[i].c);
        check(rows[i].degrees, "the sine", kd_sin_deg(rows[i].degrees), rows[i].s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(against_forty_digits) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

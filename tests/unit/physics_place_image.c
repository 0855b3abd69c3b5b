/* Tests of images of places. Places in the equatorial plane of a spinning hole are compared with rays in closed form,
 * which cross the plane there. For a hole without spin, places off the plane are compared with the same rays after a
 * rotation that moves the place into the equatorial plane. */
#include "physics/null/null_geodesic.h"
#include "physics/null/place_image.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#define RADIAN (M_PI / 180)

static struct kd_place_view view_about(struct kd_hole hole, double r, double i_deg)
{
    const struct kd_observer_motion motion = kd_observer_motion_of(KD_OBSERVER_STATIC);
    const struct kd_vantage at = { hole, r, cos(i_deg * RADIAN), sin(i_deg * RADIAN) };
    return kd_place_view_of(&motion, &at);
}

static struct kd_place_view view_of(double a, double r, double i_deg) { return view_about(kd_hole_of(a), r, i_deg); }

static double turn(double phi) { return remainder(phi, 2 * M_PI); }

/* Checks that some crossing of the ray is the place. Returns its order. */
static int crosses(const struct kd_place_view *view, const struct kd_place_image *image, double r, double phi)
{
    const struct kd_vantage *v = &view->frame.at;
    const struct kd_null_ray ray = { .hole = v->hole,
                                     .radius = v->r,
                                     .cos_theta = v->u,
                                     .sin_theta = v->s,
                                     .alpha = image->alpha,
                                     .beta = image->beta,
                                     .outward = image->outward,
                                     .orders = 4 };
    const struct kd_null_path path = kd_null_trace(&ray);
    double least = INFINITY;
    for (int n = 0; n < path.crossings; n++) {
        const struct kd_null_crossing *c = &path.crossing[n];
        const double off = hypot(c->r - r, r * turn(c->phi - phi));
        least = fmin(least, off);
        if (off < 1e-6 * r) {
            if (!(fabs(c->delay - image->delay) < 2e-5 * r))
                fail_msg("the delay is %.12g, not %.12g", image->delay, c->delay);
            return n;
        }
    }
    fail_msg("a = %g, from %g: no crossing of (%.9g, %.9g) is at r = %g, phi = %g: the nearest %.3g off, told %.3g",
             v->hole.a, v->r, image->alpha, image->beta, r, phi, least, image->off);
    return -1;
}

static void test_the_plane_of_a_hole_that_spins(void **state)
{
    (void)state;
    const double holes[][2] = { { 0, 0 }, { 0.7, 0 }, { -0.95, 0 }, { 0, 0.99 }, { 0.5, 0.8 } }, /* spin, charge */
        from[] = { INFINITY, 30 }, radii[] = { 4, 9, 25 };
    for (int k = 0; k < 5 * 2 * 3; k++) {
        const double *hole = holes[k % 5];
        const struct kd_place_view view =
            view_about(kd_hole_charged(hole[0], hole[1]), from[k / 5 % 2], k % 2 ? 70 : 120);
        const double r = radii[k / 10];
        struct kd_place_image direct;
        for (int j = 0; j < 5; j++) {
            const double phi = (20 + 72 * j) * RADIAN;
            if (!kd_place_image_seen(&view, r, 0, phi, NULL, true, &direct))
                fail_msg("a = %g, q = %g, from %g: r = %g, phi = %g has no image", hole[0], hole[1], from[k / 5 % 2], r,
                         phi);
            assert_int_equal(crosses(&view, &direct, r, phi), 0);
        }
    }
}

/* A hole without spin has no preferred equator. An observer in the plane looks at a place (theta, phi). The place and
 * the line to the observer span a plane, in which the place is at an angle psi from that line. It is seen at (right,
 * up) = b (cos, sin) of that plane's position angle. */
static void test_off_the_plane_without_spin(void **state)
{
    (void)state;
    const struct kd_place_view view = view_of(0, INFINITY, 90), same = view_of(0, INFINITY, 60);
    for (int j = 0; j < 12; j++) {
        const double theta = (25 + 11 * j) * RADIAN, phi = (35 * j + 10) * RADIAN, r = 5 + j;
        const double n[3] = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
        struct kd_place_image here, there;
        assert_true(kd_place_image_seen(&view, r, cos(theta), phi, NULL, true, &here));
        /* The place lies in a plane that is tilted by 60 degrees and is this observer's equator. psi and the ray's b
         * are unchanged. */
        const double psi = acos(n[0]), b = hypot(here.alpha, here.beta);
        const double side = atan2(n[2], n[1]);
        assert_true(fabs(turn(atan2(here.beta, here.alpha) - side)) < 1e-6);
        /* Azimuth phi' of the place in the equator that is at the angle psi from the line of sight, for an inclination
         * of 60 degrees: cos(psi) = sin(60) cos(phi'). */
        const double c = cos(psi) / sin(60 * RADIAN);
        if (fabs(c) > 1)
            continue;
        assert_true(kd_place_image_seen(&same, r, 0, acos(c), NULL, true, &there));
        crosses(&same, &there, r, acos(c));
        if (!(fabs(hypot(there.alpha, there.beta) - b) < 1e-6 * b))
            fail_msg("psi = %g, r = %g: b is %.12g, not %.12g", psi, r, b, hypot(there.alpha, there.beta));
        assert_true(fabs(there.delay - here.delay) < 2e-5 * r);
    }
}

static void test_a_neighbour_leads_to_the_same(void **state)
{
    (void)state;
    const struct kd_place_view view = view_of(0.9, 40, 65);
    struct kd_place_image alone, before, next;
    assert_true(kd_place_image_seen(&view, 10, 0, 0, NULL, true, &before));
    for (int j = 0; j < 40; j++) {
        const double phi = 9 * j * RADIAN, u = 0.4 * sin(2 * phi), r = 8 + 2 * cos(phi);
        assert_true(kd_place_image_seen(&view, r, u, phi, &before, false, &next));
        assert_true(kd_place_image_seen(&view, r, u, phi, NULL, true, &alone));
        if (!(hypot(alone.alpha - next.alpha, alone.beta - next.beta) < 1e-5))
            fail_msg("at phi = %g: (%.9g, %.9g) alone, (%.9g, %.9g) from its neighbour", phi, alone.alpha, alone.beta,
                     next.alpha, next.beta);
        before = next;
    }
    assert_false(kd_place_image_seen(&view, 1.2, 0, 0, NULL, true, &next)); /* within the horizon */
    assert_true(isnan(next.alpha) && isnan(next.off));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_plane_of_a_hole_that_spins),
        cmocka_unit_test(test_off_the_plane_without_spin),
        cmocka_unit_test(test_a_neighbour_leads_to_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Tests of the curve on which all plunging particles move: its table of radii is compared with the closed form, in both
 * directions, at any spin. */
#include "render/emit/plunging.h"

#include "physics/spacetime/kerr.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

static struct kd_scene scene_of(double spin)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.disk.model = KD_DISK_PARTICLES;
    scene.spacetime.spin = spin;
    return scene;
}

static void there_and_back(void **state)
{
    (void)state;
    static const double spins[] = { -(1 - 1e-12), -0.9, 0, 1e-9, 0.5, 0.9, 0.998, 0.9999, 1 - 1e-6, 1 - 1e-12 };
    for (size_t s = 0; s < sizeof spins / sizeof *spins; s++) {
        const struct kd_scene scene = scene_of(spins[s]);
        const struct kd_plunging p = kd_plunging_of(&scene);
        static struct kd_plunging_path path;
        kd_plunging_path(&p, &path);
        double worst[2] = { 0 }, before = INFINITY, gap = p.start - p.end, isco = kd_kerr_isco(kd_hole(spins[s]));
        assert_true(p.start < isco && p.end > kd_hole(spins[s])->outer && p.time > 0);
        for (double phase = 0; phase <= 1; phase += 1 / 7777.0) {
            double turns, r = kd_plunging_radius(&path, phase, &turns);
            assert_true(r <= p.start && r < before && r > p.end * (1 - 1e-12));
            before = r;
            const struct kd_plunging_place at = kd_plunging_at(&p, r);
            worst[0] = fmax(worst[0], fabs(at.phase - phase));
            worst[1] = fmax(worst[1], fabs(at.turns - turns));
        }
        printf("a = %.12g: phase within %.2g, azimuth %.2g turns, r in %g\n", spins[s], worst[0], worst[1], gap);
        assert_true(worst[0] < 1e-8 && worst[1] < 1e-7);
        assert_true(kd_plunging_at(&p, p.start).phase == 0 && kd_plunging_at(&p, p.start).turns == 0);
        assert_true(fabs(kd_plunging_at(&p, p.end).phase - 1) < 1e-15);
    }
}

static void where_there_are_none(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.5);
    assert_true(kd_plunging_is_on(&scene));
    scene.disk.inner = 6;
    assert_false(kd_plunging_is_on(&scene));
    scene = scene_of(0.5);
    scene.disk.plunging = 0;
    assert_false(kd_plunging_is_on(&scene));
    scene = scene_of(0.5);
    scene.disk.model = KD_DISK_NOVIKOV_THORNE;
    assert_false(kd_plunging_is_on(&scene));
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(there_and_back), cmocka_unit_test(where_there_are_none) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

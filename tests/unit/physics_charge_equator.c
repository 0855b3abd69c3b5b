/* Tests of the equatorial plane of charged holes: small oscillations about circular orbits, potentials, the bending of
 * light and the embedded plane. They are compared with the metric, with orbits in closed form, and with integrals to 40
 * digits (tests/oracle/charge_reference.py). */
#include "physics/null/deflection.h"
#include "physics/orbit/orbit_bound.h"
#include "physics/spacetime/embedding.h"
#include "physics/spacetime/epicyclic.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/potential.h"

#include "charge_reference.h"

#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#define COUNT(x) (sizeof(x) / sizeof *(x))

static void near(const struct kd_hole *hole, const char *what, double at, double got, double want, double allowed)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("a = %.17g, q = %.17g, at %.17g: %s %.17g, not %.17g: off by %.2g, allowed %.2g", hole->a, hole->q, at,
                 what, got, want, got - want, allowed);
}

/* The metric of the plane, in long double: g_tt, g_tphi, g_phiphi, and Delta. */
struct plane { long double tt, tp, pp, delta; };
static struct plane plane_at(const struct kd_hole *hole, long double r)
{
    const long double a = hole->a, q = hole->q, f = 2 / r - q * q / (r * r);
    return (struct plane) { f - 1, -a * f, r * r + a * a + a * a * f, r * r - 2 * r + a * a + q * q };
}

static double random_unit(uint64_t *seed) /* splitmix64 */
{
    uint64_t z = *seed += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return (double)((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

static struct kd_hole random_hole(uint64_t *seed)
{
    const double size = sqrt(random_unit(seed)), turn = 2 * M_PI * random_unit(seed);
    return kd_hole_charged(0.9999 * size * cos(turn), 0.9999 * size * sin(turn));
}

/* Frequencies of orbits next to a circular orbit, from the closed form of bound orbits. */
static void small_oscillations(void **state)
{
    (void)state;
    uint64_t seed = 31;
    for (int i = 0; i < 500; i++) {
        const struct kd_hole hole = random_hole(&seed);
        const double isco = kd_kerr_isco(&hole), r = isco * (1.05 + 10 * random_unit(&seed) * random_unit(&seed));
        struct kd_orbit orbit;
        struct kd_error error = { 0 };
        assert_int_equal(kd_orbit_from_shape(&hole, r, 0, 1, &orbit, &error), KD_OK);
        const struct kd_orbit_state start = kd_orbit_start(&orbit, NAN, true);
        const struct kd_orbit_bound bound = kd_orbit_bound_of(&orbit, &start);
        const struct kd_orbit_frequencies f = kd_orbit_frequencies_of(&bound);
        near(&hole, "radial frequency", r, kd_epicyclic_radial(&hole, r), f.r, 2e-13 * f.r * isco / (r - isco));
        near(&hole, "vertical frequency", r, kd_epicyclic_vertical(&hole, r), f.theta, 1e-13 * f.theta);
        near(&hole, "Omega", r, kd_kerr_omega(&hole, r), f.phi, 1e-13 * f.phi);
        assert_true(kd_epicyclic_radial(&hole, isco) == 0 && isnan(kd_epicyclic_radial(&hole, isco * 0.999)));
    }
}

/* d(phi)/dt at fixed E and L, by differences in the metric. */
static void shear(void **state)
{
    (void)state;
    uint64_t seed = 32;
    for (int i = 0; i < 200; i++) {
        const struct kd_hole hole = random_hole(&seed);
        const double r = kd_kerr_isco(&hole) * (1.05 + 5 * random_unit(&seed)), h = 1e-5 * r;
        const long double e = kd_kerr_energy(&hole, r), l = kd_kerr_momentum(&hole, r);
        long double rate[2];
        for (int k = 0; k < 2; k++) {
            const struct plane g = plane_at(&hole, r + (k ? h : -h));
            rate[k] = -(e * g.tp + l * g.tt) / (e * g.pp + l * g.tp);
        }
        const double want = (double)((rate[1] - rate[0]) / (2 * h));
        near(&hole, "shear", r, kd_epicyclic_shear(&hole, r), want, 1e-8 * fabs(want));
    }
}

/* At E = V the radial velocity is 0: g^tt E^2 - 2 g^tphi E L + g^phiphi L^2 = -mu^2. Extrema of V are circular orbits.
 * */
static void potentials(void **state)
{
    (void)state;
    uint64_t seed = 33;
    int circles = 0;
    for (int i = 0; i < 1000; i++) {
        const struct kd_hole hole = random_hole(&seed);
        const double r = hole.outer * (1.001 + 20 * random_unit(&seed) * random_unit(&seed)),
                     l = 20 * random_unit(&seed) - 10;
        for (int mu = 0; mu < 2; mu++) {
            const struct plane g = plane_at(&hole, r);
            const long double e = kd_potential(&hole, l, mu, r);
            const long double terms[] = { g.pp * e * e, 2 * g.tp * e * l, g.tt * (long double)l * l, -mu * g.delta };
            const double sum = (double)(terms[0] + terms[1] + terms[2] + terms[3]),
                         size = (double)(fabsl(terms[0]) + fabsl(terms[1]) + fabsl(terms[2]) + fabsl(terms[3]));
            near(&hole, "norm", r, sum, 0, 2e-14 * size * (1 + hole.outer / (r - hole.outer)));
        }
        const struct kd_potential_extrema matter = kd_potential_of_matter(&hole, l),
                                          light = kd_potential_of_light(&hole, l);
        const struct kd_hole turned = kd_hole_turned_of(&hole, copysign(1, l));
        near(&hole, "photon orbit", l, light.v_max, kd_potential(&hole, l, 0, light.r_max), 1e-13 * fabs(light.v_max));
        if (isnan(matter.r_max))
            continue;
        circles++;
        near(&hole, "E of the stable circle", l, matter.v_min, kd_kerr_energy(&turned, matter.r_min), 1e-13);
        near(&hole, "E of the unstable circle", l, matter.v_max, kd_kerr_energy(&turned, matter.r_max),
             1e-9 * matter.v_max);
    }
    assert_true(circles > 300);
}

/* The marginally bound circle of a hole without spin is a root of r^3 - 4 r^2 + 4 q^2 r - q^4; at q = 1 it is (3 + sqrt
 * 5)/2. */
static void marginally_bound(void **state)
{
    (void)state;
    uint64_t seed = 34;
    for (int i = 0; i < 300; i++) {
        const struct kd_hole hole = i % 2 ? kd_hole_charged(0, 0.999999 * random_unit(&seed)) : random_hole(&seed);
        const double r = kd_kerr_marginally_bound(&hole), q2 = hole.q * hole.q;
        near(&hole, "E", r, kd_kerr_energy(&hole, r), 1, 1e-14 * (1 + 1 / (r - 1)));
        if (i % 2)
            near(&hole, "cubic", r, r * (r * (r - 4) + 4 * q2) - q2 * q2, 0, 1e-13);
    }
    const struct kd_hole extreme = kd_hole_charged(0, sqrt(1 - 1e-14));
    near(&extreme, "r", 0, kd_kerr_marginally_bound(&extreme), 0.5 * (3 + sqrt(5)), 1e-12);
}

static void bending(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(charge_bending_reference); i++) {
        const struct charge_bending_reference *e = &charge_bending_reference[i];
        const struct kd_hole hole = kd_hole_charged(e->a, e->q);
        const double critical = kd_deflection_critical(&hole), loss = 1e-14 + 3e-14 / (e->b / critical - 1);
        near(&hole, "angle", e->b, kd_deflection(&hole, e->b), e->angle, loss * e->angle);
        if (e->b > 1e6)
            near(&hole, "weak field", e->b, kd_deflection_weak_second(&hole, e->b), e->angle, 1e-12 * e->angle);
        assert_true(isnan(kd_deflection(&hole, critical * (1 - 1e-9))));
    }
}

/* Turning points are roots of the radial potential, and the strong limit is approached as delta ln delta. */
static void turning_points_of_light(void **state)
{
    (void)state;
    uint64_t seed = 35;
    int farther = 0;
    for (int i = 0; i < 500; i++) {
        const struct kd_hole hole = random_hole(&seed);
        const double critical = kd_deflection_critical(&hole), b = critical * (1.01 + 10 * random_unit(&seed)),
                     near_b = critical * (1 + 1e-7);
        const double ends[2] = { kd_deflection_closest(&hole, b), kd_deflection_farthest(&hole, b) };
        for (int k = 0; k < 2; k++) {
            if (k && isnan(ends[k]))
                continue;
            farther += k;
            const struct plane g = plane_at(&hole, ends[k]);
            const double sum = (double)(g.pp + 2 * g.tp * b + g.tt * b * b);
            near(&hole, k ? "farthest" : "closest", b, sum, 0, 1e-14 * ((double)g.pp + 2 * b * b / ends[k]));
            assert_true(k ? ends[k] < kd_kerr_photon_orbit(&hole) : ends[k] > kd_kerr_photon_orbit(&hole));
        }
        const struct kd_deflection_strong strong = kd_deflection_strong(&hole);
        const double limit = strong.offset - strong.rate * log(1e-7);
        if (hole.outer - hole.inner > 0.6)
            near(&hole, "strong limit", b, limit, kd_deflection(&hole, near_b), 2e-4);
    }
    assert_true(farther > 50);
}

/* The embedded surface has the metric of the plane: dz^2 + dR^2 = r^2/Delta dr^2, by differences. */
static void embedding(void **state)
{
    (void)state;
    uint64_t seed = 36;
    for (int i = 0; i < 200; i++) {
        const struct kd_hole hole = random_hole(&seed);
        const double r = hole.outer * (1.05 + 5 * random_unit(&seed)), h = 1e-4 * (r - hole.outer);
        const struct plane g = plane_at(&hole, r);
        const double z = (kd_embedding_height(&hole, r + h) - kd_embedding_height(&hole, r - h)) / (2 * h),
                     across = (kd_embedding_radius(&hole, r + h) - kd_embedding_radius(&hole, r - h)) / (2 * h),
                     along = (kd_embedding_distance(&hole, r + h) - kd_embedding_distance(&hole, r - h)) / (2 * h);
        const double want = r * r / (double)g.delta;
        near(&hole, "R^2", r, pow(kd_embedding_radius(&hole, r), 2), (double)g.pp, 1e-14 * (double)g.pp);
        near(&hole, "dz^2 + dR^2", r, z * z + across * across, want, 1e-6 * want);
        near(&hole, "distance", r, along * along, want, 1e-6 * want);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_oscillations), cmocka_unit_test(shear),   cmocka_unit_test(potentials),
        cmocka_unit_test(marginally_bound),   cmocka_unit_test(bending), cmocka_unit_test(turning_points_of_light),
        cmocka_unit_test(embedding),
    };
    return cmocka_run_group_tests_name("the plane of charged holes", tests, NULL, NULL);
}

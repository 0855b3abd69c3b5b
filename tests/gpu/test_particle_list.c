/* Tests of particles as numbers. Positions are compared with the closed form in double precision, constants and the
 * norm with physics/orbit/timelike.h and the metric, and rates with differences of positions. Other tests: parts of a
 * list, and refused requests. */
#include "render/output/particle_list.h"

#include "physics/orbit/timelike.h"
#include "physics/spacetime/kerr.h"
#include "render_support.h"

#include <math.h>

static struct kd_scene scene_of(double spin, double epicycles)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = 30000;
    scene.disk.epicycles = epicycles;
    scene.disk.plunging = 0;
    return scene;
}

static void set(struct kd_particle_list *list, const char *name, const char *text)
{
    OK(kd_particle_list_set(list, name, text, &error));
}

static float *fill(struct kd_particle_list *list)
{
    OK(kd_particle_list_settle(list, 0, &error));
    float *rows = test_malloc(list->n * kd_particle_list_row(list));
    OK(kd_particle_list_fill(renderer, list, 0, list->n, rows, &error));
    return rows;
}

#define ALL "r,phi,latitude,x,y,z,energy,angular_momentum,dr_dt,dphi_dt,dlatitude_dt"
struct row { float r, phi, latitude, x, y, z, energy, momentum, dr, dphi, dlatitude; };

static struct row *all_at(const struct kd_scene *scene, const char *time, size_t *n)
{
    struct kd_particle_list list;
    OK(kd_particle_list_init(&list, scene, &error));
    set(&list, "fields", ALL);
    set(&list, "stride", "29");
    set(&list, "first", "3");
    set(&list, "time", time);
    float *rows = fill(&list);
    *n = list.n;
    assert_int_equal(list.n, (30000 - 3 + 28) / 29);
    assert_int_equal(kd_particle_list_row(&list), sizeof(struct row));
    return (struct row *)rows;
}

static struct kd_particle_orbit orbit_of(const struct kd_scene *scene, const struct kd_particle_grid *grid, size_t row)
{
    return kd_particle_orbit(scene, grid->radii, kd_particle_guide(grid, 3 + 29 * (uint32_t)row));
}

/* Particles on circular orbits: the azimuth after 1e4 M, and the position in space. */
static void test_phase(void **state)
{
    (void)state;
    static const double spins[] = { -0.9, 0, 0.998 };
    double worst = 0;
    for (size_t s = 0; s < sizeof spins / sizeof *spins; s++) {
        const struct kd_scene scene = scene_of(spins[s], 0);
        const struct kd_particle_grid grid = kd_particle_grid(&scene);
        size_t n;
        struct row *start = all_at(&scene, "0", &n), *then = all_at(&scene, "1e4", &n);
        for (size_t i = 0; i < n; i++) {
            const struct kd_particle_orbit o = orbit_of(&scene, &grid, i);
            double off = remainder(then[i].phi - start[i].phi - o.omega * 1e4, 2 * M_PI), a = spins[s];
            worst = fmax(worst, fabs(off));
            assert_true(fabs(then[i].r / o.r - 1) < 1e-6 && then[i].phi >= 0 && then[i].phi < 6.2831855f);
            double rho = sqrt(o.r * o.r + a * a);
            double x = rho * cos(then[i].phi), y = rho * sin(then[i].phi);
            assert_true(hypot(then[i].x - x, then[i].y - y) < 2e-6 * rho && then[i].z == 0);
        }
        test_free(start);
        test_free(then);
    }
    printf("azimuths after 1e4 M: within %.2g rad\n", worst);
    assert_true(worst < 1e-6);
}

/* E, L and the norm in the metric of a hole (spin, charge), computed from a place in or off the equatorial plane and
 * from the rates of change there. */
struct constants { double energy, momentum, norm; };
static struct constants constants_of(const double hole[2], const struct row *p)
{
    double a = hole[0], r = p->r, u = sin(p->latitude), sin2 = 1 - u * u, sigma = r * r + a * a * u * u,
           mass = 2 * r - hole[1] * hole[1], delta = r * r - mass + a * a;
    double gtt = -(1 - mass / sigma), gtp = -a * mass * sin2 / sigma;
    double gpp = (r * r + a * a + a * a * mass * sin2 / sigma) * sin2;
    double across = p->dr * p->dr / delta + (double)p->dlatitude * p->dlatitude;
    double norm = gtt + 2 * gtp * p->dphi + gpp * p->dphi * p->dphi + sigma * across;
    double ut = 1 / sqrt(-norm);
    return (struct constants) { -ut * (gtt + gtp * p->dphi), ut * (gtp + gpp * p->dphi), norm };
}

/* Rates of falling particles are those of a body with the E and L of the ISCO, which the list states. Next to the
 * horizon the norm is almost 0, while E and L contribute to it in single precision. */
static void test_falling(void **state)
{
    (void)state;
    static const double holes[][2] = { { -0.9, 0 }, { 0, 0 }, { 0.95, 0 }, { 0, 0.99 }, { 0.6, 0.7 } };
    for (size_t s = 0; s < sizeof holes / sizeof *holes; s++) {
        struct kd_scene scene = scene_of(holes[s][0], 0);
        scene.spacetime.charge = holes[s][1];
        scene.disk.plunging = 0.2;
        const struct kd_hole hole = kd_hole_charged(holes[s][0], holes[s][1]);
        double isco = kd_kerr_isco(&hole), energy = kd_kerr_energy(&hole, isco), worst = 0;
        double momentum = kd_kerr_momentum(&hole, isco);
        size_t n, fell = 0;
        struct row *rows = all_at(&scene, "777.5", &n);
        for (size_t i = 0; i < n; i++) {
            bool falls = 3 + 29 * i < 6000;
            assert_true(falls == (rows[i].r < isco * (1 - 1e-6)));
            if (!falls)
                continue;
            const struct constants c = constants_of(holes[s], &rows[i]);
            fell++;
            assert_true(rows[i].dr < 0 && rows[i].latitude == 0 && rows[i].dlatitude == 0);
            assert_true(fabs(rows[i].energy / energy - 1) < 1e-6 && fabs(rows[i].momentum / momentum - 1) < 1e-6);
            worst = fmax(worst, -c.norm * fmax(fabs(c.energy / energy - 1), fabs(c.momentum / momentum - 1)));
        }
        printf("a = %g, q = %g: E and L of %zu that fall, from rates, within %.1e over the norm\n", hole.a, hole.q,
               fell, worst);
        assert_true(fell == 207 && worst < 1e-6);
        test_free(rows);
    }
}

/* On the guiding orbit, computed by physics/orbit/timelike.c, the rates and constants belong to one orbit. With
 * epicycles this holds to first order: the difference is proportional to the square of the epicycles. */
static void test_constants(void **state)
{
    (void)state;
    static const double holes[][2] = { { -0.9, 0 }, { 0, 0 }, { 0.95, 0 }, { 0, 0.99 }, { 0.6, 0.7 } },
                        epicycles[] = { 0, 0.002, 0.02 };
    for (size_t s = 0; s < sizeof holes / sizeof *holes; s++) {
        const struct kd_hole hole = kd_hole_charged(holes[s][0], holes[s][1]);
        for (size_t k = 0; k < 3; k++) {
            struct kd_scene scene = scene_of(hole.a, epicycles[k]);
            scene.spacetime.charge = hole.q;
            const struct kd_particle_grid grid = kd_particle_grid(&scene);
            double worst = 0, fastest = 0, bound = 1e-6 + 3 * epicycles[k] * epicycles[k];
            size_t n;
            struct row *rows = all_at(&scene, "777.5", &n);
            for (size_t i = 0; i < n; i++) {
                const struct kd_particle_orbit o = orbit_of(&scene, &grid, i);
                struct kd_orbit orbit;
                if (o.r > kd_orbit_separatrix(&hole, 0, 1) * (1 + 1e-9)) {
                    OK(kd_orbit_from_shape(&hole, o.r, 0, 1, &orbit, &error));
                    assert_true(fabs(rows[i].energy / orbit.energy - 1) < 1e-6);
                    assert_true(fabs(rows[i].momentum / orbit.momentum - 1) < 1e-6);
                }
                const struct constants c = constants_of(holes[s], &rows[i]);
                assert_true(c.norm < 0);
                worst = fmax(worst, fmax(fabs(c.energy / rows[i].energy - 1), fabs(c.momentum / rows[i].momentum - 1)));
                fastest = fmax(fastest, fabs(rows[i].dr));
            }
            printf("a = %g, q = %g, epicycles %g: E and L from rates within %.1e\n", hole.a, hole.q, epicycles[k],
                   worst);
            assert_true(worst < bound && (fastest > 0.05 * epicycles[k] || !epicycles[k]));
            test_free(rows);
        }
    }
}

/* Central differences of the listed values over 2 M. The third derivative of an epicycle, and single precision, cause
 * an error of 2e-5 of the largest rates. */
static void test_rates(void **state)
{
    (void)state;
    const struct kd_scene scene = scene_of(0.5, 0.1);
    size_t n;
    struct row *before = all_at(&scene, "9999", &n), *now = all_at(&scene, "10000", &n),
               *after = all_at(&scene, "10001", &n);
    double worst = 0;
    for (size_t i = 0; i < n; i++) {
        if (now[i].r < 9)
            continue; /* skipped, because this particle is too fast for differences over such a step */
        double dphi = remainder((double)after[i].phi - before[i].phi, 2 * M_PI) / 2;
        worst = fmax(worst, fabs((after[i].r - before[i].r) / 2 - now[i].dr));
        worst = fmax(worst, fabs(dphi - now[i].dphi));
        worst = fmax(worst, fabs((after[i].latitude - before[i].latitude) / 2 - now[i].dlatitude));
    }
    printf("rates against differences: within %.1e\n", worst);
    assert_true(worst < 2e-5);
    test_free(before);
    test_free(now);
    test_free(after);
}

static void test_parts(void **state)
{
    (void)state;
    const struct kd_scene scene = scene_of(0.5, 0.02);
    struct kd_particle_list all, part;
    OK(kd_particle_list_init(&all, &scene, &error));
    float *rows = fill(&all);
    assert_int_equal(all.n, 30000);
    OK(kd_particle_list_init(&part, &scene, &error));
    set(&part, "first", "11");
    set(&part, "stride", "7");
    set(&part, "count", "1000");
    float *some = fill(&part);
    for (size_t i = 0; i < 1000; i++)
        assert_memory_equal(some + 3 * i, rows + 3 * (11 + 7 * i), 12);
    /* a part that begins in the middle of the list */
    OK(kd_particle_list_fill(renderer, &part, 500, 500, rows, &error));
    assert_memory_equal(rows, some + 1500, 6000);
    assert_false(part.orbits);
    test_free(some);
    test_free(rows);
}

static void test_refused(void **state)
{
    (void)state;
    static const struct {
        const char *name, *text, *pointer, *fragment;
    } bad[] = {
        { "stride", "0", "/stride", "stride is 0; it must be a whole number from 1 to 30000" },
        { "stride", "30001", "/stride", "30000" },
        { "first", "30000", "/first", "from 0 to 29999" },
        { "first", "-1", "/first", "-1" },
        { "count", "1.5", "/count", "count is 1.5" },
        { "count", "", "/count", "count is " },
        { "count", "nan", "/count", "count is nan" },
        { "time", "1e13", "/time", "time is 1e13; it must be -1e12 to 1e12 M" },
        { "time", "soon", "/time", "time is soon" },
        { "fields", "x,mass", "/fields",
          "fields is \"x,mass\"; it must hold some of these, each once, with commas between: x,y,z,r,phi" },
        { "fields", "x,y,x", "/fields", "each once" },
        { "fields", "", "/fields", "each once" },
        { "fields", "x,", "/fields", "each once" },
        { "colour", "red", "/colour", "the parameters are first, stride, count, fields and time" },
    };
    struct kd_scene scene = scene_of(0.5, 0);
    struct kd_particle_list list;
    struct kd_error why;
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        OK(kd_particle_list_init(&list, &scene, &error));
        assert_int_equal(kd_particle_list_set(&list, bad[i].name, bad[i].text, &why), KD_EINVAL);
        assert_string_equal(why.pointer, bad[i].pointer);
        if (!strstr(why.message, bad[i].fragment))
            fail_msg("%s", why.message);
    }
    OK(kd_particle_list_init(&list, &scene, &error));
    set(&list, "stride", "3");
    set(&list, "count", "10001");
    assert_int_equal(kd_particle_list_settle(&list, 0, &why), KD_EINVAL);
    assert_non_null(strstr(why.message, "count is 10001; it must be 1 to 10000"));
    set(&list, "count", "10000");
    assert_int_equal(kd_particle_list_settle(&list, 12 * 9999, &why), KD_EINVAL);
    assert_non_null(strstr(why.message, "count is 10000 with 12 bytes a particle; it must be 1 to 9999"));
    OK(kd_particle_list_settle(&list, 12 * 10000, &error));
    scene.disk.model = KD_DISK_NONE;
    assert_int_equal(kd_particle_list_init(&list, &scene, &why), KD_EINVAL);
    assert_string_equal(why.pointer, "/disk/model");
}

int main(void)
{
    int code = open_renderer();
    if (code)
        return code;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_phase), cmocka_unit_test(test_falling), cmocka_unit_test(test_constants),
        cmocka_unit_test(test_rates), cmocka_unit_test(test_parts),   cmocka_unit_test(test_refused),
    };
    return close_renderer(cmocka_run_group_tests_name("lists of particles", tests, NULL, NULL));
}

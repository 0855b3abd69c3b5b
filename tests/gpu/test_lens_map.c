/* Tests of the lens map on the device. It is compared with the Kerr-Schild oracle, which traces the same pixels in
 * double precision by another method (tests/oracle).
 *
 * The tolerance of a crossing is some roundings of a float times the amplification d ln r/d ln b, which is measured on
 * the oracle. The amplification is several hundred near the critical curve. */
#include "kerr_schild.h"
#include "physics/spacetime/kerr.h"
#include "render/render.h"

#include "interface.h"
#include "render_support.h"

#include <math.h>

#define ORDERS 3
#define GRID 32

struct view {
    const char *name;
    double a, inclination, r; /* INFINITY, or the radius r of a pinhole camera */
    bool zamo;
    double field; /* width of the picture in M; in degrees for a pinhole camera */
    bool away;    /* true: the pinhole camera looks outwards */
    double q;     /* charge */
};

struct sample {
    struct ks_path path, beside;
    double nudge;
};

static struct ks_photon photon(const struct view *v, double x, double y, double scale)
{
    double theta = v->inclination * M_PI / 180;
    x *= scale;
    y *= scale;
    if (isinf(v->r))
        return ks_from_infinity_charged(v->a, v->q, v->inclination == 90 ? 0 : cos(theta), 0.5 * v->field * x,
                                        0.5 * v->field * y);
    double t = tan(0.5 * v->field * M_PI / 180), n = 1 / sqrt(1 + t * t * (x * x + y * y));
    const double k[3] = { v->away ? n : -n, -t * y * n, v->away ? -t * x * n : t * x * n };
    return ks_from_camera_charged(v->a, v->q, v->r, theta, v->zamo, k);
}

/* The oracle's path for a pixel of a GRID x GRID picture, and its path for a ray that is a millionth further out. */
static struct sample sample(const struct view *v, int i, int j)
{
    double x = (2 * i + 1.0) / GRID - 1, y = 1 - (2 * j + 1.0) / GRID;
    return (struct sample) { ks_trace(photon(v, x, y, 1), 16), ks_trace(photon(v, x, y, 1 + 1e-6), 16), 1e-6 };
}

static double turn(double x) { return fabs(remainder(x, 2 * M_PI)); }

struct lens {
    struct kd_plan plan;
    float *planes;
};

/* True if the plan chooses the closed form, which it does for observers outside the photon orbits. */
static bool has_closed_form(const struct view *v)
{
    const struct kd_hole hole = kd_hole_charged(v->a, v->q);
    return v->r > 1.05 * kd_kerr_outermost_photon_orbit(&hole);
}

/* steps: number of steps for half a period; 0: the plan's choice. */
static struct lens trace(const struct view *v, const struct kd_needs *needs, int orders, int steps)
{
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct lens lens;
    kd_scene_smooth(&scene);
    scene.accuracy.steps = steps;
    scene.spacetime.spin = v->a;
    scene.spacetime.charge = v->q;
    scene.camera.inclination_deg = v->inclination;
    scene.camera.r = v->r;
    scene.camera.yaw_deg = v->away ? 180 : 0;
    scene.camera.observer = v->zamo ? KD_OBSERVER_ZAMO : KD_OBSERVER_STATIC;
    *(isinf(v->r) ? &scene.camera.field_m : &scene.camera.fov_deg) = v->field;
    scene.image.width = scene.image.height = GRID;
    scene.accuracy.orders = orders;
    OK(kd_scene_validate(&scene, &error));
    kd_renderer_capacity(renderer, &capacity);
    const struct kd_needs followed = { .quantities = needs->quantities, .followed = true };
    OK(kd_plan_make_for(&scene, &followed, &capacity, &lens.plan, &error));
    lens.planes = test_malloc(sizeof(float) * lens.plan.lens.planes * lens.plan.lens.rays);
    OK(kd_render_lens(renderer, &scene, &lens.plan, lens.planes, NULL, &error));
    return lens;
}

struct tally {
    int count, wrong;
    double worst;
    double errors[GRID * GRID];
};

static double median(struct tally *t)
{
    qsort(t->errors, (size_t)t->count, sizeof *t->errors, by_value);
    return t->count ? t->errors[t->count / 2] : 0;
}

/* True if a ray is not compared: a shift of 3e-6 changes its number of crossings, or a crossing is at the inner limit
 * of those that are kept. */
static bool undecided(const struct sample *s, int n, double inner)
{
    if ((s->path.crossings > n) != (s->beside.crossings > n))
        return true;
    double r = s->path.crossings > n ? s->path.r[n] : INFINITY;
    return r < inner * 1.001 || r > 1e4;
}

/* Compares one plane of radii and, if the map has them, azimuths. Errors are divided by 1 + the amplification. */
static void judge(const struct view *v, const struct lens *lens, const struct sample *samples, int n,
                  struct tally *radius, struct tally *azimuth)
{
    double inner = kd_hole_charged(v->a, v->q).outer;
    for (int k = 0; k < GRID * GRID; k++) {
        const struct sample *s = &samples[k];
        float w = lens->planes[n * (int)lens->plan.lens.rays + k];
        assert_true(isfinite(w) && w >= 0);
        bool has = s->path.crossings > n;
        if ((w > 0) != has) {
            if (!undecided(s, n, inner) && !(w > 0 && w < 1e-4)) {
                print_message("%s: order %d at %d, %d: device r = %g, oracle %g\n", v->name, n, k % GRID, k / GRID,
                              1 / w, has ? s->path.r[n] : INFINITY);
                radius->wrong++;
            }
            continue;
        }
        if (!has || undecided(s, n, inner) || s->beside.crossings <= n)
            continue;
        double r = s->path.r[n], gain = fabs(log(s->beside.r[n] / r)) / s->nudge;
        radius->errors[radius->count++] = fabs(1 / (double)w / r - 1) / (1 + gain);
        radius->worst = fmax(radius->worst, radius->errors[radius->count - 1]);
        if (!kd_plan_holds(&lens->plan.lens, KD_LENS_PHI) ||
            r < 1.6 * inner) /* skipped, because Boyer-Lindquist azimuth diverges at the horizon */
            continue;
        double phi_gain = turn(s->beside.phi[n] - s->path.phi[n]) / s->nudge;
        float phi = lens->planes[(ORDERS + n) * (int)lens->plan.lens.rays + k];
        azimuth->errors[azimuth->count++] = turn(phi - s->path.phi[n]) / (1 + phi_gain);
        azimuth->worst = fmax(azimuth->worst, azimuth->errors[azimuth->count - 1]);
    }
}

static const struct view views[] = {
    { "a 0.9, i 70, infinity", 0.9, 70, INFINITY, false, 24 },
    { "a 0, i 45, infinity", 0, 45, INFINITY, false, 24 },
    { "a 0.998, i 85, infinity", 0.998, 85, INFINITY, false, 20 },
    { "a -0.9, i 20, infinity", -0.9, 20, INFINITY, false, 24 },
    { "a 0.5, i 135, infinity", 0.5, 135, INFINITY, false, 24 },
    { "a 0.9, edge-on", 0.9, 90, INFINITY, false, 24 },
    { "a 0.9, face-on", 0.9, 0, INFINITY, false, 24 },
    { "a 0.9, from below the axis", 0.9, 180, INFINITY, false, 24 },
    { "a 0.99999, i 60, narrow", 0.99999, 60, INFINITY, false, 12 },
    { "a 0.9, i 70, wide", 0.9, 70, INFINITY, false, 2000 },
    { "a 0.998, i 80, into the hole", 0.998, 80, INFINITY, false, 3 },
    { "a 0, i 60, into the hole", 0, 60, INFINITY, false, 4 },
    { "static at 20", 0.9, 75, 20, false, 70 },
    { "zamo at 20", 0.9, 75, 20, true, 70 },
    { "zamo at 4", 0.9, 60, 4, true, 100 },
    { "zamo at 1.6, in the ergosphere", 0.9, 80, 1.6, true, 100 },
    { "static at 6, below", -0.7, 150, 6, false, 90 },
    { "static at 1000", 0.3, 80, 1000, false, 2 },
    { "zamo at 4.5", 0.998, 80, 4.5, true, 140 },
    { "static at 20, outwards", 0.9, 60, 20, false, 100, true },
    { "zamo at 4.5, outwards, narrow", 0.998, 50, 4.5, true, 14, true },
    { "static at 6, near the axis, outwards", 0.9, 3, 6, false, 60, true },
    { "static at 1e6", 0.9, 60, 1e6, false, 2e-3 },
    { "a 0, q 0.9, infinity", 0, 60, INFINITY, false, 24, false, 0.9 },
    { "a 0.6, q 0.6, infinity", 0.6, 80, INFINITY, false, 20, false, 0.6 },
    { "a -0.5, q 0.5, i 135", -0.5, 135, INFINITY, false, 24, false, 0.5 },
    { "a 0.8, q 0.59999, narrow", 0.8, 60, INFINITY, false, 12, false, 0.59999 },
    { "a 0.6, q 0.7, wide", 0.6, 70, INFINITY, false, 2000, false, 0.7 },
    { "a 0, q 0.99, into the hole", 0, 60, INFINITY, false, 4, false, 0.99 },
    { "q 0.6, static at 20", 0.7, 75, 20, false, 70, false, 0.6 },
    { "q 0.6, zamo at 3", 0.7, 60, 3, true, 100, false, 0.6 },
    { "q 0.4, zamo at 1.5, in the ergosphere", 0.88, 80, 1.5, true, 100, false, 0.4 },
    { "q 0.7, static at 20, outwards", 0.6, 60, 20, false, 100, true, 0.7 },
};
enum { VIEWS = sizeof views / sizeof *views };

static struct sample samples[VIEWS][GRID * GRID];

/* For each order: the median and the worst error, divided by 1 + the amplification. Rounding of floats alone gives some
 * 3e-7, from tens of operations with 6e-8 each. The bounds are larger, because square roots and divisions of other
 * devices are less accurate. */
static void check(const struct view *v, const struct lens *lens, const struct sample *s, double worst_r,
                  double worst_phi)
{
    for (int n = 0; n < ORDERS; n++) {
        struct tally r = { 0 }, phi = { 0 };
        judge(v, lens, s, n, &r, &phi);
        double mr = median(&r), mp = median(&phi);
        print_message("%-34s order %d: %4d rays, r %.1e worst %.1e, phi %.1e worst %.1e\n", v->name, n, r.count, mr,
                      r.worst, mp, phi.worst);
        assert_int_equal(r.wrong, 0);
        assert_true(mr < 1e-6);
        assert_true(r.worst < worst_r);
        assert_true(mp < 1e-6);
        assert_true(phi.worst < worst_phi);
    }
}

static void test_closed_form(void **state)
{
    (void)state;
    for (int i = 0; i < VIEWS; i++) {
        if (!has_closed_form(&views[i]))
            continue;
        for (int phi = 0; phi < 2; phi++) {
            struct lens lens =
                trace(&views[i], &(struct kd_needs) { .quantities = KD_LENS_W | (phi ? KD_LENS_PHI : 0) }, ORDERS, 0);
            assert_true(lens.plan.lens.path == KD_LENS_CLOSED);
            check(&views[i], &lens, samples[i], 5e-6, 2e-6);
            test_free(lens.planes);
        }
    }
}

static void test_integrated(void **state)
{
    (void)state;
    for (int i = 0; i < VIEWS; i++) {
        struct lens lens = trace(&views[i], &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_PHI }, ORDERS, 16);
        assert_true(lens.plan.lens.path == KD_LENS_MAP);
        check(&views[i], &lens, samples[i], 5e-6, 2e-6);
        test_free(lens.planes);
    }
}

/* Compares the fates of rays, and the directions of those that escape (the angle between unit vectors), with the
 * oracle's. */
static void check_sky(int steps)
{
    for (int i = 0; i < VIEWS; i++) {
        if (!steps && !has_closed_form(&views[i]))
            continue;
        struct lens lens =
            trace(&views[i], &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_SKY }, ORDERS, steps);
        assert_true(lens.plan.lens.path == (steps ? KD_LENS_MAP : KD_LENS_CLOSED));
        const float *u = lens.planes + ORDERS * lens.plan.lens.rays, *phi = u + lens.plan.lens.rays,
                    *fate = phi + lens.plan.lens.rays;
        double worst = 0;
        int compared = 0;
        for (int k = 0; k < GRID * GRID; k++) {
            const struct ks_path *p = &samples[i][k].path, *q = &samples[i][k].beside;
            assert_true(isfinite(u[k]) && isfinite(phi[k]));
            if (p->fate != q->fate || p->fate == KS_UNDECIDED)
                continue;
            if ((fate[k] == KD_FATE_ESCAPED) != (p->fate == KS_ESCAPED))
                fail_msg("%s: fate at %d, %d is %g, the oracle's %d", views[i].name, k % GRID, k / GRID, fate[k],
                         p->fate);
            if (p->fate != KS_ESCAPED)
                continue;
            double s = sqrt(fmax(0, 1 - p->u * p->u));
            double gain = hypot(q->u - p->u, s * turn(q->sky_phi - p->sky_phi)) / 1e-6;
            /* the oracle stops at r = 1e8, where the direction differs by 1e-8 b from the limit */
            double error = hypot(u[k] - p->u, s * turn(phi[k] - p->sky_phi)) / (1 + gain);
            worst = fmax(worst, error);
            compared++;
        }
        print_message("%-34s sky: %4d rays, worst %.1e\n", views[i].name, compared, worst);
        assert_true(worst < (views[i].field > 100 ? 2e-5 : 2e-6));
        test_free(lens.planes);
    }
}

static void test_sky(void **state)
{
    (void)state;
    check_sky(16);
}

static void test_sky_closed(void **state)
{
    (void)state;
    check_sky(0);
}

/* A row of rays in the equatorial plane, with Q = 0. They have no crossing, and their directions stay in the plane. */
static void test_in_plane(void **state)
{
    (void)state;
    const struct view v = { "a 0.9, in the plane", 0.9, 90, INFINITY, false, 24 };
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    float planes[9 * GRID];
    kd_scene_smooth(&scene);
    scene.spacetime.spin = v.a;
    scene.camera.inclination_deg = v.inclination;
    scene.camera.field_m = v.field;
    scene.image.width = GRID;
    scene.image.height = 1;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make_for(&scene,
                        &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY, .followed = true },
                        &capacity, &plan, &error));
    assert_true(plan.lens.path == KD_LENS_CLOSED && plan.lens.planes == 9);
    OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
    int escaped = 0;
    for (int k = 0; k < GRID; k++) {
        double x = (2 * k + 1.0) / GRID - 1;
        struct ks_path p = ks_trace(photon(&v, x, 0, 1), 16), q = ks_trace(photon(&v, x, 0, 1 + 1e-6), 16);
        const float *u = planes + 6 * GRID + k, *phi = u + GRID, *fate = phi + GRID;
        for (int n = 0; n < 6; n++)
            assert_true(planes[n * GRID + k] == 0);
        assert_true(*fate == (p.fate == KS_ESCAPED ? KD_FATE_ESCAPED : KD_FATE_CAPTURED));
        if (p.fate != KS_ESCAPED)
            continue;
        assert_true(*u == 0);
        assert_true(turn(*phi - p.sky_phi) < 2e-6 * (1 + turn(q.sky_phi - p.sky_phi) / 1e-6));
        escaped++;
    }
    assert_true(escaped > GRID / 2 && escaped < GRID);
}

/* The error of the first crossing meets the project's bound without division by the amplification: at most 1e-5, with a
 * median of 1e-6. */
static void test_promise(void **state)
{
    (void)state;
    const struct kd_needs both[] = { { .quantities = KD_LENS_W }, { .quantities = KD_LENS_W | KD_LENS_PHI } };
    for (int m = 0; m < 2; m++) {
        struct lens lens = trace(&views[0], &both[m], 1, 0);
        struct tally t = { 0 };
        for (int k = 0; k < GRID * GRID; k++)
            if (samples[0][k].path.crossings && lens.planes[k] > 0 &&
                !undecided(&samples[0][k], 0, kd_hole(0.9)->outer))
                t.errors[t.count++] = fabs(1 / (double)lens.planes[k] / samples[0][k].path.r[0] - 1);
        assert_true(t.count > 900);
        assert_true(median(&t) < 1e-6);
        assert_true(t.errors[t.count - 1] < 1e-5);
        test_free(lens.planes);
    }
}

/* The edge of a Schwarzschild shadow: the captured pixels of 1024^2 fill a disk of radius 3 sqrt(3) M. The area is a
 * mean over the 2900 = 2 pi R/pixel pixels of the rim. The tolerance of 0.1 % is therefore ten times the statistical
 * error. */
static void test_shadow(void **state)
{
    (void)state;
    struct kd_scene scene;
    struct kd_capacity capacity;
    struct kd_plan plan;
    const int n = 1024;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = 0;
    scene.camera.field_m = 12;
    scene.image.width = scene.image.height = n;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_SKY, .followed = true }, &capacity, &plan,
                        &error));
    float *planes = test_malloc(sizeof(float) * plan.lens.planes * plan.lens.rays);
    OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
    const float *fate = planes + (plan.lens.planes - 1) * plan.lens.rays;
    double captured = 0, undecided_rays = 0, farthest = 0, nearest = INFINITY;
    for (int k = 0; k < n * n; k++) {
        double x = (k % n + 0.5 - n / 2) * 12.0 / n, y = (k / n + 0.5 - n / 2) * 12.0 / n, b = hypot(x, y);
        captured += fate[k] == KD_FATE_CAPTURED;
        undecided_rays += fate[k] == KD_FATE_UNDECIDED;
        if (fate[k] == KD_FATE_CAPTURED)
            farthest = fmax(farthest, b);
        else
            nearest = fmin(nearest, b);
    }
    double radius = sqrt((captured + 0.5 * undecided_rays) / M_PI) * 12.0 / n, exact = 3 * sqrt(3);
    print_message("shadow: radius %.6f M, exact %.6f; edge between %.6f and %.6f\n", radius, exact, nearest, farthest);
    assert_true(fabs(radius / exact - 1) < 1e-3);
    assert_true(farthest < exact * (1 + 1e-5) && nearest > exact * (1 - 1e-5));
    test_free(planes);
}

/* The edge of the shadow of charged holes without spin (J. Eiroa et al. 2002, Phys. Rev. D 66, 024010), seen in a row
 * of pixels 1e-8 M wide. */
static void test_charged_shadow(void **state)
{
    (void)state;
    static const struct {
        double q, b;
    } known[] = { { 0, 5.196152422706632 }, { 0.5, 4.96791433 }, { 0.6, 4.85869419 }, { 1 - 1e-12, 4 } };
    enum { N = 512 };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const double pixel = 1e-8;
        struct kd_scene scene;
        struct kd_capacity capacity;
        struct kd_plan plan;
        float planes[16 * N];
        int captured = 0, decided = 0;
        kd_scene_smooth(&scene);
        scene.spacetime.spin = 0;
        scene.spacetime.charge = known[i].q;
        scene.camera.inclination_deg = 60;
        scene.camera.centre_alpha = known[i].b;
        scene.camera.field_m = N * pixel;
        scene.image.width = N;
        scene.image.height = 1;
        kd_renderer_capacity(renderer, &capacity);
        OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_SKY, .followed = true }, &capacity,
                            &plan, &error));
        assert_true(plan.lens.planes <= 16);
        OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
        for (int k = 0; k < N; k++) {
            const float fate = planes[(plan.lens.planes - 1) * N + (size_t)k];
            captured += fate == KD_FATE_CAPTURED;
            decided += fate != KD_FATE_UNDECIDED;
        }
        const double edge = known[i].b + (captured - N / 2) * pixel;
        print_message("charge %.12g: edge at %.9f M, %d pixels decided\n", known[i].q, edge, decided);
        assert_true(decided >= N - 2);
        assert_true(fabs(edge - known[i].b) <= 1.5e-8);
    }
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    for (int v = 0; v < VIEWS; v++)
        for (int k = 0; k < GRID * GRID; k++)
            samples[v][k] = sample(&views[v], k % GRID, k / GRID);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_promise), cmocka_unit_test(test_closed_form),    cmocka_unit_test(test_integrated),
        cmocka_unit_test(test_sky),     cmocka_unit_test(test_sky_closed),     cmocka_unit_test(test_in_plane),
        cmocka_unit_test(test_shadow),  cmocka_unit_test(test_charged_shadow),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

/* Tests of every kind of observer by the view of its camera. The whole sky, in six pictures, is compared with frames
 * and rays in Kerr-Schild coordinates. */
#include "kerr_schild.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/observer.h"
#include "render/render.h"
#include "render/view/camera.h"

#include "render_support.h"

#include <math.h>

enum { GRID = 12, RAYS = GRID * GRID, FACES = 6, ORDERS = 2 };
#define RADIAN (M_PI / 180)
#define HORIZON 1.4358898943540673 /* radius of a horizon of a = 0.9 */
#define FALL .fall_from = INFINITY, .fall_energy = INFINITY

static const struct seer {
    const char *name;
    double spin, inclination, r;
    struct kd_observer_motion motion;
    double
        /* energies of bodies in free fall and on circular orbits, from Bardeen, Press & Teukolsky or computed by
         * hand */
        energy;
    double momentum;
} seers[] = {
    { "zamo", 0.9, 60, 4, { .observer = KD_OBSERVER_ZAMO }, 0, 0 },
    { "velocity", 0.9, 70, 12, { .observer = KD_OBSERVER_VELOCITY, .velocity = { -0.5, 0.3, 0.6 } }, 0, 0 },
    { "velocity", -0.6, 120, 2.5, { .observer = KD_OBSERVER_VELOCITY, .velocity = { 0.2, -0.4, -0.3 } }, 0, 0 },
    { "rain", 0, 75, 20, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 110, 2, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 2.1, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 2, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 1.9, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 1, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 0.3, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0, 75, 0.05, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, HORIZON * 1.001, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, HORIZON * 1.000001, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, HORIZON, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, HORIZON * 0.999999, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, HORIZON * 0.999, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, 1.43, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 75, 1.2, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "rain", 0.9, 120, 0.7, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "plunge",
      0.9,
      80,
      1.3,
      { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = 0.9, .fall_momentum = 1.2 },
      0.9,
      1.2 },
    { "rain", 0.9, 75, 6, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 },
    { "from 10 M",
      0,
      80,
      5,
      { .observer = KD_OBSERVER_INFALL, .fall_from = 10, .fall_energy = INFINITY },
      0.89442719099991588,
      0 }, /* sqrt(0.8) */
    { "plunge",
      0.7,
      80,
      3,
      { .observer = KD_OBSERVER_INFALL, .fall_from = INFINITY, .fall_energy = 0.95, .fall_momentum = 1.5 },
      0.95,
      1.5 },
};
enum { SEERS = sizeof seers / sizeof *seers };

static const struct {
    double yaw, pitch;
} faces[FACES] = { { 0, 0 }, { 90, 0 }, { 180, 0 }, { -90, 0 }, { 0, 90 }, { 0, -90 } };

static struct kd_scene scene_of(const struct seer *seer, int face)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = seer->spin;
    scene.camera.inclination_deg = seer->inclination;
    scene.camera.r = seer->r;
    scene.camera.observer = seer->motion.observer;
    scene.camera.velocity_r = seer->motion.velocity[0];
    scene.camera.velocity_theta = seer->motion.velocity[1];
    scene.camera.velocity_phi = seer->motion.velocity[2];
    if (seer->motion.observer == KD_OBSERVER_INFALL) {
        scene.camera.infall_from = seer->motion.fall_from;
        scene.camera.infall_energy = seer->motion.fall_energy;
        scene.camera.infall_momentum = seer->motion.fall_momentum;
    }
    scene.camera.fov_deg = 90;
    scene.camera.yaw_deg = faces[face].yaw;
    scene.camera.pitch_deg = faces[face].pitch;
    scene.image.width = scene.image.height = GRID;
    scene.image.critical_factor = 1;
    scene.accuracy.orders = ORDERS;
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

static struct ks_place place_of(const struct seer *seer)
{
    return (struct ks_place) { seer->spin, seer->r, seer->inclination * RADIAN };
}

static struct ks_frame frame_of(const struct seer *seer)
{
    const struct ks_place at = place_of(seer);
    const double *v = seer->motion.velocity, x[4] = { 1, v[0], v[1], v[2] };
    const struct ks_frame base = seer->motion.observer == KD_OBSERVER_INFALL ? ks_rain(&at) : ks_zamo(&at);
    double u[4] = { 0 }, gamma = 1 / sqrt(1 - (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
    if (seer->motion.observer == KD_OBSERVER_INFALL)
        ks_inwards(&at, 1, seer->energy, seer->momentum, 0, u);
    else
        for (int i = 0; i < 4; i++)
            for (int k = 0; k < 4; k++)
                u[k] += gamma * x[i] * base.e[i][k];
    return ks_boost(&at, &base, u);
}

static double step_of(int i) { return (2 * i + 1.0) / GRID - 1; }

/* The direction (k_r, k_theta, k_phi) of a pixel on one face of the cube. */
static void direction(int face, double x, double y, double k[3])
{
    double n = 1 / sqrt(1 + x * x + y * y);
    double yaw = faces[face].yaw * RADIAN, pitch = faces[face].pitch * RADIAN;
    double ahead = cos(pitch) - y * sin(pitch), up = sin(pitch) + y * cos(pitch);
    double in = ahead * cos(yaw) - x * sin(yaw), right = ahead * sin(yaw) + x * cos(yaw);
    k[0] = -in * n, k[1] = -up * n, k[2] = right * n;
}

static void photon(const struct seer *seer, int face, double x, double y, double p[4])
{
    const struct ks_frame f = frame_of(seer);
    double k[3];
    direction(face, x, y, k);
    ks_seen(&f, k, p);
}

/* The kernels' starting values for each pixel of the whole sky: E (the redshift), L, p_theta and p^r, in the kernels'
 * arithmetic. Errors are relative to the size of the tetrad's legs. */
static double constants(const struct seer *seer)
{
    const struct ks_place at = place_of(seer);
    const double s = sin(at.theta);
    double worst = 0;
    for (int n = 0; n < FACES * RAYS; n++) {
        int face = n / RAYS, i = n % GRID, j = n / GRID % GRID;
        const struct kd_scene scene = scene_of(seer, face);
        const struct kd_camera_block c = kd_camera_block(&scene);
        float x = (float)i - c.middle_x, y = c.middle_y - (float)j;
        float kx = c.c0x + x * c.cxx + y * c.cyx, ky = c.c0y + x * c.cxy + y * c.cyy,
              kz = c.c0z + x * c.cxz + y * c.cyz;
        float norm = 1 / sqrtf(kx * kx + ky * ky + kz * kz), m_r = -kx * norm, m_theta = -ky * norm, m_phi = -kz * norm;
        double p[4], want[4];
        photon(seer, face, step_of(i), -step_of(j), p);
        ks_constants(&at, p, want);
        const double is[4] = {
            c.e_t + c.e_r * m_r + c.e_theta * m_theta + c.e_phi * m_phi,
            s * (c.l_t + c.l_r * m_r + c.l_theta * m_theta + c.l_phi * m_phi),
            c.p_t + c.p_r * m_r + c.p_theta * m_theta + c.p_phi * m_phi,
            (c.dw_t + c.dw_r * m_r + c.dw_theta * m_theta + c.dw_phi * m_phi) * seer->r * seer->r,
        };
        const double size[4] = {
            fabsf(c.e_t) + fabsf(c.e_r) + fabsf(c.e_phi),
            s * (fabsf(c.l_t) + fabsf(c.l_r) + fabsf(c.l_phi)),
            fabsf(c.p_t) + fabsf(c.p_theta),
            seer->r * seer->r * (fabsf(c.dw_t) + fabsf(c.dw_r)),
        };
        for (int q = 0; q < 4; q++)
            worst = fmax(worst, fabs(is[q] - want[q]) / size[q]);
    }
    return worst;
}

/* The direction in which an observer sees a photon with given constants, in double precision, by contraction with the
 * oracle's tetrad. */
static double aberration(const struct seer *seer)
{
    const struct ks_place at = place_of(seer);
    const struct ks_frame f = frame_of(seer);
    const struct kd_scene scene = scene_of(seer, 0);
    const struct kd_observer_motion motion = kd_scene_observer(&scene);
    const struct kd_vantage where = kd_scene_vantage(&scene);
    const struct kd_tetrad tetrad = kd_observer_tetrad(&motion, &where);
    double worst = 0;
    for (int n = 0; n < FACES * RAYS; n++) {
        double p[4], c[4], k[3];
        direction(n / RAYS, step_of(n % GRID), step_of(n / GRID % GRID), k);
        ks_seen(&f, k, p);
        ks_constants(&at, p, c);
        const struct kd_covector light = { c[0], c[1] / where.s, c[2], c[3] };
        const struct kd_look look = kd_tetrad_look(&tetrad, &light);
        worst = fmax(worst, fmax(fmax(fabs(look.inwards + k[0]), fabs(look.up + k[1])),
                                 fmax(fabs(look.right - k[2]), fabs(look.energy - c[0]))));
    }
    return worst;
}

static void whole_sky(void **state)
{
    (void)state;
    for (int i = 0; i < SEERS; i++) {
        double single = constants(&seers[i]), twice = aberration(&seers[i]);
        print_message("%s, a = %g, r = %g: constants of a pixel within %.1e, aberration and redshift within %.1e\n",
                      seers[i].name, seers[i].spin, seers[i].r, single, twice);
        assert_true(single < 1e-6 && twice < 1e-9);
    }
}

struct judged {
    double errors[(ORDERS + 1) * RAYS * FACES];
    size_t n, wrong, sky;
};

/* Boyer-Lindquist azimuth minus ingoing azimuth at a point: the integral of a/Delta from r to infinity. */
static double twist(const struct seer *seer)
{
    double a = seer->spin, root = sqrt((1 - a) * (1 + a));
    if (seer->motion.observer == KD_OBSERVER_INFALL) /* the observer's azimuth is ingoing already */
        return 0;
    return a / (2 * root) * log1p(2 * root / (seer->r - 1 - root));
}

static double turn(double x) { return remainder(x, 2 * M_PI); }

/* Errors divided by the map's amplification. A ray is unsure if a small shift changes its end or number of
 * crossings. */
static void judge(const struct seer *seer, int face, int k, const float *planes, struct judged *o)
{
    const struct ks_place at = place_of(seer);
    double p[4], q[4], x = step_of(k % GRID), y = -step_of(k / GRID), nudge = 1e-6;
    photon(seer, face, x, y, p);
    photon(seer, face, x + nudge, y + nudge, q);
    struct ks_path want = ks_follow(&at, p, 16), beside = ks_follow(&at, q, 16);
    for (int order = 0; order < ORDERS; order++)
        want.phi[order] -= twist(seer), beside.phi[order] -= twist(seer);
    want.sky_phi -= twist(seer), beside.sky_phi -= twist(seer);
    for (int order = 0; order < ORDERS; order++) {
        double w = planes[order * RAYS + k], phi = planes[(ORDERS + order) * RAYS + k];
        bool has = want.crossings > order, sure = has == (beside.crossings > order);
        if (!sure || (has && (want.r[order] > 1e4 || want.r[order] < 1.01 * kd_hole(seer->spin)->outer)))
            continue;
        o->wrong += (w > 0) != has && !(w > 0 && w < 1e-4);
        if (w > 0 && has)
            o->errors[o->n++] =
                (fabs(1 / w / want.r[order] - 1) + fabs(turn(phi - want.phi[order]))) /
                (1 + (fabs(log(beside.r[order] / want.r[order])) + fabs(turn(beside.phi[order] - want.phi[order]))) /
                         nudge);
    }
    const float *end = planes + 2 * ORDERS * RAYS + k;
    if (want.fate != beside.fate || want.fate == KS_UNDECIDED)
        return;
    o->wrong += (end[2 * RAYS] == (float)KD_FATE_ESCAPED) != (want.fate == KS_ESCAPED);
    if (want.fate != KS_ESCAPED || end[2 * RAYS] != (float)KD_FATE_ESCAPED)
        return;
    double s = sqrt(1 - want.u * want.u),
           move = hypot(acos(beside.u) - acos(want.u), s * turn(beside.sky_phi - want.sky_phi)) / nudge;
    o->errors[o->n++] = hypot(acos(end[0]) - acos(want.u), s * turn(end[RAYS] - want.sky_phi)) / (1 + move);
    o->sky++;
}

static void maps(void **state)
{
    (void)state;
    static float planes[(2 * ORDERS + 3) * RAYS];
    static struct judged all;
    struct kd_capacity capacity;
    int bad = 0;
    kd_renderer_capacity(renderer, &capacity);
    for (int i = 0; i < SEERS; i++) {
        all = (struct judged) { .n = 0 };
        struct kd_plan plan;
        for (int face = 0; face < FACES; face++) {
            const struct kd_scene scene = scene_of(&seers[i], face);
            OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY },
                                &capacity, &plan, &error));
            OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
            for (int k = 0; k < RAYS; k++)
                judge(&seers[i], face, k, planes, &all);
        }
        qsort(all.errors, all.n, sizeof *all.errors, by_value);
        print_message("%s, a = %g, r = %g, %s: %zu crossings and %zu places in the sky, error %.1e in the median, %.1e "
                      "at most, %zu wrong\n",
                      seers[i].name, seers[i].spin, seers[i].r,
                      plan.lens.path == KD_LENS_CLOSED ? "closed form" : "steps", all.n - all.sky, all.sky,
                      all.errors[all.n / 2], all.errors[all.n - 1], all.wrong);
        bad += !(all.wrong == 0 && all.n > 200 && all.errors[all.n / 2] < 5e-7 && all.errors[all.n - 1] < 4e-5);
    }
    assert_int_equal(bad, 0);
}

/* Angular radius x of the dark disk that an observer falling from rest at infinity ("rain") sees in Schwarzschild's
 * metric: b = r sin x/(1 - sqrt(2/r) cos x) = sqrt(27), a quadratic equation for tan(x/2). One root is for light moving
 * inwards at the photon orbits, the other for light moving outwards. */
static double dark_angle(double r)
{
    double q = sqrt(54 / r), middle = atan2(r, q), half = acos(fmin(1, sqrt(27) / hypot(r, q)));
    return r < 3 ? middle + half : middle - half;
}

/* Position of the dark disk's edge in a row of pixels that are a few microradians apart. */
static void dark_disk(void **state)
{
    (void)state;
    enum { ROW = 64 };
    static float planes[(3 + 3) * ROW];
    static const double radii[] = { 20,  6,        4, 3.1,      3.01, 3.0001, 3, 2.9999, 2.99, 2.9, 2.5,
                                    2.1, 2.000002, 2, 1.999998, 1.9,  1.5,    1, 0.3,    0.1,  0.03 };
    struct kd_capacity capacity;
    int bad = 0;
    kd_renderer_capacity(renderer, &capacity);
    assert_true(fabs(dark_angle(2) - 2 * atan(2 / sqrt(27))) < 1e-12 && fabs(dark_angle(2) / RADIAN - 42.1) < 0.05);
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++) {
        const struct seer rain = { "rain", 0, 90, radii[i], { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 };
        struct kd_scene scene = scene_of(&rain, 0);
        struct kd_plan plan;
        double want = dark_angle(radii[i]), step = 2e-6;
        scene.camera.yaw_deg = want / RADIAN;
        scene.camera.fov_deg = ROW * step / RADIAN;
        scene.image.width = ROW;
        scene.image.height = 1;
        OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_SKY }, &capacity, &plan, &error));
        assert_int_equal(plan.lens.planes, plan.lens.orders + 3);
        OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
        const float *fate = planes + plan.lens.orders * ROW + 2 * ROW;
        int dark = 0, unsure = 0;
        for (int k = 0; k < ROW; k++) {
            dark += fate[k] == (float)KD_FATE_CAPTURED;
            unsure += fate[k] == (float)KD_FATE_UNDECIDED;
        }
        double off = (dark + 0.5 * unsure - 0.5 * ROW) * step;
        print_message("r = %g: dark to %.6f degrees, within %.1e rad; %d dark, %d undecided of %d\n", radii[i],
                      want / RADIAN, off, dark, unsure, ROW);
        bad += !(fabs(off) < 1e-5 && dark > 0 && dark + unsure < ROW && unsure * step < 3e-5);
    }
    assert_int_equal(bad, 0);
}

/* The whole sky that a falling observer ("rain") sees at a radius. For each ray: its fate, and cos(theta) and azimuth
 * of its end. */
static void look_around(double spin, double inclination, double r, float ends[FACES][3 * RAYS])
{
    static float planes[(ORDERS + 3) * RAYS];
    const struct seer rain = { "rain", spin, inclination, r, { .observer = KD_OBSERVER_INFALL, FALL }, 1, 0 };
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    for (int face = 0; face < FACES; face++) {
        const struct kd_scene scene = scene_of(&rain, face);
        struct kd_plan plan;
        OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_SKY }, &capacity, &plan, &error));
        assert_int_equal(plan.lens.planes, ORDERS + 3);
        OK(kd_render_lens(renderer, &scene, &plan, planes, NULL, &error));
        for (int k = 0; k < ORDERS * RAYS; k++)
            assert_true(isfinite(planes[k]));
        memcpy(ends[face], planes + ORDERS * RAYS, sizeof ends[face]);
    }
}

/* The view changes continuously at the horizon, in all directions, also on the axis. No ray is given up or lost. Each
 * ray ends where it ends for an observer a millionth of the radius away. */
static void no_seam_at_the_horizon(void **state)
{
    (void)state;
    static float ends[2][FACES][3 * RAYS];
    static const double spins[] = { 0, 0.9, 0.9 }, inclinations[] = { 0, 0, 75 },
                        off[] = { -1e-3, -1e-6, 0, 1e-6, 1e-3 };
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 5; k++) {
            const double r = (spins[i] == 0 ? 2 : HORIZON) * (1 + off[k]), apart = k ? off[k] - off[k - 1] : 0;
            size_t turned = 0, sky = 0;
            look_around(spins[i], inclinations[i], r, ends[k % 2]);
            for (int face = 0; face < FACES; face++)
                for (int ray = 0; ray < RAYS; ray++) {
                    const float *end = ends[k % 2][face] + ray, *before = ends[1 - k % 2][face] + ray;
                    const bool here = end[2 * RAYS] == (float)KD_FATE_ESCAPED,
                               there = before[2 * RAYS] == (float)KD_FATE_ESCAPED;
                    assert_true(end[2 * RAYS] != (float)KD_FATE_UNDECIDED);
                    assert_true(!here || (isfinite(end[0]) && isfinite(end[RAYS]) && fabsf(end[0]) <= 1));
                    if (!k || !(here && there)) {
                        turned += k && here != there;
                        continue;
                    }
                    sky++;
                    const double s = sqrt(1 - end[0] * end[0]),
                                 moved = hypot(acos(end[0]) - acos(before[0]), s * turn(end[RAYS] - before[RAYS]));
                    turned += moved > 1e-4 + 100 * apart;
                }
            /* Some rays in a hundred are within 0.01 of the critical curve. Their ends move 100 times as far as those
             * of others. */
            if (turned > FACES * RAYS / 100 || (k && sky < FACES * RAYS / 3))
                fail_msg("a = %g, inclination %g, r = %.7g: %zu of %zu rays end elsewhere than next to it", spins[i],
                         inclinations[i], r, turned, sky);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(whole_sky), cmocka_unit_test(maps),
                                        cmocka_unit_test(dark_disk), cmocka_unit_test(no_seam_at_the_horizon) };
    int skip = open_renderer();
    return skip ? skip : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

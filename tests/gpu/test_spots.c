/* Tests of hot spots and the light of a picture. They are compared with sums over rays of the Kerr-Schild oracle, which
 * shares no equation with the kernels, and with limits far from the hole. Also tests self-consistency. */
#include "render_support.h"

#include "kerr_schild.h"

#include <math.h>

static struct kd_scene spot_scene(double spin, double inclination)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 160;
    scene.image.critical_factor = 1; /* one ray a pixel, as these tests assume */
    scene.image.height = 120;
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = inclination;
    scene.camera.field_m = 40;
    scene.disk.model = KD_DISK_NONE;
    scene.spots.count = 1;
    scene.spots.at[0].brightness = 1;
    scene.style.exposure = 0;
    return scene;
}

static struct kd_plan plan_of(const struct kd_scene *scene, uint64_t most_bytes)
{
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    if (most_bytes)
        c.max_binding_bytes = most_bytes;
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make(scene, &c, &plan, &error));
    return plan;
}

static struct kd_light_report light_by(const struct kd_scene *scene, const struct kd_plan *plan, bool *reused)
{
    struct kd_frame frame;
    OK(kd_render(renderer, scene, plan, NULL, NULL, &frame, &error));
    struct kd_light_report report = frame.light;
    assert_true(report.measured);
    if (reused)
        *reused = frame.lens_reused;
    kd_frame_finish(&frame);
    return report;
}

static struct kd_light_report light(const struct kd_scene *scene)
{
    const struct kd_plan plan = plan_of(scene, 0);
    return light_by(scene, &plan, NULL);
}

static double off(double got, double want, double scale, double bound, const char *what)
{
    double by = fabs(got - want) / scale;
    if (!(by <= bound))
        fail_msg("%s: %.9g, expected %.9g: off by %.2g, allowed %.2g", what, got, want, by, bound);
    return by;
}

static void same_light(const struct kd_light *a, const struct kd_light *b, double bound, const char *what)
{
    off(a->flux, b->flux, b->flux, bound, what);
    off(a->x, b->x, 1 + hypot(b->x, b->y), bound, what);
    off(a->y, b->y, 1 + hypot(b->x, b->y), bound, what);
}

/* The circular orbit and g in the plane, from the metric g_tt = -(1 - f), g_tphi = -a f, g_phiphi = r^2 + a^2 + a^2 f
 * with f = (2r - q^2)/r^2. Omega is the root of the radial force, g_tt' + 2 Omega g_tphi' + Omega^2 g_phiphi' = 0, with
 * derivatives by differences. */
static double line(const struct kd_spacetime *hole, double r, double omega)
{
    const double a = hole->spin, f = (2 * r - hole->charge * hole->charge) / (r * r);
    return f - 1 - 2 * a * f * omega + (r * r + a * a + a * a * f) * omega * omega;
}
static double force(const struct kd_spacetime *hole, double r, double omega)
{
    double h = 1e-3 * r;
    return (8 * (line(hole, r + h, omega) - line(hole, r - h, omega)) - line(hole, r + 2 * h, omega) +
            line(hole, r - 2 * h, omega)) /
           (12 * h);
}
static double orbit_omega(const struct kd_spacetime *hole, double r)
{
    double low = 0, high = 1 / r;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        *(force(hole, r, middle) < 0 ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

struct oracle {
    int n;           /* number of rays */
    double area;     /* area of each ray in the picture, if all areas are equal */
    double (*at)[3]; /* for each ray: its weight by solid angle, and its position in the units of the picture */
    struct ks_photon *photons;
    struct ks_path *paths;
};

enum { ORDERS = 2 };

/* The rays of the picture's pixels, from the documented conventions. */
static struct oracle trace(const struct kd_scene *scene)
{
    const struct kd_spacetime *hole = &scene->spacetime;
    int width = scene->image.width, height = scene->image.height, n = width * height;
    struct oracle o = { .n = n };
    o.at = malloc((size_t)n * sizeof *o.at);
    o.photons = malloc((size_t)n * sizeof *o.photons);
    o.paths = malloc((size_t)n * sizeof *o.paths);
    double theta = scene->camera.inclination_deg * M_PI / 180;
    bool far = isinf(scene->camera.r);
    double step = far ? scene->camera.field_m / width : 2 * tan(scene->camera.fov_deg * M_PI / 360) / width;
    o.area = step * step;
    for (int i = 0; i < n; i++) {
        double x = step * (i % width - 0.5 * (width - 1)), y = -step * (i / width - 0.5 * (height - 1));
        double length = sqrt(1 + x * x + y * y), k[3] = { -1 / length, -y / length, x / length };
        o.photons[i] = far ? ks_from_infinity_charged(hole->spin, hole->charge, cos(theta), x, y)
                           : ks_from_camera_charged(hole->spin, hole->charge, scene->camera.r, theta, false, k);
        o.paths[i] = ks_trace(o.photons[i], ORDERS);
        o.at[i][0] = far ? 1 : 1 / (length * length * length);
        o.at[i][1] = far ? x : x / length;
        o.at[i][2] = far ? y : y / length;
    }
    return o;
}

static void oracle_finish(struct oracle *o)
{
    free(o->at);
    free(o->photons);
    free(o->paths);
}

/* Light of a crossing. At each point the gas has the circular motion of that radius. The spot is a Gaussian in the
 * plane with x = r cos(phi), y = r sin(phi). */
static double crossing_light(const struct kd_scene *scene, const struct ks_photon *p, const struct ks_path *path, int k,
                             double isco)
{
    const struct kd_spot *spot = &scene->spots.at[0];
    const struct kd_spacetime *hole = &scene->spacetime;
    double r = path->r[k], phi = path->phi[k] + scene->camera.azimuth_deg * M_PI / 180;
    if (r < isco)
        return 0;
    double t = scene->top.time - (scene->disk.slow_light ? path->delay[k] : 0);
    double centre = spot->phase_deg * M_PI / 180 + orbit_omega(hole, spot->r) * t, omega = orbit_omega(hole, r);
    double dx = r * cos(phi) - spot->r * cos(centre), dy = r * sin(phi) - spot->r * sin(centre);
    double g = sqrt(-line(hole, r, omega)) / (p->energy - omega * p->momentum);
    return spot->brightness * pow(g, 3 + spot->index) * exp(-(dx * dx + dy * dy) / (2 * spot->size * spot->size));
}

static struct kd_light oracle_light(const struct kd_scene *scene, const struct oracle *o, double isco)
{
    double flux = 0, weight = 0, x = 0, y = 0, z = 0;
    for (int i = 0; i < o->n; i++) {
        double sum = 0, through = 1;
        for (int k = 0; k < o->paths[i].crossings; k++) {
            double r = o->paths[i].r[k];
            sum += through * crossing_light(scene, &o->photons[i], &o->paths[i], k, isco);
            if (scene->disk.model != KD_DISK_NONE && r > isco && r < scene->disk.outer)
                through *= 1 - scene->disk.opacity;
        }
        sum *= o->at[i][0];
        flux += sum * o->area;
        weight += sum;
        x += sum * o->at[i][1];
        y += sum * o->at[i][2];
        z += sum * sqrt(fmax(0, 1 - o->at[i][1] * o->at[i][1] - o->at[i][2] * o->at[i][2]));
    }
    if (isinf(scene->camera.r))
        return (struct kd_light) { flux, x / weight, y / weight };
    return (struct kd_light) { flux, atan2(x, z) * 180 / M_PI, atan2(y, hypot(x, z)) * 180 / M_PI };
}

/* Compares the light at several phases with the oracle: with fast and slow light, for prograde and retrograde spots,
 * from infinity and nearby, and behind half transparent gas. The bound allows that a ray next to the critical curve
 * misses a crossing in 32 bits. The picture's width is not a round number, and the spot crosses the picture's edges. */
static void test_oracle(void **state)
{
    (void)state;
    static const struct {
        double spin, charge, isco, inclination, r;
        int model;
    } views[] = {
        { 0.7, 0, 3.3931, 55, INFINITY, KD_DISK_NONE },   { -0.6, 0, 7.8507, 100, INFINITY, KD_DISK_NONE },
        { 0.9, 0, 2.3209, 35, 30, KD_DISK_NONE },         { 0.5, 0, 4.2330, 75, INFINITY, KD_DISK_NOVIKOV_THORNE },
        { 0.5, 0.8, 2.5921, 60, INFINITY, KD_DISK_NONE },
    };
    double worst[2] = { 0 };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = spot_scene(views[v].spin, views[v].inclination);
        scene.spacetime.charge = views[v].charge;
        scene.camera.r = views[v].r;
        scene.camera.fov_deg = 36;
        scene.camera.field_m = 22;
        scene.disk.model = views[v].model;
        scene.disk.opacity = 0.6;
        scene.disk.outer = 40; /* the disk extends beyond the picture */
        scene.disk.taper = 0;
        scene.image.width = 67;
        scene.image.height = 49;
        scene.accuracy.orders = ORDERS;
        scene.accuracy.profile = KD_PROFILE_HIGH;
        scene.camera.azimuth_deg = 77;
        scene.spots.at[0].r = 8;
        scene.spots.at[0].size = 1.7;
        scene.spots.at[0].index = 0.6;
        scene.spots.at[0].phase_deg = -50;
        struct oracle o = trace(&scene);
        for (int k = 0; k < 10; k++) {
            scene.top.time = 1000 + 31.7 * k;
            scene.disk.slow_light = k % 2;
            struct kd_light_report got = light(&scene);
            struct kd_light want = oracle_light(&scene, &o, views[v].isco);
            double size = hypot(want.x, want.y);
            worst[0] = fmax(worst[0], off(got.spots.flux, want.flux, want.flux, 2e-4, "flux"));
            worst[1] = fmax(worst[1], off(got.spots.x, want.x, size, 2e-4, "centroid x"));
            worst[1] = fmax(worst[1], off(got.spots.y, want.y, size, 2e-4, "centroid y"));
            if (scene.disk.model == KD_DISK_NONE)
                same_light(&got.all, &got.spots, 1e-6, "without a disk all light is the spot's");
        }
        oracle_finish(&o);
    }
    printf("against the oracle: flux within %.2g, centroid within %.2g of its distance\n", worst[0], worst[1]);
}

/* Face-on and far out, to first order in 1/r: g^2 = 1 - 3/r, and light from r is seen at r + 1 (A. M. Beloborodov
 * 2002, ApJ 566, L85, eq. 1, at 90 degrees: b^2 = (r^2 - 4)/(1 - 2/r)), so that areas are larger by 1 + 1/r. */
static void test_far_out(void **state)
{
    (void)state;
    static const double radii[] = { 100, 400 };
    for (int k = 0; k < 2; k++) {
        double r = radii[k];
        for (int quarter = 0; quarter < 4; quarter++) {
            struct kd_scene scene = spot_scene(0, 0);
            scene.spots.at[0].r = r;
            scene.spots.at[0].size = 2;
            scene.spots.at[0].index = 2;
            scene.spots.at[0].brightness = 3;
            scene.spots.at[0].phase_deg = 90 * quarter;
            scene.camera.azimuth_deg = 10;
            double phi = (90 * quarter - 10) * M_PI / 180;
            /* at phi = 0 the spot is nearest to the observer: beta < 0 */
            scene.camera.centre_alpha = round((r + 1) * sin(phi));
            scene.camera.centre_beta = round(-(r + 1) * cos(phi));
            struct kd_light_report got = light(&scene);
            double want = 3 * 2 * M_PI * 4 * pow(1 - 3 / r, 2.5) * (1 + 1 / r);
            off(got.spots.flux, want, want, 20 / (r * r), "flux far out");
            off(got.spots.x, (r + 1) * sin(phi), 1, 10 / r, "alpha far out");
            off(got.spots.y, -(r + 1) * cos(phi), 1, 10 / r, "beta far out");
        }
    }
}

/* Time at which the centroid of a small spot passes alpha = 0 upwards, after `from`. */
static double upward(struct kd_scene *scene, double from, double step)
{
    double before = NAN;
    for (int i = 0; i < 200; i++) {
        scene->top.time = from + i * step;
        double now = light(scene).spots.x;
        if (before < 0 && now >= 0)
            return scene->top.time - step * now / (now - before);
        before = now;
    }
    fail_msg("the centroid never went round");
    return NAN;
}

/* The centroid returns after the time 2 pi (r^(3/2) + a), for either sense of the hole's rotation, and also after 1e8
 * M. */
static void test_period(void **state)
{
    (void)state;
    static const double spins[] = { 0.8, 0, -0.8 };
    for (int k = 0; k < 3; k++) {
        struct kd_scene scene = spot_scene(spins[k], 25);
        scene.image.width = 120;
        scene.image.height = 90;
        scene.spots.at[0].r = 9;
        scene.accuracy.orders = 1;
        double expected = 2 * M_PI * (27 + spins[k]), step = expected / 80;
        double first = upward(&scene, 0.1, step), second = upward(&scene, first + 0.6 * expected, step);
        double late = upward(&scene, 1e8, step);
        off(second - first, expected, expected, 1e-4, "period");
        off(remainder(late - first, expected), 0, expected, 1e-4, "a million orbits later");
        scene.top.time = first + 0.25 * expected; /* the spot moves anticlockwise as seen from above */
        assert_true(light(&scene).spots.x > 5);
    }
}

/* With slow light, the centroid of a small spot at t + D equals the centroid without slow light at t. D is the delay of
 * the ray from the spot, by the oracle. */
static void test_slow_light(void **state)
{
    (void)state;
    double least = INFINITY, most = -INFINITY, worst = 0;
    for (int k = 0; k < 8; k++) {
        struct kd_scene scene = spot_scene(0.5, 70);
        scene.image.width = 400;
        scene.image.height = 300;
        scene.camera.field_m = 30;
        scene.spots.at[0].r = 10;
        scene.spots.at[0].size = 0.25;
        scene.spots.at[0].phase_deg = 45 * k;
        scene.accuracy.orders = 1;
        struct kd_light_report fast = light(&scene);
        struct ks_path path = ks_trace(ks_from_infinity(0.5, cos(70 * M_PI / 180), fast.spots.x, fast.spots.y), 1);
        assert_int_equal(path.crossings, 1);
        scene.top.time = path.delay[0];
        scene.disk.slow_light = true;
        struct kd_light_report slow = light(&scene);
        double apart = hypot(slow.spots.x - fast.spots.x, slow.spots.y - fast.spots.y);
        scene.top.time = 0;
        struct kd_light_report unshifted = light(&scene);
        off(apart, 0, 1, 0.02, "the centroid with slow light");
        worst = fmax(worst, apart);
        if (fabs(path.delay[0]) > 5)
            assert_true(hypot(unshifted.spots.x - fast.spots.x, unshifted.spots.y - fast.spots.y) > 10 * apart);
        least = fmin(least, path.delay[0]);
        most = fmax(most, path.delay[0]);
    }
    printf("slow light: delays of %.3g to %.3g M, centroids within %.2g M\n", least, most, worst);
    assert_true(most - least > 15);
}

/* The light of several spots is the sum of the light of each, also behind gas, which passes a fraction of each
 * order. */
static void test_parts(void **state)
{
    (void)state;
    for (int gas = 0; gas < 4; gas++) {
        struct kd_scene scene = spot_scene(0.6, 65);
        scene.disk.model = gas == 3 ? KD_DISK_PARTICLES : gas ? KD_DISK_NOVIKOV_THORNE : KD_DISK_NONE;
        scene.disk.opacity = gas == 2 ? 1 : 0.5;
        scene.disk.particles = 20000;
        struct kd_spot one = scene.spots.at[0], two = one, three = one;
        two.r = 6, two.phase_deg = 130, two.index = -1, two.brightness = 0.2, two.temperature_k = 3000;
        three.r = 14, three.phase_deg = 250, three.size = 3, three.brightness = 0.5;
        scene.spots.count = 3;
        scene.spots.at[1] = two, scene.spots.at[2] = three;
        struct kd_light_report all = light(&scene), parts[3];
        for (int k = 0; k < 3; k++) {
            scene.spots.at[0] = k == 0 ? one : k == 1 ? two : three;
            scene.spots.at[1].brightness = scene.spots.at[2].brightness = 0;
            parts[k] = light(&scene);
        }
        scene.spots.at[0].brightness = 1e-30; /* the spot is measured, but too faint to be visible */
        double disk = light(&scene).all.flux, sum = parts[0].spots.flux + parts[1].spots.flux + parts[2].spots.flux;
        off(all.spots.flux, sum, sum, 1e-6, "three spots");
        off(all.all.flux, disk + sum, disk + sum, 2e-6, "spots and disk");
        assert_true(gas ? disk > 1 : disk < 1e-20);
        double x = 0;
        for (int k = 0; k < 3; k++)
            x += parts[k].spots.flux * parts[k].spots.x;
        off(all.spots.x, x / sum, 10, 1e-6, "their centroid");
    }
}

/* Tests the maximum number of spots, in any order of the list: their light is the sum of the light of each. Spots of
 * brightness 0 among them have no effect. */
static void test_many(void **state)
{
    (void)state;
    struct kd_scene scene = spot_scene(0.6, 65), single = scene;
    double sum = 0, x = 0;
    scene.spots.count = KD_SPOTS;
    for (int k = 0; k < KD_SPOTS; k++) {
        struct kd_spot spot = { .brightness = 0.2 + 0.1 * k,
                                .r = 5 + 0.7 * k,
                                .phase_deg = 133 * k % 360,
                                .size = 0.5 + 0.1 * (k % 4),
                                .index = k % 3 - 1,
                                .temperature_k = 4000 + 500 * k };
        if (k == 0 || k == 7)
            spot.brightness = 0;
        scene.spots.at[k] = single.spots.at[0] = spot;
        if (spot.brightness == 0)
            continue;
        struct kd_light_report alone = light(&single);
        sum += alone.spots.flux;
        x += alone.spots.flux * alone.spots.x;
    }
    struct kd_plan plan = plan_of(&scene, 0);
    assert_true(plan.light.apart);
    struct kd_light_report all = light(&scene);
    off(all.spots.flux, sum, sum, 1e-6, "fourteen spots");
    off(all.spots.x, x / sum, 10, 1e-6, "their centroid");
}

/* The light depends only on the difference of azimuths, on both sides of azimuth 0 and 360. It does not depend on the
 * direction of the camera. */
static void test_seams(void **state)
{
    (void)state;
    struct kd_scene scene = spot_scene(0.9, 40);
    scene.spots.at[0].size = 2;
    struct kd_light_report first = light(&scene);
    static const double turns[] = { 90, 180, -180, 359.9, 360, -360, -0.001 };
    for (size_t k = 0; k < sizeof turns / sizeof *turns; k++) {
        scene.spots.at[0].phase_deg = scene.camera.azimuth_deg = turns[k];
        struct kd_light_report other = light(&scene);
        same_light(&other.spots, &first.spots, 3e-6, "turned as one");
    }
    scene.camera.azimuth_deg = scene.spots.at[0].phase_deg = 0;
    scene.image.width = scene.image.height = 240;
    scene.camera.roll_deg = 33;
    scene.camera.centre_alpha = 3;
    scene.camera.centre_beta = -2;
    struct kd_light_report aimed = light(&scene);
    same_light(&aimed.spots, &first.spots, 2e-3, "aimed elsewhere");
    scene.camera.roll_deg = scene.camera.centre_alpha = scene.camera.centre_beta = 0;
    scene.camera.r = 60;
    first = light(&scene);
    scene.camera.yaw_deg = 5;
    scene.camera.pitch_deg = -7;
    scene.camera.roll_deg = -50;
    aimed = light(&scene);
    same_light(&aimed.spots, &first.spots, 2e-3, "aimed elsewhere, near");
}

/* The light is the same at any resolution, in bands, and with several rays a pixel. It is the same bit for bit when it
 * is rendered again. */
static void test_resolution(void **state)
{
    (void)state;
    struct kd_scene scene = spot_scene(0.9, 60);
    scene.image.width = 640;
    scene.image.height = 480;
    scene.top.time = 50;
    struct kd_light_report fine = light(&scene), again = light(&scene);
    assert_memory_equal(&fine.all, &again.all, sizeof fine.all);
    assert_memory_equal(&fine.spots, &again.spots, sizeof fine.spots);
    for (uint64_t rows = 7; rows < 300; rows *= 6) {
        struct kd_plan plan = plan_of(&scene, rows * 4 * 6 * 640 + 64);
        assert_true(plan.picture.bands > 1);
        struct kd_light_report cut = light_by(&scene, &plan, NULL);
        same_light(&cut.spots, &fine.spots, 3e-7, "in bands");
    }
    static const int widths[] = { 160, 240, 320 };
    for (int k = 0; k < 3; k++) {
        scene.image.width = widths[k];
        scene.image.height = widths[k] * 3 / 4;
        struct kd_light_report coarse = light(&scene);
        printf("%d pixels wide: flux off by %.2g, centroid by %.2g M\n", widths[k],
               coarse.spots.flux / fine.spots.flux - 1,
               hypot(coarse.spots.x - fine.spots.x, coarse.spots.y - fine.spots.y));
        same_light(&coarse.spots, &fine.spots, 0.01, "coarser");
    }
    scene.image.samples = 2;
    struct kd_light_report four = light(&scene);
    same_light(&four.spots, &fine.spots, 1e-4, "four rays a pixel are as many pixels");
}

/* Moving a spot keeps the lens map. Without spots the map is the same, and no light is measured. */
static void test_plans(void **state)
{
    (void)state;
    struct kd_scene scene = spot_scene(0.3, 61.5);
    bool reused;
    struct kd_plan plan = plan_of(&scene, 0);
    light_by(&scene, &plan, &reused);
    assert_false(reused);
    struct kd_scene others[5] = { scene, scene, scene, scene, scene };
    others[0].top.time = 1e5;
    others[1].spots.at[0].phase_deg = 40;
    others[2].camera.azimuth_deg = -100;
    others[3].spots.count = 2;
    others[3].spots.at[1] = scene.spots.at[0], others[3].spots.at[1].r = 20;
    others[4].disk.model = KD_DISK_NOVIKOV_THORNE;
    for (int k = 0; k < 5; k++) {
        plan = plan_of(&others[k], 0);
        light_by(&others[k], &plan, &reused);
        assert_true(reused);
    }
    scene.disk.model = KD_DISK_NOVIKOV_THORNE;
    plan = plan_of(&scene, 0);
    assert_true(kd_plan_holds(&plan.lens, KD_LENS_PHI) && plan.light.photometry && plan.light.apart);
    scene.spots.at[0].brightness = 0;
    plan = plan_of(&scene, 0);
    assert_true(!kd_plan_holds(&plan.lens, KD_LENS_PHI) && !plan.light.photometry && !plan.light.apart &&
                !kd_plan_holds(&plan.lens, KD_LENS_DELAY) && plan.lens.planes == plan.lens.orders);
    scene.disk.slow_light = true; /* without moving matter, slow light has no effect */
    plan = plan_of(&scene, 0);
    assert_false(kd_plan_holds(&plan.lens, KD_LENS_DELAY));
    scene.spots.at[0].brightness = 1;
    plan = plan_of(&scene, 0);
    assert_true(kd_plan_holds(&plan.lens, KD_LENS_DELAY));
}

/* Light measured without a picture is the same bit for bit, in one band and in many. It needs none of the picture's
 * passes. */
static void test_unseen(void **state)
{
    (void)state;
    struct kd_scene scene = spot_scene(0.9, 60);
    scene.disk.model = KD_DISK_NOVIKOV_THORNE;
    scene.style.exposure = INFINITY; /* "auto" */
    scene.style.bloom = 0.1;
    for (int bands = 0; bands < 2; bands++) {
        struct kd_capacity c;
        struct kd_frame frames[2];
        kd_renderer_capacity(renderer, &c);
        c.max_binding_bytes = bands ? 1 << 16 : c.max_binding_bytes;
        OK(kd_scene_set(&scene, "image.layers", bands ? "rgb" : "rgb,r,intensity_1",
                        &error)); /* the light is the same without a picture */
        for (int unseen = 0; unseen < 2; unseen++) {
            struct kd_plan plan;
            struct kd_needs needs = kd_needs_of(&scene);
            needs.no_image = unseen;
            OK(kd_plan_make_for(&scene, &needs, &c, &plan, &error));
            assert_true(plan.light.photometry && (plan.picture.bands > 1) == bands &&
                        (plan.cost.host_bytes == 0) == unseen && (plan.picture.bloom.levels == 0) == unseen);
            OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frames[unseen], &error));
            assert_int_equal(frames[unseen].n_layers, unseen ? 0 : bands ? 1 : 3);
            assert_true(ran(&frames[unseen], "light"));
            for (int i = 0; i < 4; i++)
                assert_true(ran(&frames[unseen], (const char *[]) { "expose", "bloom", "post", "readback" }[i]) !=
                            unseen);
        }
        assert_true(frames[0].light.measured && frames[1].light.measured && frames[0].light.spots.flux > 0);
        assert_memory_equal(&frames[0].light.all, &frames[1].light.all, sizeof frames[0].light.all);
        assert_memory_equal(&frames[0].light.spots, &frames[1].light.spots, sizeof frames[0].light.spots);
        for (int k = 0; k < 2; k++)
            kd_frame_finish(&frames[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_oracle),     cmocka_unit_test(test_far_out),    cmocka_unit_test(test_period),
        cmocka_unit_test(test_slow_light), cmocka_unit_test(test_parts),      cmocka_unit_test(test_many),
        cmocka_unit_test(test_seams),      cmocka_unit_test(test_resolution), cmocka_unit_test(test_plans),
        cmocka_unit_test(test_unseen),
    };
    int code = open_renderer();
    return code ? code : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

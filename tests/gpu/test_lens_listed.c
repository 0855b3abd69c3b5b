/* Tests of lens maps from listed rays in double precision, compared with lens maps by kernels in single precision.
 * Lists and kernels compute the ray of a pixel differently, and a ray is traced by one of three methods. Also tests
 * rays whose tracing was given up. */
#include "render_support.h"

#include "physics/spacetime/kerr.h"
#include "render/accuracy/table.h"
#include "render/device/device_internal.h"
#include "render/rays/rays.h"
#include "interface.h"

#include <math.h>

struct lens {
    struct kd_plan plan;
    float *planes;
};

static struct lens trace(const struct kd_scene *scene)
{
    const struct kd_needs needs = { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY };
    struct kd_capacity capacity;
    struct lens lens;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &needs, &capacity, &lens.plan, &error));
    lens.planes = test_malloc(sizeof(float) * lens.plan.lens.planes * lens.plan.lens.rays);
    OK(kd_render_lens(renderer, scene, &lens.plan, lens.planes, NULL, &error));
    return lens;
}

static double quantile(double *values, int n, double q)
{
    qsort(values, (size_t)n, sizeof *values, by_value);
    return values[(int)(q * (n - 1))];
}

/* Counts rays whose fate or number of crossings differs. For all other rays, gives the median errors of r, phi and the
 * angle on the sky. */
static void compare(const char *what, const struct lens *a, const struct lens *b, double bound, int stray)
{
    uint64_t n = a->plan.lens.rays;
    uint32_t orders = a->plan.lens.orders;
    double *e[3] = { NULL };
    int count[3] = { 0 }, differ = 0;
    assert_true(b->plan.lens.planes == a->plan.lens.planes && b->plan.lens.rays == n);
    for (int k = 0; k < 3; k++)
        e[k] = test_malloc(sizeof(double) * n * orders);
    for (uint64_t i = 0; i < n; i++) {
        const float *x = a->planes + i, *y = b->planes + i, *xs = x + 2 * orders * n, *ys = y + 2 * orders * n;
        bool other = xs[2 * n] != ys[2 * n];
        for (uint32_t k = 0; k < orders; k++)
            other = other || (x[k * n] > 0) != (y[k * n] > 0);
        differ += other;
        for (uint32_t k = 0; k < orders && !other && x[k * n] > 0; k++) {
            e[0][count[0]++] = fabs(x[k * n] / (double)y[k * n] - 1);
            e[1][count[1]++] = fabs(remainder(x[(orders + k) * n] - (double)y[(orders + k) * n], 2 * M_PI));
        }
        if (!other && xs[2 * n] == KD_FATE_ESCAPED)
            e[2][count[2]++] =
                hypot(xs[0] - ys[0], sqrt(fmax(0, 1 - xs[0] * xs[0])) * remainder(xs[n] - ys[n], 2 * M_PI));
    }
    assert_true(count[0] > (int)n / 4 && count[2] > (int)n / 8);
    double r = quantile(e[0], count[0], 0.5), phi = quantile(e[1], count[1], 0.5), sky = quantile(e[2], count[2], 0.5);
    double r99 = quantile(e[0], count[0], 0.99);
    print_message("%s: r %.1e (99%% %.1e), phi %.1e, sky %.1e, %d of %llu differ\n", what, r, r99, phi, sky, differ,
                  (unsigned long long)n);
    assert_true(r < bound && phi < bound && sky < bound && r99 < 1e3 * bound && differ <= stray);
    for (int k = 0; k < 3; k++)
        test_free(e[k]);
}

static const struct {
    const char *name;
    double spin, r, inclination, yaw;
    int observer;
} views[] = {
    { "from infinity", 0.9, INFINITY, 65, 0, KD_OBSERVER_STATIC },
    { "static, looking past the hole", 0.9, 12, 80, 60, KD_OBSERVER_STATIC }, /* many rays start outwards */
    { "zero angular momentum, below the plane", -0.6, 6, 120, -20, KD_OBSERVER_ZAMO },
    { "in the ergosphere, where some rays have negative energy", 0.9, 1.7, 80, 150, KD_OBSERVER_ZAMO },
};

static struct kd_scene scene_of(size_t i)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 40;
    scene.image.height = 36;
    scene.spacetime.spin = views[i].spin;
    scene.camera.r = views[i].r;
    scene.camera.inclination_deg = views[i].inclination;
    scene.camera.yaw_deg = views[i].yaw;
    scene.camera.observer = views[i].observer;
    scene.camera.fov_deg = 120;
    scene.camera.field_m = 26;
    scene.accuracy.orders = 2;
    return scene;
}

static void test_engines_agree(void **state)
{
    (void)state;
    static const struct {
        int engine, precision;
        /* bound of the medians. At least one of the maps is in single precision. The start of the Kerr-Schild engine in
         * single precision has a larger error. */
        double bound;
        int stray; /* largest number of the 1440 rays that may differ, all of them at the rim of the shadow */
    } engines[] = {
        { KD_ENGINE_CLOSED, KD_PRECISION_F64, 5e-7, 3 },    { KD_ENGINE_MINO_RKN6, KD_PRECISION_F64, 5e-7, 3 },
        { KD_ENGINE_MINO_RKN4, KD_PRECISION_F32, 5e-6, 3 }, { KD_ENGINE_MINO_RKN4, KD_PRECISION_F64, 5e-7, 3 },
        { KD_ENGINE_KS_RK4, KD_PRECISION_F64, 1e-5, 12 },
    };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = scene_of(v);
        scene.accuracy.profile = KD_PROFILE_HIGH;
        struct lens single = trace(&scene);
        assert_int_equal(single.plan.lens.path,
                         views[v].r > 1.05 * kd_kerr_photon_orbit(kd_hole(-fabs(scene.spacetime.spin))) ? KD_LENS_CLOSED
                                                                                                        : KD_LENS_MAP);
        for (size_t k = 0; k < sizeof engines / sizeof *engines; k++) {
            char what[120];
            bool wide = engines[k].precision == KD_PRECISION_F64 && engines[k].engine != KD_ENGINE_CLOSED;
            if (views[v].r < 2 && (wide || engines[k].engine >= KD_ENGINE_KS_EULER))
                continue; /* refused: see test_refused */
            if (wide && !has_float64(kd_engine_name((enum kd_engine)engines[k].engine)))
                continue;
            scene.accuracy.engine = engines[k].engine + 1;
            scene.accuracy.precision = engines[k].precision + 1;
            struct lens other = trace(&scene);
            assert_true(other.plan.lens.setting.engine == (enum kd_engine)engines[k].engine);
            snprintf(what, sizeof what, "%s, %s %s", views[v].name, kd_engine_name(other.plan.lens.setting.engine),
                     kd_precision_name(other.plan.lens.setting.precision));
            compare(what, &single, &other, engines[k].bound, engines[k].stray);
            test_free(other.planes);
        }
        test_free(single.planes);
    }
}

/* A map that is made in slices of a few rows, supersampled and in bands, equals a map that is made at once. */
static void test_slices(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0);
    scene.image.samples = 2;
    bool wide = has_float64("slices in f64, in f32 instead");
    /* both maps are made from listed rays */
    scene.accuracy.engine = (wide ? KD_ENGINE_MINO_RKN6 : KD_ENGINE_KS_RK4) + 1;
    scene.accuracy.precision = (wide ? KD_PRECISION_F64 : KD_PRECISION_F32) + 1;
    struct lens whole = trace(&scene), cut = { .planes = NULL };
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    capacity.max_binding_bytes = 4ull * whole.plan.lens.planes * 40 * 4 * 5 + 64;
    OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY }, &capacity,
                        &cut.plan, &error));
    assert_true(cut.plan.picture.bands > 5);
    cut.plan.cost.trace_ns = 1e7; /* a device so slow that a slice is a part of a row */
    cut.planes = test_malloc(sizeof(float) * cut.plan.lens.planes * cut.plan.lens.rays);
    OK(kd_render_lens(renderer, &scene, &cut.plan, cut.planes, NULL, &error));
    assert_memory_equal(whole.planes, cut.planes, sizeof(float) * whole.plan.lens.planes * whole.plan.lens.rays);
    test_free(whole.planes);
    test_free(cut.planes);
}

/* Tests that crossing radii have the accuracy that the profiles promise. Median and largest error are differences from
 * the closed form, over the bulk set of rays, from the ISCO to 1000 M. The rows of the accuracy table have larger
 * errors, because the table covers all sets. */
static void test_profiles(void **state)
{
    (void)state;
    enum { RAYS = 4096, ORDERS = KD_ACCURACY_ORDERS };
    static const struct {
        int profile;
        double median, worst;
    } promises[] = {
        { KD_PROFILE_DRAFT, 2e-6, 1e-2 },
        { KD_PROFILE_BALANCED, 2e-7, 1e-4 },
        { KD_PROFILE_HIGH, 2e-7, 1e-4 },
        { KD_PROFILE_REFERENCE, 1e-12, 1e-9 },
    };
    static double rays[2 * RAYS], errors[RAYS * ORDERS];
    static struct kd_ray_crossing exact[RAYS * ORDERS], found[RAYS * ORDERS];
    static struct kd_ray_end exact_ends[RAYS], ends[RAYS];
    struct kd_accuracy_view all[KD_ACCURACY_VIEWS], view;
    kd_accuracy_views(KD_ACCURACY_BULK, all);
    view = all[0];
    kd_accuracy_rays(KD_ACCURACY_BULK, 0, RAYS, rays);
    struct kd_rays_params params = { .spin = view.spin,
                                     .r = INFINITY,
                                     .inclination_deg = view.inclination_deg,
                                     .orders = ORDERS,
                                     .engine = KD_ENGINE_CLOSED,
                                     .precision = KD_PRECISION_F64 };
    OK(kd_rays_trace(NULL, &params, rays, RAYS, exact, exact_ends, NULL, NULL, &error));
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    for (size_t k = 0; k < sizeof promises / sizeof *promises; k++) {
        struct kd_accuracy_request asked_accuracy = KD_WISH_NONE;
        struct kd_setting by;
        asked_accuracy.profile = promises[k].profile;
        OK(kd_setting_of(&asked_accuracy, NULL, capacity.float64, &by, &error));
        params.engine = by.engine, params.precision = by.precision, params.steps = by.steps;
        OK(kd_rays_trace(renderer, &params, rays, RAYS, found, ends, NULL, NULL, &error));
        int n = 0, differ = 0;
        for (int i = 0; i < RAYS; i++) {
            differ += ends[i].error < 1 &&
                      (ends[i].n_crossings != exact_ends[i].n_crossings || ends[i].fate != exact_ends[i].fate);
            for (uint32_t j = 0; j < ends[i].n_crossings && j < exact_ends[i].n_crossings; j++) {
                double r = exact[i * ORDERS + (int)j].r;
                if (r >= kd_kerr_isco(kd_hole(view.spin)) && r <= KD_ACCURACY_FAR)
                    errors[n++] = fabs(found[i * ORDERS + (int)j].r / r - 1);
            }
        }
        double median = quantile(errors, n, 0.5), worst = quantile(errors, n, 1);
        print_message("profile %d, %s %s, %u steps: r %.1e, worst %.1e of %d\n", promises[k].profile,
                      kd_engine_name(by.engine), kd_precision_name(by.precision), by.steps, median, worst, n);
        assert_true(n > RAYS && differ == 0 && median <= promises[k].median && worst <= promises[k].worst);
    }
}

static bool magenta(const unsigned char *pixel) { return pixel[0] > 200 && pixel[1] < 60 && pixel[2] > 200; }

/* Rays marked as given up in a cached map: a crossing in row 3, the sky in row 20. */
static void test_given_up(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0);
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_frame frame;
    scene.sky.model = KD_SKY_GRID;
    scene.style.exposure = 0;
    scene.style.tone_map = KD_TONE_SRGB;
    scene.disk.opacity = 0.5;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
    assert_true(frame.accuracy.undecided == 0);
    for (size_t i = 0; i < 40 * 36; i++)
        assert_false(magenta((unsigned char *)kd_frame_pixels(&frame) + 3 * i));
    kd_frame_finish(&frame);

    struct kd_lens_map *map = NULL;
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++)
        if (!strcmp(renderer->store.maps[i].key, plan.lens.key))
            map = &renderer->store.maps[i];
    assert_non_null(map);
    float given_up = -1, undecided = KD_FATE_UNDECIDED;
    uint32_t words[2];
    memcpy(&words[0], &given_up, 4);
    memcpy(&words[1], &undecided, 4);
    OK(kd_vk_fill(renderer->vk, "fill", map->bands.buffers[0], 4 * 40 * 3, 4 * 40, words[0], &error));
    OK(kd_vk_fill(renderer->vk, "fill", map->bands.buffers[0], 4 * ((plan.lens.planes - 1) * plan.lens.rays + 40 * 20),
                  4 * 40, words[1], &error));
    OK(kd_vk_submit(renderer->vk, NULL, &error));
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
    assert_true(frame.lens_reused);
    for (size_t i = 0; i < 40; i++)
        assert_true(magenta((unsigned char *)kd_frame_pixels(&frame) + 3 * (40 * 3 + i)));
    int sky = 0;
    for (size_t i = 0; i < 40; i++)
        sky += magenta((unsigned char *)kd_frame_pixels(&frame) + 3 * (40 * 20 + i));
    assert_true(sky > 0); /* some rays must see the sky without a disk in front of it */
    kd_frame_finish(&frame);
    memset(map->key, 0, sizeof map->key); /* changes the key, so that other tests do not find this map */
}

/* An engine, precision or tolerance that is not available is refused before any ray is traced. */
static void test_refused(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0);
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &capacity);
    /* the built-in table, because a table of this device might choose another engine */
    capacity.accuracy = kd_accuracy_built_in();
    capacity.accuracy_measured = false;
    scene.accuracy.tolerance = 1e-15;
    FAILS(KD_EINVAL, "at least 6e-08", kd_plan_make(&scene, &capacity, &plan, &error));
    scene.accuracy.tolerance = 1e-5;
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    assert_true(plan.lens.setting.holds <= 1e-5 && plan.lens.path == KD_LENS_CLOSED);
    scene.accuracy.tolerance = INFINITY;
    scene.accuracy.precision = KD_PRECISION_F32 + 1;
    scene.accuracy.engine = KD_ENGINE_CLOSED + 1;
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    scene.sky.model = KD_SKY_GRID;
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    assert_int_equal(plan.lens.path, KD_LENS_CLOSED);
    scene.camera.r = 3.5;
    FAILS(KD_EINVAL, "beyond the photon orbits", kd_plan_make(&scene, &capacity, &plan, &error));
    scene.camera.r = INFINITY;
    scene.accuracy.precision = 0;
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    assert_int_equal(plan.lens.path, KD_LENS_LISTED);
    scene.camera.r = 1.7;
    scene.camera.observer = KD_OBSERVER_ZAMO;
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    assert_true(plan.lens.setting.engine == KD_ENGINE_CLOSED && plan.lens.audit);
    if (capacity.float64) {
        scene.accuracy.engine = 0;
        scene.accuracy.precision = KD_PRECISION_F64 + 1;
        OK(kd_plan_make(&scene, &capacity, &plan, &error));
        assert_true(plan.lens.setting.engine == KD_ENGINE_CLOSED && plan.lens.setting.precision == KD_PRECISION_F64);
        scene.accuracy.engine = KD_ENGINE_MINO_RKN6 + 1;
        FAILS(KD_EINVAL, "ergosphere", kd_plan_make(&scene, &capacity, &plan, &error));
    }
    capacity.float64 = false;
    scene = scene_of(0);
    scene.accuracy.precision = KD_PRECISION_F64 + 1;
    scene.accuracy.engine = KD_ENGINE_MINO_RKN6 + 1;
    FAILS(KD_EINVAL, "this device lacks", kd_plan_make(&scene, &capacity, &plan, &error));
}

static bool says_noise(const struct kd_plan *plan)
{
    for (size_t i = 0; i < plan->report.n_approximations; i++)
        if (strstr(plan->report.approximations[i].text, "sky: it is noise"))
            return true;
    return false;
}

/* The answer reports sky noise exactly where neighbouring rays of the map end far from each other. */
static void test_noise_is_named(void **state)
{
    (void)state;
    static const struct {
        double spin, radius;
        bool noise;
    } cases[] = {
        /* radius in units of the horizon's radius */
        { 0.999999, 1.0001, true }, { 0.999999999, 1.001, true }, { 0.999999, 1.3, false }, { 0.9, 1.05, false },
        { 0, 1.4, false },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        struct kd_scene scene = scene_of(2);
        struct kd_plan plan;
        struct kd_capacity capacity;
        int pairs = 0, apart = 0;
        scene.image.width = 160;
        scene.image.height = 90;
        scene.spacetime.spin = cases[k].spin;
        scene.camera.r = cases[k].radius * kd_hole(cases[k].spin)->outer;
        scene.camera.inclination_deg = 80;
        scene.camera.yaw_deg = 180;
        scene.camera.fov_deg = 60;
        scene.sky.model = KD_SKY_GRID;
        struct lens lens = trace(&scene);
        const uint64_t n = lens.plan.lens.rays;
        const float *u = lens.planes + 2 * lens.plan.lens.orders * n, *phi = u + n, *fate = phi + n;
        for (uint64_t i = 0; i + 1 < n; i++) {
            if (i % 160 == 159 || fate[i] != KD_FATE_ESCAPED)
                continue;
            double s = sqrt(fmax(0, (1 - u[i] * (double)u[i]) * (1 - u[i + 1] * (double)u[i + 1])));
            pairs++;
            apart += fate[i + 1] != KD_FATE_ESCAPED ||
                     u[i] * (double)u[i + 1] + s * cos(phi[i] - (double)phi[i + 1]) < cos(0.1);
        }
        kd_renderer_capacity(renderer, &capacity);
        OK(kd_plan_make(&scene, &capacity, &plan, &error));
        print_message("a %.9g, %g horizons: %d of %d neighbours on the sky are far apart\n", cases[k].spin,
                      cases[k].radius, apart, pairs);
        assert_true(pairs > 100 && (2 * apart > pairs) == cases[k].noise);
        assert_int_equal(says_noise(&plan), cases[k].noise);
        scene.sky.model = KD_SKY_NONE;
        OK(kd_plan_make(&scene, &capacity, &plan, &error));
        assert_false(says_noise(&plan));
        test_free(lens.planes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_engines_agree), cmocka_unit_test(test_slices),  cmocka_unit_test(test_profiles),
        cmocka_unit_test(test_given_up),      cmocka_unit_test(test_refused), cmocka_unit_test(test_noise_is_named),
    };
    int status = open_renderer();
    return status ? status : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

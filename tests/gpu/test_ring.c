/* Tests of the ring projection. The edges of the orders in a lens map are compared with the solved ones, pixel by
 * pixel. The light of a ring picture is compared with that of a plane picture. Also tests the measured e^-gamma. */
#include "render_support.h"

#include "physics/null/lensing.h"
#include "physics/spacetime/kerr.h"
#include "render/view/ring.h"

#include <math.h>

enum { WIDTH = 24, HEIGHT = 800, ORDERS = 7 };

static struct kd_scene scene_of(double spin, double inclination_deg)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.projection = KD_PROJECTION_RING;
    scene.camera.inclination_deg = inclination_deg;
    scene.camera.ring_decades_min = -9.5;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.accuracy.orders = ORDERS;
    return scene;
}

/* Four rows for four decades, and four columns for quarter turns. Expected values are computed by hand. */
static void rows_and_columns(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.5, 60);
    scene.camera.ring_decades_max = -1;
    scene.camera.ring_decades_min = -5;
    scene.camera.roll_deg = 90;
    scene.image.width = scene.image.height = 2;
    scene.image.samples = 2;
    const struct kd_ring ring = kd_ring_of(&scene);
    const double distances[] = { 1e-2, 1e-4, -1e-4, -1e-2 }, degrees[] = { -45, 45, 135, 225 };
    for (uint32_t k = 0; k < 4; k++) {
        assert_true(fabs(kd_ring_distance(&ring, k) / distances[k] - 1) < 1e-14);
        assert_true(fabs(kd_ring_column(&ring, k).angle - degrees[k] * M_PI / 180) < 1e-14);
    }
}

/* Traces the lens map of a ring picture. Planes: w of each crossing, and alpha. */
static float *trace(const struct kd_scene *scene, struct kd_plan *plan)
{
    const struct kd_needs needs = { .quantities = KD_LENS_W };
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &needs, &capacity, plan, &error));
    assert_true(plan->lens.planes == ORDERS + 1 && plan->lens.path == KD_LENS_LISTED &&
                plan->lens.setting.precision == KD_PRECISION_F64);
    float *planes = test_malloc(sizeof(float) * plan->lens.planes * plan->lens.rays);
    OK(kd_render_lens(renderer, scene, plan, planes, NULL, &error));
    return planes;
}

static const struct { double spin, inclination_deg; } views[] = { { 0, 60 }, { 0.9, 60 }, { -0.998, 30 } };

/* Returns 1 if a pixel shows the plane within `source` exactly where the solved edge predicts it. Pixels are skipped if
 * they are so close to the edge that alpha and beta cannot decide on which side they are. */
static int check_column(const struct kd_ring *ring, const struct kd_critical_point *column, int n, double source,
                        const float *w, int *skipped)
{
    double edge = kd_lensing_edge(&ring->curve, column, n, source);
    int wrong = 0;
    for (uint32_t y = 0; y < ring->height; y++) {
        double d = kd_ring_distance(ring, y), seen = w[(size_t)y * ring->width];
        if (fabs(d / edge - 1) < 1e-5 + 4e-15 / fabs(d)) {
            ++*skipped;
            continue;
        }
        bool nearer = source < 2.5 ? seen == 0 && d < 0 : seen > 1 / source || (seen == 0 && d < 0);
        wrong += nearer != (d < edge);
    }
    return wrong;
}

static void every_edge_is_where_it_belongs(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof views / sizeof *views; k++) {
        const struct kd_scene scene = scene_of(views[k].spin, views[k].inclination_deg);
        const struct kd_ring ring = kd_ring_of(&scene);
        struct kd_plan plan;
        float *w = trace(&scene, &plan);
        const double sources[] = { kd_hole(views[k].spin)->outer, 6, 30, INFINITY };
        int skipped = 0;
        for (uint32_t x = 0; x < WIDTH; x++) {
            const struct kd_critical_point column = kd_ring_column(&ring, x);
            for (int n = 1; n < ORDERS; n++)
                for (int s = 0; s < 4; s++) {
                    int wrong = check_column(&ring, &column, n, sources[s], w + n * plan.lens.rays + x, &skipped);
                    if (wrong)
                        fail_msg("a = %g, column %u, order %d, source %g: %d pixels on the wrong side", views[k].spin,
                                 x, n, sources[s], wrong);
                }
        }
        assert_true(skipped < 20); /* at most 20 of the 460 800 pixels */
        test_free(w);
    }
}

/* The row of the picture in which order n crosses r = 6. */
static int row_of(const float *w, int height)
{
    int y = 0;
    while (y < height / 2 && !(w[(size_t)y * WIDTH] > 1.0 / 6))
        y++;
    return y;
}

static void each_order_is_a_gamma_further_in(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof views / sizeof *views; k++) {
        const struct kd_scene scene = scene_of(views[k].spin, views[k].inclination_deg);
        const struct kd_ring ring = kd_ring_of(&scene);
        double row = 2 * (ring.most - ring.least) / HEIGHT * M_LN10, sum = 0;
        int count = 0;
        struct kd_plan plan;
        float *w = trace(&scene, &plan);
        for (uint32_t x = 0; x < WIDTH; x++) {
            const struct kd_critical_point column = kd_ring_column(&ring, x);
            double gamma = kd_shell_exponents(&column.orbit).gamma;
            for (int n = 3; n + 1 < ORDERS; n++) {
                double apart = row * (row_of(w + (n + 1) * plan.lens.rays + x, HEIGHT) -
                                      row_of(w + n * plan.lens.rays + x, HEIGHT));
                if (!(fabs(apart - gamma) < 1.05 * row +
                                                /* tolerance: rounding to rows is at most two half rows, and order 3
                                                 * differs from the limit of high orders */
                                                0.02))
                    fail_msg("a = %g, column %u: orders %d and %d are e^-%.4f apart, not e^-%.4f", views[k].spin, x, n,
                             n + 1, apart, gamma);
                sum += apart / gamma;
                count++;
            }
        }
        print_message("a = %g, i = %g: exponent read off the picture over gamma: %.4f\n", views[k].spin,
                      views[k].inclination_deg, sum / count);
        assert_true(fabs(sum / count - 1) < 4e-3);
        test_free(w);
    }
}

/* An integrator in double precision finds the same edges, up to the orders that it resolves. */
static void integrators_see_the_rings_too(void **state)
{
    (void)state;
    struct kd_capacity capacity;
    kd_renderer_capacity(renderer, &capacity);
    if (!capacity.float64)
        skip();
    struct kd_scene scene = scene_of(0.9, 60);
    scene.image.height = 96;
    struct kd_plan plan, closed;
    float *w = trace(&scene, &closed);
    scene.accuracy.engine = KD_ENGINE_MINO_RKN6 + 1;

    float *v = trace(&scene, &plan);
    assert_true(closed.lens.setting.engine == KD_ENGINE_CLOSED && plan.lens.setting.engine == KD_ENGINE_MINO_RKN6);
    int differ = 0, seen = 0;
    for (uint64_t i = 0; i < ORDERS * plan.lens.rays; i++) {
        seen += w[i] > 0;
        differ += (w[i] > 0) != (v[i] > 0) || fabs((double)w[i] - v[i]) > 1e-4 * w[i] + 1e-5;
    }
    print_message("%d of %d crossings differ between the closed form and Mino's in double\n", differ, seen);
    assert_true(seen > 1000 && differ < seen / 200);
    test_free(w);
    test_free(v);
}

static void shoot(const struct kd_scene *scene, struct kd_frame *frame)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make(scene, &capacity, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, frame, &error));
}

/* Parameters of a case, and the spacing of the compared pixels. */
struct shown {
    const char *what;
    uint32_t width, height, every;
    double emission_opacity, amplitude;
    int octaves, orders, lit;
};

/* A pixel of a ring picture has the light and redshift of the same ray in a plane picture. */
static void same_light(const struct shown *shown)
{
    struct kd_scene ring_scene = scene_of(0.9, 70), plane;
    ring_scene.image.width = shown->width;
    ring_scene.image.height = shown->height;
    ring_scene.camera.ring_decades_max = -0.2;
    ring_scene.camera.ring_decades_min = -2.5;
    ring_scene.disk.opacity = shown->emission_opacity > 0 ? 1 : 0.5;
    ring_scene.disk.emission_opacity = shown->emission_opacity;
    ring_scene.gas.amplitude = shown->amplitude;
    ring_scene.gas.octaves = shown->octaves;
    ring_scene.gas.shear = 0;
    ring_scene.gas.scale = 1;
    ring_scene.accuracy.orders = shown->orders;
    ring_scene.sky.model = KD_SKY_GRID;
    ring_scene.style.exposure = 1;
    ring_scene.style.dither = false;
    const struct kd_ring ring = kd_ring_of(&ring_scene);
    struct kd_frame frame;
    int lit = 0;
    shoot(&ring_scene, &frame);
    assert_true(frame.accuracy.worst < 1e-6 && frame.accuracy.differ == 0);
    for (uint32_t i = 0; i < shown->width * shown->height; i += shown->every) {
        const struct kd_critical_point column = kd_ring_column(&ring, i % shown->width);
        const struct kd_camera_label label = kd_ring_label(&ring, &column, i / shown->width);
        struct kd_frame one;
        plane = ring_scene;
        plane.image.width = plane.image.height = 3; /* with a single ray there is no footprint */
        plane.camera.projection = KD_PROJECTION_PLANE;
        plane.camera.field_m = 1e-5;
        plane.camera.centre_alpha = label.alpha;
        plane.camera.centre_beta = label.beta;
        plane.accuracy.engine = KD_ENGINE_CLOSED + 1;
        plane.accuracy.precision = KD_PRECISION_F64 + 1;
        shoot(&plane, &one);
        const uint8_t *a = (const uint8_t *)kd_frame_pixels(&frame) + 3 * i,
                      *b = (const uint8_t *)kd_frame_pixels(&one) + 3 * 4;
        for (int c = 0; c < 3; c++) {
            lit += a[c] > 16;
            if (abs(a[c] - b[c]) > 1)
                fail_msg("%s: pixel %u, channel %d: %d, aimed at %d", shown->what, i, c, a[c], b[c]);
        }
        kd_frame_finish(&one);
    }
    print_message("%s: %d channels lit\n", shown->what, lit);
    assert_true(lit > shown->lit);
    kd_frame_finish(&frame);
}

/* Turbulence is compared at order 0 of a fine ring only. Elsewhere a pixel of the ring picture covers many cells of the
 * turbulence, and shows their mean. */
static void light_is_that_of_a_plane_picture(void **state)
{
    (void)state;
    static const struct shown cases[] = {
        { "smooth disk", 10, 12, 1, 0, 0, 6, ORDERS, 150 },
        { "optical depth", 10, 12, 1, 3, 0, 6, ORDERS, 150 },
        { "turbulence", 360, 432, 1307, 3, 0.8, 1, 1, 100 },
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++)
        same_light(cases + k);
}

/* Rays beside the critical curve are not on the camera's grid, so the kernel of layers computes Carter's Q from the
 * slope of their crossings. The angle of emission then has the cosine g sqrt(Q)/r, with Q = beta^2 + (alpha^2 - a^2)
 * cos^2 i of the labels. */
static void angles_are_those_of_the_labels(void **state)
{
    static const double holes[][2] = { { 0.9, 0 }, { 0, 0.95 }, { 0.6, 0.75 } }; /* spin, charge */
    static const char *const names[][3] = { { "emission_angle_0", "g_0", "r_0" },
                                            { "emission_angle_1", "g_1", "r_1" },
                                            { "emission_angle_2", "g_2", "r_2" } };
    (void)state;
    for (size_t k = 0; k < sizeof holes / sizeof *holes; k++) {
        struct kd_scene scene = scene_of(holes[k][0], 60);
        scene.spacetime.charge = holes[k][1];
        scene.image.width = 12, scene.image.height = 120;
        scene.image.samples = 1;
        scene.accuracy.orders = 3;
        scene.camera.ring_decades_min = -4;
        OK(kd_scene_set(&scene, "image.layers",
                        "rgb,emission_angle_0,emission_angle_1,emission_angle_2,g_0,g_1,g_2,r_0,r_1,r_2", &error));
        const struct kd_ring ring = kd_ring_of(&scene);
        const double a = scene.spacetime.spin, u = cos(60 * M_PI / 180);
        struct kd_frame frame = rendered(&scene);
        double worst = 0;
        int compared = 0;
        for (uint32_t i = 0; i < 12 * 120; i++) {
            const struct kd_critical_point column = kd_ring_column(&ring, i % 12);
            const struct kd_camera_label label = kd_ring_label(&ring, &column, i / 12);
            const double carter = label.beta * label.beta + (label.alpha * label.alpha - a * a) * u * u;
            for (int n = 0; n < 3; n++) {
                double at[3];
                for (int q = 0; q < 3; q++)
                    at[q] = (double)((const float *)kd_frame_layer(&frame, names[n][q])->data)[i];
                if (isnan(at[0]))
                    continue;
                const double got = cos(at[0]), want = at[1] * sqrt(carter) / at[2];
                compared++;
                worst = fmax(worst, fabs(got - want));
                if (!(fabs(got - want) < 3e-6))
                    fail_msg("a = %g, q = %g, pixel %u, order %d, r = %g: the cosine is %.7f, not %.7f", a,
                             scene.spacetime.charge, i, n, at[2], got, want);
            }
        }
        kd_frame_finish(&frame);
        print_message("a = %g, q = %g: cosines of %d angles within %.1e\n", a, scene.spacetime.charge, compared, worst);
        assert_true(compared > 500);
    }
}

static void needs_double_precision(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 60);
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_error refused = { 0 };
    kd_renderer_capacity(renderer, &capacity);
    scene.accuracy.tolerance = 1e-4; /* rows of the accuracy table do not apply to rays of a ring */
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    assert_true(plan.lens.setting.engine == KD_ENGINE_CLOSED && plan.lens.setting.holds < 1e-7);
    scene.accuracy.engine = KD_ENGINE_MINO_RKN6 + 1;
    if (capacity.float64) {
        OK(kd_plan_make(&scene, &capacity, &plan, &error));
        assert_true(plan.lens.setting.engine == KD_ENGINE_MINO_RKN6 && plan.lens.setting.precision == KD_PRECISION_F64);
    }
    scene.accuracy.engine = 0;
    scene.accuracy.tolerance = INFINITY;
    scene.accuracy.precision = KD_PRECISION_F32 + 1;
    assert_int_equal(kd_plan_make(&scene, &capacity, &plan, &refused), KD_EINVAL);
    assert_string_equal(refused.pointer, "/accuracy/precision");
    scene.accuracy.precision = 0;
    scene.accuracy.engine = KD_ENGINE_MINO_RKN6 + 1;
    capacity.float64 = false;
    assert_int_equal(kd_plan_make(&scene, &capacity, &plan, &refused), KD_EINVAL);
    assert_string_equal(refused.pointer, "/accuracy/precision");
    scene.accuracy.tolerance = 1e-4;
    assert_int_equal(kd_plan_make(&scene, &capacity, &plan, &refused), KD_EINVAL);
    assert_string_equal(refused.pointer, "/accuracy/tolerance");
    scene.accuracy.engine = 0;
    scene.accuracy.tolerance = INFINITY; /* the closed form needs no table of the device */
    OK(kd_plan_make(&scene, &capacity, &plan, &error));
    assert_true(plan.lens.setting.engine == KD_ENGINE_CLOSED && plan.lens.setting.precision == KD_PRECISION_F64);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_and_columns),
        cmocka_unit_test(every_edge_is_where_it_belongs),
        cmocka_unit_test(each_order_is_a_gamma_further_in),
        cmocka_unit_test(integrators_see_the_rings_too),
        cmocka_unit_test(light_is_that_of_a_plane_picture),
        cmocka_unit_test(angles_are_those_of_the_labels),
        cmocka_unit_test(needs_double_precision),
    };
    int code = open_renderer();
    if (code)
        return code;
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

/* Tests of the ringing of a struck hole. The light of image orders 1 and up must follow the hole's mode, whose
 * frequency was computed by another method (tests/oracle/qnm_reference.py). The light of order 0 is unchanged, and
 * nothing is traced again. */
#include "render_support.h"

#include "qnm_reference.h"

#include <math.h>

#define STRUCK 100.0

static struct kd_scene scene_of(double spin)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = 75;
    scene.camera.field_m = 30;
    scene.image.critical_factor = 1; /* gives each pixel one ray */
    scene.disk.outer = 15;
    scene.disk.opacity = 0.5;
    scene.image.width = 96;
    scene.image.height = 64;
    scene.image.bit_depth = 16;
    scene.style.exposure = -3;
    scene.style.tone_map = KD_TONE_SRGB;
    scene.style.dither = false;
    scene.style.ringdown_time = STRUCK;
    return scene;
}

static size_t samples(const struct kd_frame *f) { return (size_t)f->width * f->height * 3; }

static double light(const struct kd_frame *f, size_t i)
{
    const uint16_t *pixels = kd_frame_pixels(f);
    assert_true(pixels[i] < 65535); /* no pixel is clipped */
    return shown(pixels, i);
}

static double expected(double spin, double t)
{
    for (size_t i = 0; i < sizeof qnm_reference / sizeof *qnm_reference; i++) {
        const struct qnm_reference *q = &qnm_reference[i];
        if (q->l == 2 && q->m == 2 && !q->n && q->a == fabs(spin))
            return t < 0 ? 0 : exp(q->im * t) * cos(q->re * t);
    }
    fail_msg("no reference for spin %g", spin);
    return NAN;
}

/* A step of 16 bits is at most 3.5e-5 of linear light. The difference of three pictures contains three roundings. */
#define STEP 3.5e-5

static void follow(const char *name, struct kd_scene scene)
{
    static const double times[] = { -1e-3, 0, 1, 3.3, 7.5, 20, 80 }, amplitudes[] = { 1, 0.3 };
    const int orders = scene.accuracy.orders;
    double worst = 0;
    scene.top.time = STRUCK + 1;
    scene.accuracy.orders = 1;
    struct kd_frame direct = rendered(&scene);
    scene.style.ringdown = 1;
    struct kd_frame rung = rendered(&scene);
    assert_memory_equal(kd_frame_pixels(&rung), kd_frame_pixels(&direct), 2 * samples(&direct));
    kd_frame_finish(&rung);
    for (size_t k = 0; k < 2 * sizeof times / sizeof *times; k++) {
        double t = times[k / 2], amplitude = amplitudes[k % 2], sum = 0, squares = 0;
        double gain = 1 + amplitude * expected(scene.spacetime.spin, t);
        scene.accuracy.orders = orders;
        scene.top.time = STRUCK + t;
        scene.style.ringdown = 0;
        struct kd_frame still = rendered(&scene);
        scene.style.ringdown = amplitude;
        rung = rendered(&scene);
        assert_true(rung.lens_reused);
        for (size_t i = 0; i < samples(&rung); i++) {
            double first = light(&direct, i), rest = light(&still, i) - first, got = light(&rung, i) - first;
            if (!(fabs(got - gain * rest) < 3 * STEP))
                fail_msg("%s, t = %g: sample %zu is off by %.2g", name, t, i, got - gain * rest);
            sum += got * rest;
            squares += rest * rest;
        }
        assert_true(squares > 1e-2); /* some light must change by the ringing */
        worst = fmax(worst, fabs(sum / squares - gain));
        if (t < 0)
            assert_memory_equal(kd_frame_pixels(&rung), kd_frame_pixels(&still), 2 * samples(&still));
        kd_frame_finish(&still);
        kd_frame_finish(&rung);
    }
    kd_frame_finish(&direct);
    printf("%-34s factor of orders 1 and up within %.1e\n", name, worst);
    assert_true(worst < 1e-4);
}

static void test_spins(void **state)
{
    (void)state;
    follow("spin 0", scene_of(0));
    follow("spin 0.5", scene_of(0.5));
    follow("spin -0.8, the mode of 0.8", scene_of(-0.8));
    follow("spin 0.9999", scene_of(0.9999));
}

static void test_paths(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.95);
    scene.camera.r = 30;
    scene.camera.fov_deg = 60;
    follow("a camera at 30 M", scene);
    scene = scene_of(0.95);
    scene.accuracy.engine = KD_ENGINE_CLOSED + 1;
    scene.accuracy.precision = KD_PRECISION_F64 + 1;
    follow("listed rays, closed form", scene);
    scene.accuracy.engine = KD_ENGINE_KS_RK4 + 1;
    scene.accuracy.precision = KD_PRECISION_F32 + 1;
    scene.image.width = 48;
    scene.image.height = 32;
    follow("listed rays, Kerr-Schild", scene);
    scene = scene_of(0.5);
    scene.camera.projection = KD_PROJECTION_RING;
    scene.camera.ring_decades_min = -4;
    scene.image.width = 48;
    scene.image.height = 32;
    follow("the ring projection", scene);
}

/* The brightness of particles and spots changes even without ringing. The reference is therefore a picture of the same
 * time without ringdown. */
static void test_lumps(void **state)
{
    (void)state;
    for (int k = 0; k < 4; k++) {
        const bool slow = k & 1;
        double gain = 1 + expected(0.95, 3), sum = 0, squares = 0;
        struct kd_scene scene = scene_of(0.95);
        scene.disk.model = k < 2 ? KD_DISK_PARTICLES : KD_DISK_NONE;
        scene.style.exposure = -5;
        scene.spots.count = 1;
        scene.spots.at[0].brightness = k < 2 ? 0 : 10;
        scene.disk.slow_light = slow;
        scene.image.width = slow ? 48 : 96;
        scene.image.height = slow ? 32 : 64;
        scene.top.time = STRUCK + 3;
        scene.style.ringdown = 0;
        struct kd_frame still = rendered(&scene);
        scene.style.ringdown = 1;
        struct kd_frame rung = rendered(&scene);
        scene.accuracy.orders = 1;
        struct kd_frame direct = rendered(&scene);
        scene.accuracy.orders = 3;
        for (size_t i = 0; i < samples(&rung); i++) {
            double first = light(&direct, i), rest = light(&still, i) - first;
            sum += (light(&rung, i) - first) * rest;
            squares += rest * rest;
        }
        assert_true(rung.lens_reused && squares > 1e-3);
        assert_true(fabs(sum / squares - gain) < 1e-3);
        kd_frame_finish(&still);
        kd_frame_finish(&rung);
        kd_frame_finish(&direct);
    }
}

/* sum: light that ringing adds to a disk's light, over all samples. off: sum of the differences of this light from that
 * of another disk. */
struct change { double sum, off; };

static struct kd_frame at_time(struct kd_scene scene, double t, double amplitude)
{
    scene.top.time = STRUCK + t;
    scene.style.ringdown = amplitude;
    return rendered(&scene);
}

static struct change changed(const struct kd_scene *scene, double t, double *last, bool compare)
{
    struct kd_frame still = at_time(*scene, t, 0), rung = at_time(*scene, t, 1);
    struct change c = { 0 };
    for (size_t i = 0; i < samples(&rung); i++) {
        const double more = light(&rung, i) - light(&still, i);
        c.off += compare ? fabs(more - last[i]) : 0;
        c.sum += more;
        last[i] = more;
    }
    kd_frame_finish(&still);
    kd_frame_finish(&rung);
    return c;
}

/* A thick disk of almost no height rings at the same places as the thin disk, and as strongly; its light has one common
 * factor. The light of a disk of some height changes by the same factor. */
static void test_thick(void **state)
{
    static const double times[] = { 0, 1, 7.5 };
    (void)state;
    struct kd_scene scene = scene_of(0.5);
    scene.image.width = 48;
    scene.image.height = 32;
    double *last = calloc((size_t)scene.image.width * (size_t)scene.image.height * 3, sizeof *last);
    assert_non_null(last);
    scene.accuracy.orders = 8; /* as many orders as the march includes */
    const struct change flat = changed(&scene, 0, last, false);
    for (int high = 0; high < 2; high++) {
        scene.disk.height = high ? 0.1 : 5e-5;
        const struct change first = changed(&scene, 0, last, !high);
        printf("height %g: %.4g of light rings, of the thin disk %.4g; apart by %.2g\n", scene.disk.height, first.sum,
               flat.sum, first.off / flat.sum);
        assert_true(first.sum > 1);
        assert_true(high || (fabs(first.sum / flat.sum - 1) < 0.01 && first.off < 0.02 * flat.sum));
        for (size_t k = 1; k < sizeof times / sizeof *times; k++)
            assert_float_equal(changed(&scene, times[k], last, false).sum / first.sum, expected(0.5, times[k]), 2e-3);
    }
    free(last);
}

/* Without a ringdown, no approximation about it is reported. */
static void test_said(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.5);
    struct kd_capacity c;
    struct kd_plan off, on;
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &off, &error));
    scene.style.ringdown = 0.1;
    OK(kd_plan_make(&scene, &c, &on, &error));
    assert_int_equal(on.report.n_approximations, off.report.n_approximations + 1);
    assert_string_equal(on.lens.key, off.lens.key);
    size_t said = 0;
    for (size_t i = 0; i < on.report.n_approximations; i++)
        said += !strncmp(on.report.approximations[i].text, "ringdown: ", 10);
    assert_int_equal(said, 1);
}

int main(void)
{
    int code = open_renderer();
    if (code)
        return code;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_spins), cmocka_unit_test(test_paths), cmocka_unit_test(test_lumps),
        cmocka_unit_test(test_thick), cmocka_unit_test(test_said),
    };
    return close_renderer(cmocka_run_group_tests_name("ringdown", tests, NULL, NULL));
}

/* Tests of footprints of the lens map. Expected values are finite differences of the Kerr-Schild oracle (tests/oracle),
 * for rays a thousandth of a step apart, in double precision. Kernel and test share no formula: the test finds the
 * singular value by a search for the angle that maximises it. */
#include "kerr_schild.h"
#include "physics/spacetime/kerr.h"
#include "render/device/device_internal.h"
#include "render/render.h"
#include "render/view/layout.h"
#include "render/view/ring.h"

#include "interface.h"
#include "render_support.h"

#include <math.h>

#define WIDTH 160
#define HEIGHT 90
#define ORDERS 3
/* Step of the finite differences, in steps of the camera. The truncation error is the square of the step. The rounding
 * error is 1e-12 divided by the step. */
#define NUDGE 1e-3

struct view {
    const char *name;
    double a, inclination, r; /* INFINITY, or the radius r of a pinhole camera */
    double field;             /* M, or degrees */
    int steps;                /* 0: the closed form, chosen by the plan */
    bool listed;
    bool ring;
};

static const struct view views[] = {
    { "a 0, i 60", 0, 60, INFINITY, 30, 0, false, false },
    { "a 0.9, i 82", 0.9, 82, INFINITY, 46, 0, false, false },
    { "a 0.998, i 20", 0.998, 20, INFINITY, 24, 0, false, false },
    { "a -0.9, i 120", -0.9, 120, INFINITY, 30, 0, false, false },
    { "a 0.9, i 75, from 20 M", 0.9, 75, 20, 60, 0, false, false },
    { "a 0.7, i 70, by steps", 0.7, 70, INFINITY, 30, 16, false, false },
    { "a 0.7, i 70, from 4 M, by steps", 0.7, 70, 4, 100, 16, false, false },
    { "a 0.9, i 70, listed", 0.9, 70, INFINITY, 30, 0, true, false },
    { "a 0.9, i 60, ring", 0.9, 60, INFINITY, 30, 0, true, true },
};
enum { VIEWS = sizeof views / sizeof *views };

static struct kd_scene scene_of(const struct view *v)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = v->a;
    scene.camera.inclination_deg = v->inclination;
    scene.camera.r = v->r;
    *(isinf(v->r) ? &scene.camera.field_m : &scene.camera.fov_deg) = v->field;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.accuracy.orders = ORDERS;
    scene.accuracy.steps = v->steps;
    if (v->listed) {
        scene.accuracy.engine = 1 + KD_ENGINE_CLOSED;
        scene.accuracy.precision = 1 + KD_PRECISION_F64;
    }
    if (v->ring) {
        scene.camera.projection = KD_PROJECTION_RING;
        scene.camera.ring_decades_min = -4;
    }
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

static const struct kd_needs both = { .quantities = KD_LENS_SHAPE | KD_LENS_SKY_FOOTPRINT };

static struct kd_plan plan_of(const struct kd_scene *scene, uint64_t binding)
{
    struct kd_capacity capacity;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &capacity);
    if (binding)
        capacity.max_binding_bytes = binding;
    OK(kd_plan_make_for(scene, &both, &capacity, &plan, &error));
    return plan;
}

static float *map_of(const struct kd_scene *scene, const struct kd_plan *plan)
{
    float *planes = test_malloc(sizeof(float) * plan->lens.planes * plan->lens.rays);
    OK(kd_render_lens(renderer, scene, plan, planes, NULL, &error));
    return planes;
}

static const float *plane(const struct kd_plan *plan, const float *planes, uint32_t quantity, uint32_t n)
{
    return planes + (kd_lens_plane(plan->lens.quantities, plan->lens.orders, quantity) + n) * plan->lens.rays;
}

/* The photon at (x, y). x, y: steps from the upper left ray. */
static struct ks_photon photon(const struct view *v, const struct kd_scene *scene, double x, double y)
{
    double theta = v->inclination * M_PI / 180, step = v->field / WIDTH;
    double right = x - 0.5 * (WIDTH - 1), up = 0.5 * (HEIGHT - 1) - y;
    if (v->ring) {
        const struct kd_ring ring = kd_ring_of(scene);
        const struct kd_critical_point p = kd_critical_at(&ring.curve, 2 * M_PI * ((x + 0.5) / WIDTH - 0.5));
        double half = 1 - 2 * (y + 0.5) / HEIGHT, d = copysign(pow(10, -4 * (1 - fabs(half))), half);
        return ks_from_infinity(v->a, cos(theta), p.alpha + d * (p.alpha - ring.curve.centre), p.beta + d * p.beta);
    }
    if (isinf(v->r))
        return ks_from_infinity(v->a, cos(theta), right * step, up * step);
    double t = 2 * tan(0.5 * v->field * M_PI / 180) / WIDTH, n = 1 / sqrt(1 + t * t * (right * right + up * up));
    const double k[3] = { -n, -t * up * n, t * right * n };
    return ks_from_camera(v->a, v->r, theta, false, k);
}

struct spot {
    double x, y, z;
    bool there;
};

/* End of a ray: its crossing in M from the middle, or its direction on the sky. */
static struct spot spot_of(const struct ks_path *p, int n)
{
    if (n < ORDERS)
        return (struct spot) { n < p->crossings ? p->r[n] : 0, n < p->crossings ? p->phi[n] : 0, 0, n < p->crossings };
    double s = sqrt(fmax(0, 1 - p->u * p->u));
    return (struct spot) { s * cos(p->sky_phi), s * sin(p->sky_phi), p->u, p->fate == KS_ESCAPED };
}

/* Derivative of the end along (dx, dy), in M or radians per step of the camera; NAN if it is undefined. */
struct change { double x, y, z; };
static struct change change_of(const struct ks_path *p, const struct ks_path *q, double r, int n)
{
    const struct spot a = spot_of(p, n), b = spot_of(q, n);
    if (!a.there || !b.there)
        return (struct change) { NAN, NAN, NAN };
    double s = 1 / (2 * NUDGE);
    if (n < ORDERS)
        return (struct change) { s * (b.x - a.x), s * r * remainder(b.y - a.y, 2 * M_PI), 0 };
    return (struct change) { s * (b.x - a.x), s * (b.y - a.y), s * (b.z - a.z) };
}

/* Footprints of all orders and of the sky at one place; NAN if undefined. share and tilt describe J J^T: share is rr
 * over the trace, and tilt is rf over sqrt(rr ff). */
struct sizes { double of[ORDERS + 1], share[ORDERS + 1], tilt[ORDERS + 1]; };

static struct sizes sizes_at(const struct view *v, const struct kd_scene *scene, double x, double y)
{
    struct ks_path at[5];
    static const double dx[] = { 0, -NUDGE, NUDGE, 0, 0 }, dy[] = { 0, 0, 0, -NUDGE, NUDGE };
    struct sizes out;
    for (int i = 0; i < 5; i++)
        at[i] = ks_trace(photon(v, scene, x + dx[i], y + dy[i]), 16);
    for (int n = 0; n <= ORDERS; n++) {
        double r = n < ORDERS && n < at[0].crossings ? at[0].r[n] : NAN;
        const struct change i = change_of(&at[1], &at[2], r, n), j = change_of(&at[3], &at[4], r, n);
        out.of[n] = 0;
        for (int k = 0; k < 720; k++) { /* length of the longest image of a unit vector */
            double c = cos(k * M_PI / 720), s = sin(k * M_PI / 720);
            out.of[n] = fmax(out.of[n],
                             sqrt(pow(c * i.x + s * j.x, 2) + pow(c * i.y + s * j.y, 2) + pow(c * i.z + s * j.z, 2)));
        }
        double rr = i.x * i.x + j.x * j.x, ff = i.y * i.y + j.y * j.y;
        out.share[n] = rr / (rr + ff);
        out.tilt[n] = (i.x * i.y + j.x * j.y) / sqrt(rr * ff);
        if (isnan(i.x) || isnan(j.x))
            out.of[n] = NAN;
    }
    return out;
}

/* Smallest and largest footprint of this pixel and its four neighbours; NAN if one of them has none. The kernel's
 * finite difference over a step equals the derivative somewhere on the step. Its footprint is therefore between these
 * two values. */
struct range { struct sizes own, least, most; };

static struct range range_at(const struct view *v, const struct kd_scene *scene, double x, double y, double way)
{
    struct range out = { .own = sizes_at(v, scene, x, y) };
    out.least = out.most = out.own;
    static const double dx[] = { -1, 1, 0, 0 }, dy[] = { 0, 0, -1, 1 };
    for (int k = 0; k < 4; k++) {
        const struct sizes s = sizes_at(v, scene, x + way * dx[k], y + way * dy[k]);
        for (int n = 0; n <= ORDERS; n++) {
            bool none = isnan(s.of[n]) || isnan(out.least.of[n]);
            out.least.of[n] = none ? NAN : fmin(out.least.of[n], s.of[n]);
            out.most.of[n] = none ? NAN : fmax(out.most.of[n], s.of[n]);
        }
    }
    return out;
}

struct tally {
    int n, outside, edges;
    double errors[WIDTH * HEIGHT], shapes[WIDTH * HEIGHT];
};

/* noise: error of the map's own arithmetic, relative to the footprint's size. */
static void judge(struct tally *t, const struct range *range, int n, double got, double slack, double noise)
{
    double own = range->own.of[n], least = range->least.of[n], most = range->most.of[n];
    if (isnan(least))
        return;
    if (got == (double)(float)KD_FOOTPRINT_EDGE) {
        t->edges++;
        return;
    }
    t->errors[t->n++] = fabs(got / own - 1);
    /* The long axis turns between the samples `least` and `most`, and the kernel includes the second difference. These
     * effects are of second order in the step. The slack allows for them. */
    if (got < least * (1 - slack - noise) || got > most * (1 + slack + noise)) {
        t->outside++;
        print_message("  order %d: %.6g, the oracle's %.6g between %.6g and %.6g\n", n, got, own, least, most);
    }
}

/* Compares the shape with the numbers that shaders/shared/lens.h packs into one word. */
static void judge_shape(struct tally *t, const struct sizes *own, int n, float packed)
{
    long bits = lround(((double)packed - 1) * 8388608);
    t->shapes[t->n - 1] = fmax(fabs((double)(bits % 2048) / 2047 - own->share[n]),
                               fabs((double)(bits / 2048) * 2 / 2047 - 1 - own->tilt[n]));
}

static void report(const char *name, struct tally *t)
{
    for (int n = 0; n <= ORDERS; n++) {
        qsort(t[n].errors, (size_t)t[n].n, sizeof *t[n].errors, by_value);
        print_message("%-34s %s %d: %3d rays, median %.1e, 90 %% %.1e, at edges %d, out of range %d\n", name,
                      n < ORDERS ? "order" : "sky  ", n, t[n].n, t[n].n ? t[n].errors[t[n].n / 2] : 0,
                      t[n].n ? t[n].errors[t[n].n * 9 / 10] : 0, t[n].edges, t[n].outside);
    }
}

static void test_grid(void **state)
{
    (void)state;
    for (int i = 0; i < VIEWS; i++) {
        const struct view *v = &views[i];
        const struct kd_scene scene = scene_of(v);
        if (scene.accuracy.precision && !has_float64(v->name))
            continue;
        const struct kd_plan plan = plan_of(&scene, 0);
        float *planes = map_of(&scene, &plan);
        static struct tally t[ORDERS + 1];
        memset(t, 0, sizeof t);
        for (uint32_t y = 0; y < HEIGHT; y += 11)
            for (uint32_t x = 0; x < WIDTH; x += 13) {
                if (v->ring &&
                    2 * y + 2 == HEIGHT) /* the step to the next row crosses the curve: the map has a crease there */
                    continue;
                size_t at = y * WIDTH + x;
                const struct range range = range_at(v, &scene, x, y, 1);
                for (int n = 0; n <= ORDERS; n++) {
                    bool sky = n == ORDERS;
                    double size = plane(&plan, planes, sky ? KD_LENS_SKY_FOOTPRINT : KD_LENS_FOOTPRINT,
                                        sky ? 0 : (uint32_t)n)[at];
                    double r = sky ? 1 : 1 / (double)plane(&plan, planes, KD_LENS_W, (uint32_t)n)[at];
                    if (isfinite(r) && r < 1000)
                        judge(&t[n], &range, n, size, 0.02, 1e-5 * r / size);
                    if (n == 0 && t[0].n > 0 && isfinite(r) && r < 1000 && !isnan(range.least.of[0]))
                        judge_shape(&t[0], &range.own, 0, plane(&plan, planes, KD_LENS_SHAPE, 0)[at]);
                }
            }
        report(v->name, t);
        for (int n = 0; n <= ORDERS; n++)
            assert_true(t[n].outside == 0 && t[n].edges == 0);
        /* Typical errors in a picture of many pixels: half of the direct image's errors are below 1/200, and nine
         * tenths below 1/30 */
        assert_true(t[0].n > 50 && t[0].errors[t[0].n / 2] < 5e-3 && t[0].errors[t[0].n * 9 / 10] < 0.03);
        assert_true(t[1].n > 5 && t[ORDERS].n > 5);
        qsort(t[0].shapes, (size_t)t[0].n, sizeof *t[0].shapes, by_value);
        print_message("%-34s shape of order 0: median %.1e, 90 %% %.1e\n", v->name, t[0].shapes[t[0].n / 2],
                      t[0].shapes[t[0].n * 9 / 10]);
        assert_true(t[0].shapes[t[0].n / 2] < 5e-3 && t[0].shapes[t[0].n * 9 / 10] < 0.05);
        test_free(planes);
    }
}

/* The cached lens map that a picture used. */
static const struct kd_lens_map *kept(const struct kd_plan *plan)
{
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++)
        if (!strcmp(renderer->store.maps[i].key, plan->lens.key))
            return &renderer->store.maps[i];
    fail_msg("the map is not kept");
    return NULL;
}

static float *read_buffer(struct kd_vk_buffer *buffer)
{
    struct kd_vk_buffer *host;
    uint64_t bytes = kd_vk_buffer_size(buffer) / 4 * 4;
    OK(kd_vk_buffer_create(renderer->vk, bytes, KD_VK_READBACK, "test", &host, &error));
    OK(kd_vk_copy(renderer->vk, "readback", host, 0, buffer, 0, bytes, &error));
    OK(kd_vk_submit(renderer->vk, NULL, &error));
    OK(kd_vk_wait(renderer->vk, 0, &error));
    float *out = test_malloc(bytes);
    memcpy(out, kd_vk_buffer_map(host), bytes);
    kd_vk_buffer_destroy(renderer->vk, host);
    return out;
}

/* A picture is traced and lit in slices of a few rows. Its footprints equal those of a map that is traced at once. */
static void test_slices(void **state)
{
    (void)state;
    const struct kd_scene scene = scene_of(&views[1]);
    struct kd_plan plan = plan_of(&scene, 0);
    float *whole = map_of(&scene, &plan);
    static const double rows[] = { 1, 2, 7 };
    for (int i = 0; i < 3; i++) {
        struct kd_frame frame;
        plan.cost.trace_ns = 40e6 / (rows[i] * WIDTH); /* sets the number of rows a slice */
        plan.lens.key[0] = (char)('a' + i);            /* this map is not in the cache, so it is traced */
        OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
        assert_false(frame.lens_reused);
        float *planes = read_buffer(kept(&plan)->bands.buffers[0]);
        assert_memory_equal(planes, whole, sizeof(float) * plan.lens.planes * plan.lens.rays);
        test_free(planes);
        kd_frame_finish(&frame);
    }
    test_free(whole);
}

/* A band ends where a buffer ends. At the ends of a band, footprints use rays on one side only, by a formula of the
 * same order of accuracy. */
static void test_bands(void **state)
{
    (void)state;
    const struct kd_scene scene = scene_of(&views[1]);
    const struct kd_plan one = plan_of(&scene, 0), many = plan_of(&scene, 4ull * one.lens.planes * WIDTH * 10 + 64);
    assert_true(one.picture.bands == 1 && many.picture.bands == HEIGHT / 10 && many.picture.band_rows == 10);
    float *a = map_of(&scene, &one), *b = map_of(&scene, &many);
    static struct tally t;
    t.n = 0;
    for (uint32_t n = 0; n < ORDERS; n++)
        for (size_t at = 0; at < one.lens.rays; at++) {
            if (!(plane(&one, a, KD_LENS_W, n)[at] > 0)) /* a ray without a crossing has no footprint */
                continue;
            double x = plane(&one, a, KD_LENS_FOOTPRINT, n)[at], y = plane(&many, b, KD_LENS_FOOTPRINT, n)[at];
            uint32_t row = (uint32_t)(at / WIDTH), in_band = row % 10;
            if (row == 0 || row == HEIGHT - 1 || (in_band != 0 && in_band != 9))
                assert_true(x == y);
            else if (x > 0 && x < 3) /* tested only where texture is visible */
                t.errors[t.n++] = fabs(y / x - 1);
        }
    qsort(t.errors, (size_t)t.n, sizeof *t.errors, by_value);
    print_message("beside the ends of bands: %d crossings, median %.1e, 90 %% %.1e, 99 %% %.1e, worst %.1e\n", t.n,
                  t.errors[t.n / 2], t.errors[t.n * 9 / 10], t.errors[t.n * 99 / 100], t.errors[t.n - 1]);
    /* Fading depends on the footprint. It would show a line where a footprint is wrong by a tenth. */
    assert_true(t.n > 1000 && t.errors[t.n / 2] < 0.01 && t.errors[t.n * 9 / 10] < 0.04);
    test_free(a);
    test_free(b);
}

/* Footprints of the rays of pixels on the critical curve. */
static void test_listed_pixels(void **state)
{
    (void)state;
    static const int factors[] = { 4, 2, 7 };
    for (int i = 0; i < 3; i++) {
        const struct view *v = &views[1];
        struct kd_scene scene = scene_of(v);
        struct kd_frame frame;
        scene.image.critical_factor = factors[i];
        const struct kd_plan plan = plan_of(&scene, 0);
        assert_true(plan.lens.critical == (uint32_t)(factors[i] * factors[i]));
        OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
        const struct kd_lens_map *map = kept(&plan);
        float *planes = read_buffer(map->critical.buffers[0]);
        const struct kd_critical_lattice lattice = kd_critical_lattice(plan.lens.critical);
        size_t stride = plan.lens.critical_part * plan.lens.critical;
        static struct tally t[ORDERS + 1];
        memset(t, 0, sizeof t);
        double side = sqrt(plan.lens.critical);
        for (size_t k = 0; k < map->pixels.n; k += 11) {
            uint32_t ray = (uint32_t)(k % plan.lens.critical);
            const struct kd_pixel step = kd_critical_place(&lattice, map->pixels.pixels[k], ray);
            struct range range = range_at(v, &scene, (step.x + 0.5) / plan.lens.critical - 0.5,
                                          (step.y + 0.5) / plan.lens.critical - 0.5, 1.5 / side);
            for (int n = 0; n <= ORDERS; n++) {
                bool sky = n == ORDERS;
                uint32_t first = kd_lens_plane(plan.lens.quantities, plan.lens.orders,
                                               sky ? KD_LENS_SKY_FOOTPRINT : KD_LENS_FOOTPRINT) +
                                 (sky ? 0 : (uint32_t)n);
                double got = planes[first * stride + k * plan.lens.critical + ray];
                range.own.of[n] /= side;
                range.least.of[n] /= side;
                range.most.of[n] /= side;
                judge(&t[n], &range, n, got, 0.1, 1e-5 * 20 / got);
            }
        }
        report(v->name, t);
        for (int n = 0; n <= ORDERS;
             /* skipped: a pixel has four rays, and those without neighbours determine the footprint in one direction
              * only */
             n++)
            assert_true(10 * t[n].outside <= (factors[i] == 2 ? t[n].n : 0));
        assert_true(t[0].n > 40 && t[1].n > 15 && t[ORDERS].n > 10);
        assert_true(t[0].errors[t[0].n / 2] < 0.06 && t[1].errors[t[1].n / 2] < 0.1);
        test_free(planes);
        kd_frame_finish(&frame);
    }
}

/* The lens map of a scene that needs no footprints has no memory for them, and no pass computes them. */
static void test_plan(void **state)
{
    (void)state;
    const struct kd_scene scene = scene_of(&views[1]);
    struct kd_capacity capacity;
    struct kd_plan off;
    kd_renderer_capacity(renderer, &capacity);
    OK(kd_plan_make_for(&scene, &(struct kd_needs) { .quantities = KD_LENS_PHI | KD_LENS_SKY }, &capacity, &off,
                        &error));
    const struct kd_plan on = plan_of(&scene, 0);
    assert_int_equal(on.lens.planes, off.lens.planes + 2 * ORDERS + 1);
    assert_int_equal(on.cost.n_passes, off.cost.n_passes + 1);
    assert_string_equal(on.cost.passes[2].name, "footprint");
    for (size_t i = 0; i < off.cost.n_passes; i++)
        assert_string_not_equal(off.cost.passes[i].name, "footprint");
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_plan), cmocka_unit_test(test_slices),        cmocka_unit_test(test_bands),
        cmocka_unit_test(test_grid), cmocka_unit_test(test_listed_pixels),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

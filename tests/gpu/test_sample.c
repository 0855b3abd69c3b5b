/* Tests of lens maps that are interpolated between nodes (src/render/frame/sample.h). They are compared with the same
 * maps with every ray traced: fates, orders and hemispheres of all rays, crossings and directions of most to the
 * tolerance, and footprints. Tiles are compared with the whole picture's, byte for byte.
 *
 *   test_sample [CAMERAS [SEED [FIRST]]]     e.g. nice build/tests/gpu/test_sample 200 7
 *
 * Without arguments the run is short. */
#include "physics/spacetime/hole.h"
#include "random_camera.h"
#include "render_support.h"

#include "render/frame/lens.h"
#include "render/plan/parts.h"
#include "render/rays/closed.h"
#include "render/view/camera.h"
#include "scene/hole.h"

#include "interface.h"

enum { SIDE = 200, RAYS = SIDE * SIDE };

static unsigned cameras = 12, first;
static uint64_t seed = 37;

struct map {
    struct kd_plan plan;
    float *planes;
};

static struct map map_with(const struct kd_scene *scene, const struct kd_needs *needs)
{
    struct kd_capacity c;
    struct map map;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_one(scene, needs, &c, &map.plan, &error)); /* plans a tile without the margin round it */
    map.planes = test_calloc(map.plan.lens.planes * map.plan.lens.rays, sizeof *map.planes);
    OK(kd_render_lens(renderer, scene, &map.plan, map.planes, NULL, &error));
    return map;
}

static struct map map_of(const struct kd_scene *scene, uint32_t quantities, bool followed)
{
    const struct kd_needs needs = { .quantities = quantities, .followed = followed };
    const struct map map = map_with(scene, &needs);
    assert_true(followed ? map.plan.lens.interpolates == 0 : map.plan.lens.interpolates > 0);
    return map;
}

static const float *plane(const struct map *m, uint32_t quantity, uint32_t order)
{
    return m->planes +
           (kd_lens_plane(m->plan.lens.quantities, m->plan.lens.orders, quantity) + order) * m->plan.lens.rays;
}

static uint32_t crossings(const struct map *m, size_t i)
{
    uint32_t n = 0;
    while (n < m->plan.lens.orders && plane(m, KD_LENS_W, n)[i] > 0)
        n++;
    return n;
}

struct tally {
    uint64_t rays, other_fate, other_order, other_side, same;
    /* between, followed: errors of w over the condition, in the interpolated and in the traced map. sky: angles between
     * the two maps' directions */
    double *between, *followed, *sky;
    size_t n, n_sky;
};

/* The change of w when all directions change by the fraction CONDITION, from the differences of neighbours. The
 * tolerance is relative to it (comp/lens_cells.comp). */
static double condition(const struct map *m, uint32_t n, uint32_t x, uint32_t y)
{
    const float *w = plane(m, KD_LENS_W, n);
    const size_t i = (size_t)y * SIDE + x;
    const double dx = x + 1 < SIDE ? w[i + 1] - w[i] : w[i] - w[i - 1],
                 dy = y + 1 < SIDE ? w[i + SIDE] - w[i] : w[i] - w[i - SIDE];
    return fmax(1, 0.3 * SIDE * hypot(dx, dy) / w[i]);
}

static double apart(double a, double b) { return fabs(remainder(a - b, 2 * M_PI)); }

/* Compares fates, orders and hemispheres of two maps, and the differences of directions. */
static void compare(const struct map *a, const struct map *b, struct tally *t)
{
    for (size_t i = 0; i < RAYS; i++) {
        const float fate = plane(b, KD_LENS_FATE, 0)[i];
        t->rays++;
        if (fate == KD_FATE_UNDECIDED)
            continue;
        t->other_fate += plane(a, KD_LENS_FATE, 0)[i] != fate;
        t->other_order += crossings(a, i) != crossings(b, i);
        if (fate != KD_FATE_ESCAPED)
            continue;
        const double u = plane(a, KD_LENS_SKY_U, 0)[i], v = plane(b, KD_LENS_SKY_U, 0)[i],
                     d = apart(plane(a, KD_LENS_SKY_PHI, 0)[i], plane(b, KD_LENS_SKY_PHI, 0)[i]);
        t->sky[t->n_sky++] = hypot(u - v, d * sqrt(fmax(0, 1 - v * v)));
        t->other_side += u * v < 0 && fabs(v) > 1e-4;
    }
}

enum { EVERY = 13, JUDGED = (RAYS + EVERY - 1) / EVERY, ORDERS = 3 };
static struct kd_ray_crossing truth[JUDGED * ORDERS];
static struct kd_ray_end ends[JUDGED];

/* Traces every EVERY-th ray by the closed form in double, and fills `truth` and `ends`. */
static void follow(const struct kd_scene *scene)
{
    static double alpha_beta[2 * JUDGED];
    static bool outward[JUDGED];
    const struct kd_camera_exact c = kd_camera_exact(scene);
    for (uint32_t i = 0; i < JUDGED; i++) {
        struct kd_camera_label label;
        kd_camera_label(&c, i * EVERY % SIDE, i * EVERY / SIDE, &label);
        alpha_beta[2 * i] = label.alpha;
        alpha_beta[2 * i + 1] = label.beta;
        outward[i] = label.outward;
    }
    const struct kd_rays_params params = {
        .spin = scene->spacetime.spin,
        .r = scene->camera.r,
        .inclination_deg = scene->camera.inclination_deg,
        .orders = ORDERS,
        .engine = KD_ENGINE_CLOSED,
        .precision = KD_PRECISION_F64,
    };
    const struct kd_ray_labels rays = { alpha_beta, outward, JUDGED };
    OK(kd_rays_closed(&params, &rays, KD_CLOSED_RADII, truth, ends, NULL, NULL, &error));
}

/* Compares the radii of the interpolated and of the traced map with the closed form. */
static void judge(const struct kd_scene *scene, const struct map *a, const struct map *b, struct tally *t)
{
    if (scene->camera.r <= kd_scene_hole(scene)->outer)
        return;
    follow(scene);
    for (uint32_t i = 0; i < JUDGED; i++) {
        const uint32_t at = i * EVERY, n = crossings(b, at);
        for (uint32_t k = 0; k < n && k < ends[i].n_crossings; k++) {
            const double steep = condition(b, k, at % SIDE, at / SIDE), r = truth[i * ORDERS + k].r;
            if (!(r < 1e3)) /* skipped: there is no light further out */
                continue;
            t->between[t->n] = fabs(plane(a, KD_LENS_W, k)[at] * r - 1) / steep;
            t->followed[t->n++] = fabs(plane(b, KD_LENS_W, k)[at] * r - 1) / steep;
        }
    }
}

/* Quantile of the values. */
static double within(double *values, size_t n, double share)
{
    qsort(values, n, sizeof *values, by_value);
    return n ? values[(size_t)(share * (double)(n - 1))] : 0;
}

static void rays_between_nodes_are_those_that_are_followed(void **state)
{
    (void)state;
    const size_t most = 2 * (size_t)cameras * RAYS;
    struct tally t = { .between = test_calloc(most, sizeof(double)),
                       .followed = test_calloc(most, sizeof(double)),
                       .sky = test_calloc(most, sizeof(double)) };
    const uint32_t quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY;
    for (unsigned i = 2 * first; i < 2 * (first + cameras); i++) {
        struct kd_random random = { seed + i / 2 * UINT64_C(0x100000001) };
        struct kd_scene scene;
        const struct tally before = t;
        (i % 2 ? random_camera_near_horizon : random_camera)(&random, SIDE, &scene);
        scene.accuracy.orders = 3; /* one number of orders for all, so that they share a kernel */
        struct map a = map_of(&scene, quantities, false), b = map_of(&scene, quantities, true);
        compare(&a, &b, &t);
        judge(&scene, &a, &b, &t);
        if (t.other_fate + t.other_order + t.other_side > before.other_fate + before.other_order + before.other_side)
            print_message("camera %u%s: %llu of another fate, %llu of another order, %llu of another hemisphere\n",
                          i / 2, i % 2 ? " near the horizon" : "",
                          (unsigned long long)(t.other_fate - before.other_fate),
                          (unsigned long long)(t.other_order - before.other_order),
                          (unsigned long long)(t.other_side - before.other_side));
        test_free(a.planes);
        test_free(b.planes);
    }
    const double between_half = within(t.between, t.n, 0.5), between = within(t.between, t.n, 0.999),
                 followed_half = within(t.followed, t.n, 0.5), followed = within(t.followed, t.n, 0.999);
    print_message("%u cameras, %llu rays: radii, against double precision and over the condition, half within %.3g "
                  "(%.3g where every ray is followed), 99.9 %% within %.3g (%.3g); directions of the two maps %.3g and "
                  "%.3g apart\n",
                  2 * cameras, (unsigned long long)t.rays, between_half, followed_half, between, followed,
                  within(t.sky, t.n_sky, 0.5), within(t.sky, t.n_sky, 0.999));
    assert_int_equal(t.other_fate, 0);
    assert_int_equal(t.other_order, 0);
    assert_int_equal(t.other_side, 0);
    /* The bound of the median is twice the single-precision error of a radius where each ray is traced. The bound of
     * the 99.9 % quantile is the single-precision error next to the critical curve, where the neighbours give only a
     * rough value of the condition. */
    assert_true(between_half < 2.5e-7 && between < fmax(2 * followed, 5e-6));
    test_free(t.between);
    test_free(t.followed);
    test_free(t.sky);
}

static struct kd_scene scene_of(double spin, double r)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.spacetime.spin = spin;
    scene.camera.r = r;
    scene.image.width = 300;
    scene.image.height = 200;
    scene.sky.model = KD_SKY_GRID;
    scene.style.exposure = 0; /* a tile has no automatic exposure */
    return scene;
}

/* A tile's map is a part of the whole picture's map, wherever the tile's edges are. This also holds for the map of a
 * picture that is made a few rows at a time. */
static void tiles_are_the_bytes_of_the_whole(void **state)
{
    (void)state;
    static const struct kd_window tiles[] = {
        { 0, 0, 300, 200 }, { 37, 21, 90, 70 }, { 140, 90, 1, 1 }, { 63, 64, 65, 66 }
    };
    const uint32_t quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY;
    const struct kd_scene scene = scene_of(0.9, INFINITY);
    struct map whole = map_of(&scene, quantities, false);
    for (size_t i = 0; i < sizeof tiles / sizeof *tiles; i++) {
        const struct kd_scene tile = kd_scene_tile(&scene, tiles[i]);
        struct map part = map_of(&tile, quantities, false);
        for (uint32_t p = 0; p < part.plan.lens.planes; p++)
            for (uint32_t y = 0; y < tiles[i].height; y++)
                for (uint32_t x = 0; x < tiles[i].width; x++) {
                    const size_t at = (size_t)(y + tiles[i].top) * 300 + x + tiles[i].left,
                                 n = (size_t)y * tiles[i].width + x;
                    const bool crosses = p % 3 < crossings(&whole, at),
                               escapes = plane(&whole, KD_LENS_FATE, 0)[at] == KD_FATE_ESCAPED;
                    if (p < 3 || (p < 6 ? crosses : escapes || p == 8))
                        assert_memory_equal(&part.planes[p * part.plan.lens.rays + n],
                                            &whole.planes[p * whole.plan.lens.rays + at], sizeof(float));
                }
        test_free(part.planes);
    }
    test_free(whole.planes);
}

/* In smooth cells, footprints are those of the derivative. Their difference from those of neighbouring rays is of
 * second order. */
static void footprints_are_derivatives(void **state)
{
    (void)state;
    const uint32_t quantities = KD_LENS_W | KD_LENS_PHI | KD_LENS_SKY | KD_LENS_FOOTPRINT | KD_LENS_SKY_FOOTPRINT;
    const struct kd_scene scene = scene_of(0.7, 40);
    struct map a = map_of(&scene, quantities, false), b = map_of(&scene, quantities, true);
    static double off[300 * 200], sky[300 * 200];
    size_t n = 0, m = 0;
    for (size_t i = 0; i < a.plan.lens.rays; i++) {
        if (crossings(&b, i)) /* only for crossings of the direct image, whose second-order differences are small */
            off[n++] = fabs(plane(&a, KD_LENS_FOOTPRINT, 0)[i] / plane(&b, KD_LENS_FOOTPRINT, 0)[i] - 1);
        if (plane(&b, KD_LENS_FATE, 0)[i] == KD_FATE_ESCAPED)
            sky[m++] = fabs(plane(&a, KD_LENS_SKY_FOOTPRINT, 0)[i] / plane(&b, KD_LENS_SKY_FOOTPRINT, 0)[i] - 1);
    }
    print_message("footprints: half within %.2g of the differences, 95 %% within %.2g; in the sky %.2g and %.2g\n",
                  within(off, n, 0.5), within(off, n, 0.95), within(sky, m, 0.5), within(sky, m, 0.95));
    assert_true(within(off, n, 0.5) < 2e-3 && within(off, n, 0.95) < 2e-2);
    assert_true(within(sky, m, 0.5) < 2e-3 && within(sky, m, 0.95) < 2e-2);
    test_free(a.planes);
    test_free(b.planes);
}

/* Profiles that promise more accuracy trace every ray, and so does a scene that names an engine. */
static void some_scenes_follow_every_ray(void **state)
{
    (void)state;
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    struct kd_scene scene = scene_of(0.9, INFINITY);
    static const struct {
        enum kd_profile profile;
        bool interpolates;
    } profiles[] = {
        { KD_PROFILE_DRAFT, true }, { KD_PROFILE_INTERACTIVE, true }, { KD_PROFILE_BALANCED, true },
        { KD_PROFILE_HIGH, false }, { KD_PROFILE_REFERENCE, false },
    };
    for (size_t i = 0; i < sizeof profiles / sizeof *profiles; i++) {
        scene.accuracy.profile = profiles[i].profile;
        if (profiles[i].profile == KD_PROFILE_REFERENCE && !c.float64)
            continue;
        OK(kd_plan_make(&scene, &c, &plan, &error));
        assert_int_equal(plan.lens.interpolates > 0, profiles[i].interpolates);
    }
    scene.accuracy.profile = KD_PROFILE_BALANCED;
    scene.accuracy.tolerance = 1e-6;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.interpolates == 0);
    scene.accuracy.tolerance = INFINITY;
    scene.accuracy.engine = KD_ENGINE_MINO_RKN6 + 1;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.interpolates == 0);
}

/* Tests the statement of docs/accuracy.md about a picture's tolerance. Of all crossings of the bulk 99 in 100 are
 * within it. Of order 0 nearly all are, and of order 1 most are; the others are within four times the tolerance. */
static void a_tolerance_of_a_picture(void **state)
{
    (void)state;
    static const struct {
        double spin, inclination_deg;
    } holes[] = { { 0, 20 }, { 0.9, 70 }, { -0.9, 80 }, { 0.998, 45 } };
    static const double tolerances[] = { 1e-4, 1e-5, 1e-6, 1e-7 };
    for (size_t k = 0; k < sizeof tolerances / sizeof *tolerances; k++) {
        const double tolerance = tolerances[k];
        size_t n[2] = { 0 }, beyond[2] = { 0 }, far = 0;
        for (size_t h = 0; h < sizeof holes / sizeof *holes; h++) {
            struct kd_scene scene = scene_of(holes[h].spin, INFINITY);
            scene.camera.inclination_deg = holes[h].inclination_deg;
            scene.image.width = scene.image.height = SIDE;
            scene.accuracy.orders = ORDERS;
            scene.accuracy.tolerance = tolerance;
            const struct kd_needs needs = { .quantities = KD_LENS_W };
            struct map map = map_with(&scene, &needs);
            follow(&scene);
            for (uint32_t i = 0; i < JUDGED; i++) {
                if (ends[i].n_crossings > 2) /* next to the critical curve, where 32 bits do not suffice */
                    continue;
                for (uint32_t order = 0; order < ends[i].n_crossings; order++) {
                    const double r = truth[i * ORDERS + order].r,
                                 off = fabs(plane(&map, KD_LENS_W, order)[i * EVERY] * r - 1);
                    if (!(r < 1e3) || r < kd_kerr_isco(kd_hole(scene.spacetime.spin)))
                        continue;
                    n[order]++;
                    beyond[order] += off > tolerance;
                    far += order ? off > 4 * tolerance : 0;
                }
            }
            test_free(map.planes);
        }
        print_message("tolerance %g: beyond it %zu of %zu crossings of order 0, %zu of %zu of order 1, of which %zu by "
                      "more than four times\n",
                      tolerance, beyond[0], n[0], beyond[1], n[1], far);
        assert_true(n[0] > 4000 && n[1] > 100);
        assert_true((double)(beyond[0] + beyond[1]) <= 0.01 * (double)(n[0] + n[1]));
        assert_true((double)beyond[0] <= 0.005 * (double)n[0]);
        assert_true((double)beyond[1] <= 0.15 * (double)n[1] && (double)far <= 0.01 * (double)n[1]);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_between_nodes_are_those_that_are_followed),
        cmocka_unit_test(tiles_are_the_bytes_of_the_whole),
        cmocka_unit_test(footprints_are_derivatives),
        cmocka_unit_test(some_scenes_follow_every_ray),
        cmocka_unit_test(a_tolerance_of_a_picture),
    };
    cameras = argc > 1 ? (unsigned)strtoul(argv[1], NULL, 10) : cameras;
    seed = argc > 2 ? strtoull(argv[2], NULL, 10) : seed;
    first = argc > 3 ? (unsigned)strtoul(argv[3], NULL, 10) : first;
    int status = open_renderer();
    if (status)
        return status;
    return close_renderer(cmocka_run_group_tests_name("sample", tests, NULL, NULL));
}

/* Tests of frames on the device. Bands, slices and the cache must not change a picture, while a change of the scene's
 * fields must. Other tests: limits, and cancelled frames. */
#include "render/render.h"
#include "render/view/critical_pixels.h"

#include "render/device/device_internal.h"

#include "render/device/rest.h"
#include "render_support.h"

#include <math.h>

static struct kd_scene small_scene(void)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 160;
    scene.image.height = 90;
    return scene;
}

static struct kd_capacity capacity(void)
{
    struct kd_capacity c;
    kd_renderer_capacity(renderer, &c);
    return c;
}

static struct kd_frame render_with(const struct kd_scene *scene, const struct kd_capacity *c, struct kd_plan *plan)
{
    struct kd_frame frame;
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make(scene, c, plan, &error));
    OK(kd_render(renderer, scene, plan, NULL, NULL, &frame, &error));
    return frame;
}

static size_t bytes(const struct kd_frame *f)
{
    return (size_t)f->width * f->height * (kd_frame_bit_depth(f) == 16 ? 6 : 3);
}

static void assert_same(struct kd_frame *a, struct kd_frame *b)
{
    assert_int_equal(bytes(a), bytes(b));
    assert_memory_equal(kd_frame_pixels(a), kd_frame_pixels(b), bytes(a));
    kd_frame_finish(a);
    kd_frame_finish(b);
}

/* A scene reuses the lens map if it differs only in fields on which the map does not depend. */
static void test_reuse(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    scene.camera.inclination_deg = 61.5; /* a view that is not in the cache yet */
    struct kd_frame first = rendered(&scene), again = rendered(&scene);
    assert_false(first.lens_reused);
    assert_true(again.lens_reused && ran(&first, "trace") && !ran(&again, "trace"));
    assert_false(ran(&again, "upload")); /* the tables are already on the device */
    assert_same(&first, &again);

    scene.disk.peak_temperature_k = 12000;
    scene.camera.azimuth_deg = 40;
    scene.style.exposure = 1;
    scene.image.bit_depth = 16;
    first = rendered(&scene);
    /* times exist only where the device has timestamps */
    assert_true(first.lens_reused && ran(&first, "upload") == ran(&first, "transfer"));
    kd_frame_finish(&first);

    double *const geometry[] = { &scene.spacetime.spin, &scene.camera.inclination_deg, &scene.camera.field_m,
                                 &scene.camera.roll_deg, &scene.camera.centre_beta };
    for (size_t i = 0; i < sizeof geometry / sizeof *geometry; i++) {
        *geometry[i] += 0.01;
        first = rendered(&scene);
        assert_false(first.lens_reused);
        kd_frame_finish(&first);
    }
}

/* The critical curve is computed once for a picture and its plan. It is not computed again until the camera changes. */
static void test_the_curve_is_followed_once(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    scene.camera.inclination_deg = 62.75; /* a view that is not in the cache yet */
    uint64_t before = kd_critical_pixels_made();
    struct kd_frame frame = rendered(&scene);
    assert_false(frame.lens_reused);
    kd_frame_finish(&frame);
    assert_int_equal(kd_critical_pixels_made() - before, 1);
    scene.disk.peak_temperature_k = 12000;
    scene.accuracy.steps = 24; /* another lens map */
    frame = rendered(&scene);
    assert_false(frame.lens_reused);
    kd_frame_finish(&frame);
    assert_int_equal(kd_critical_pixels_made() - before, 1);
}

/* A picture in many bands, with or without a cached map, has the same bytes as in one band. Tested with supersampling,
 * 16 bits, a sky, and an odd width. */
static void test_bands(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        struct kd_scene scene = small_scene();
        scene.image.width = 157;
        scene.image.samples = k & 1 ? 2 : 1;
        scene.image.bit_depth = k & 2 ? 16 : 8;
        scene.sky.model = k & 4 ? KD_SKY_GRID : KD_SKY_NONE;
        scene.style.bloom = k & 1 ? 0.5 : 0;
        struct kd_capacity c = capacity();
        struct kd_plan plan;
        struct kd_frame whole = render_with(&scene, &c, &plan);
        assert_int_equal(plan.picture.bands, 1);

        c.max_binding_bytes = 4ull * plan.lens.planes * 157 * plan.lens.side * plan.lens.side * 7 + 64;
        struct kd_frame banded = render_with(&scene, &c, &plan);
        assert_true(plan.picture.bands >= 12 && plan.lens.cacheable);
        assert_same(&whole, &banded);

        whole = rendered(&scene);
        c.memory_bytes = plan.cost.device_bytes + (c.host_memory ? 2 * plan.cost.host_bytes : 0) -
                         1; /* the memory holds only one band of the lens map */
        banded = render_with(&scene, &c, &plan);
        assert_false(plan.lens.cacheable);
        assert_same(&whole, &banded);
    }
}

/* A larger picture in several slices is the same when it is rendered twice. */
static void test_slices(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    scene.image.width = 900;
    scene.image.height = 700;
    struct kd_capacity c = capacity();
    struct kd_plan plan;
    c.ns[KD_NS_RAY_RADIUS] = c.ns[KD_NS_RAY_FULL] = c.ns[KD_NS_SAMPLE_TRANSFER] = 1e5;
    struct kd_frame a = render_with(&scene, &c, &plan);
    scene.camera.azimuth_deg = 1;
    struct kd_frame b = rendered(&scene);
    assert_same(&a, &b);
}

static void test_sizes(void **state)
{
    (void)state;
    const int sizes[][2] = { { 1, 1 }, { 1, 64 }, { 64, 1 }, { 3, 5 }, { 65, 63 }, { 4096, 2 }, { 2, 4096 } };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        for (int depth = 8; depth <= 16; depth += 8) {
            struct kd_scene scene = small_scene();
            scene.image.width = sizes[i][0];
            scene.image.height = sizes[i][1];
            scene.image.bit_depth = depth;
            struct kd_frame f = rendered(&scene);
            assert_int_equal(f.width, sizes[i][0]);
            assert_int_equal(f.height, sizes[i][1]);
            kd_frame_finish(&f);
        }
    }
}

/* Every number of the lens map is finite, every radius is outside the horizon, and every fate is decided. */
static void check_lens(const struct kd_scene *scene)
{
    struct kd_capacity c = capacity();
    struct kd_plan plan;
    OK(kd_plan_make(scene, &c, &plan, &error));
    float *planes = test_malloc(sizeof(float) * plan.lens.planes * plan.lens.rays);
    OK(kd_render_lens(renderer, scene, &plan, planes, NULL, &error));
    double horizon = 1 / (1 + sqrt((1 - scene->spacetime.spin) * (1 + scene->spacetime.spin)));
    for (size_t k = 0; k < plan.lens.planes * plan.lens.rays; k++) {
        assert_true(isfinite(planes[k]));
        if (k < plan.lens.orders * plan.lens.rays)
            assert_true(planes[k] >= 0 && planes[k] <= horizon * (1 + 1e-6));
    }
    for (size_t k = 0; kd_plan_holds(&plan.lens, KD_LENS_SKY) && k < plan.lens.rays; k++)
        assert_true(planes[(plan.lens.planes - 1) * plan.lens.rays + k] < 1.5);
    test_free(planes);
}

/* Cameras and holes at the limits of their ranges. */
static void test_extremes(void **state)
{
    (void)state;
    static const double spins[] = { 0, 1e-12, 0.5, 0.999999999999, -0.999999999999 };
    static const double angles[] = { 0, 1e-9, 45, 89.999999, 90, 90.000001, 180 };
    static const double radii[] = { INFINITY, 2.0001, 3, 50, 1e7 };
    for (size_t a = 0; a < 5; a++)
        for (size_t i = 0; i < 7; i++)
            for (size_t r = 0; r < 5; r++)
                for (int sky = 0; sky < 2; sky++) {
                    struct kd_scene scene = small_scene();
                    scene.image.width = 48, scene.image.height = 32;
                    scene.spacetime.spin = spins[a];
                    scene.camera.inclination_deg = angles[i];
                    scene.camera.r = radii[r];
                    scene.camera.observer = KD_OBSERVER_ZAMO;
                    scene.sky.model = sky;
                    scene.accuracy.orders = sky ? 8 : 3;
                    struct kd_frame f = rendered(&scene);
                    kd_frame_finish(&f);
                    check_lens(&scene);
                }
}

static bool stop_at_once(void *user, double fraction)
{
    (void)fraction;
    ++*(int *)user;
    return false;
}

static bool count_up(void *user, double fraction)
{
    double *last = user;
    assert_true(fraction >= *last && fraction <= 1);
    *last = fraction;
    return true;
}

static void test_progress(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    struct kd_capacity c = capacity();
    struct kd_plan plan;
    struct kd_frame frame;
    int calls = 0;
    double last = 0;
    scene.spacetime.spin = 0.123; /* a spin whose map no test has cached */
    OK(kd_plan_make(&scene, &c, &plan, &error));
    FAILS(KD_ECANCELLED, "cancelled", kd_render(renderer, &scene, &plan, stop_at_once, &calls, &frame, &error));
    assert_int_equal(calls, 1);
    /* A cancelled frame does not leave an incomplete lens map in the cache. */
    OK(kd_render(renderer, &scene, &plan, count_up, &last, &frame, &error));
    assert_false(frame.lens_reused);
    assert_true(last == 1);
    kd_frame_finish(&frame);
}

struct glances {
    const struct kd_frame *want; /* exposure to set; NULL: the picture's own exposure */
    uint32_t rows[64], n;
};

static bool wanted(void *user) { return ((struct glances *)user)->n < 64; }

static void seen(void *user, const struct kd_frame *frame, uint32_t rows)
{
    struct glances *g = user;
    size_t size = bytes(frame), lit = size / frame->height * rows;
    const unsigned char *pixels = kd_frame_pixels(frame);
    assert_true(rows > (g->n ? g->rows[g->n - 1] : 0) && rows <= frame->height);
    g->rows[g->n++] = rows;
    if (g->want)
        assert_memory_equal(pixels, kd_frame_pixels(g->want), lit);
    for (size_t i = lit; i < size; i++)
        assert_int_equal(pixels[i], 0);
}

/* Previews do not change the picture, and show its finished upper part. */
static void test_glances(void **state)
{
    (void)state;
    static const struct kd_preview_hook preview = { wanted, seen };
    const struct kd_capacity c = capacity();
    for (int k = 0; k < 6; k++) {
        struct kd_scene scene = small_scene();
        struct kd_plan plan;
        /* a view of its own, so that this picture needs a new lens map */
        scene.camera.inclination_deg = 60 + k;
        /* true: all rays are traced; false: the map is sampled */
        scene.accuracy.profile = k ? KD_PROFILE_HIGH : KD_PROFILE_BALANCED;
        scene.image.bit_depth = k % 2 ? 16 : 8;
        scene.style.exposure = k < 3 ? 0 : INFINITY;
        /* the last three pictures have glare; a preview has the glare of the finished part */
        scene.style.bloom = k < 3 ? 0 : 0.5;
        scene.image.critical_factor = 1;
        scene.accuracy.precision = k == 2 ? (int32_t)KD_PRECISION_F64 + 1 : KD_PRECISION_WORD_AUTO;
        if (k == 2 && !has_float64("glances of f64 rays, of the closed form instead"))
            scene.accuracy.engine = KD_ENGINE_CLOSED + 1;
        struct kd_frame whole = rendered(&scene), looked;
        struct kd_capacity narrow = c;
        OK(kd_plan_make(&scene, &c, &plan, &error));
        if (k % 3 == 1) {
            narrow.max_binding_bytes = 4ull * plan.lens.planes * 160 * 25 + 64;
            OK(kd_plan_make(&scene, &narrow, &plan, &error));
            assert_true(plan.picture.bands > 2);
        }
        plan.cost.trace_ns = 40e6 / 160 / 7; /* seven rows a slice */
        plan.lens.key[0] = 'x';              /* a key that is not cached */
        renderer->slice_pace = (struct kd_slice_pace) { 0 };
        struct glances glances = { .want = isinf(scene.style.exposure) ? NULL : &whole };
        OK(kd_render_in_background(renderer, &scene, &plan, NULL, &preview, &glances, &looked, &error));
        assert_in_range(glances.n, k ? 12 : 1, 20); /* a sampled map's slices are blocks of 64 rows */
        assert_same(&whole, &looked);
    }
}

static bool count_reports(void *user, double fraction)
{
    (void)fraction;
    ++*(unsigned *)user;
    return true;
}

/* The light of a block of a sampled map is made in several submissions, so that other work does not wait for the whole
 * block. The longer the light takes, the more submissions there are. The picture does not change. */
static void test_light_of_a_block(void **state)
{
    (void)state;
    const struct kd_capacity c = capacity();
    struct kd_scene scene = small_scene();
    struct kd_plan plan;
    struct kd_frame whole, cut[2];
    unsigned reports[2] = { 0 };
    scene.image.samples = 4; /* 16 rows of pixels a block */
    scene.image.critical_factor = 1;
    scene.camera.inclination_deg = 57;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.interpolates > 0 && !plan.light.points);
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &whole, &error));
    double *const light = &renderer->capacity.ns[kd_plan_light_figure(&plan.light)], before = *light;
    for (int i = 0; i < 2; i++) {
        plan.lens.key[0] = (char)('x' + i); /* a key that is not cached */
        *light = 40e6 / (160 * 16 * 5);     /* five rows */
        renderer->slice_pace = (struct kd_slice_pace) { .slowness = i ? 5 : 0 };
        OK(kd_render_in_background(renderer, &scene, &plan, count_reports, NULL, &reports[i], &cut[i], &error));
        assert_false(cut[i].lens_reused);
    }
    *light = before;
    assert_in_range(reports[0], 90 / 5, 40);
    assert_in_range(reports[1], reports[0] + 10, 90 + 20);
    assert_memory_equal(kd_frame_pixels(&whole), kd_frame_pixels(&cut[0]), bytes(&whole));
    kd_frame_finish(&cut[0]);
    assert_same(&whole, &cut[1]);
}

struct others {
    struct kd_renderer *r;
    struct kd_scene scenes[2];
    struct kd_plan plans[2];
    struct kd_frame frames[2];
    int dynamic; /* number of kernels that are requested in addition */
    int calls;
};

/* In the middle of a picture, renders another long picture, then a short one, then several with one kernel each. */
static bool let_others(void *user, double fraction)
{
    struct others *o = user;
    (void)fraction;
    if (o->calls++ != 3)
        return true;
    OK(kd_render_in_background(o->r, &o->scenes[0], &o->plans[0], NULL, NULL, NULL, &o->frames[0], &error));
    OK(kd_render(o->r, &o->scenes[1], &o->plans[1], NULL, NULL, &o->frames[1], &error));
    for (int i = 0; i < o->dynamic; i++) {
        const struct kd_capacity c = capacity();
        struct kd_scene scene = small_scene();
        struct kd_plan plan;
        struct kd_frame frame;
        scene.image.width = scene.image.height = 8;
        scene.image.samples = 1 + i % 4;
        scene.accuracy.orders = 1 + i / 4;
        OK(kd_plan_make(&scene, &c, &plan, &error));
        OK(kd_render(o->r, &scene, &plan, NULL, NULL, &frame, &error));
        kd_frame_finish(&frame);
    }
    return true;
}

/* Interleaved pictures, and the pictures that they interrupt, are the same as when rendered alone. Each has its own
 * pass times. */
static void test_asides(void **state)
{
    (void)state;
    const struct kd_capacity c = capacity();
    enum { KEPT = 8 };
    struct others o = { .dynamic = KEPT };
    struct kd_scene scene = small_scene();
    struct kd_plan plan;
    struct kd_frame beside, alone;
    scene.camera.inclination_deg = 51;
    scene.accuracy.profile = KD_PROFILE_HIGH;
    OK(kd_renderer_create(&(struct kd_renderer_params) { .device = "auto", .validate = true, .passing = true }, &o.r,
                          &error));
    /* with this limit, kernels of the interleaved pictures evict all kernels of the interrupted one */
    o.r->kernels.limit = KEPT;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    plan.cost.trace_ns = 40e6 / 160 / 7; /* seven rows a slice */
    for (int i = 0; i < 2; i++) {
        o.scenes[i] = small_scene();
        o.scenes[i].camera.inclination_deg = 52 + i;
        o.scenes[i].disk.model = i ? KD_DISK_PARTICLES : o.scenes[i].disk.model;
        OK(kd_plan_make(&o.scenes[i], &c, &o.plans[i], &error));
    }
    OK(kd_render_in_background(o.r, &scene, &plan, let_others, NULL, &o, &beside, &error));
    assert_true(o.calls > 10 && !beside.lens_reused);
    assert_true(timing_of(&beside, "trace") > 0 && timing_of(&beside, "transfer") > 0 &&
                timing_of(&beside, "total") > 0);
    /* the particles on the device were those of the other picture */
    assert_true(isnan(timing_of(&beside, "particles")));

    OK(kd_render(o.r, &scene, &plan, NULL, NULL, &alone, &error));
    assert_true(alone.lens_reused); /* the lens map is found in the cache, whichever store traced it */
    kd_frame_finish(&alone);
    struct kd_renderer *fresh;
    OK(kd_renderer_create(&(struct kd_renderer_params) { .device = "auto", .passing = true }, &fresh, &error));
    OK(kd_render(fresh, &scene, &plan, NULL, NULL, &alone, &error));
    assert_same(&alone, &beside);
    for (int i = 0; i < 2; i++) {
        OK(kd_render(fresh, &o.scenes[i], &o.plans[i], NULL, NULL, &alone, &error));
        assert_same(&alone, &o.frames[i]);
    }
    OK(kd_render_in_background(fresh, &scene, &plan, NULL, NULL, NULL, &alone, &error));
    assert_true(alone.lens_reused); /* a picture in the background uses a map that was traced in the foreground */
    kd_frame_finish(&alone);
    kd_renderer_destroy(fresh);
    assert_int_equal(kd_renderer_validation_messages(o.r), 0);
    kd_renderer_destroy(o.r);
}

/* A lens map made by another store is sufficient for a whole frame, although refinement needs more buffers than the
 * map. */
static void test_a_map_that_is_handed_over(void **state)
{
    (void)state;
    const struct kd_capacity c = capacity();
    struct kd_scene scene = small_scene();
    struct kd_plan plan;
    struct kd_frame here, background, again;
    struct kd_renderer *fresh;
    scene.image.samples = 0; /* auto */
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.adaptive);
    OK(kd_renderer_create(&(struct kd_renderer_params) { .device = "auto", .passing = true }, &fresh, &error));
    OK(kd_render(fresh, &scene, &plan, NULL, NULL, &here, &error));
    OK(kd_render_in_background(fresh, &scene, &plan, NULL, NULL, NULL, &background, &error));
    assert_true(timing_of(&here, "kernels") > 0 &&
                isnan(timing_of(&background, "kernels"))); /* the first picture had to compile the kernels */
    assert_true(background.lens_reused && background.accuracy.followed > 0);
    kd_store_hand_over(&fresh->background_renders[0].store, &fresh->store, &plan);
    OK(kd_render(fresh, &scene, &plan, NULL, NULL, &again, &error));
    assert_true(again.lens_reused);
    kd_frame_finish(&again);
    assert_same(&here, &background);
    kd_renderer_destroy(fresh);
}

static struct kd_frame rendered_by(struct kd_renderer *r, const struct kd_scene *scene)
{
    const struct kd_capacity c = capacity();
    struct kd_plan plan;
    struct kd_frame frame;
    OK(kd_plan_make(scene, &c, &plan, &error));
    OK(kd_render(r, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

/* Idle memory is released. Later pictures are the same, and the latest view still finds its lens map in the cache. If
 * the program cannot account for much of the remaining memory, the device is reopened. */
static void test_rest(void **state)
{
    (void)state;
    enum { VIEWS = 6, BLOCKS = 128 << 20 };
    struct kd_scene scene = small_scene();
    struct kd_renderer *fresh;
    uint64_t kept[KD_N_CACHE_KINDS], sum = 0;
    OK(kd_renderer_create(&(struct kd_renderer_params) { .device = "auto", .passing = true }, &fresh, &error));
    scene.image.samples = 2;
    scene.image.width = 1280;
    scene.image.height = 720;
    for (int i = 0; i < VIEWS; i++) {
        scene.camera.inclination_deg = 33 + i;
        struct kd_frame frame = rendered_by(fresh, &scene);
        kd_frame_finish(&frame);
    }
    const uint64_t held = kd_renderer_held(fresh);
    scene = small_scene();
    scene.camera.inclination_deg = 41;
    for (int often = 0; often < 2; often++) {
        struct kd_frame before = rendered_by(fresh, &scene), after;
        /* Simulates that all memory of this process, and much more, was allocated after the renderer was opened, or
         * that none was. */
        fresh->opened_bytes = fresh->started_bytes = often ? 0 : UINT64_MAX / 4;
        OK(kd_renderer_rest(fresh, &error));
        kd_renderer_cached(fresh, kept);
        sum = 0;
        for (int i = 0; i < KD_N_CACHE_KINDS; i++)
            sum += kept[i];
        print_message("%.0f MiB were held on the device, %.0f are, %.0f are kept in all, %.0f of them without a name\n",
                      (double)held / 0x1p20, (double)kd_renderer_held(fresh) / 0x1p20, (double)sum / 0x1p20,
                      (double)kept[KD_CACHE_OTHER] / 0x1p20);
        if (often) /* reopening does not change the category of other resident memory */
            assert_true(kept[KD_CACHE_OTHER] + kept[KD_CACHE_HEAP] > 1 << 20);
        assert_true(kd_renderer_held(fresh) < held &&
                    kd_renderer_held(fresh) <= BLOCKS); /* each of the map's buffers may keep one page */
        if (!often)
            assert_in_range(kept[KD_CACHE_LENS_MAPS], 1, KD_REST_MAPS_BYTES);
        after = rendered_by(fresh, &scene);
        assert_int_equal(after.lens_reused, kept[KD_CACHE_LENS_MAPS] > 0);
        assert_true(isnan(timing_of(&after, "kernels"))); /* the reopened device has the kernels again */
        assert_same(&before, &after);
    }
    kd_renderer_destroy(fresh);
}

/* A picture rendered in the background keeps resources for the next one, up to a limit. All resources of the last
 * picture are kept. */
static void test_what_idle_asides_keep_is_bounded(void **state)
{
    (void)state;
    enum { VIEWS = 7 };
    const struct kd_capacity c = capacity();
    struct kd_scene scene = small_scene();
    struct kd_renderer *fresh;
    struct kd_plan plan;
    struct kd_frame frame;
    OK(kd_renderer_create(&(struct kd_renderer_params) { .device = "auto", .passing = true }, &fresh, &error));
    scene.image.width = 1280;
    scene.image.height = 720;
    uint64_t kept[KD_N_CACHE_KINDS], all = 0, one = 0;
    for (int i = 0; i <= VIEWS; i++) {
        /* renders the last view once more */
        scene.camera.inclination_deg = 33 + i % VIEWS + (i == VIEWS ? VIEWS - 1 : 0);
        OK(kd_plan_make(&scene, &c, &plan, &error));
        OK(kd_render_in_background(fresh, &scene, &plan, NULL, NULL, NULL, &frame, &error));
        assert_int_equal(frame.lens_reused, i == VIEWS);
        kd_frame_finish(&frame);
        all = 0;
        for (int k = 0; k < KD_BACKGROUND_RENDERS; k++)
            all += kd_store_bytes(&fresh->background_renders[k].store);
        one = i ? one : all;
    }
    kd_renderer_cached(fresh, kept);
    print_message("%.0f MiB of one picture, %.0f of %d, %.0f of them lens maps\n", (double)one / 0x1p20,
                  (double)all / 0x1p20, VIEWS, (double)kept[KD_CACHE_LENS_MAPS] / 0x1p20);
    assert_true(VIEWS * one > KD_IDLE_ASIDES_BYTES + one);
    assert_in_range(all, one, KD_IDLE_ASIDES_BYTES + one);
    kd_renderer_destroy(fresh);
}

/* Resident memory is measured on request, not in each frame. */
static void test_what_is_resident_is_counted_when_asked(void **state)
{
    (void)state;
    const uint64_t started = renderer->started_bytes;
    uint64_t kept[KD_N_CACHE_KINDS];
    renderer->started_bytes = UINT64_MAX / 4; /* pretends that more memory was resident at the start, ... */
    kd_renderer_cached(renderer, kept);
    assert_int_equal(kept[KD_CACHE_OTHER], 0);
    renderer->started_bytes = 0; /* ... and then, that no memory was */
    kd_renderer_cached(renderer, kept);
    assert_true(kept[KD_CACHE_OTHER] > 1 << 20);
    renderer->started_bytes = started;
}

/* A defect of the program, here a buffer that is too small, is reported as a defect, and the store is emptied. */
static void test_a_defect_does_not_stay(void **state)
{
    (void)state;
    const struct kd_capacity c = capacity();
    struct kd_scene scene = small_scene();
    struct kd_plan plan;
    struct kd_frame before, after;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &before, &error));
    kd_vk_buffer_destroy(renderer->vk, renderer->store.transfer);
    OK(kd_vk_buffer_create(renderer->vk, 256, KD_VK_DEVICE, "too small", &renderer->store.transfer, &error));
    FAILS(KD_EINTERNAL, "binding", kd_render(renderer, &scene, &plan, NULL, NULL, &after, &error));
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &after, &error));
    assert_same(&before, &after);
}

/* Particles that were deposited for another picture between the slices do not affect this one. */
static void test_asides_with_particles(void **state)
{
    (void)state;
    const struct kd_capacity c = capacity();
    struct others o = { .r = renderer };
    struct kd_scene scene = small_scene();
    struct kd_plan plan;
    struct kd_frame beside, alone;
    scene.disk.model = KD_DISK_PARTICLES;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    plan.cost.trace_ns = 40e6 / 160 / 7; /* seven rows a slice */
    for (int i = 0; i < 2; i++) {
        o.scenes[i] = scene;
        o.scenes[i].top.time = 50 + 50 * i;
        OK(kd_plan_make(&o.scenes[i], &c, &o.plans[i], &error));
    }
    OK(kd_render_in_background(renderer, &scene, &plan, let_others, NULL, &o, &beside, &error));
    assert_true(o.calls > 10);
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &alone, &error));
    assert_same(&alone, &beside);
    for (int i = 0; i < 2; i++) {
        OK(kd_render(renderer, &o.scenes[i], &o.plans[i], NULL, NULL, &alone, &error));
        assert_same(&alone, &o.frames[i]);
    }
}

static void test_too_big(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    struct kd_capacity c = capacity();
    struct kd_plan plan;
    scene.image.width = scene.image.height = 32768;
    scene.image.samples = 8;
    c.memory_bytes = 4ull << 30; /* amount of memory that a device may have */
    FAILS(KD_ETOOBIG, "GiB", kd_plan_make(&scene, &c, &plan, &error));
    c.max_binding_bytes = 65536;
    FAILS(KD_ETOOBIG, "row", kd_plan_make(&scene, &c, &plan, &error));
}

/* The error that an answer reports is measured in double precision. It is small for accurate profiles and larger for a
 * draft. It is cached with the lens map. Cameras at a finite radius have it too. It is absent where it cannot be
 * measured. */
static void test_audit(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    scene.camera.inclination_deg = 66;
    struct kd_frame first = rendered(&scene), again = rendered(&scene);
    assert_true(again.lens_reused);
    assert_memory_equal(&first.accuracy, &again.accuracy, sizeof first.accuracy);
    assert_int_equal(first.accuracy.sampled, KD_AUDIT_RAYS);
    assert_true(first.accuracy.crossings > KD_AUDIT_RAYS / 2 && first.accuracy.differ == 0);
    assert_true(first.accuracy.median > 0 && first.accuracy.median < 1e-6 && first.accuracy.worst < 1e-3);
    kd_frame_finish(&first);
    kd_frame_finish(&again);

    scene.camera.r = 15;
    /* near the critical curve, rounding errors exceed the error of the steps */
    scene.accuracy.orders = 1;
    /* all rays are traced, because the error of a sampled map would be its tolerance */
    scene.accuracy.profile = KD_PROFILE_HIGH;
    first = rendered(&scene);
    scene.accuracy.steps = 4;
    again = rendered(&scene);
    scene.accuracy.steps = 0;
    scene.accuracy.profile = KD_PROFILE_DRAFT;
    assert_true(first.accuracy.median < 1e-6 && first.accuracy.differ == 0);
    assert_true(again.accuracy.worst > 3 * first.accuracy.worst);
    kd_frame_finish(&first);
    kd_frame_finish(&again);

    scene.spacetime.spin = 0.99; /* a camera in the ergosphere, where some rays have negative energy */
    scene.camera.r = 1.6;
    scene.camera.yaw_deg = 150;
    scene.camera.observer = KD_OBSERVER_ZAMO;
    first = rendered(&scene);
    assert_true(first.accuracy.sampled > 100 && first.accuracy.crossings > 20 && first.accuracy.differ == 0);
    assert_true(first.accuracy.median > 0 && first.accuracy.median < 1e-5);
    kd_frame_finish(&first);
}

/* Rays that start sideways. Constants in single precision would start them elsewhere, so that the audit uses double
 * precision. */
static void test_audit_of_rays_that_start_sideways(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    scene.spacetime.spin = 0.7;
    scene.camera.r = 5;
    scene.camera.inclination_deg = 17;
    scene.camera.fov_deg = 0.001;
    scene.camera.yaw_deg = 90;
    scene.camera.pitch_deg = 30;
    struct kd_frame frame = rendered(&scene);
    assert_int_equal(frame.accuracy.sampled, KD_AUDIT_RAYS);
    assert_int_equal(frame.accuracy.crossings, KD_AUDIT_RAYS);
    assert_int_equal(frame.accuracy.differ, 0);
    assert_true(frame.accuracy.worst < 1e-5);
    kd_frame_finish(&frame);
}

/* A plan contains only what its scene uses. */
static void test_plan(void **state)
{
    (void)state;
    struct kd_scene scene = small_scene();
    struct kd_capacity c = capacity();
    struct kd_plan plan;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.path == KD_LENS_CLOSED && kd_plan_is_radii(&plan.lens) &&
                !kd_plan_holds(&plan.lens, KD_LENS_PHI) && !kd_plan_holds(&plan.lens, KD_LENS_SKY) &&
                plan.lens.planes == 3 && plan.lens.setting.steps == 0);
    assert_string_equal(plan.cost.passes[1].name, "interpolate");
    assert_string_equal(plan.cost.passes[4].name, "expose");
    scene.style.exposure = 0;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_string_equal(plan.cost.passes[4].name, "post");
    scene.sky.model = KD_SKY_GRID;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.path == KD_LENS_CLOSED && !kd_plan_is_radii(&plan.lens) &&
                kd_plan_holds(&plan.lens, KD_LENS_SKY) && plan.lens.setting.steps == 0 && plan.lens.planes == 6);
    scene.accuracy.steps = 8;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.path == KD_LENS_MAP && plan.lens.setting.engine == KD_ENGINE_MINO_RKN6 &&
                plan.lens.setting.steps == 8);
    scene.accuracy.steps = 0;
    scene.sky.model = KD_SKY_NONE;
    scene.camera.r = 30;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(kd_plan_is_radii(&plan.lens) && plan.lens.planes == 3);
    scene.camera.r = 3.2;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.lens.path == KD_LENS_MAP && plan.lens.setting.steps > 0 && plan.lens.planes == 3);
    scene.camera.r = 30;
    scene.sky.model = KD_SKY_GRID;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(kd_plan_holds(&plan.lens, KD_LENS_SKY) && plan.lens.planes == 6);
    scene.sky.model = KD_SKY_NONE;
    scene.disk.model = KD_DISK_NONE;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_int_equal(plan.lens.planes, 0);
    assert_string_equal(plan.cost.passes[0].name, "transfer");
    struct kd_frame f = rendered(&scene);
    for (size_t i = 0; i < bytes(&f); i++)
        assert_int_equal(((uint8_t *)kd_frame_pixels(&f))[i], 0);
    kd_frame_finish(&f);
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reuse),
        cmocka_unit_test(test_the_curve_is_followed_once),
        cmocka_unit_test(test_bands),
        cmocka_unit_test(test_slices),
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_progress),
        cmocka_unit_test(test_glances),
        cmocka_unit_test(test_light_of_a_block),
        cmocka_unit_test(test_asides),
        cmocka_unit_test(test_what_idle_asides_keep_is_bounded),
        cmocka_unit_test(test_a_map_that_is_handed_over),
        cmocka_unit_test(test_what_is_resident_is_counted_when_asked),
        cmocka_unit_test(test_a_defect_does_not_stay),
        cmocka_unit_test(test_rest),
        cmocka_unit_test(test_asides_with_particles),
        cmocka_unit_test(test_too_big),
        cmocka_unit_test(test_audit),
        cmocka_unit_test(test_audit_of_rays_that_start_sideways),
        cmocka_unit_test(test_plan),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

/* Tests of the explanation of a pixel: its light adds up to the picture's linear light, and its crossings are those of
 * listed rays and of layers. Explaining a pixel does not change the picture. */
#include "physics/spacetime/kerr.h"
#include "render/emit/emitter.h"
#include "render/explain/ahead.h"
#include "render/explain/explain.h"
#include "render/lens/label.h"
#include "render/rays/rays.h"
#include "render/view/critical_pixels.h"
#include "scene/hole.h"

#include "render_support.h"

enum { WIDTH = 64, HEIGHT = 36 };

static struct kd_scene scene_of(const char *preset, const char *const *set)
{
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    if (preset)
        OK(kd_scene_preset(&scene, preset, &error));
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    for (; set && set[0]; set += 2)
        OK(kd_scene_set(&scene, set[0], set[1], &error));
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

/* A frame that explains a pixel, with its linear light. */
static struct kd_frame told_at(const struct kd_scene *scene, uint32_t x, uint32_t y, struct kd_plan *plan)
{
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_capacity c;
    struct kd_frame frame;
    char at[40];
    kd_renderer_capacity(renderer, &c);
    needs.radiance = true;
    snprintf(at, sizeof at, "%u.25,%u.75", x, y);
    OK(kd_plan_make_for(scene, &needs, &c, plan, &error));
    OK(kd_explain_at(at, plan, &error));
    OK(kd_render(renderer, scene, plan, NULL, NULL, &frame, &error));
    assert_non_null(frame.told);
    return frame;
}

static void near(const char *what, double got, double want, double allowed)
{
    if (!(fabs(got - want) <= allowed))
        fail_msg("%s: %.9g, not %.9g: off by %.2g, allowed %.2g", what, got, want, fabs(got - want), allowed);
}

/* Adds the parts of the volume that are in front of the crossing of this order. */
static void add_stretches(const struct kd_probed_ray *told, size_t *s, uint32_t order, double *through, double sum[3])
{
    for (; *s < told->n_stretches && told->stretches[*s].order <= order; ++*s) {
        const struct kd_probed_stretch *stretch = &told->stretches[*s];
        near("what comes through", (double)stretch->through[0], *through, 2e-6);
        for (int c = 0; c < 3; c++)
            sum[c] += (double)stretch->light[c];
        *through *= (double)stretch->through[1] / (double)stretch->through[0];
    }
}

/* The light that arrives, from the parts of the emitters, combined front to back. */
static void add_up(const struct kd_probed_ray *told, double sum[3])
{
    double through = 1;
    size_t s = 0;
    for (size_t i = 0; i < told->n_places; i++) {
        const struct kd_probed_place *p = &told->places[i];
        add_stretches(told, &s, p->order, &through, sum);
        near("what comes through", (double)p->through, through, 1e-6);
        for (size_t k = 0; k < p->n_glows; k++) {
            for (int c = 0; c < 3; c++)
                sum[c] += (double)p->glows[k].through * (double)p->glows[k].light[c];
            through *= 1 - (double)p->glows[k].opacity;
        }
    }
    add_stretches(told, &s, UINT32_MAX, &through, sum);
    near("what comes through all", (double)told->through, through, 1e-6);
    for (size_t k = 0; k < told->n_ends; k++)
        for (int c = 0; c < 3; c++)
            sum[c] += through * (double)told->ends[k].light[c];
}

/* Checks that the sum is the pixel's linear radiance. Returns the number of emitters with light. */
static size_t judge_sum(const struct kd_frame *frame, uint32_t x, uint32_t y)
{
    const struct kd_probed_ray *told = &frame->told->middle;
    const float *radiance = (const float *)kd_frame_layer(frame, "radiance")->data + 3 * (y * (size_t)frame->width + x);
    double sum[3] = { 0 }, size = 0;
    size_t n = told->n_ends;
    add_up(told, sum);
    for (int c = 0; c < 3; c++)
        size = fmax(size, fabs((double)radiance[c]));
    for (int c = 0; c < 3; c++) {
        near("the ray's light", (double)told->light[c], sum[c], 2e-6 * size);
        near("the pixel's light", (double)frame->told->radiance[c], (double)radiance[c], 0);
        if (frame->told->rays == 1)
            near("the pixel's light and its ray's", (double)told->light[c], (double)radiance[c], 2e-6 * size);
    }
    for (size_t i = 0; i < told->n_places; i++)
        for (size_t k = 0; k < told->places[i].n_glows; k++)
            n += told->places[i].glows[k].light[0] > 0;
    return n;
}

/* Checks that all rays of the pixel together give its light, and that each ray has light from its emitters. A ray with
 * 0 would mean that data was lost between the kernel and the answer. Returns the number of rays whose light differs
 * from that of the first. */
static uint32_t judge_rays(const struct kd_frame *frame)
{
    const struct kd_probed_pixel *told = frame->told;
    double sum[3] = { 0 }, size = 0;
    uint32_t others = 0;
    for (int c = 0; c < 3; c++)
        size = fmax(size, fabs((double)told->radiance[c]));
    for (uint32_t i = 0; i < told->rays; i++) {
        const struct kd_probed_ray *ray = &told->each[i];
        double given[3] = { 0 };
        add_up(ray, given);
        assert_int_equal(ray->x / ray->steps_a_pixel, told->x);
        assert_int_equal(ray->y / ray->steps_a_pixel, told->y);
        others += ray->light[0] < told->each[0].light[0] || ray->light[0] > told->each[0].light[0];
        for (int c = 0; c < 3; c++) {
            sum[c] += given[c] / told->rays;
            near("a ray's light", (double)ray->light[c], given[c], 2e-6 * (size + fabs(given[c])));
        }
    }
    for (int c = 0; c < 3; c++)
        near("light of all rays", sum[c], (double)told->radiance[c], 2e-6 * size + 1e-30);
    return others;
}

/* The list of rays for the viewing direction of an observer at a finite radius. */
static void judge_direction(const struct kd_scene *scene, const struct kd_explained *x, uint32_t side,
                            struct kd_rays_params params)
{
    const struct kd_scene counted =
        x->told->steps_a_pixel == side ? x->scene : kd_critical_camera(&x->scene, x->told->steps_a_pixel);
    const struct kd_camera_exact camera = kd_camera_exact(&counted);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS];
    struct kd_ray_end end;
    double at[3];
    kd_camera_direction(&camera, x->told->x, x->told->y, at);
    const double look[2] = { atan2(at[2], -at[0]) * (180 / M_PI), asin(-at[1]) * (180 / M_PI) };
    params.observer = 1 + (int)motion.observer, params.fall_from = motion.fall_from;
    params.fall_energy = motion.fall_energy, params.fall_momentum = motion.fall_momentum;
    memcpy(params.velocity, motion.velocity, sizeof params.velocity);
    OK(kd_rays_trace(NULL, &params, look, 1, crossings, &end, NULL, NULL, &error));
    near("energy", end.energy, x->label.energy, 1e-11);
    assert_int_equal(end.fate, x->end.fate);
    assert_int_equal(end.n_crossings, x->end.n_crossings);
    for (uint32_t n = 0; n < end.n_crossings; n++) {
        const double bound =
            /* tolerance: the rounding error of the direction is amplified */
            (1e-11 + 1e3 * x->end.error) * fmax(x->crossings[n].r, 1);
        near("r of a direction", x->crossings[n].r, crossings[n].r, bound);
        near("phi of a direction", x->crossings[n].phi, crossings[n].phi + x->frame.twist, bound);
        near("delay of a direction", x->crossings[n].delay, crossings[n].delay, bound);
        near("g of a direction", x->crossings[n].g, crossings[n].g, bound);
    }
}

/* The closed form's crossings equal those of the list of rays. They equal the picture's crossings up to rounding. */
static void judge_crossings(const struct kd_scene *scene, const struct kd_plan *plan, const struct kd_frame *frame)
{
    const struct kd_picture picture = { frame, scene, plan, "", 0 };
    const struct kd_rays_params params = { .spin = scene->spacetime.spin,
                                           .r = scene->camera.r,
                                           .inclination_deg = scene->camera.inclination_deg,
                                           .orders = (uint32_t)scene->accuracy.orders,
                                           .engine = KD_ENGINE_CLOSED,
                                           .precision = KD_PRECISION_F64 };
    struct kd_ray_crossing crossings[KD_RAYS_MAX_ORDERS];
    struct kd_ray_end end;
    struct kd_explained x;
    OK(kd_explain(&picture, &x, &error));
    if (!x.label.outward && x.label.energy > 0) {
        OK(kd_rays_trace(NULL, &params, (double[]) { x.label.alpha, x.label.beta }, 1, crossings, &end, NULL, NULL,
                         &error));
        assert_int_equal(end.n_crossings, x.end.n_crossings);
        assert_int_equal(end.fate, x.end.fate);
        for (uint32_t n = 0; n < end.n_crossings; n++) {
            near("r", x.crossings[n].r, crossings[n].r, 0);
            near("phi", x.crossings[n].phi, crossings[n].phi + x.frame.twist, 1e-12);
            near("delay", x.crossings[n].delay, crossings[n].delay, 0);
            near("g", x.crossings[n].g, crossings[n].g / x.label.energy, 1e-15);
        }
    }
    if (isfinite(scene->camera.r) && !x.motion.within)
        judge_direction(scene, &x, plan->lens.side, params);
    for (size_t i = 0; i < x.told->n_places; i++) {
        const struct kd_probed_place *p = &x.told->places[i];
        const struct kd_ray_crossing *c = &x.crossings[p->order];
        if (p->order > 1 || p->order >= x.end.n_crossings || c->r > 100)
            continue;
        near("r of the picture over r", 1 / ((double)p->w * c->r), 1, 2e-4);
        if (c->r > 1.05 * kd_kerr_isco(kd_scene_hole(scene)) && kd_explained_has_gas(p))
            near("g of the picture", (double)p->g, c->g, 2e-4);
    }
    if (x.path.course.end != KD_COURSE_CAPTURED && x.path.course.end != KD_COURSE_ESCAPED)
        fail_msg("the path has no end");
    if ((x.path.course.end == KD_COURSE_ESCAPED) != (x.end.fate == KD_RAY_ESCAPED) && x.end.fate != KD_RAY_UNDECIDED)
        fail_msg("the path ends otherwise");
    if (!isnan(x.path.error))
        near("crossings of the path", x.path.error, 0,
             /* tolerance: these differences are proportional to the ray's amplification */
             fmin(1e-9 + 1e4 * x.end.error, 1e-3));
    kd_explained_finish(&x);
}

/* The explanation does not change the picture. */
static void judge_picture(const struct kd_scene *scene, const struct kd_plan *plan, const struct kd_frame *frame)
{
    struct kd_plan silent = *plan;
    struct kd_frame other;
    silent.report.probe.on = false;
    OK(kd_render(renderer, scene, &silent, NULL, NULL, &other, &error));
    assert_null(other.told);
    assert_memory_equal(kd_frame_pixels(frame), kd_frame_pixels(&other),
                        (size_t)frame->width * frame->height * kd_layer_pixel_bytes(&frame->layers[0]));
    kd_frame_finish(&other);
}

static void judge(const struct kd_scene *scene, size_t least)
{
    static const uint32_t at[][2] = {
        { 20, 20 }, { 32, 22 }, { 41, 14 }, { 5, 3 }, { 31, 17 }, { 26, 15 }, { 50, 20 }
    };
    size_t n = 0;
    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        struct kd_plan plan;
        struct kd_frame frame = told_at(scene, at[i][0], at[i][1], &plan);
        assert_int_equal(frame.told->x, at[i][0]);
        assert_int_equal(frame.told->middle.lost, 0);
        n += judge_sum(&frame, at[i][0], at[i][1]);
        judge_rays(&frame);
        judge_crossings(scene, &plan, &frame);
        if (!i)
            judge_picture(scene, &plan, &frame);
        kd_frame_finish(&frame);
    }
    if (n < least)
        fail_msg("only %zu emitters gave light", n);
}

static void sums(void **state)
{
    const struct {
        const char *preset;
        const char *const *set;
        size_t least;
    } cases[] = {
        { NULL, NULL, 3 },
        { "gas-stars", (const char *const[]) { "image.critical_factor", "1", NULL }, 6 },
        { "smooth",
          (const char *const[]) { "disk.opacity", "0.4", "sky.model", "grid", "image.critical_factor", "1", NULL }, 8 },
        { "living-disk", (const char *const[]) { "disk.particles", "4000", "accuracy.orders", "3", NULL }, 3 },
        { "hot-spot", NULL, 3 },
        { "luminet1979", (const char *const[]) { "image.samples", "2", NULL }, 2 },
        { "falling", NULL, 2 },
        { NULL, (const char *const[]) { "accuracy.engine", "mino-rkn6", "style.ringdown", "0.5", "time", "10", NULL },
          3 },
        { "smooth",
          (const char *const[]) { "volume.model", "uniform", "disk.opacity", "0.5", "sky.model", "grid",
                                  "image.critical_factor", "1", NULL },
          8 },
        { "smooth",
          (const char *const[]) { "volume.model", "uniform", "disk.model", "none", "sky.model", "none",
                                  "image.critical_factor", "1", NULL },
          0 },
        { "smooth",
          (const char *const[]) { "volume.model", "uniform", "disk.model", "none", "sky.model", "grid", "volume.outer",
                                  "1000", "volume.opacity", "0.001", "accuracy.engine", "mino-rkn6", "accuracy.steps",
                                  "400", "image.critical_factor", "1", NULL },
          3 },
        { NULL, (const char *const[]) { "image.samples", "auto", "image.bit_depth", "16", NULL }, 3 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct kd_scene scene = scene_of(cases[i].preset, cases[i].set);
        judge(&scene, cases[i].least);
    }
}

/* The layers of the pixel have the same numbers, bit for bit, for its first crossing of the disk. */
static void layers(void **state)
{
    static const char *const names[] = { "r", "g", "temperature", "emission_angle", "delay", "phi" };
    struct kd_scene scene =
        scene_of("gas", (const char *const[]) { "image.critical_factor", "1", "camera.azimuth_deg", "70", NULL });
    int compared = 0;
    (void)state;
    OK(kd_scene_set(&scene, "image.layers", "r,g,temperature,emission_angle,delay,phi,rgb", &error));
    for (uint32_t x = 2; x < WIDTH; x += 9) {
        struct kd_plan plan;
        struct kd_frame frame = told_at(&scene, x, 19, &plan);
        const struct kd_picture picture = { &frame, &scene, &plan, "", 0 };
        struct kd_explained e;
        double layer[6];
        for (int i = 0; i < 6; i++)
            layer[i] = ((const float *)kd_frame_layer(&frame, names[i])->data)[19 * WIDTH + x];
        OK(kd_explain(&picture, &e, &error));
        const struct kd_probed_place *p = NULL;
        for (size_t i = 0; i < frame.told->middle.n_places && !p; i++)
            if (kd_explained_has_gas(&frame.told->middle.places[i]))
                p = &frame.told->middle.places[i];
        if (p) {
            const struct kd_ray_crossing *c = &e.crossings[p->order];
            near("layer r", layer[0], (double)(1.0f / p->w), 0);
            near("layer g", layer[1], (double)p->g, 2e-7);
            near("layer temperature", layer[2] / (double)p->temperature, 1, 1e-6);
            near("layer emission angle", layer[3], (double)p->angle, 1e-6);
            near("layer delay", layer[4], c->delay, 1e-4 * (1 + fabs(c->delay)));
            near("layer phi", remainder(layer[5] - kd_explained_azimuth(&e, c->phi), 2 * M_PI), 0, 1e-4);
            compared++;
        }
        kd_explained_finish(&e);
        kd_frame_finish(&frame);
    }
    assert_true(compared > 3);
}

/* The gas's velocity from its g is that of its circular orbit, along the azimuthal component of the light's direction.
 * Gas on the side of positive lambda approaches. */
static void velocity_of_gas(void **state)
{
    (void)state;
    static const char *const sets[][5] = { { "camera.inclination_deg", "75", NULL },
                                           { "camera.r", "30", "spacetime.spin", "-0.6", NULL } };
    int compared = 0, approaching = 0;
    for (size_t i = 0; i < sizeof sets / sizeof *sets; i++) {
        const struct kd_scene scene = scene_of(NULL, sets[i]);
        const struct kd_hole *hole = kd_scene_hole(&scene);
        for (uint32_t x = 4; x < WIDTH; x += 7) {
            struct kd_plan plan;
            struct kd_frame frame = told_at(&scene, x, 20, &plan);
            const struct kd_picture picture = { &frame, &scene, &plan, "", 0 };
            struct kd_explained e;
            OK(kd_explain(&picture, &e, &error));
            for (uint32_t k = 0; k < e.end.n_crossings; k++) {
                const struct kd_ray_crossing *c = &e.crossings[k];
                if (!kd_explained_has_gas(kd_explained_place(&e, k)) || c->r < kd_kerr_isco(hole))
                    continue;
                const struct kd_gas_velocity v = kd_explained_velocity(&e, c);
                const double drag = kd_kerr_dragging(hole, c->r, 0), reach = kd_kerr_rotation_reach(hole, c->r, 0, 1);
                const double speed = (kd_kerr_omega(hole, c->r) - drag) / reach,
                             along = e.motion.lambda * reach / (1 - drag * e.motion.lambda);
                near("speed of the gas", v.speed, fabs(speed), 1e-9);
                near("its approach", v.approach, speed * along, 1e-6);
                approaching += v.approach > 0.1;
                compared++;
            }
            kd_explained_finish(&e);
            kd_frame_finish(&frame);
        }
    }
    assert_true(compared > 8 && approaching > 2 && compared > approaching + 2);
}

/* Explains pixels of special pictures: of one eye of a stereo pair, of a band that is no longer in memory, and of a
 * ring projection. */
static void other_pictures(void **state)
{
    static const uint32_t columns[] = { 20, WIDTH + 20 };
    const struct kd_scene pair = scene_of(
        NULL, (const char *const[]) { "camera.r", "30", "camera.stereo", "pair", "image.critical_factor", "1", NULL });
    const struct kd_scene ring = scene_of("photon-rings", (const char *const[]) { "image.samples", "1", NULL });
    double alpha[2];
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct kd_plan plan;
        struct kd_explained x;
        struct kd_frame frame = told_at(&pair, columns[i], 20, &plan);
        const struct kd_picture picture = { &frame, &pair, &plan, "", 0 };
        assert_int_equal(frame.width, 2 * WIDTH);
        assert_int_equal(frame.told->x, 20);
        judge_sum(&frame, columns[i], 20);
        OK(kd_explain(&picture, &x, &error));
        assert_string_equal(x.eye, i ? "right" : "left");
        alpha[i] = x.label.alpha;
        kd_explained_finish(&x);
        kd_frame_finish(&frame);
    }
    assert_true(alpha[0] != alpha[1]);
    struct kd_plan plan;
    struct kd_frame frame = told_at(&ring, 30, 12, &plan);
    judge_sum(&frame, 30, 12);
    judge_crossings(&ring, &plan, &frame);
    kd_frame_finish(&frame);
}

/* Light of negative energy at infinity from gas within the ergosphere: the explained g for the observer equals that of
 * the picture. */
static void negative_energies(void **state)
{
    const struct kd_scene scene =
        scene_of(NULL, (const char *const[]) { "spacetime.spin", "0.998", "camera.r", "1.6", "camera.observer", "zamo",
                                               "camera.inclination_deg", "80", "camera.fov_deg", "120",
                                               "camera.yaw_deg", "90", "image.critical_factor", "1", NULL });
    int below = 0, compared = 0;
    (void)state;
    struct kd_plan plan;
    struct kd_capacity c;
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&scene, &c, &plan, &error));
    for (uint32_t i = 0; i < WIDTH * HEIGHT && compared < 4; i += 7) {
        struct kd_camera_label label;
        kd_lens_label(&scene, &plan.lens, i % WIDTH, i / WIDTH, &label);
        if (!(label.energy < -0.05) || ++below % 5)
            continue;
        struct kd_plan told;
        struct kd_frame frame = told_at(&scene, i % WIDTH, i / WIDTH, &told);
        const struct kd_picture picture = { &frame, &scene, &told, "", 0 };
        struct kd_explained x;
        OK(kd_explain(&picture, &x, &error));
        assert_true(x.label.energy < 0);
        for (size_t k = 0; k < frame.told->middle.n_places; k++) {
            const struct kd_probed_place *p = &frame.told->middle.places[k];
            const double r = p->order < x.end.n_crossings ? x.crossings[p->order].r : 0;
            if (kd_explained_has_gas(p) && r > 1.05 * kd_kerr_isco(kd_hole(0.998))) {
                near("g of light whose energy is below 0", (double)p->g / x.crossings[p->order].g, 1, 1e-3);
                compared++;
            }
        }
        kd_explained_finish(&x);
        kd_frame_finish(&frame);
    }
    printf("negative energies: %d compared of %d\n", compared, below);
    assert_true(compared > 0);
}

/* Pixels of many rays: by image.samples, at the critical curve, and chosen by "auto", traced or interpolated. The mean
 * light of the explained rays equals the layer of the pixel's light. The rays' labels are as far apart as in the
 * picture. */
static void many_rays(void **state)
{
    const struct {
        const char *preset;
        const char *const *set;
        uint32_t rays;
    } cases[] = {
        { "gas", (const char *const[]) { "image.samples", "3", NULL }, 9 },
        { "smooth", (const char *const[]) { "sky.model", "grid", "image.critical_factor", "16", NULL }, 16 },
        { "smooth",
          (const char *const[]) { "sky.model", "grid", "image.critical_factor", "16", "accuracy.engine", "mino-rkn6",
                                  "accuracy.precision", "f64", NULL },
          16 },
        { "smooth",
          (const char *const[]) { "sky.model", "grid", "image.samples", "auto", "image.pixel_error", "0.002", NULL },
          2 },
        { "smooth",
          (const char *const[]) { "volume.model", "uniform", "disk.opacity", "0.5", "image.critical_factor", "4",
                                  NULL },
          4 },
        { NULL,
          (const char *const[]) { "camera.r", "12", "camera.projection", "equirectangular", "image.samples", "2",
                                  NULL },
          4 },
        { NULL, (const char *const[]) { "camera.r", "12", "camera.projection", "fulldome", "image.samples", "2", NULL },
          4 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct kd_scene scene = scene_of(cases[i].preset, cases[i].set);
        uint32_t most = 0, others = 0;
        for (uint32_t x = 12; x < 54; x += 7) {
            struct kd_plan plan;
            struct kd_frame frame = told_at(&scene, x, 18, &plan);
            const struct kd_picture picture = { &frame, &scene, &plan, "", 0 };
            const struct kd_probed_pixel *told = frame.told;
            judge_sum(&frame, x, 18);
            others += judge_rays(&frame);
            most = told->rays > most ? told->rays : most;
            for (uint32_t k = 0; k < told->rays; k++) {
                struct kd_explained e;
                double at[2];
                OK(kd_explain_each(&picture, k, &e, &error));
                kd_explained_ray_at(&picture, &e, at);
                assert_true(at[0] > x && at[0] < x + 1 && at[1] > 18 && at[1] < 19);
                near("weight", e.weight, 1.0 / told->rays, 0);
                for (size_t n = 0; n < e.told->n_places; n++) {
                    const struct kd_probed_place *p = &e.told->places[n];
                    const struct kd_ray_crossing *c = &e.crossings[p->order];
                    if (p->order == 0 && e.end.n_crossings && c->r < 60 &&
                        told->rays == plan.lens.side * plan.lens.side)
                        near("r of the picture over r", 1 / ((double)p->w * c->r), 1, 2e-4);
                }
            }
            kd_frame_finish(&frame);
        }
        printf("%s: up to %u rays a pixel, %u unlike the first\n", cases[i].preset ? cases[i].preset : "default", most,
               others);
        assert_true(most >= cases[i].rays && others > 0);
    }
}

/* For an observer within the horizon the explanation follows the ray by steps in double precision, which
 * unit/physics_course.c tests. It agrees with the picture's kernel in crossings (azimuths and frequencies), fate, and
 * direction on the sky. The sum of the light is that of the pixel. */
static void from_within(void **state)
{
    const struct {
        const char *spin, *r, *yaw, *projection;
    } cases[] = {
        { "0.9", "1.3", "0", "pinhole" },          { "0.9", "1.3", "180", "pinhole" }, { "0", "1.2", "60", "pinhole" },
        { "-0.6", "1.5", "0", "equirectangular" }, { "0.5", "0.9", "0", "fulldome" },
    };
    int crossed = 0, gas = 0, sky = 0, dark = 0;
    (void)state;
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const struct kd_scene scene = scene_of("smooth", (const char *const[]) { "sky.model",
                                                                                 "grid",
                                                                                 "disk.opacity",
                                                                                 "0.5",
                                                                                 "spacetime.spin",
                                                                                 cases[i].spin,
                                                                                 "camera.observer",
                                                                                 "infall",
                                                                                 "camera.r",
                                                                                 cases[i].r,
                                                                                 "camera.yaw_deg",
                                                                                 cases[i].yaw,
                                                                                 "camera.projection",
                                                                                 cases[i].projection,
                                                                                 "camera.fov_deg",
                                                                                 "120",
                                                                                 "image.critical_factor",
                                                                                 "1",
                                                                                 "camera.azimuth_deg",
                                                                                 "40",
                                                                                 NULL });
        for (uint32_t n = 0; n < 10; n++) {
            const uint32_t at_x = (7 + 13 * n) % WIDTH, at_y = (3 + 11 * n) % HEIGHT;
            struct kd_plan plan;
            struct kd_frame frame = told_at(&scene, at_x, at_y, &plan);
            const struct kd_picture picture = { &frame, &scene, &plan, "", 0 };
            struct kd_explained x;
            judge_sum(&frame, at_x, at_y);
            OK(kd_explain(&picture, &x, &error));
            assert_true(x.motion.within && x.path.course.n > 1);
            near("first place of the path", x.path.places[0].r, scene.camera.r, 1e-12);
            if (x.told->ended && x.end.fate != KD_RAY_UNDECIDED) {
                assert_int_equal(x.end.fate, KD_RAY_ESCAPED);
                near("theta of the sky", (double)x.told->end_u, cos(x.end.theta), 1e-4);
                near("phi of the sky", remainder((double)x.told->end_phi - x.end.phi, 2 * M_PI) * sin(x.end.theta), 0,
                     3e-4);
                sky++;
            }
            dark += x.end.fate == KD_RAY_CAPTURED;
            for (size_t k = 0; k < x.told->n_places; k++) {
                const struct kd_probed_place *p = &x.told->places[k];
                const struct kd_ray_crossing *c = &x.crossings[p->order];
                assert_true(p->order < x.end.n_crossings);
                if (p->order > 1 || c->r > 100)
                    continue;
                near("r of the picture over r", 1 / ((double)p->w * c->r), 1, 2e-4);
                if (p->phi != 0)
                    near("phi of the picture", remainder((double)p->phi - c->phi, 2 * M_PI), 0, 5e-4);
                crossed++;
                if (kd_explained_has_gas(p) && c->r > 1.05 * kd_kerr_isco(kd_hole(scene.spacetime.spin))) {
                    near("g of the picture over g", (double)p->g / c->g, 1, 3e-4);
                    gas++;
                }
            }
            kd_explained_finish(&x);
            kd_frame_finish(&frame);
        }
    }
    printf("from within: %d crossings, %d on the disk, %d to the sky, %d to the horizon\n", crossed, gas, sky, dark);
    assert_true(crossed > 8 && gas > 2 && sky > 10 && dark > 2);
}

static void places(void **state)
{
    struct kd_plan plan = { .picture.width = 64, .picture.height = 36 };
    (void)state;
    FAILS(KD_EINVAL, "X below 64 and Y below 36", kd_explain_at("64,0", &plan, &error));
    FAILS(KD_EINVAL, "is \"1\"", kd_explain_at("1", &plan, &error));
    FAILS(KD_EINVAL, "is \"1,2,3\"", kd_explain_at("1,2,3", &plan, &error));
    FAILS(KD_EINVAL, "is \"-1,2\"", kd_explain_at("-1,2", &plan, &error));
    FAILS(KD_EINVAL, "is \"nan,2\"", kd_explain_at("nan,2", &plan, &error));
    assert_false(plan.report.probe.on);
    OK(kd_explain_at("63.9,35.5", &plan, &error));
    assert_int_equal(plan.report.probe.x, 63);
    assert_int_equal(plan.report.probe.y, 35);
}

/* The volume of that name in an explanation, or NULL. */
static const struct kd_probed_volume *volume_of(const struct kd_frame *frame, const char *name)
{
    for (size_t i = 0; i < frame->told->middle.n_volumes; i++)
        if (!strcmp(kd_emitters[frame->told->middle.volumes[i].emitter]->name, name))
            return &frame->told->middle.volumes[i];
    return NULL;
}

/* The volumes' parts add up to their total. */
static void judge_volumes(const struct kd_probed_ray *told)
{
    double sum[3] = { 0 }, all[3] = { 0 }, depth = 0, passes = 1;
    for (size_t i = 0; i < told->n_volumes; i++) {
        depth += (double)told->volumes[i].depth;
        for (int c = 0; c < 3; c++)
            sum[c] += (double)told->volumes[i].light[c];
    }
    for (size_t i = 0; i < told->n_stretches; i++) {
        passes *= (double)told->stretches[i].through[1] / (double)told->stretches[i].through[0];
        for (int c = 0; c < 3; c++)
            all[c] += (double)told->stretches[i].light[c];
    }
    for (int c = 0; c < 3; c++)
        near("light of all volumes", sum[c], all[c], 1e-5 * all[c]);
    near("depth of all volumes", depth, -log(passes), 1e-5 * (1 + depth));
    assert_true(told->n_stretches == 0 ||
                (told->steps > 0 && told->samples >= 3 * told->n_stretches && told->steps <= told->samples + 12 * 16));
}

/* Each of two overlapping volumes is explained with the depth that it has alone. If neither hides the other, each also
 * has the light that it has in a picture without the other. The shell's edges are within the jets' bounds. The march
 * must find the edges within a step, or the error would be 1 %. */
static void volumes(void **state)
{
    static const char *const names[] = { "volume", "jets" };
    static const uint32_t at[][2] = { { 20, 20 }, { 31, 8 }, { 32, 28 }, { 33, 10 }, { 40, 18 } };
    int lit[2] = { 0 }, dim = 0;
    (void)state;
    for (int hides = 0; hides < 2; hides++) {
        const struct kd_scene both =
            scene_of("smooth", (const char *const[]) { "disk.model", "none", "sky.model", "none", "volume.model",
                                                       "uniform", "volume.outer", "15", "volume.emissivity", "0.001",
                                                       "volume.opacity", hides ? "0.2" : "0", "jets.brightness", "0.05",
                                                       "jets.opening_deg", "20", "image.critical_factor", "1", NULL });
        for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
            struct kd_plan plan;
            struct kd_frame frame = told_at(&both, at[i][0], at[i][1], &plan);
            judge_volumes(&frame.told->middle);
            assert_int_equal(frame.told->middle.n_volumes, 2);
            for (int k = 0; k < 2; k++) {
                struct kd_scene one = both;
                OK(kd_scene_set(&one, k ? "volume.model" : "jets.brightness", k ? "none" : "0", &error));
                struct kd_frame alone = told_at(&one, at[i][0], at[i][1], &plan);
                const struct kd_probed_volume *v = volume_of(&frame, names[k]);
                const double depth = -log((double)alone.told->middle.through);
                near("its depth", (double)v->depth, depth, 2e-5 + 5e-4 * depth);
                for (int c = 0; c < 3 && !hides; c++)
                    near("its light", (double)v->light[c], (double)alone.told->radiance[c],
                         5e-4 * (double)alone.told->radiance[c]);
                lit[k] += v->light[0] > 0;
                /* light of points behind the shell's matter */
                dim += hides && k && v->light[0] < 0.9f * alone.told->middle.light[0];
                kd_frame_finish(&alone);
            }
            kd_frame_finish(&frame);
        }
    }
    assert_true(lit[0] >= 8 && lit[1] >= 4 && dim >= 1);
}

static void encoded(const struct kd_scene *scene, const struct kd_plan *plan, struct kd_buffer *out)
{
    struct kd_frame frame;
    OK(kd_render(renderer, scene, plan, NULL, NULL, &frame, &error));
    const struct kd_picture picture = { &frame, scene, plan, "", 0 };
    OK(kd_format_pixel.encode(&picture, KD_EFFORT_QUICK, NULL, out, &error));
    OK(kd_buffer_append(out, "", 1));
    kd_frame_finish(&frame);
}

/* If a pixel does not depend on the rest of the picture, only the pixel and a margin are rendered to explain it, with
 * the same bytes. With automatic exposure a pixel depends on the whole picture, which is then rendered. */
static void alone(void **state)
{
    (void)state;
    static const struct {
        const char *preset;
        uint32_t x, y;
    } pixels[] = {
        { "gas", 20, 20 }, { "gas", 0, 35 },        { "gas", 31, 14 },
        { "jet", 30, 8 },  { "milky-way", 40, 20 }, { "thick-disk", 50, 19 },
    };
    for (size_t i = 0; i < sizeof pixels / sizeof *pixels; i++) {
        struct kd_scene scene =
                            scene_of(pixels[i].preset, (const char *const[]) { "style.exposure", "-1", "style.bloom",
                                                                               "0", "image.samples", "2", NULL }),
                        narrow;
        struct kd_capacity c;
        struct kd_plan plan, less;
        struct kd_buffer texts[2] = { { 0 }, { 0 } };
        char at[40];
        kd_renderer_capacity(renderer, &c);
        snprintf(at, sizeof at, "%u,%u", pixels[i].x, pixels[i].y);
        OK(kd_plan_make(&scene, &c, &plan, &error));
        OK(kd_explain_at(at, &plan, &error));
        narrow = scene, less = plan;
        OK(kd_explain_narrow(&c, &narrow, &less, &error));
        /* skipped for stars, which need a wide margin, so that more rays are traced */
        assert_true(less.lens.rays < plan.lens.rays || scene.sky.model);
        encoded(&scene, &plan, &texts[0]);
        encoded(&narrow, &less, &texts[1]);
        const char *by_itself = (char *)texts[1].data, *whole = (char *)texts[0].data;
        size_t same = 0;
        while (by_itself[same] && by_itself[same] == whole[same])
            same++;
        if (by_itself[same] != whole[same])
            fail_msg("%s at %s: \"%.60s\", not \"%.60s\", behind \"%.60s\"", pixels[i].preset, at, by_itself + same,
                     whole + same, by_itself + (same < 60 ? 0 : same - 60));
        for (int k = 0; k < 2; k++)
            kd_buffer_finish(&texts[k]);
        OK(kd_scene_set(&scene, "style.exposure", "auto", &error));
        less = plan, narrow = scene;
        OK(kd_explain_narrow(&c, &narrow, &less, &error));
        assert_int_equal(less.lens.rays, plan.lens.rays);
    }
}

static bool until_done(void *user, double fraction)
{
    (void)user, (void)fraction;
    return true;
}

/* The kernels that are compiled ahead for a picture suffice for the explanation of its pixels, at the critical curve
 * and elsewhere. */
static void kernels_ahead(void **state)
{
    (void)state;
    static const char *const presets[] = { "gas", "gas-stars", "jet" };
    for (size_t i = 0; i < sizeof presets / sizeof *presets; i++) {
        struct kd_scene scene = scene_of(presets[i], (const char *const[]) { "image.samples", "2", NULL });
        struct kd_compilation *ahead = kd_explain_ahead(renderer, &scene);
        if (ahead) {
            OK(kd_compilation_run(ahead, until_done, NULL, &error));
            kd_compilation_end(ahead);
        }
        OK(kd_scene_set(&scene, "image.samples", "1", &error));
        OK(kd_scene_set(&scene, "style.exposure", "0", &error));
        OK(kd_scene_set(&scene, "style.bloom", "0", &error));
        struct kd_capacity c;
        kd_renderer_capacity(renderer, &c);
        size_t at_curve = 0, elsewhere = 0;
        for (uint32_t y = 1; y < (uint32_t)scene.image.height; y += 3) {
            for (uint32_t x = 1; x < (uint32_t)scene.image.width; x += 3) {
                struct kd_scene narrow = scene;
                struct kd_plan plan;
                char at[40];
                snprintf(at, sizeof at, "%u,%u", x, y);
                OK(kd_plan_make(&narrow, &c, &plan, &error));
                OK(kd_explain_at(at, &plan, &error));
                OK(kd_explain_narrow(&c, &narrow, &plan, &error));
                *(plan.lens.critical ? &at_curve : &elsewhere) += 1;
                struct kd_compilation *lacks = kd_compilation_begin(renderer, &narrow, &plan);
                if (lacks)
                    fail_msg("%s: the pixel %s lacks a kernel", presets[i], at);
            }
        }
        assert_true(at_curve && elsewhere);
    }
}

int main(void)
{
    /* runs first, before other tests have compiled the kernels */
    const struct CMUnitTest tests[] = { cmocka_unit_test(kernels_ahead),  cmocka_unit_test(sums),
                                        cmocka_unit_test(many_rays),      cmocka_unit_test(volumes),
                                        cmocka_unit_test(layers),         cmocka_unit_test(velocity_of_gas),
                                        cmocka_unit_test(other_pictures), cmocka_unit_test(negative_energies),
                                        cmocka_unit_test(from_within),    cmocka_unit_test(places),
                                        cmocka_unit_test(alone) };
    int status = open_renderer();
    return status ? status : close_renderer(cmocka_run_group_tests_name("pixel", tests, NULL, NULL));
}

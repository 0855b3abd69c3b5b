/* Tests of layers. They are compared with the Kerr-Schild oracle, which shares no equation with the kernels and
 * integrates the photon's momentum in Cartesian coordinates. Expected values of g and of the angle to the disk's normal
 * follow from the metric in the plane. Layers of light are compared with the picture's own linear light.
 *
 * The tolerance of a number is some roundings of a float, times the sensitivity of the number to the ray. This
 * sensitivity is measured on the oracle. */
#include "cgs.h"
#include "kerr_schild.h"
#include "image/colour_map.h"
#include "physics/disk/thin_disk.h"
#include "physics/spacetime/kerr.h"
#include "render/output/format.h"
#include "render/device/device_internal.h"
#include "render/view/layout.h"
#include "scene/hole.h"

#include "interface.h"
#include "render_support.h"

#include <math.h>

enum { WIDTH = 28, HEIGHT = 20, PIXELS = WIDTH * HEIGHT, ORDERS = 2 };

static struct kd_scene scene_of(double spin, double inclination, double r, const char *layers)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.critical_factor = 1;
    scene.spacetime.spin = spin;
    scene.camera.inclination_deg = inclination;
    scene.camera.r = r;
    scene.camera.azimuth_deg = 130;
    scene.camera.field_m = 34;
    scene.camera.fov_deg = 60;
    scene.disk.outer = 15;
    scene.disk.taper = 0;
    scene.accuracy.orders = ORDERS;
    OK(kd_scene_set(&scene, "image.layers", layers, &error));
    OK(kd_scene_validate(&scene, &error));
    return scene;
}

/* The plan of a picture in the format NPY, which may have any layers. */
static struct kd_plan plan_of(struct kd_scene *scene, uint64_t most_bytes)
{
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(renderer, &c);
    if (most_bytes)
        c.max_binding_bytes = most_bytes;
    OK(kd_format_plan(&kd_format_npy, scene, &c, &plan, &error));
    return plan;
}

static struct kd_frame frame_of(struct kd_scene *scene)
{
    struct kd_frame frame;
    const struct kd_plan plan = plan_of(scene, 0);
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static const float *layer(const struct kd_frame *frame, const char *name)
{
    const struct kd_layer *found = kd_frame_layer(frame, name);
    if (!found)
        fail_msg("the frame has no layer %s", name);
    return found->data;
}

/* The oracle's path of a pixel's centre, for a ray scaled by `scale`. */
static struct ks_path path_of(const struct kd_scene *scene, int pixel, double scale, int crossings, double *energy)
{
    bool far = isinf(scene->camera.r);
    double theta = scene->camera.inclination_deg * M_PI / 180;
    double step = scale * (far ? scene->camera.field_m : 2 * tan(scene->camera.fov_deg * M_PI / 360)) / WIDTH;
    double x = step * (pixel % WIDTH - 0.5 * (WIDTH - 1)), y = -step * (pixel / WIDTH - 0.5 * (HEIGHT - 1));
    double n = 1 / sqrt(1 + x * x + y * y), k[3] = { -n, -y * n, x * n };
    const struct ks_photon photon = far ? ks_from_infinity(scene->spacetime.spin, cos(theta), x, y)
                                        : ks_from_camera(scene->spacetime.spin, scene->camera.r, theta, false, k);
    *energy = photon.energy;
    return ks_trace(photon, crossings);
}

/* -(ds/dt)^2 of a circle in the plane, with g_tt = -(1 - 2/r), g_tphi = -2a/r, g_phiphi = r^2 + a^2 + 2a^2/r; and the
 * Omega for which its radial derivative is 0. */
static double line(double a, double r, double omega)
{
    return (1 - 2 / r) + 4 * a / r * omega - (r * r + a * a + 2 * a * a / r) * omega * omega;
}
static double omega_of(double a, double r)
{
    double low = 0, high = 1 / r, h = 1e-3 * r;
    for (int i = 0; i < 60; i++) {
        double w = 0.5 * (low + high);
        double pull = 8 * (line(a, r + h, w) - line(a, r - h, w)) - line(a, r + 2 * h, w) + line(a, r - 2 * h, w);
        *(pull > 0 ? &low : &high) = w;
    }
    return 0.5 * (low + high);
}

/* The layers at a crossing: g, r, phi, delay, emission angle. */
enum { G, R, PHI, DELAY, ANGLE, KINDS };
static const char *const names[KINDS] = { "g", "r", "phi", "delay", "emission_angle" };

static void expected(const struct kd_scene *scene, const struct ks_path *path, int n, double energy, double out[KINDS])
{
    double a = scene->spacetime.spin, r = path->r[n], omega = omega_of(a, r);
    double emitted = (energy - omega * path->momentum[n]) / sqrt(line(a, r, omega)); /* -p.u */
    out[G] = 1 / emitted;
    out[R] = r;
    out[PHI] = path->phi[n] + scene->camera.azimuth_deg * M_PI / 180;
    out[DELAY] = path->delay[n];
    /* the cosine of the angle contains g, because in the plane the unit normal is along z, and the gas does not move
     * along z */
    out[ANGLE] = acos(fmin(fabs(path->p_z[n]) / emitted, 1));
}

static double apart(int kind, double x, double y)
{
    return kind == PHI ? fabs(remainder(x - y, 2 * M_PI)) : fabs(x - y);
}

/* True if a crossing is on the disk. *near: true if the crossing is so close to an edge that single precision may place
 * it on either side. */
static bool on_disk(const struct kd_scene *scene, const struct ks_path *path, int n, bool *near)
{
    double in = kd_kerr_isco(kd_scene_hole(scene)), out = scene->disk.outer, r = path->r[n];
    bool there = n < path->crossings;
    *near = there && (fabs(r / in - 1) < 1e-3 || fabs(r / out - 1) < 1e-3);
    return there && r > in && r < out;
}

static void judge(const struct kd_scene *scene, const struct kd_frame *frame, const float *values[KINDS][ORDERS],
                  bool delay)
{
    double worst[KINDS] = { 0 };
    int compared = 0;
    for (int k = 0; k < PIXELS; k++) {
        double energy, other;
        struct ks_path path = path_of(scene, k, 1, ORDERS, &energy),
                       beside = path_of(scene, k, 1 + 1e-6, ORDERS, &other);
        int first = -1;
        bool unsure = false;
        for (int n = 0; n < ORDERS; n++) {
            bool near, on = on_disk(scene, &path, n, &near);
            double want[KINDS], moved[KINDS];
            unsure |= near || (first < 0 && path.crossings != beside.crossings);
            if (near || path.crossings != beside.crossings)
                continue;
            if (isnan(values[R][n][k]) == on)
                fail_msg("spin %g, pixel %d, order %d: %g, the oracle has %g", scene->spacetime.spin, k, n,
                         values[R][n][k], path.r[n]);
            if (!on)
                continue;
            first = first < 0 ? n : first;
            expected(scene, &path, n, energy, want);
            expected(scene, &beside, n, other, moved);
            for (int i = 0; i < KINDS; i++) {
                if (i == DELAY && !delay)
                    continue;
                double gain = apart(i, moved[i], want[i]) / 1e-6, scale = i == R || i == DELAY ? 1 + fabs(want[i]) : 1;
                /* the sensitivity of an angle to its cosine is the slope of the arc cosine */
                double steep = i == ANGLE ? 1 / fmax(sin(want[i]), 1e-3) : 1;
                worst[i] = fmax(worst[i], apart(i, values[i][n][k], want[i]) / (scale * steep + gain));
            }
            compared++;
        }
        const float *orders = layer(frame, "order"), *g = layer(frame, "g");
        if (unsure)
            continue;
        assert_true(first < 0 ? isnan(orders[k]) && isnan(g[k]) : orders[k] == first && g[k] == values[G][first][k]);
    }
    print_message("a %6.3f, i %2.0f, r %4g: %4d crossings, worst", scene->spacetime.spin, scene->camera.inclination_deg,
                  scene->camera.r, compared);
    for (int i = 0; i < KINDS; i++)
        print_message(" %s %.1e", names[i], worst[i]);
    print_message("\n");
    assert_true(compared > PIXELS / 4);
    for (int i = 0; i < KINDS; i++)
        /* bounds: ten times the observed error for g and angles; for delays, the error of the profile's steps */
        assert_true(worst[i] < (i == DELAY ? 2e-5 : 4e-6));
}

static void test_crossings(void **state)
{
    (void)state;
    static const struct {
        double a, i, r;
        bool delay;
    } views[] = {
        { 0, 60, INFINITY, false },    { 0.9, 75, INFINITY, false }, { 0.998, 85, INFINITY, true },
        { -0.7, 30, INFINITY, false }, { 0.9, 70, 25, false },       { 0.5, 80, 30, true },
    };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = scene_of(
            views[v].a, views[v].i, views[v].r,
            views[v].delay ? "g_0,r_0,phi_0,emission_angle_0,g_1,r_1,phi_1,emission_angle_1,order,g,delay_0,delay_1"
                           : "g_0,r_0,phi_0,emission_angle_0,g_1,r_1,phi_1,emission_angle_1,order,g");
        struct kd_frame frame = frame_of(&scene);
        const float *values[KINDS][ORDERS];
        for (int i = 0; i < KINDS; i++)
            for (int n = 0; n < ORDERS && (i != DELAY || views[v].delay); n++) {
                char name[40];
                snprintf(name, sizeof name, "%s_%d", names[i], n);
                values[i][n] = layer(&frame, name);
            }
        judge(&scene, &frame, values, views[v].delay);
        kd_frame_finish(&frame);
    }
}

/* Directions in the sky and fates are compared with the oracle's. */
static void test_ends(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 75, INFINITY, "sky_theta,sky_phi,fate");
    struct kd_frame frame = frame_of(&scene);
    const float *theta = layer(&frame, "sky_theta"), *phi = layer(&frame, "sky_phi"), *fate = layer(&frame, "fate");
    int compared = 0;
    for (int k = 0; k < PIXELS; k++) {
        double energy, azimuth = scene.camera.azimuth_deg * M_PI / 180;
        struct ks_path path = path_of(&scene, k, 1, 16, &energy), beside = path_of(&scene, k, 1 + 1e-6, 16, &energy);
        if (path.fate == KS_UNDECIDED || path.fate != beside.fate)
            continue;
        assert_true(fate[k] == (path.fate == KS_ESCAPED ? KD_FATE_ESCAPED : KD_FATE_CAPTURED));
        assert_true(isnan(theta[k]) == (path.fate != KS_ESCAPED) && isnan(phi[k]) == isnan(theta[k]));
        if (path.fate != KS_ESCAPED)
            continue;
        double want = acos(path.u), gain = fabs(acos(beside.u) - want) / 1e-6,
               turn = fabs(remainder(beside.sky_phi - path.sky_phi, 2 * M_PI)) / 1e-6;
        assert_true(fabs(theta[k] - want) < 2e-6 * (1 + gain) / fmax(sin(want), 1e-2));
        assert_true(fabs(remainder(phi[k] - path.sky_phi - azimuth, 2 * M_PI)) <
                    2e-6 * (1 + turn) / fmax(sin(want), 1e-2));
        assert_true(phi[k] > -M_PI - 1e-5 && phi[k] < M_PI + 1e-5);
        compared++;
    }
    assert_true(compared > PIXELS / 2);
    kd_frame_finish(&frame);
}

static double luminance(const float *rgb) { return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]; }

/* The layers contain the light of each order. The sum of all orders and the sky is the picture's luminance, for any
 * number of rays a pixel. */
static void test_light(void **state)
{
    (void)state;
    static const char *const settings[][2] = { { "image.samples", "1" },         { "image.samples", "2" },
                                               { "image.critical_factor", "4" }, { "disk.opacity", "0.4" },
                                               { "sky.model", "grid" },          { "disk.model", "particles" } };
    for (size_t s = 0; s < sizeof settings / sizeof *settings; s++) {
        struct kd_scene scene = scene_of(0.9, 75, INFINITY, "rgb,intensity,intensity_0,intensity_1,intensity_2");
        scene.accuracy.orders = 3;
        OK(kd_scene_set(&scene, settings[s][0], settings[s][1], &error));
        struct kd_frame frame = frame_of(&scene);
        const float *all = layer(&frame, "intensity"), *rgb = layer(&frame, "radiance");
        const float *parts[] = { layer(&frame, "intensity_0"), layer(&frame, "intensity_1"),
                                 layer(&frame, "intensity_2") };
        double most = 0, higher = 0, rest = 0;
        for (int k = 0; k < PIXELS; k++)
            most = fmax(most, all[k]);
        for (int k = 0; k < PIXELS; k++) {
            double sum = (double)parts[0][k] + parts[1][k] + parts[2][k];
            assert_true(fabs(all[k] - luminance(rgb + 3 * k)) <= 1e-6 * most);
            assert_true(scene.sky.model ? all[k] - sum >= -1e-6 * most : fabs(all[k] - sum) <= 1e-6 * most);
            higher += parts[1][k] + parts[2][k];
            rest += all[k] - sum;
        }
        assert_true(most > 0.5 && higher > 0);
        assert_true((rest > 0.01 * PIXELS) == (scene.sky.model != 0));
        kd_frame_finish(&frame);
    }
}

/* A black body appears with the brightness (g T)^4, where T follows from the flux at its radius. An opaque crossing has
 * infinite optical depth. */
static void test_temperature(void **state)
{
    (void)state;
    struct kd_scene scene =
        scene_of(0.9, 75, INFINITY, "r_0,g_0,temperature_0,intensity_0,optical_depth_0,intensity_1");
    double largest = kd_disk_flux_page_thorne(kd_hole(0.9), kd_disk_peak_page_thorne(kd_hole(0.9)));
    for (int clear = 0; clear < 2; clear++) {
        scene.disk.opacity = clear ? 0.25 : 1;
        struct kd_frame frame = frame_of(&scene);
        const float *r = layer(&frame, "r_0"), *g = layer(&frame, "g_0"), *t = layer(&frame, "temperature_0");
        const float *light = layer(&frame, "intensity_0"), *depth = layer(&frame, "optical_depth_0");
        int n = 0;
        for (int k = 0; k < PIXELS; k++) {
            assert_true(isnan(t[k]) == isnan(r[k]) && isnan(depth[k]) == isnan(r[k]));
            if (isnan(r[k]) || r[k] < 1.01 * kd_kerr_isco(kd_hole(0.9)))
                continue;
            double want =
                scene.disk.peak_temperature_k * pow(kd_disk_flux_page_thorne(kd_hole(0.9), r[k]) / largest, 0.25);
            assert_true(fabs(t[k] / want - 1) < 2e-4); /* the table is linear between 1024 nodes */
            assert_true(
                fabs(light[k] / (scene.disk.opacity * pow(g[k] * t[k] / scene.disk.peak_temperature_k, 4)) - 1) < 1e-5);
            assert_true(clear ? fabs(depth[k] + log(0.75)) < 1e-6 : isinf(depth[k]));
            n++;
        }
        assert_true(n > PIXELS / 8);
        kd_frame_finish(&frame);
    }
}

/* The product x.y of vectors in the plane, from their covariant components along t and phi, by the inverse metric. */
static double product(double a, double r, double x_t, double x_phi, double y_t, double y_phi)
{
    double delta = r * r - 2 * r + a * a;
    return (-(r * r + a * a + 2 * a * a / r) * x_t * y_t - 2 * a / r * (x_t * y_phi + x_phi * y_t) +
            (1 - 2 / r) * x_phi * y_phi) /
           delta;
}

/* Layers of gas that falls from the ISCO: position, temperature and g. The expected g follows from the gas's
 * four-velocity, which has the E and L of the ISCO. The radial components follow from u.u = -1 for the gas and p.p = 0
 * for the light. */
static void test_plunge(void **state)
{
    (void)state;
    const double a = 0.3, isco = kd_kerr_isco(kd_hole(a)), omega = omega_of(a, isco),
                 ut = 1 / sqrt(line(a, isco, omega));
    const double u_t = ut * (-(1 - 2 / isco) - 2 * a / isco * omega),
                 u_phi = ut * (-2 * a / isco + (isco * isco + a * a + 2 * a * a / isco) * omega);
    struct kd_scene scene = scene_of(a, 60, INFINITY, "r_0,g_0,temperature_0");
    scene.disk.model = KD_DISK_PARTICLES;
    scene.camera.field_m = 12;
    struct kd_frame frame = frame_of(&scene);
    const float *r = layer(&frame, "r_0"), *g = layer(&frame, "g_0"), *t = layer(&frame, "temperature_0");
    int inside = 0;
    for (int k = 0; k < PIXELS; k++) {
        if (!(r[k] < 0.97 * isco))
            continue;
        double energy, p_t = -1;
        const struct ks_path path = path_of(&scene, k, 1, ORDERS, &energy);
        double x = path.r[0], l = path.momentum[0];
        double u_r = -sqrt(fmax(-1 - product(a, x, u_t, u_phi, u_t, u_phi), 0)),
               p_r = sqrt(fmax(-product(a, x, p_t, l, p_t, l) - path.p_z[0] * path.p_z[0], 0));
        /* both radial parts are along one unit vector, so u_r p_r adds to the rest of the product */
        double rest = product(a, x, u_t, u_phi, p_t, l);
        double want = -1 / (rest + u_r * (path.falls[0] ? -p_r : p_r));
        inside++;
        assert_true(fabs(t[k] - 0.7 * scene.disk.peak_temperature_k) < 0.01);
        if (!(fabs(g[k] - want) < 1e-4 * want)) /* larger tolerance near the horizon, where g is a small difference */
            fail_msg("at r %g g is %.9g instead of %.9g", x, g[k], want);
    }
    assert_true(inside > 50);
    kd_frame_finish(&frame);
}

/* The numbers are the same bit for bit in many bands, and from a cached lens map. */
static void test_bands(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.9, 75, INFINITY, "rgb,phi,intensity_1,footprint,fate");
    struct kd_frame whole = frame_of(&scene), again = frame_of(&scene), parts;
    scene.camera.azimuth_deg = 131; /* another picture that uses the same map */
    struct kd_frame other = frame_of(&scene);
    scene.camera.azimuth_deg = 130;
    const struct kd_plan plan = plan_of(&scene, 7200);

    assert_true(plan.picture.bands > 2 && !whole.lens_reused && again.lens_reused && other.lens_reused);
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &parts, &error));
    for (size_t i = 0; i < whole.n_layers; i++) {
        size_t bytes = PIXELS * kd_layer_pixel_bytes(&whole.layers[i]);
        assert_memory_equal(whole.layers[i].data, again.layers[i].data, bytes);
        if (strcmp(whole.layers[i].name, "footprint")) /* rays at the edges of bands have neighbours on one side only */
            assert_memory_equal(whole.layers[i].data, parts.layers[i].data, bytes);
    }
    const float *a = layer(&whole, "phi"), *b = layer(&other, "phi");
    for (int k = 0; k < PIXELS; k++)
        assert_true(isnan(a[k]) ? isnan(b[k]) : fabs(remainder(b[k] - a[k] - M_PI / 180, 2 * M_PI)) < 1e-6);
    kd_frame_finish(&whole);
    kd_frame_finish(&again);
    kd_frame_finish(&parts);
    kd_frame_finish(&other);
}

/* Marks all rays in a plan's cached map as given up. */
static void give_up(const struct kd_plan *plan)
{
    const float undecided = KD_FATE_UNDECIDED;
    uint32_t word;
    memcpy(&word, &undecided, 4);
    for (int i = 0; i < KD_LENS_MAPS_KEPT; i++) {
        const struct kd_lens_map *map = &renderer->store.maps[i];
        if (strcmp(map->key, plan->lens.key))
            continue;
        uint32_t plane = kd_lens_plane(plan->lens.quantities, plan->lens.orders, KD_LENS_FATE);
        OK(kd_vk_fill(renderer->vk, "fill", map->bands.buffers[0], 4 * plane * plan->lens.rays, 4 * plan->lens.rays,
                      word, &error));
        OK(kd_vk_submit(renderer->vk, NULL, &error));
        return;
    }
    fail();
}

static void assert_same_picture(const char *json, const char *layers)
{
    struct kd_scene scene = scene_of(0.9, 75, INFINITY, "rgb");
    OK(kd_scene_patch(&scene, json, strlen(json), &error));
    struct kd_frame alone = frame_of(&scene);
    OK(kd_scene_set(&scene, "image.layers", layers, &error));
    for (int given_up = 0; given_up < 2; given_up++) {
        const struct kd_plan plan = plan_of(&scene, 0);
        if (given_up && (!kd_plan_holds(&plan.lens, KD_LENS_SKY) || scene.sky.model))
            break;
        if (given_up)
            give_up(&plan);
        struct kd_frame beside = frame_of(&scene);
        assert_true(beside.lens_reused || !given_up);
        for (int i = 0; i < 2; i++)
            if (memcmp(alone.layers[i].data, beside.layers[i].data, PIXELS * kd_layer_pixel_bytes(&alone.layers[i])))
                fail_msg("%s: another %s beside %s%s", json, alone.layers[i].name, layers,
                         given_up ? ", of rays that are given up" : "");
        kd_frame_finish(&beside);
    }
    kd_frame_finish(&alone);
    kd_store_empty(&renderer->store); /* removes the modified maps */
}

/* The requested layers do not change the picture, bit for bit, even if they need more of the lens map. This also holds
 * for rays that were given up, in a scene without sky. The layer `delay` is not tested, because it changes the steps of
 * its rays. */
static void test_picture_beside(void **state)
{
    (void)state;
    static const char *const scenes[] = {
        "{}",
        "{\"accuracy\": {\"orders\": 1}, \"image\": {\"critical_factor\": 4}}",
        "{\"image\": {\"samples\": 2}, \"sky\": {\"model\": \"grid\"}}",
        "{\"disk\": {\"emission_opacity\": 3, \"gas\": {\"amplitude\": 1}}, \"camera\": {\"r\": 40}}",
        "{\"disk\": {\"opacity\": 0.5}, \"spots\": [{\"brightness\": 2}]}",
    };
    for (size_t k = 0; k < sizeof scenes / sizeof *scenes; k++) {
        assert_same_picture(scenes[k], "rgb,fate");
        assert_same_picture(scenes[k], "rgb,phi,sky_theta,footprint,intensity,optical_depth,order");
    }
}

/* In a picture of a single layer, each pixel has the colour that the colour map gives its number, in 8 and in 16 bits.
 * No pixel is black. */
static void test_false_colour(void **state)
{
    (void)state;
    for (int depth = 8; depth <= 16; depth += 8) {
        struct kd_scene scene = scene_of(0.9, 75, INFINITY, "r");
        struct kd_map_table table;
        const struct kd_map_scale scale = { 2, 12, false };
        scene.image.bit_depth = depth;
        scene.image.layer_min = scale.low;
        scene.image.layer_max = scale.high;
        struct kd_frame frame = frame_of(&scene);
        const float *r = layer(&frame, "r");
        int coloured = 0;
        kd_colour_map_fill(&table, KD_MAP_SEQUENTIAL);
        for (int k = 0; k < PIXELS; k++) {
            struct kd_map_colour c = isnan(r[k]) ? (struct kd_map_colour) { 0, 0, 0 }
                                                 : kd_map_table_at(&table, kd_map_scale_place(&scale, r[k]));
            const double want[3] = { c.r, c.g, c.b };
            for (int i = 0; i < 3; i++) {
                long got = depth == 16 ? ((uint16_t *)kd_frame_pixels(&frame))[3 * k + i]
                                       : ((uint8_t *)kd_frame_pixels(&frame))[3 * k + i];
                assert_true(got == lround(want[i] * (depth == 16 ? 65535 : 255)));
            }
            coloured += !isnan(r[k]);
        }
        assert_true(coloured > PIXELS / 4);
        kd_frame_finish(&frame);
    }
}

/* One end of the scale may be set so that all numbers are beyond it. All pixels then have the colour of that end. */
static void test_ends_beyond(void **state)
{
    (void)state;
    struct kd_map_table table;
    kd_colour_map_fill(&table, KD_MAP_SEQUENTIAL);
    for (int above = 0; above < 2; above++) {
        struct kd_scene scene = scene_of(0.9, 75, INFINITY, "r");
        *(above ? &scene.image.layer_max : &scene.image.layer_min) = above ? -1e9 : 1e9;
        struct kd_frame frame = frame_of(&scene);
        const struct kd_map_colour c = kd_map_table_at(&table, above);
        const float *r = layer(&frame, "r");
        for (int k = 0; k < PIXELS; k++)
            if (!isnan(r[k]))
                assert_int_equal(((uint8_t *)kd_frame_pixels(&frame))[3 * k + 1], lround(255 * c.g));
        kd_frame_finish(&frame);
    }
}

/* The numbers of a layer of the frame, which must exist. */
static const float *numbers_of(const struct kd_frame *frame, const char *name)
{
    const struct kd_layer *layer = kd_frame_layer(frame, name);
    assert_non_null(layer);
    return layer->data;
}

/* Neighbouring rays that 32 bits cannot distinguish have no footprint, instead of one of size 0. All other rays have a
 * footprint. */
static void test_tiny_fields(void **state)
{
    (void)state;
    static const struct {
        double fov_deg, yaw_deg;
        const char *layer;
        bool there;
    } views[] = {
        { 1e-6, 0.12, "footprint", false },
        { 1e-6, 60, "sky_footprint", false },
        { 0.1, 0.12, "footprint", true },
        { 0.1, 60, "sky_footprint", true },
    };
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        struct kd_scene scene = scene_of(0.7, 60, 4000, views[v].layer);
        scene.camera.fov_deg = views[v].fov_deg;
        scene.camera.yaw_deg = views[v].yaw_deg;
        struct kd_frame frame = frame_of(&scene);
        const float *is = numbers_of(&frame, views[v].layer);
        int there = 0; /* counts pixels of the disk, which does not fill the picture */
        for (int i = 0; i < PIXELS; i++) {
            there += is[i] > 0;
            if (views[v].there ? is[i] <= 0 : !isnan(is[i]))
                fail_msg("%s over %g degrees: %g in pixel %d", views[v].layer, views[v].fov_deg, is[i], i);
        }
        assert_true(!views[v].there || there > PIXELS / 2);
        kd_frame_finish(&frame);
    }
}

/* At one frequency the brightness is B_nu(g T) f^-4. T follows from the flux at the radius, times the hardening factor
 * f. Tested from the Rayleigh-Jeans limit to the highest frequency that is accepted. */
static void test_one_frequency(void **state)
{
    (void)state;
    static const double quanta[] = { 1e-7, 0.2, 3, 20, KD_DISK_QUANTA * (1 - 1e-9) };
    static const double hardenings[] = { 1, 1.7 };
    const double largest = kd_disk_flux_page_thorne(kd_hole(0.9), kd_disk_peak_page_thorne(kd_hole(0.9)));
    for (size_t q = 0; q < 5; q++)
        for (size_t h = 0; h < 2; h++) {
            struct kd_scene scene = scene_of(0.9, 75, INFINITY, "specific_intensity,brightness_temperature,r_0,g_0");
            const double f = hardenings[h], peak = 1e7, nu = quanta[q] * K * peak * f / H; /* Hz */
            scene.disk.peak_temperature_k = peak;
            scene.disk.band = KD_BAND_FREQUENCY;
            scene.disk.hardening = f;
            scene.disk.frequency_ghz = nu * 1e-9;
            scene.accuracy.orders = 1;
            OK(kd_scene_validate(&scene, &error));
            struct kd_frame frame = frame_of(&scene);
            const float *light = layer(&frame, "specific_intensity"), *t = layer(&frame, "brightness_temperature"),
                        *r = layer(&frame, "r_0"), *g = layer(&frame, "g_0");
            int n = 0;
            for (int k = 0; k < PIXELS; k++) {
                if (isnan(r[k]) || r[k] < 1.01 * kd_kerr_isco(kd_hole(0.9)))
                    continue;
                const double kelvin =
                    f * peak * pow(kd_disk_flux_page_thorne(kd_hole(0.9), r[k]) / largest, 0.25) * g[k];
                const double x = H * nu / (K * kelvin), i = 2 * H * nu * (nu / C) * (nu / C) / expm1(x) / pow(f, 4);
                const double bound = 2e-5 + 2e-4 * x; /* tolerance: the table of T has an error of 2e-4 */
                /* skipped, because the value is near the smallest or largest float */
                if (i * 1e23 < 1e-30 || i * C * C / (2 * K * nu * nu) < 1e-30)
                    continue;
                if (!(fabs(light[k] / (i * 1e23) - 1) < bound) ||
                    !(fabs(t[k] / (i * C * C / (2 * K * nu * nu)) - 1) < bound))
                    fail_msg("x %g, f %g, r %g, g %g: %g Jy/sr, not %g; %g K", quanta[q], f, r[k], g[k], light[k],
                             i * 1e23, t[k]);
                n++;
            }
            assert_true(n > (quanta[q] > 20 ? 0 : PIXELS / 8));
            kd_frame_finish(&frame);
        }
}

/* Light that is too bright for 32 bits gives an error that says so. Other light is finite, and scales with the
 * brightness of the matter. */
static void test_too_bright(void **state)
{
    (void)state;
    static const char *const layers[] = { "brightness_temperature", "specific_intensity", "jy_per_pixel", "intensity" };
    static const double emissions[] = { 3e-18, 3e-6, 1e30 };
    for (size_t k = 0; k < 4; k++) {
        double first = 0;
        for (size_t e = 0; e < 3; e++) {
            struct kd_scene scene;
            struct kd_frame frame = { 0 };
            struct kd_error why = { 0 };
            OK(kd_scene_preset(&scene, "gold-1", &error));
            scene.image.width = scene.image.height = 12;
            scene.volume.gold_emission = emissions[e];
            OK(kd_scene_set(&scene, "image.layers", layers[k], &error));
            const struct kd_plan plan = plan_of(&scene, 0);
            const enum kd_status status = kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &why);
            const bool too_bright =
                e == 2 && k < 2; /* light overflows in the first two layers only; in the others it is clipped at 1e30 */
            if (too_bright != (status == KD_EINVAL) || (status && !too_bright))
                fail_msg("%s of %g: status %d", layers[k], emissions[e], (int)status);
            if (too_bright) {
                assert_string_equal(why.pointer, "/image/layers");
                assert_non_null(strstr(why.message, layers[k]));
                continue;
            }
            double sum = 0;
            for (int i = 0; i < 144; i++)
                sum += numbers_of(&frame, layers[k])[i];
            first = e ? first : sum / emissions[0];
            if (!isfinite(sum) || (e < 2 && fabs(sum / emissions[e] / first - 1) > 1e-5))
                fail_msg("%s of %g: %g", layers[k], emissions[e], sum);
            kd_frame_finish(&frame);
        }
    }
}

static void test_each_is_a_picture(void **state)
{
    (void)state;
    for (int turns = 0; turns < 2; turns++)
        for (int kind = 1; kind < KD_LAYER_COUNT; kind++) {
            /* These layers exist only for matter at a radio frequency. One spin is enough for them: each of their
             * pictures takes seconds. */
            const bool radio = kind == KD_LAYER_brightness_temperature || kind == KD_LAYER_specific_intensity ||
                               kind == KD_LAYER_jy_per_pixel || kind == KD_LAYER_stokes_v;
            if (radio && !turns)
                continue;
            uint8_t *with = NULL;
            for (int legend = 1; legend >= 0; legend--) {
                struct kd_scene scene = scene_of(turns ? 0.9 : 0, 75, INFINITY, kd_layer_kinds[kind].name);
                scene.polarization.model = turns ? KD_POLARIZATION_SCATTERING : KD_POLARIZATION_SYNCHROTRON;
                if (radio) {
                    scene.disk.model = KD_DISK_NONE;
                    scene.volume.model = KD_VOLUME_RIAF;
                    scene.polarization.model =
                        kind == KD_LAYER_stokes_v ? KD_POLARIZATION_TRANSFER : KD_POLARIZATION_NONE;
                }
                scene.image.width = 200;
                scene.image.height = 120;
                scene.image.legend = legend;
                struct kd_frame frame = frame_of(&scene);
                size_t bytes = 3u * 200 * 120, lit = 0, differ = 0;
                const uint8_t *pixels = kd_frame_pixels(&frame);
                for (size_t i = 0; i < bytes; i++) {
                    lit += pixels[i] > 0;
                    differ += with && with[i] != pixels[i];
                }
                assert_true(lit > bytes / 50);
                if (with && !(differ > 500 && differ < bytes / 2))
                    fail_msg("%s: a legend changes %zu bytes", kd_layer_kinds[kind].name, differ);
                if (legend && (with = malloc(bytes)))
                    memcpy(with, pixels, bytes);
                kd_frame_finish(&frame);
            }
            free(with);
        }
}

int main(int argc, char **argv)
{
    if (argc > 1)
        cmocka_set_test_filter(argv[1]);
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_crossings),     cmocka_unit_test(test_ends),
        cmocka_unit_test(test_light),         cmocka_unit_test(test_temperature),
        cmocka_unit_test(test_plunge),        cmocka_unit_test(test_bands),
        cmocka_unit_test(test_false_colour),  cmocka_unit_test(test_picture_beside),
        cmocka_unit_test(test_ends_beyond),   cmocka_unit_test(test_tiny_fields),
        cmocka_unit_test(test_too_bright),    cmocka_unit_test(test_each_is_a_picture),
        cmocka_unit_test(test_one_frequency),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

/* Tests of matter on a grid. The light of each ray is compared with the integral of emission and absorption along the
 * Kerr-Schild oracle's path. The integral uses the test's own interpolation, velocities and fields from the metric's
 * components, and emissivities in CGS. Other tests: numbers beyond single precision. */
#include "image/npy.h"
#include "image/zip.h"
#include "render/emit/matter_grid.h"
#include "scene/asset.h"

#include "render_support.h"

#include "cgs.h"
#include "kerr_schild.h"

#include <math.h>
#include <pthread.h>

enum { SIDE = 4, PIXELS = SIDE * SIDE, MOST_ANGLES = 64 * 48 };
static const char *const names[] = { "density",   "temperature", "u_con_r",     "u_con_theta",
                                     "u_cov_phi", "b_con_r",     "b_con_theta", "b_cov_phi" };
enum { ARRAYS = 8 };

/* A grid as in its file. */
struct numbers {
    uint32_t rows, columns, layers;
    double a, q, r[2];
    bool ingoing, packed;
    double phi;
    /* theta = y + bend sin 2y, with y evenly spaced from pole to pole; bend[0]: for the first row of radii; bend[1]:
     * for the last row; 0: even theta */
    double bend[2];
    uint32_t frames; /* 0: the file has no times */
    double time[2];
    bool late;          /* true: the frames are slices of constant Kerr-Schild time */
    double *of[ARRAYS]; /* allocated once, by make_room */
};

static struct keeper {
    char hash[KD_ASSET_NAME];
    struct kd_buffer file;
    bool missing;
    unsigned taken;
    pthread_t taker; /* the thread that fetched the file last */
} keeper;

static bool take(void *user, const char *hash, struct kd_asset_bytes *out)
{
    struct keeper *k = user;
    *out = (struct kd_asset_bytes) { k->file.data, k->file.size, k };
    k->taken++;
    k->taker = pthread_self();
    return !k->missing && !strcmp(hash, k->hash);
}
static void give_back(void *user, struct kd_asset_bytes *bytes) { assert_ptr_equal(bytes->held, user); }
static const struct kd_assets assets = { NULL, take, give_back, "those of this test", &keeper };

static void add(struct kd_zip *zip, const char *name, const struct kd_npy *array, const void *data)
{
    struct kd_buffer bytes = { 0 };
    char file[40];
    size_t n = kd_npy_item_size(array);
    for (size_t i = 0; i < array->n_dimensions; i++)
        n *= array->shape[i];
    snprintf(file, sizeof file, "%s.npy", name);
    OK(kd_npy_write_header(array, &bytes));
    OK(kd_buffer_append(&bytes, data, n));
    OK(kd_zip_add(zip, file, bytes.data, bytes.size));
    kd_buffer_finish(&bytes);
}

static void add_line(struct kd_zip *zip, const char *name, const double *at, size_t n)
{
    add(zip, name,
        &(struct kd_npy) { .fields = { { "", KD_NPY_F8, 0 } }, .n_fields = 1, .shape = { n }, .n_dimensions = 1 }, at);
}

/* Polar angle theta of a node. */
static double theta_of(const struct numbers *g, double row, double column)
{
    const double y = (column + 0.5) * M_PI / g->columns,
                 bend = g->bend[0] + (g->bend[1] - g->bend[0]) * row / (g->rows - 1.0);
    return y + bend * sin(2 * y);
}

/* Writes theta: one line if all rows have the same angles, otherwise a line for each row. */
static void add_angles(struct kd_zip *zip, const struct numbers *g)
{
    double theta[MOST_ANGLES];
    const bool alone = g->bend[0] == g->bend[1];
    for (uint32_t i = 0; i < g->rows * g->columns; i++)
        theta[i] = theta_of(g, i / g->columns, i % g->columns);
    add(zip, "theta",
        &(struct kd_npy) { .fields = { { "", KD_NPY_F8, 0 } },
                           .n_fields = 1,
                           .shape = { alone ? g->columns : g->rows, g->columns },
                           .n_dimensions = alone ? 1 : 2 },
        theta);
}

/* A counter; a thread waits for its value. */
struct event {
    pthread_mutex_t lock;
    pthread_cond_t changed;
    unsigned n;
};

/* Replaces the previous grid's file; the new file has another hash. */
static void keep(const struct numbers *g)
{
    static int n;
    struct kd_zip *zip;
    char header[720];
    double line[64];
    kd_buffer_finish(&keeper.file);
    snprintf(keeper.hash, sizeof keeper.hash, "%064x", ++n);
    OK(kd_zip_create(&keeper.file, true, &zip));
    snprintf(header, sizeof header,
             "{\"format\":\"kerrd-grid\",\"version\":1,\"packed\":%s,\"spin\":%.17g,\"charge\":%.17g,\"azimuth\":\"%"
             "s\",\"time\":\"%s\",\"units\":{\"time\":\"M\","
             "\"r\":\"M\","
             "\"theta\":\"rad\",\"density\":\"cm^-3\",\"temperature\":\"K\",\"u_con_r\":\"c\","
             "\"u_con_theta\":\"c/M\",\"u_cov_phi\":\"c "
             "M\",\"b_con_r\":\"G\",\"b_con_theta\":\"G/M\",\"b_cov_phi\":\"G M\"}}",
             g->packed ? "true" : "false", g->a, g->q, g->ingoing ? "kerr-schild" : "boyer-lindquist",
             g->late ? "kerr-schild" : "boyer-lindquist");
    add(zip, "header",
        &(struct kd_npy) {
            .fields = { { "", KD_NPY_U1, 0 } }, .n_fields = 1, .shape = { strlen(header) }, .n_dimensions = 1 },
        header);
    for (uint32_t i = 0; i < g->rows; i++)
        line[i] = g->r[0] * pow(g->r[1] / g->r[0], i / (g->rows - 1.0));
    add_line(zip, "r", line, g->rows);
    add_angles(zip, g);
    for (uint32_t i = 0; i < g->layers; i++)
        line[i] = g->phi + i * 2 * M_PI / g->layers;
    if (g->layers > 1)
        add_line(zip, "phi", line, g->layers);
    for (uint32_t i = 0; i < g->frames; i++)
        line[i] = g->time[0] + (g->time[1] - g->time[0]) * i / (g->frames - 1.0);
    if (g->frames)
        add_line(zip, "time", line, g->frames);
    for (int i = 0; i < ARRAYS; i++) {
        struct kd_npy shape = { .fields = { { "", KD_NPY_F8, 0 } }, .n_fields = 1 };
        if (g->frames)
            shape.shape[shape.n_dimensions++] = g->frames;
        shape.shape[shape.n_dimensions++] = g->rows;
        shape.shape[shape.n_dimensions++] = g->columns;
        if (g->layers > 1)
            shape.shape[shape.n_dimensions++] = g->layers;
        add(zip, names[i], &shape, g->of[i]);
    }
    OK(kd_zip_close(zip));
    kd_zip_destroy(zip);
}

static struct kd_scene scene_of(double spin, const char *json)
{
    struct kd_scene scene;
    OK(kd_scene_preset(&scene, "torus", &error));
    scene.spacetime.spin = spin;
    scene.volume.model = KD_VOLUME_GRID;
    scene.volume.inner = INFINITY;
    snprintf(scene.volume.grid, sizeof scene.volume.grid, "%s", keeper.hash);
    scene.image.width = scene.image.height = SIDE;
    scene.image.critical_factor = 1;
    scene.camera.field_m = 24;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "image.layers", "rgb,brightness_temperature", &error));
    return scene;
}

static const float *kelvin_of(const struct kd_frame *frame)
{
    return kd_frame_layer(frame, "brightness_temperature")->data;
}

static double random_of(uint32_t *seed) { return (double)((*seed = *seed * 1664525u + 1013904223u) >> 8) / 16777216; }

static uint32_t numbers_of(const struct numbers *g)
{
    return (g->frames ? g->frames : 1) * g->rows * g->columns * g->layers;
}

static void make_room(struct numbers *g)
{
    for (int k = 0; k < ARRAYS && !g->of[k]; k++)
        assert_non_null(g->of[k] = calloc(numbers_of(g), sizeof(double)));
}

/* Each node has different values, which vary about a flow that falls in and rotates. */
static void fill(struct numbers *g, uint32_t seed, double rough)
{
    make_room(g);
    for (uint32_t i = 0; i < numbers_of(g); i++) {
        const uint32_t row = i / g->layers / g->columns % g->rows;
        const double r = g->r[0] * pow(g->r[1] / g->r[0], row / (g->rows - 1.0)),
                     theta = theta_of(g, row, i / g->layers % g->columns), s = sin(theta);
        double x[ARRAYS];
        for (int k = 0; k < ARRAYS; k++)
            x[k] = rough * (2 * random_of(&seed) - 1);
        g->of[0][i] = 2e6 / r * exp(2 * x[0] - 2 * cos(theta) * cos(theta));
        g->of[1][i] = 2e11 / r * exp(x[1]);
        g->of[2][i] = (-0.4 + 0.3 * x[2]) / sqrt(r);
        g->of[3][i] = 0.3 * x[3] / pow(r, 1.5);
        g->of[4][i] = (0.7 + 0.3 * x[4]) * sqrt(r) * s * s;
        g->of[5][i] = 30 * (x[5] + cos(theta)) / r;
        g->of[6][i] = -30 * (x[6] + s) / (r * r);
        g->of[7][i] = 40 * (1 + x[7]) * s;
    }
}

/* The fractional column index at theta in a row, by linear interpolation between the nodes' angles. */
static double column_of(const struct numbers *g, double row, double theta)
{
    double column = 0;
    while (column < g->columns - 2.0 && theta_of(g, row, column + 1) < theta)
        column++;
    const double below = theta_of(g, row, column);
    return fmin(fmax(column + (theta - below) / (theta_of(g, row, column + 1) - below), 0), g->columns - 1.0);
}

/* Interpolation over the eight nodes about a place, in a frame. Components are converted to unit lengths of M: the
 * theta component is multiplied by r, the phi component is divided by r sin^2 theta. */
static double between(const struct numbers *g, uint32_t frame, int which, double r, double theta, double phi)
{
    const double x = log(r / g->r[0]) / log(g->r[1] / g->r[0]) * (g->rows - 1), under = fmin(floor(x), g->rows - 2.0),
                 y = column_of(g, under, theta) * (under + 1 - x) + column_of(g, under + 1, theta) * (x - under),
                 z = (phi - g->phi) / (2 * M_PI) * g->layers;
    const double power = which == 3 || which == 6 ? 1 : which == 4 || which == 7 ? -1 : 0;
    double sum = 0;
    const bool turns = which == 4 || which == 7;
    for (int corner = 0; corner < 8; corner++) {
        const double i = fmin(floor(x), g->rows - 2.0) + corner % 2,
                     j = fmin(floor(y), g->columns - 2.0) + corner / 2 % 2, k = floor(z) + corner / 4;
        const double part = (1 - fabs(x - i)) * (1 - fabs(y - j)) * (g->layers > 1 ? 1 - fabs(z - k) : 0.5),
                     layer = k - floor(k / g->layers) * g->layers;
        const double value = g->of[which][((frame * g->rows + (uint32_t)i) * g->columns + (uint32_t)j) * g->layers +
                                          (uint32_t)layer],
                     here = g->r[0] * pow(g->r[1] / g->r[0], i / (g->rows - 1.0));
        sum +=
            part * (which < 2 ? log(value) : value * pow(here, power) / (turns ? pow(sin(theta_of(g, i, j)), 2) : 1));
    }
    return which < 2 ? exp(sum) : sum * pow(r, -power) * (turns ? pow(sin(theta), 2) : 1);
}

/* Kerr-Schild time minus Boyer-Lindquist time, by partial fractions of (2r - q^2)/Delta. */
static double later(const struct numbers *g, double r)
{
    const double q2 = g->q * g->q, root = sqrt(1 - g->a * g->a - q2), out = 1 + root, in = 1 - root;
    return ((2 * out - q2) * log((r - out) / 2) - (2 * in - q2) * log((r - in) / 2)) / (2 * root);
}

/* A ring whose density has one lump. The lump moves with the angular velocity of the orbit at 8 M. */
static void ring(const struct numbers *g, double r, double theta, double phi, double time, double at[ARRAYS])
{
    const double turn = phi - time / (pow(8, 1.5) + g->a), x = log(r / 8) / 0.4, u = cos(theta) / 0.4, s = sin(theta);
    at[0] = 3e6 * exp(-0.5 * (x * x + u * u)) * (1 + 0.7 * s * cos(turn));
    at[1] = 3e11 / r * (1 + 0.3 * s * sin(turn));
    at[2] = -0.1 / sqrt(r);
    at[3] = 0.01 * u / r * s;
    at[4] = 0.9 * sqrt(r) * s * s;
    at[5] = 3 / r;
    at[6] = -3 * s / (r * r);
    at[7] = 30 * s * s;
}

static void fill_ring(struct numbers *g)
{
    double at[ARRAYS];
    make_room(g);
    for (uint32_t i = 0; i < numbers_of(g); i++) {
        const uint32_t row = i / g->layers / g->columns % g->rows, layer = i % g->layers,
                       frame = i / g->layers / g->columns / g->rows;
        const double r = g->r[0] * pow(g->r[1] / g->r[0], row / (g->rows - 1.0));
        double time = g->time[0] + (g->time[1] - g->time[0]) * frame / (g->frames - 1.0),
               phi = g->phi + layer * 2 * M_PI / g->layers;
        const double root = sqrt(1 - g->a * g->a - g->q * g->q);
        time -= g->late ? later(g, fmax(r, 1.0001 * (1 + root))) : 0;
        phi -= g->ingoing ? g->a / (2 * root) * log(fmax(r - 1 - root, 1e-4) / (r - 1 + root)) : 0;
        ring(g, r, theta_of(g, row, i / g->layers % g->columns), phi, time, at);
        for (int k = 0; k < ARRAYS; k++)
            g->of[k][i] = at[k];
    }
}

struct view {
    const struct kd_scene *scene;
    const struct numbers *g;
    bool closed; /* compared with the formula of the ring, not with its values at the nodes */
};

/* The time on the grid's clock, as a fractional index of a frame. This is the scene's time or, with slow light, the
 * time of emission. */
static double frame_of(const struct view *view, const struct ks_photon *p, double r)
{
    const struct numbers *g = view->g;
    double time = view->scene->top.time;
    if (!g->frames)
        return 0;
    if (view->scene->volume.slow_light)
        time += (g->late ? later(g, r) : 0) - p->delay;
    return fmin(fmax((time - g->time[0]) / (g->time[1] - g->time[0]), 0), 1) * (g->frames - 1);
}

static void numbers_at(const struct view *view, const struct ks_photon *p, double r, double theta, double phi,
                       double at[ARRAYS])
{
    const double frame = frame_of(view, p, r), below = floor(frame), part = frame - below;
    for (int i = 0; i < ARRAYS; i++) {
        const double one = between(view->g, (uint32_t)below, i, r, theta, phi),
                     two = part > 0 ? between(view->g, (uint32_t)below + 1, i, r, theta, phi) : one;
        at[i] = i < 2 ? pow(one, 1 - part) * pow(two, part) : (1 - part) * one + part * two;
    }
}

/* The product x.y in a metric whose only off-diagonal component is g_tphi. */
static double product(const double g[5], const double x[4], const double y[4])
{
    return g[0] * x[0] * y[0] + g[1] * x[1] * y[1] + g[2] * x[2] * y[2] + g[3] * x[3] * y[3] +
           g[4] * (x[0] * y[3] + x[3] * y[0]);
}

/* u^t is the root of u.u = -1, u^phi follows from u_phi, and b^t from b.u = 0. */
static void medium(void *user, const struct ks_photon *p, double r, double u, double out[2])
{
    const struct view *view = user;
    const struct numbers *n = view->g;
    const double a = p->a, q2 = n->q * n->q, mass = 2 * r - q2, s2 = 1 - u * u, sigma = r * r + a * a * u * u,
                 delta = r * r - mass + a * a, root = sqrt(1 - a * a - q2),
                 cm = GM_SUN * view->scene->spacetime.mass_msun / (C * C);
    const double g[5] = { -(1 - mass / sigma), sigma / delta, sigma, (r * r + a * a + mass * a * a * s2 / sigma) * s2,
                          -mass * a * s2 / sigma };
    double theta = acos(u), phi = p->phi + view->scene->camera.azimuth_deg * M_PI / 180, at[ARRAYS];
    if (view->closed)
        ring(n, r, theta, phi, view->scene->top.time - (view->scene->volume.slow_light ? p->delay : 0), at);
    else
        numbers_at(view, p, r, theta, phi + (n->ingoing ? a / (2 * root) * log((r - 1 - root) / (r - 1 + root)) : 0),
                   at);
    /* With u^phi = (u_phi - g_tphi u^t)/g_phiphi the norm is a quadratic in u^t without a linear term. */
    const double rest = 1 + g[1] * at[2] * at[2] + g[2] * at[3] * at[3] + at[4] * at[4] / g[3],
                 lapse2 = g[4] * g[4] / g[3] - g[0], time = sqrt(rest / lapse2);
    const double flow[4] = { time, at[2], at[3], (at[4] - g[4] * time) / g[3] };
    double field[4] = { 0, at[5], at[6], at[7] / g[3] }, axis[4] = { 1, 0, 0, -g[4] / g[3] };
    assert_true(fabs(product(g, flow, flow) + 1) < 1e-9);
    const double more =
        -product(g, field, flow) / product(g, axis, flow); /* the normal's covariant phi component is 0 */
    for (int i = 0; i < 4; i++)
        field[i] += more * axis[i];
    assert_true(fabs(product(g, field, flow)) < 1e-6);
    const double b = sqrt(product(g, field, field)) * sqrt(view->scene->volume.grid_scale),
                 k[4] = { -p->energy, p->p_r, p->p_theta, p->momentum };
    double seen = 0, along = 0;
    for (int i = 0; i < 4; i++) {
        seen -= flow[i] * k[i];
        along += field[i] * k[i] / sqrt(product(g, field, field));
    }
    const double density = at[0] * view->scene->volume.grid_scale, heat = K * at[1] / (ME * C * C),
                 sine = sqrt(1 - along * along / (seen * seen));
    const double turn = sqrt(E2) * b / (2 * M_PI * ME * C), nu = view->scene->volume.frequency_ghz * 1e9 * seen,
                 x = nu / (2.0 / 9 * turn * heat * heat * sine);
    const double shape = sqrt(x) + pow(2, 11.0 / 12) * pow(x, 1.0 / 6),
                 j = density * E2 * turn / C * sqrt(2) * M_PI / 27 * sine * shape * shape * exp(-cbrt(x));
    out[0] = cm / (seen * seen) * j;
    out[1] = cm * seen * j * expm1(H * nu / (heat * ME * C * C)) * C * C / (2 * H * nu * nu * nu);
}

/* Brightness temperature of pixel i of a square picture. */
static double kelvin_by_oracle(struct view *view, int side, int i)
{
    const struct kd_scene *scene = view->scene;
    const struct numbers *g = view->g;
    const double nu = scene->volume.frequency_ghz * 1e9, step = scene->camera.field_m / side,
                 inner = fmax(g->r[0], isinf(scene->volume.inner) ? 0 : scene->volume.inner);
    const struct ks_photon photon =
        ks_from_infinity_charged(g->a, g->q, cos(scene->camera.inclination_deg * M_PI / 180),
                                 step * (i % side - 0.5 * (side - 1)), -step * (i / side - 0.5 * (side - 1)));
    return ks_along(photon, inner, fmin(g->r[1], scene->volume.outer), false, medium, view).light * C * C /
           (2 * K * nu * nu);
}

static void compare(const struct numbers *g, const char *json, double allowed)
{
    keep(g);
    struct kd_scene scene = scene_of(g->a, json);
    scene.spacetime.charge = g->q;
    struct kd_frame frame = rendered(&scene);
    struct view view = { &scene, g, false };
    double worst = 0, most = 0;
    for (int i = 0; i < PIXELS; i++)
        most = fmax(most, kelvin_of(&frame)[i]);
    assert_true(most > 1e8);
    for (int i = 0; i < PIXELS; i++) {
        const double want = kelvin_by_oracle(&view, SIDE, i);
        const double off = fabs(kelvin_of(&frame)[i] - want) / fmax(want, 1e-3 * most);
        worst = fmax(worst, off);
        if (!(off <= allowed))
            fail_msg("%s, pixel %d: %.7g K, the oracle has %.7g, off by %.2g, allowed %.2g", json, i,
                     (double)kelvin_of(&frame)[i], want, off, allowed);
    }
    printf("%u x %u x %u: worst %.2g, brightest %.3g K\n", g->rows, g->columns, g->layers, worst, most);
    kd_frame_finish(&frame);
}

#define HIGH "\"accuracy\":{\"profile\":\"high\"}"

/* The errors come from single precision and from the oracle's own steps, which do not end at the edges of cells. */
static void test_rays(void **state)
{
    (void)state;
    static struct numbers
        flat = { .rows = 16, .columns = 12, .layers = 1, .a = 0.9, .r = { 2, 20 } },
        round = { .rows = 12, .columns = 8, .layers = 6, .a = -0.6, .r = { 2.5, 18 }, .phi = -0.3 },
        ingoing = { .rows = 12, .columns = 8, .layers = 5, .a = 0.8, .r = { 2, 15 }, .phi = 0.7, .ingoing = true };
    static struct numbers
        bent = { .rows = 16, .columns = 12, .layers = 1, .a = 0.9, .r = { 2, 20 }, .bend = { 0.3, 0.3 } },
        turning = { .rows = 12, .columns = 10, .layers = 6, .a = 0.5, .r = { 2.5, 18 }, .bend = { 0.4, -0.2 } };
    static struct numbers charged = { .rows = 16, .columns = 12, .layers = 1, .a = 0.3, .q = 0.9, .r = { 2, 15 } },
                          whirling = { .rows = 12,
                                       .columns = 8,
                                       .layers = 5,
                                       .a = 0.6,
                                       .q = 0.7,
                                       .r = { 2, 15 },
                                       .phi = 0.7,
                                       .ingoing = true };
    fill(&charged, 6, 0.3);
    compare(&charged, "{" HIGH ",\"volume\":{\"grid_scale\":3}}", 2e-3);
    fill(&whirling, 8, 0.5);
    compare(&whirling, "{" HIGH ",\"camera\":{\"inclination_deg\":50,\"azimuth_deg\":-70}}", 2e-3);
    fill(&flat, 1, 0.3);
    fill(&bent, 4, 0.3);
    fill(&turning, 5, 0.3);
    compare(&bent, "{" HIGH ",\"volume\":{\"grid_scale\":3}}", 2e-3);
    compare(&turning, "{" HIGH ",\"camera\":{\"inclination_deg\":75,\"azimuth_deg\":20}}", 2e-3);
    fill(&round, 2, 0.5);
    fill(&ingoing, 3, 0.5);
    bent.packed = turning.packed = true;
    compare(&bent, "{" HIGH ",\"volume\":{\"grid_scale\":3}}", 2e-3);
    compare(&turning, "{" HIGH ",\"camera\":{\"inclination_deg\":75,\"azimuth_deg\":20}}", 2e-3);
    compare(&flat, "{" HIGH ",\"volume\":{\"grid_scale\":3}}", 2e-3);
    compare(&round,
            "{" HIGH ",\"camera\":{\"inclination_deg\":105,\"azimuth_deg\":40},\"volume\":{\"inner\":3,\"outer\":15}}",
            2e-3);
    compare(&ingoing, "{" HIGH ",\"camera\":{\"inclination_deg\":50,\"azimuth_deg\":-70}}", 2e-3);
}

/* Rays through series of unrelated frames. Tested with fast and slow light, with the grid whole and packed, and on
 * slices of Kerr-Schild or Boyer-Lindquist time. Some light is older than the first frame or younger than the last. */
static void test_series(void **state)
{
    (void)state;
    static struct numbers
        flat = { .rows = 12, .columns = 8, .layers = 1, .a = 0.9, .r = { 2, 20 }, .frames = 4, .time = { -25, 20 } },
        round = { .rows = 12,
                  .columns = 8,
                  .layers = 5,
                  .a = 0.8,
                  .r = { 2, 15 },
                  .phi = 0.7,
                  .ingoing = true,
                  .late = true,
                  .frames = 3,
                  .time = { 90, 130 },
                  .bend = { 0.3, 0.1 } },
        charged = { .rows = 12,
                    .columns = 8,
                    .layers = 1,
                    .a = 0.3,
                    .q = 0.9,
                    .r = { 1.8, 15 },
                    .late = true,
                    .frames = 2,
                    .time = { -60, 30 } };
    fill(&flat, 21, 0.5);
    fill(&round, 22, 0.5);
    fill(&charged, 23, 0.5);
    compare(&flat, "{" HIGH ",\"time\":3}", 2e-3);
    compare(&flat, "{" HIGH ",\"volume\":{\"slow_light\":true}}", 2e-3);
    compare(&round, "{" HIGH ",\"time\":105}", 2e-3);
    compare(&round, "{" HIGH ",\"time\":112,\"camera\":{\"azimuth_deg\":30},\"volume\":{\"slow_light\":true}}", 2e-3);
    compare(&charged, "{" HIGH ",\"volume\":{\"slow_light\":true}}", 2e-3);
    round.packed = true;
    compare(&round, "{" HIGH ",\"time\":112,\"camera\":{\"azimuth_deg\":30},\"volume\":{\"slow_light\":true}}", 2e-3);
}

/* Before the first frame and after the last, a series is a grid of that frame alone, which ignores slow light. The
 * differences are due to slow light, which divides rays into other steps. */
static void test_ends(void **state)
{
    (void)state;
    static struct numbers
        series = { .rows = 12, .columns = 8, .layers = 4, .a = 0.9, .r = { 2, 20 }, .frames = 2, .time = { 0, 10 } },
        one;
    const uint32_t nodes = 12 * 8 * 4;
    fill(&series, 31, 0.5);
    for (int end = 0; end < 2; end++)
        for (int slow = 0; slow < 2; slow++) {
            keep(&series);
            struct kd_scene scene = scene_of(0.9, "{}");
            scene.top.time = end ? 1e9 : -1e9;
            scene.volume.slow_light = slow;
            struct kd_frame got = rendered(&scene);
            one = series;
            one.frames = 0;
            for (int k = 0; k < ARRAYS; k++)
                one.of[k] = series.of[k] + (end ? nodes : 0);
            keep(&one);
            scene = scene_of(0.9, "{}");
            scene.matter.frames = 1;
            scene.volume.slow_light = slow;
            struct kd_frame want = rendered(&scene);
            for (int i = 0; i < PIXELS; i++)
                if (!(fabsf(kelvin_of(&got)[i] - kelvin_of(&want)[i]) <= (slow ? 1e-3f : 1e-5f) * kelvin_of(&want)[i]))
                    fail_msg("end %d, slow %d, pixel %d: %.8g K, the frame alone has %.8g", end, slow, i,
                             (double)kelvin_of(&got)[i], (double)kelvin_of(&want)[i]);
            kd_frame_finish(&got);
            kd_frame_finish(&want);
        }
}

/* In slow light, the ring with its lump is compared with the formula at the time when the light left each point. The
 * picture without slow light differs. */
static void test_moving(void **state)
{
    enum { FINE = 10 };
    (void)state;
    static struct numbers g = {
        .rows = 48, .columns = 32, .layers = 24, .a = 0.7, .r = { 2, 25 }, .frames = 13, .time = { 100, 220 }
    };
    static float pictures[2][FINE * FINE];
    static double want[FINE * FINE];
    for (int late = 0; late < 2; late++) {
        g.late = g.ingoing = late;
        fill_ring(&g);
        keep(&g);
        struct kd_scene scene = scene_of(0.7, "{" HIGH ",\"time\":165,\"volume\":{\"slow_light\":true,\"inner\":2.2}}");
        scene.image.width = scene.image.height = FINE;
        scene.camera.inclination_deg = 60;
        struct view view = { &scene, &g, true };
        struct kd_frame slow = rendered(&scene);
        double off = 0, all = 0, apart = 0;
        memcpy(pictures[late], kelvin_of(&slow), sizeof pictures[late]);
        scene.volume.slow_light = false;
        struct kd_frame fast = rendered(&scene);
        scene.volume.slow_light = true;
        for (int i = 0; i < FINE * FINE; i++) {
            want[i] = late ? want[i] : kelvin_by_oracle(&view, FINE, i);
            off += pow((double)pictures[late][i] - want[i], 2);
            apart += pow((double)kelvin_of(&fast)[i] - want[i], 2);
            all += want[i] * want[i];
        }
        printf("%s: NMSE %.2g in slow light, %.2g in fast light\n", late ? "Kerr-Schild" : "Boyer-Lindquist", off / all,
               apart / all);
        assert_true(off <= 1e-3 * all);
        assert_true(apart >= 1e-2 * all);
        kd_frame_finish(&slow);
        kd_frame_finish(&fast);
    }
}

/* For extreme numbers, light is finite and not negative, with and without polarisation. */
static void test_adversarial(void **state)
{
    (void)state;
    static const struct {
        int of;
        double by;
        const char *json;
    } extremes[] = {
        { 5, 0, "{}" },
        { 0, 0, "{}" },
        { 1, 1e-9, "{}" },
        { 1, 1e6, "{}" },
        { 0, 1e23, "{}" },
        { 0, 1e-20, "{}" },
        { 5, 1e10, "{}" },
        { 5, 1e-25, "{}" },
        { 2, 1e4, "{}" },
        { 4, 0, "{\"volume\":{\"grid_scale\":0}}" },
        { 2, 0, "{\"volume\":{\"frequency_ghz\":1e12}}" },
        { 2, 0, "{\"volume\":{\"electrons\":\"kappa\"}}" },
        { 1, 0, "{\"volume\":{\"electrons\":\"power-law\"}}" },
        { 1, 0, "{\"volume\":{\"grid_scale\":1e30}}" },
    };
    for (size_t i = 0; i < 4 * sizeof extremes / sizeof *extremes; i++) {
        const int of = extremes[i / 4].of, last = of == 5 ? 8 : of == 2 ? 5 : of + 1;
        static struct numbers g = { .rows = 6, .columns = 5, .layers = 4, .a = 0.9 };
        g.r[0] = 1, g.r[1] = 30;         /* in this case the first rows lie inside the horizon */
        g.q = i % 3 ? 0 : 0.43588989435; /* in this case the horizons are 4e-6 M apart */
        fill(&g, 7, 0.4);
        for (int k = of; k < last; k++)
            for (uint32_t n = 0; n < g.rows * g.columns * g.layers; n++)
                g.of[k][n] *= n % 3 ? extremes[i / 4].by : extremes[i / 4].by > 0 ? 1 : 0;
        g.packed = i % 4 > 1;
        keep(&g);
        struct kd_scene scene = scene_of(0.9, extremes[i / 4].json);
        scene.spacetime.charge = g.q;
        scene.polarization.model = i % 2 ? KD_POLARIZATION_TRANSFER : KD_POLARIZATION_NONE;
        struct kd_frame frame = rendered(&scene);
        for (int p = 0; p < PIXELS; p++)
            if (!isfinite(kelvin_of(&frame)[p]) || kelvin_of(&frame)[p] < 0)
                fail_msg("array %d by %g, %s, %s%s, pixel %d: %g K", of, extremes[i / 4].by, extremes[i / 4].json,
                         i % 2 ? "polarised" : "not polarised", g.packed ? ", packed" : "", p,
                         (double)kelvin_of(&frame)[p]);
        if (extremes[i / 4].by == 0 && of == 0)
            for (int p = 0; p < PIXELS; p++)
                assert_true(kelvin_of(&frame)[p] == 0);
        kd_frame_finish(&frame);
    }
}

static void asset_read(void *user)
{
    struct event *event = user;
    pthread_mutex_lock(&event->lock);
    event->n++;
    pthread_cond_signal(&event->changed);
    pthread_mutex_unlock(&event->lock);
}

static void await(struct event *event, unsigned n)
{
    pthread_mutex_lock(&event->lock);
    while (event->n < n)
        pthread_cond_wait(&event->changed, &event->lock);
    pthread_mutex_unlock(&event->lock);
}

static enum kd_status render_one(struct kd_renderer *r, const struct kd_scene *scene, struct kd_frame *out,
                                 struct kd_error *why)
{
    struct kd_capacity c;
    struct kd_plan plan;
    kd_renderer_capacity(r, &c);
    OK(kd_plan_make(scene, &c, &plan, &error));
    return kd_render(r, scene, &plan, NULL, NULL, out, why);
}

/* A thread reads a grid before a picture needs it. This picture then does not read it, and neither does a picture whose
 * grid is already on the device. While the file is missing, a picture is refused with an error at the field. */
static void test_reading(void **state)
{
    (void)state;
    struct event event = { PTHREAD_MUTEX_INITIALIZER, PTHREAD_COND_INITIALIZER, 0 };
    static struct numbers g = { .rows = 8, .columns = 6, .layers = 1, .a = 0.5, .r = { 2, 20 } };
    struct kd_renderer *own;
    struct kd_frame first, again;
    struct kd_error why = { 0 };
    fill(&g, 11, 0.3);
    keep(&g);
    keeper.taken = 0;
    const struct kd_scene scene = scene_of(0.5, "{}");
    OK(kd_renderer_create(
        &(struct kd_renderer_params) { .assets = &assets, .asset_read = asset_read, .asset_read_user = &event }, &own,
        &error));
    kd_renderer_assets_begin(own, &scene);
    await(&event, 1);
    assert_false(kd_renderer_assets_begin(own, &scene));
    assert_int_equal(keeper.taken, 1);
    assert_false(pthread_equal(keeper.taker, pthread_self()));
    OK(render_one(own, &scene, &first, &error));
    assert_false(kd_renderer_assets_begin(own, &scene));
    assert_int_equal(keeper.taken, 1);

    static struct numbers h = { .rows = 8, .columns = 6, .layers = 1, .a = 0.5, .r = { 2, 20 } };
    fill(&h, 12, 0.3);
    keep(&h);
    keeper.missing = true;
    const struct kd_scene other = scene_of(0.5, "{}");
    for (int i = 0; i < 2; i++) {
        assert_int_equal(render_one(own, &other, &again, &why), KD_EINVAL);
        assert_string_equal(why.pointer, "/volume/grid");
        assert_non_null(strstr(why.message, "whose file is missing; it must be those of this test"));
    }
    keeper.missing = false;
    OK(render_one(own, &other, &again, &error));
    assert_true(memcmp(kelvin_of(&first), kelvin_of(&again), PIXELS * sizeof *kelvin_of(&first)));
    kd_frame_finish(&again);
    kd_renderer_assets_stop(own);
    kd_renderer_destroy(own);
    kd_frame_finish(&first);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_rays),   cmocka_unit_test(test_adversarial),
                                        cmocka_unit_test(test_series), cmocka_unit_test(test_ends),
                                        cmocka_unit_test(test_moving), cmocka_unit_test(test_reading) };
    renderer_assets = &assets;
    int skip = open_renderer();
    if (skip)
        return skip;
    int failed = close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
    kd_buffer_finish(&keeper.file);
    return failed;
}

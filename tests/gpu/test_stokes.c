/* Polarised light of a volume at a radio frequency: Stokes I, Q, U and V of rays against an integration that shares no step with the march: the ray and the vectors across it carried
 * in Kerr-Schild coordinates by Runge and Kutta (tests/oracle/kerr_schild_transport.c), coefficients in CGS with Bessel's functions by quadrature, and the transfer equation by
 * Runge and Kutta's method with the 4 x 4 matrix in each place, from the far end on. */
#include "render_support.h"

#include "kerr_schild_transport.h"
#include "physics/kerr.h"
#include "render/output/flux.h"

enum { WIDTH = 4, HEIGHT = 3, PIXELS = WIDTH * HEIGHT };

/* In CGS. */
#define C 2.99792458e10
#define E2 (4.80320471e-10 * 4.80320471e-10)
#define ME 9.1093837015e-28
#define MP 1.67262192369e-24
#define H 6.62607015e-27
#define K 1.380649e-16
#define GM_SUN 1.3271244e26

static struct kd_scene scene_of(const char *json, int width, int height)
{
    struct kd_scene scene;
    OK(kd_scene_preset(&scene, "riaf", &error));
    scene.image.width = width;
    scene.image.height = height;
    scene.image.critical_factor = 1;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "polarization.model", "transfer", &error));
    OK(kd_scene_set(&scene, "image.layers", "intensity,stokes_q,stokes_u,stokes_v", &error));
    return scene;
}

static const float *layer_of(const struct kd_frame *frame, const char *name)
{
    const struct kd_layer *layer = kd_frame_layer(frame, name);
    assert_non_null(layer);
    return layer->data;
}

/* K_n(x) exp(x), by the trapezium rule, which is exact for what falls as quickly. */
static double bessel(int n, double x)
{
    enum { POINTS = 200 };
    double sum = 0;
    const double most = acosh(1 + 60 / x), h = most / POINTS;
    for (int i = 0; i <= POINTS; i++)
        sum += (i ? 1 : 0.5) * exp(-x * (cosh(i * h) - 1)) * cosh(n * i * h);
    return sum * h;
}

/* j and alpha of I, Q and V, and rho of Q and V. */
struct coefficients { double j[3], a[3], rho[2]; };

static void hold(double *p)
{
    const double size = hypot(p[1], p[2]), most = 0.99 * p[0];
    for (int i = 1; i < 3 && size > most; i++)
        p[i] *= most / size;
}

static struct coefficients thermal(double n, double theta, double turn, double s, double c, double nu)
{
    struct coefficients o = { 0 };
    const double x = nu / (2.0 / 9 * turn * theta * theta * s), t = pow(theta, 0.96), k = pow(2, 11.0 / 12), lead = n * E2 * turn / C * sqrt(2) * M_PI / 27 * s * exp(-cbrt(x));
    const double planck = 2 * H * nu * nu * nu / (C * C) / expm1(H * nu / (theta * ME * C * C));
    const double y = nu / (1.5 * turn * s * theta * theta), y3 = 1 / cbrt(y);
    o.j[0] = lead * pow(sqrt(x) + k * pow(x, 1.0 / 6), 2);
    o.j[1] = lead * pow(sqrt(x) + (7 * t + 35) / (10 * t + 75) * k * pow(x, 1.0 / 6), 2);
    /* Dexter 2016, A1 to A18: both of his */
    const double ii = 2.5651 * (1 + 1.92 * y3 + 0.9977 * y3 * y3), iv = 1.81348 / y + 3.42319 * pow(y, -2.0 / 3) + 0.0292545 / sqrt(y) + 2.03773 * y3;
    o.j[2] = o.j[0] * (2 * c / s / (3 * sqrt(3) * theta) * iv) / (ii / (2 * sqrt(3)));
    hold(o.j);
    for (int i = 0; i < 3; i++)
        o.a[i] = o.j[i] / planck;
    const double omega = 2 * M_PI * turn, plasma = 4 * M_PI * n * E2 / ME, w = 2 * M_PI * nu, k0 = bessel(0, 1 / theta), k1 = bessel(1, 1 / theta), k2 = bessel(2, 1 / theta);
    const double f = theta * sqrt(sqrt(2) * s * 1000 * turn / nu), tail = 0.011 * exp(-f / 47.2);
    const double modified = 2.011 * exp(-pow(f, 1.035) / 4.7) - cos(f / 2) * exp(-pow(f, 1.2) / 2.73) - tail +
                            (tail - pow(2, -1.0 / 3) / pow(3, 23.0 / 6) * 1e4 * M_PI * pow(f + 1e-16, -8.0 / 3)) * 0.5 * (1 + tanh(10 * log(f / 120)));
    o.rho[0] = w / (2 * C) * plasma * omega * omega / pow(w, 4) * modified * (k1 / k2 + 6 * theta) * s * s;
    o.rho[1] = w / C * plasma * omega / pow(w, 3) * k0 / k2 * (1 - 0.11 * log(1 + 0.035 * f)) * c;
    return o;
}

static struct coefficients power_law(const struct kd_volume *v, double n, double turn, double s, double c, double nu)
{
    struct coefficients o;
    const double p = v->electrons_index, least = v->gamma_min, share = (p - 1) / (pow(least, 1 - p) - pow(v->gamma_max, 1 - p)), x = nu / (turn * s);
    o.j[0] = n * E2 * turn / C * share * pow(3, p / 2) * s / (2 * (p + 1)) * tgamma((3 * p - 1) / 12) * tgamma((3 * p + 19) / 12) * pow(x, -(p - 1) / 2);
    o.j[1] = o.j[0] * (p + 1) / (p + 7.0 / 3);
    o.j[2] = o.j[0] * 171.0 / 250 * pow(p, 0.49) * c / s / sqrt(x / 3);
    hold(o.j);
    o.a[0] = n * E2 / (nu * ME * C) * share * pow(3, (p + 1) / 2) / 4 * tgamma((3 * p + 2) / 12) * tgamma((3 * p + 22) / 12) * pow(x, -(p + 2) / 2);
    o.a[1] = o.a[0] * pow(17.0 / 500 * p - 43.0 / 1250, 43.0 / 500);
    o.a[2] = o.a[0] * pow(71.0 / 100 * p + 22.0 / 625, 197.0 / 500) * pow(3.1 * pow(s, -48.0 / 25) - 3.1, 64.0 / 125) / sqrt(x) * (c > 0 ? 1 : -1);
    hold(o.a);
    const double across = n * E2 / (ME * C * turn * s) * share, y = least * least / x;
    o.rho[0] = across * pow(x, -3) * pow(least, 2 - p) * (1 - pow(y, p / 2 - 1)) / (p / 2 - 1);
    o.rho[1] = 2 * (p + 2) / (p + 1) * across / (x * x) * pow(least, -(p + 1)) * log(least) * c / s;
    return o;
}

/* One ray: its places, from the observer on. */
enum { PLACES = 120000 };
struct place { double step, j[4], k[4][4]; };
static struct ray { const struct kd_scene *scene; int n; struct place at[PLACES]; } ray;

static void dot_all(double g[4][4], const double x[4], double out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = g[i][0] * x[0] + g[i][1] * x[1] + g[i][2] * x[2] + g[i][3] * x[3];
}

static double dot(double g[4][4], const double x[4], const double y[4])
{
    double low[4];
    dot_all(g, x, low);
    return low[0] * y[0] + low[1] * y[1] + low[2] * y[2] + low[3] * y[3];
}

static void boyer_lindquist(double a, double r, double u, double g[4][4])
{
    const double sigma = r * r + a * a * u * u, delta = r * r - 2 * r + a * a, s2 = 1 - u * u;
    memset(g, 0, 16 * sizeof g[0][0]);
    g[0][0] = -(1 - 2 * r / sigma);
    g[0][3] = g[3][0] = -2 * a * r * s2 / sigma;
    g[1][1] = sigma / delta;
    g[2][2] = sigma;
    g[3][3] = (r * r + a * a + 2 * a * a * r * s2 / sigma) * s2;
}

/* Goes round with the circular orbit's angular velocity, or is at rest for observers of zero angular momentum: the scenes below have their inner edge outside the ISCO, or matter at rest. */
static void flow_of(const struct kd_scene *scene, double a, double r, double g[4][4], double v[4])
{
    const double turns[4] = { 1, 0, 0, scene->volume.flow == KD_VOLUME_REST ? -g[0][3] / g[3][3] : 1 / (pow(r, 1.5) + a) }, size = 1 / sqrt(-dot(g, turns, turns));
    for (int i = 0; i < 4; i++)
        v[i] = size * turns[i];
}

static void take(void *user, const struct ks_carried *at)
{
    struct ray *to = user;
    const struct kd_volume *v = &to->scene->volume;
    const double a = at->a, r = at->r, u = at->x[3] / r, sine = sqrt(1 - u * u), cm = GM_SUN * to->scene->spacetime.mass_msun / (C * C);
    double g[4][4], flow[4], field[4], lines[3][4] = { { 0, 0, 0, 1 }, { 0, u, -sine / r, 0 }, { 0, 1, 0, 0 } }, low[4];
    boyer_lindquist(a, r, u, g);
    flow_of(to->scene, a, r, g, low);
    ks_carried_vector(at, low, flow);
    ks_carried_vector(at, lines[v->field], field);
    const double along = ks_carried_product(at, field, flow);
    for (int i = 0; i < 4; i++)
        field[i] += along * flow[i];
    const double size = sqrt(ks_carried_product(at, field, field)), seen = -ks_carried_product(at, at->k, flow), c = ks_carried_product(at, at->k, field) / (size * seen), s = sqrt(1 - c * c);
    /* The field across the ray: what it has along the direction of the light in the frame of the matter is taken away. */
    double across[4];
    for (int i = 0; i < 4; i++)
        across[i] = field[i] / size - c * (at->k[i] / seen - flow[i]);
    const double x = ks_carried_product(at, across, at->right), y = ks_carried_product(at, across, at->up), angle = atan2(-x, y) + M_PI / 2; /* of the electric field, from up to the left */
    const double z = r * u, h = v->height * r * sine, n = v->density_cm3 * pow(r, -v->density_index) * (v->height > 0 ? exp(-z * z / (2 * h * h)) : 1);
    const double b = sqrt(8 * M_PI * v->magnetisation * pow(r, -v->magnetisation_index) * n * MP * C * C), turn = sqrt(E2) * b / (2 * M_PI * ME * C);
    const double theta = K * v->electron_temperature_k * pow(r, -v->temperature_index) / (ME * C * C), nu = v->frequency_ghz * 1e9 * seen;
    if (to->n == PLACES)
        fail_msg("more places than there is room for");
    struct place *p = &to->at[to->n++];
    *p = (struct place) { .step = at->step };
    if (n < 1e-12)
        return;
    const struct coefficients o = v->electrons == KD_VOLUME_POWER_LAW ? power_law(v, n, turn, s, c, nu) : thermal(n, theta, turn, s, c, nu);
    const double q = cos(2 * angle), w = sin(2 * angle), light = cm / (seen * seen), depth = cm * seen;
    const double j[4] = { o.j[0], o.j[1] * q, o.j[1] * w, o.j[2] }, t[4] = { o.a[0], o.a[1] * q, o.a[1] * w, o.a[2] };
    const double rho[3] = { o.rho[0] * q, o.rho[0] * w, o.rho[1] };
    const double m[4][4] = { { t[0], t[1], t[2], t[3] }, { t[1], t[0], rho[2], -rho[1] }, { t[2], -rho[2], t[0], rho[0] }, { t[3], rho[1], -rho[0], t[0] } };
    for (int i = 0; i < 4; i++) {
        p->j[i] = light * j[i];
        for (int k = 0; k < 4; k++)
            p->k[i][k] = depth * m[i][k];
    }
}

static void grows(struct place *p, const double s[4], double out[4])
{
    dot_all(p->k, s, out);
    for (int i = 0; i < 4; i++)
        out[i] = p->j[i] - out[i];
}

/* From the far end: light comes towards the observer. */
static void integrate(double s[4])
{
    memset(s, 0, 4 * sizeof *s);
    for (int n = ray.n - 1; n >= 2; n -= 2) {
        const double h = 2 * ray.at[n - 1].step;
        double d[4][4], t[4];
        grows(&ray.at[n], s, d[0]);
        for (int m = 1; m < 4; m++) {
            for (int i = 0; i < 4; i++)
                t[i] = s[i] + (m == 3 ? h : 0.5 * h) * d[m - 1][i];
            grows(&ray.at[m == 3 ? n - 2 : n - 1], t, d[m]);
        }
        for (int i = 0; i < 4; i++)
            s[i] += h / 6 * (d[0][i] + 2 * d[1][i] + 2 * d[2][i] + d[3][i]);
    }
}

/* In the picture's brightness: 1e10 K. */
static void wanted(const struct kd_scene *scene, int i, double s[4])
{
    const double step = scene->camera.field_m / WIDTH /* pixels are square */, x = step * (i % WIDTH - 0.5 * (WIDTH - 1)), y = -step * (i / WIDTH - 0.5 * (HEIGHT - 1)), nu = scene->volume.frequency_ghz * 1e9;
    const struct ks_screen screen = ks_screen_far(scene->spacetime.spin, scene->camera.inclination_deg * M_PI / 180, x, y);
    ray.scene = scene;
    ray.n = 0;
    ks_carry(&screen, scene->volume.inner, scene->volume.outer, 0.008, take, &ray);
    integrate(s);
    for (int k = 0; k < 4; k++)
        s[k] *= C * C / (2 * K * nu * nu) / 1e10;
}

static const struct view { const char *json; double allowed; } views[] = {
    { "{\"camera\":{\"field_m\":20},\"volume\":{\"inner\":2.5,\"outer\":20}}", 1e-3 },
    { "{\"spacetime\":{\"spin\":-0.5},\"camera\":{\"inclination_deg\":110,\"field_m\":24},\"volume\":{\"inner\":2.2,\"outer\":18,\"height\":0.3,\"field\":\"radial\",\"flow\":\"rest\",\"frequency_ghz\":100}}", 1e-3 },
    { "{\"spacetime\":{\"spin\":0.3},\"camera\":{\"inclination_deg\":35,\"field_m\":22},\"volume\":{\"inner\":2.5,\"outer\":20,\"height\":0,\"field\":\"vertical\",\"flow\":\"rest\","
      "\"electrons\":\"power-law\",\"density_cm3\":1e5,\"magnetisation\":0.3,\"gamma_max\":1e4}}", 1e-3 },
};
enum { VIEWS = sizeof views / sizeof *views };

static void test_rays(void **state)
{
    (void)state;
    static const char *const names[] = { "intensity", "stokes_q", "stokes_u", "stokes_v" };
    for (size_t v = 0; v < VIEWS; v++) {
        const struct kd_scene scene = scene_of(views[v].json, WIDTH, HEIGHT);
        struct kd_frame frame = rendered(&scene);
        double worst[4] = { 0 }, most = 0, turned = 0, sums[4] = { 0 };
        for (int i = 0; i < PIXELS; i++)
            most = fmax(most, layer_of(&frame, names[0])[i]);
        for (int i = 0; i < PIXELS; i++) {
            double want[4], got[4];
            wanted(&scene, i, want);
            for (int k = 0; k < 4; k++) {
                got[k] = layer_of(&frame, names[k])[i];
                sums[k] += got[k];
                const double off = fabs(got[k] - want[k]) / fmax(want[0], 1e-3 * most);
                worst[k] = fmax(worst[k], off);
                if (!(off <= views[v].allowed))
                    fail_msg("view %zu, pixel %d, %s: %.7g, the oracle has %.7g of I = %.7g, off by %.2g, allowed %.2g", v, i, names[k], got[k], want[k], want[0], off, views[v].allowed);
            }
            if (hypot(want[1], want[2]) > 0.02 * want[0] && want[0] > 1e-3 * most) {
                const double apart = 0.5 * (atan2(got[2], got[1]) - atan2(want[2], want[1]));
                turned = fmax(turned, fabs(remainder(apart, M_PI)));
            }
        }
        printf("view %zu: off by %.1e, %.1e, %.1e, %.1e of I; EVPA by %.3f deg; Q %.3f, U %.3f, V %.4f of I\n", v, worst[0], worst[1], worst[2], worst[3], turned * 180 / M_PI,
               sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]);
        if (!(turned * 180 / M_PI <= 0.5))
            fail_msg("view %zu: EVPA is off by %g degrees", v, turned * 180 / M_PI);
        assert_true(hypot(sums[1], sums[2]) > 0.01 * sums[0] && fabs(sums[3]) > 1e-4 * sums[0]); /* there is something to be off */
        kd_frame_finish(&frame);
    }
}

static void test_adversarial(void **state)
{
    (void)state;
    static const char *const extremes[] = {
        "{\"volume\":{\"magnetisation\":0}}", "{\"volume\":{\"density_cm3\":0}}", "{\"volume\":{\"electron_temperature_k\":5930}}", "{\"volume\":{\"electron_temperature_k\":5.93e15}}",
        "{\"volume\":{\"electron_temperature_k\":1e30,\"density_cm3\":1e30,\"magnetisation\":1e12}}", "{\"volume\":{\"density_cm3\":1e30}}", "{\"volume\":{\"frequency_ghz\":1e-6}}",
        "{\"volume\":{\"frequency_ghz\":1e12}}", "{\"volume\":{\"density_cm3\":3e9,\"electron_temperature_k\":6e9,\"magnetisation\":3}}",
        "{\"volume\":{\"density_index\":-10,\"temperature_index\":10,\"magnetisation_index\":-10,\"outer\":30000}}", "{\"spacetime\":{\"spin\":0.999999},\"volume\":{\"inner\":\"horizon\"}}",
        "{\"volume\":{\"electrons\":\"power-law\",\"electrons_index\":10,\"gamma_min\":1e9,\"gamma_max\":1e12,\"density_cm3\":1e30}}",
    };
    for (size_t i = 0; i < sizeof extremes / sizeof *extremes; i++) {
        const struct kd_scene scene = scene_of(extremes[i], WIDTH, HEIGHT);
        struct kd_frame frame = rendered(&scene);
        for (int p = 0; p < PIXELS; p++) {
            const double s[4] = { layer_of(&frame, "intensity")[p], layer_of(&frame, "stokes_q")[p], layer_of(&frame, "stokes_u")[p], layer_of(&frame, "stokes_v")[p] };
            if (!(isfinite(s[0]) && s[0] >= 0 && hypot(hypot(s[1], s[2]), s[3]) <= s[0] * (1 + 1e-5)))
                fail_msg("%s, pixel %d: %g %g %g %g", extremes[i], p, s[0], s[1], s[2], s[3]);
        }
        kd_frame_finish(&frame);
    }
}

/* ipole's model/riaf/riaf.txt: flux with polarised transfer, which is less than without. */
static void test_published(void **state)
{
    (void)state;
    static const struct { const char *json; double jy; } fluxes[] = {
        { "{}", 2.6534246703175217 },
    };
    for (size_t i = 0; i < sizeof fluxes / sizeof *fluxes; i++) {
        struct kd_scene scene = scene_of(fluxes[i].json, 64, 64);
        OK(kd_scene_set(&scene, "image.layers", "rgb", &error));
        struct kd_frame frame = rendered(&scene);
        const double jy = kd_flux_jy(&scene, &frame);
        printf("%s: %.5f Jy, %+.2f %% of ipole's\n", fluxes[i].json, jy, 100 * (jy / fluxes[i].jy - 1));
        if (!(fabs(jy / fluxes[i].jy - 1) <= 0.02))
            fail_msg("%s: %.5f Jy, ipole has %.5f", fluxes[i].json, jy, fluxes[i].jy);
        kd_frame_finish(&frame);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_rays), cmocka_unit_test(test_adversarial), cmocka_unit_test(test_published) };
    int skip = open_renderer();
    return skip ? skip : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

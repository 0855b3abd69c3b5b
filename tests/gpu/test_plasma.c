/* Tests of matter at a radio frequency. Each ray's brightness temperature is compared with the integral of emission and
 * absorption along the Kerr-Schild oracle's path, with velocities from the metric's components and emissivities in CGS.
 * Other tests: fluxes in Jy, and numbers beyond single precision. */
#include "render_support.h"

#include "cgs.h"
#include "kerr_schild.h"
#include "integral/pictures.h"
#include "physics/spacetime/kerr.h"
#include "render/device/device_internal.h"
#include "render/output/flux.h"
#include "scene/hole.h"
#include "torus_turns.h"

#include <math.h>

enum { WIDTH = 7, HEIGHT = 7, PIXELS = WIDTH * HEIGHT };

static struct kd_scene scene_of(const char *preset, const char *json)
{
    struct kd_scene scene;
    OK(kd_scene_preset(&scene, preset, &error));
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    scene.image.critical_factor = 1;
    scene.camera.field_m = 24;
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    OK(kd_scene_set(&scene, "image.layers", "rgb,brightness_temperature", &error));
    return scene;
}

static const float *kelvin_of(const struct kd_frame *frame)
{
    const struct kd_layer *layer = kd_frame_layer(frame, "brightness_temperature");
    assert_non_null(layer);
    return layer->data;
}

struct metric { double g[4][4], i[4][4]; };

static struct metric metric_of(const struct ks_photon *p, double r, double u)
{
    const double a = p->a, sigma = r * r + a * a * u * u, m2 = 2 * r - p->q * p->q, delta = r * r - m2 + a * a,
                 s2 = 1 - u * u;
    struct metric m = { { { -(1 - m2 / sigma), 0, 0, -a * m2 * s2 / sigma },
                          { 0, sigma / delta, 0, 0 },
                          { 0, 0, sigma, 0 },
                          { -a * m2 * s2 / sigma, 0, 0, (r * r + a * a + a * a * m2 * s2 / sigma) * s2 } } };
    const double det = m.g[0][0] * m.g[3][3] - m.g[0][3] * m.g[0][3];
    m.i[0][0] = m.g[3][3] / det;
    m.i[3][3] = m.g[0][0] / det;
    m.i[0][3] = m.i[3][0] = -m.g[0][3] / det;
    m.i[1][1] = 1 / m.g[1][1];
    m.i[2][2] = 1 / m.g[2][2];
    return m;
}

static double dot(const double g[4][4], const double x[4], const double y[4])
{
    double sum = 0;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++)
            sum += g[i][k] * x[i] * y[k];
    return sum;
}

static void raise(const double g[4][4], const double x[4], double out[4])
{
    for (int i = 0; i < 4; i++)
        out[i] = g[i][0] * x[0] + g[i][1] * x[1] + g[i][2] * x[2] + g[i][3] * x[3];
}

/* Contravariant velocity of a circular orbit. */
static void circle(const struct ks_photon *p, double r, const struct metric *m, double out[4])
{
    const double turns[4] = { 1, 0, 0, 1 / (r * r / sqrt(r - p->q * p->q) + p->a) },
                 scale = 1 / sqrt(-dot(m->g, turns, turns));
    for (int i = 0; i < 4; i++)
        out[i] = scale * turns[i];
}

static void flow_of(const struct kd_scene *scene, const struct ks_photon *p, double r, double u, double out[4])
{
    const struct metric m = metric_of(p, r, u);
    const double edge = kd_kerr_isco(kd_scene_hole(scene));
    if (scene->volume.flow == KD_VOLUME_REST) {
        const double normal[4] = { -1, 0, 0, 0 }, scale = 1 / sqrt(-m.i[0][0]);
        raise(m.i, normal, out);
        for (int i = 0; i < 4; i++)
            out[i] *= scale;
    } else if (r >= edge)
        circle(p, r, &m, out);
    else { /* u_t and u_phi of the orbit at the ISCO, u_r from the norm */
        const struct metric there = metric_of(p, edge, u);
        double v[4], low[4];
        circle(p, edge, &there, v);
        raise(there.g, v, low);
        low[1] = low[2] = 0;
        const double rest = -1 - dot(m.i, low, low);
        low[1] = -sqrt(fmax(rest, 0) / m.i[1][1]);
        raise(m.i, low, out);
        if (rest < 0) {
            const double scale = 1 / sqrt(-dot(m.g, out, out));
            for (int i = 0; i < 4; i++)
                out[i] *= scale;
        }
    }
}

/* A field of unit length perpendicular to v. */
static void field_of(const struct kd_scene *scene, const struct metric *m, const double v[4], double r, double u,
                     double out[4])
{
    const double lines[3][4] = { { 0, 0, 0, 1 }, { 0, u, -sqrt(1 - u * u) / r, 0 }, { 0, 1, 0, 0 } },
                 *e = lines[scene->volume.field], along = dot(m->g, e, v);
    for (int i = 0; i < 4; i++)
        out[i] = e[i] + along * v[i];
    const double scale = 1 / sqrt(dot(m->g, out, out));
    for (int i = 0; i < 4; i++)
        out[i] *= scale;
}

/* Pandya et al. 2016: emissivity and absorptivity. */
static void thermal(double n, double theta, double turn, double sine, double nu, double out[2])
{
    const double x = nu / (2.0 / 9 * turn * theta * theta * sine),
                 shape = sqrt(x) + pow(2, 11.0 / 12) * pow(x, 1.0 / 6);
    out[0] = out[1] = 0;
    if (!(x < 1e6)) /* skipped, because here the contribution is only e^-100 of the total */
        return;
    out[0] = n * E2 * turn / C * sqrt(2) * M_PI / 27 * sine * shape * shape * exp(-cbrt(x));
    out[1] = out[0] * expm1(H * nu / (theta * ME * C * C)) * C * C / (2 * H * nu * nu * nu);
}

static void power_law(const struct kd_volume *v, double n, double turn, double sine, double nu, double out[2])
{
    const double p = v->electrons_index, share = (p - 1) / (pow(v->gamma_min, 1 - p) - pow(v->gamma_max, 1 - p)),
                 x = nu / (turn * sine);
    out[0] = n * E2 * turn / C * share * pow(3, p / 2) * sine / (2 * (p + 1)) * tgamma((3 * p - 1) / 12) *
             tgamma((3 * p + 19) / 12) * pow(x, -(p - 1) / 2);
    out[1] = n * E2 / (nu * ME * C) * share * pow(3, (p + 1) / 2) / 4 * tgamma((3 * p + 2) / 12) *
             tgamma((3 * p + 22) / 12) * pow(x, -(p + 2) / 2);
}

/* Absorptivity by equations 35 to 44 of the same paper, with the hypergeometric function from Euler's integral in ln t.
 * */
static void kappa_law(double kappa, double n, double theta, double turn, double sine, double nu, double out[2])
{
    const double w = theta * (kappa - 3) / kappa, wk = w * kappa, x = nu / (turn * wk * wk * sine), a = kappa - 1.0 / 3,
                 b = kappa + 1, all = (kappa - 2) * (kappa - 1) * kappa;
    enum { PARTS = 200 };
    double f = 0, s = 3 * pow(kappa, -1.5),
           low = cbrt(x) * sine * 4 * M_PI * tgamma(kappa - 4.0 / 3) / (pow(3, 7.0 / 3) * tgamma(kappa - 2));
    double high = pow(x, -(kappa - 2) / 2) * sine * pow(3, (kappa - 1) / 2) * (kappa - 2) * (kappa - 1) / 4 *
                  tgamma(kappa / 4 - 1.0 / 3) * tgamma(kappa / 4 + 4.0 / 3);
    for (int i = 0; i <= PARTS; i++) {
        const double h = 20.0 / PARTS, t = exp(-i * h);
        f += (i == 0 || i == PARTS ? 1 : i % 2 ? 4 : 2) * h / 3 * a * pow(t, a) * pow(1 + wk * t, -b);
    }
    out[0] = n * E2 * turn / C * pow(pow(low, -s) + pow(high, -s), -1 / s);
    low = pow(x, -2.0 / 3) * pow(3, 1.0 / 6) * 10 / 41 * 2 * M_PI / pow(wk, 10.0 / 3 - kappa) * all / (3 * kappa - 1) *
          tgamma(5.0 / 3) * f;
    high = pow(x, -(1 + kappa) / 2) * pow(M_PI, 1.5) / 3 * all / (wk * wk * wk) *
           (2 * tgamma(2 + kappa / 2) / (2 + kappa) - 1) * (pow(3 / kappa, 19.0 / 4) + 3.0 / 5);
    s = pow(-7.0 / 4 + 8 * kappa / 5, -43.0 / 50);
    out[1] = n * E2 / (nu * ME * C) * pow(pow(low, -s) + pow(high, -s), -1 / s);
}

static void medium(void *user, const struct ks_photon *p, double r, double u, double out[2])
{
    const struct kd_scene *scene = user;
    const struct kd_volume *v = &scene->volume;
    const double k[4] = { -p->energy, p->p_r, p->p_theta, p->momentum }, axis = r * sqrt(1 - u * u),
                 cm = GM_SUN * scene->spacetime.mass_msun / (C * C);
    const struct metric m = metric_of(p, r, u);
    double flow[4], field[4], seen = 0, along = 0;
    if (v->model == KD_VOLUME_GOLD) {
        const double low[4] = { -1, 0, 0, v->gold_momentum * pow(axis, 1.5) / (1 + axis) },
                     scale = 1 / sqrt(-dot(m.i, low, low));
        raise(m.i, low, flow);
        for (int i = 0; i < 4; i++)
            seen -= scale * flow[i] * k[i];
        const double n = v->gold_emission * exp(-0.5 * (r * r / 100 + pow(v->gold_flattening * u, 2))),
                     x = seen * v->frequency_ghz / 230;
        out[0] = n * pow(x, -v->gold_index) * cm / (seen * seen);
        out[1] = n * v->gold_absorption * pow(x, -2.5 - v->gold_index) * cm * seen;
        return;
    }
    double enthalpy = 0, most = 0;
    if (v->model == KD_VOLUME_TORUS) {
        const struct metric inner = metric_of(p, v->inner, 0), mid = metric_of(p, v->torus_radius, 0);
        double orbit[4], low[4];
        circle(p, v->torus_radius, &mid, orbit);
        raise(mid.g, orbit, low);
        const double l = orbit[0] * low[3], edge = torus_turns(inner.g[0][0], inner.g[0][3], inner.g[3][3], l, flow);
        most = expm1(torus_turns(mid.g[0][0], mid.g[0][3], mid.g[3][3], l, flow) - edge);
        enthalpy = expm1(torus_turns(m.g[0][0], m.g[0][3], m.g[3][3], l, flow) - edge);
        out[0] = out[1] = 0;
        if (!(enthalpy > 0))
            return;
    } else
        flow_of(scene, p, r, u, flow);
    field_of(scene, &m, flow, r, u, field);
    for (int i = 0; i < 4; i++) {
        seen -= flow[i] * k[i];
        along += field[i] * k[i];
    }
    const double z = r * u, h = v->height * axis, share = (v->adiabatic_index - 1) / v->adiabatic_index;
    double n = v->density_cm3 * pow(r, -v->density_index) * (v->height > 0 ? exp(-z * z / (2 * h * h)) : 1);
    double magnetic = v->magnetisation * pow(r, -v->magnetisation_index),
           theta = K * v->electron_temperature_k * pow(r, -v->temperature_index) / (ME * C * C);
    if (v->model == KD_VOLUME_TORUS) {
        n = v->density_cm3 * pow(enthalpy / most, 1 / (v->adiabatic_index - 1));
        magnetic = share * enthalpy / v->beta;
        theta = MP / ME * share * enthalpy / (1 + v->temperature_ratio);
    }
    const double b = sqrt(8 * M_PI * magnetic * n * MP * C * C), turn = sqrt(E2) * b / (2 * M_PI * ME * C);
    const double sine = sqrt(1 - along * along / (seen * seen)), nu = v->frequency_ghz * 1e9 * seen;
    if (v->electrons == KD_VOLUME_POWER_LAW)
        power_law(v, n, turn, sine, nu, out);
    else if (v->electrons == KD_VOLUME_KAPPA)
        kappa_law(v->kappa, n, theta, turn, sine, nu, out);
    else
        thermal(n, theta, turn, sine, nu, out);
    out[0] *= cm / (seen * seen);
    out[1] *= cm * seen;
}

static double kelvin(const struct kd_scene *scene, int i)
{
    const double step = scene->camera.field_m / WIDTH, x = step * (i % WIDTH - 0.5 * (WIDTH - 1)),
                 y = -step * (i / WIDTH - 0.5 * (HEIGHT - 1)), nu = scene->volume.frequency_ghz * 1e9;
    const struct ks_photon photon = ks_from_infinity_charged(scene->spacetime.spin, scene->spacetime.charge,
                                                             cos(scene->camera.inclination_deg * M_PI / 180), x, y);
    return ks_along(photon, scene->volume.inner, scene->volume.outer, false, medium, (void *)scene).light * C * C /
           (2 * K * nu * nu);
}

/* At the inner edges the light is still 0, because the oracle's quadrature is inaccurate where light grows without
 * bound. The outer edges are close to the hole, to save time. */
static const struct view {
    const char *preset, *json;
    double allowed;
} views[] = {
    { "gold-1", "{\"volume\":{\"inner\":1.5,\"outer\":30}}", 2e-4 },
    { "gold-4", "{\"volume\":{\"inner\":1.5,\"outer\":30,\"frequency_ghz\":300}}", 2e-4 },
    { "riaf", "{\"volume\":{\"inner\":1.5,\"outer\":30}}", 4e-4 },
    { "riaf",
      "{\"spacetime\":{\"spin\":-0.5},\"camera\":{\"inclination_deg\":110},\"volume\":{\"inner\":2,\"outer\":20,"
      "\"height\":0.3,\"field\":\"radial\",\"frequency_ghz\":30}}",
      4e-4 },
    { "riaf",
      "{\"spacetime\":{\"spin\":0.3},\"camera\":{\"inclination_deg\":35},\"volume\":{\"inner\":2.5,\"outer\":20,"
      "\"height\":0,\"field\":\"vertical\",\"flow\":\"rest\","
      "\"electrons\":\"power-law\",\"density_cm3\":1e5,\"magnetisation\":0.3,\"gamma_max\":1e4}}",
      4e-4 },
    { "riaf",
      "{\"volume\":{\"inner\":4,\"outer\":12,\"height\":0.5,\"electrons\":\"kappa\",\"kappa\":3.6,\"density_cm3\":1e6}"
      "}",
      1e-4 },
    { "riaf", "{\"volume\":{\"model\":\"torus\",\"inner\":6,\"outer\":60,\"density_cm3\":1e6,\"temperature_ratio\":1}}",
      1e-4 },
    { "gold-1", "{\"spacetime\":{\"spin\":0.3,\"charge\":0.9},\"volume\":{\"inner\":1.5,\"outer\":30}}", 2e-4 },
    { "riaf",
      "{\"spacetime\":{\"spin\":0.5,\"charge\":0.8},\"volume\":{\"inner\":1.5,\"outer\":20,\"field\":\"radial\"}}",
      4e-4 },
    { "riaf",
      "{\"spacetime\":{\"spin\":0.2,\"charge\":0.9},\"volume\":{\"model\":\"torus\",\"inner\":5,\"torus_radius\":10,"
      "\"outer\":"
      "60,\"density_cm3\":1e6,\"temperature_ratio\":1}}",
      1e-4 },
};
enum { VIEWS = sizeof views / sizeof *views };

static void test_rays(void **state)
{
    (void)state;
    for (size_t v = 0; v < VIEWS; v++) {
        const struct kd_scene scene = scene_of(views[v].preset, views[v].json);
        struct kd_frame frame = rendered(&scene);
        double worst = 0, most = 0, sum = 0;
        for (int i = 0; i < PIXELS; i++)
            most = fmax(most, kelvin_of(&frame)[i]);
        for (int i = 0; i < PIXELS; i++) {
            const double want = kelvin(&scene, i), off = fabs(kelvin_of(&frame)[i] - want) / fmax(want, 1e-3 * most);
            worst = fmax(worst, off);
            sum += kelvin_of(&frame)[i];
            if (!(off <= views[v].allowed))
                fail_msg("view %zu, pixel %d: %.7g K, the oracle has %.7g, off by %.2g, allowed %.2g", v, i,
                         (double)kelvin_of(&frame)[i], want, off, views[v].allowed);
        }
        /* Flux: the sum of 2 nu^2 k T/c^2 times the solid angle of a pixel. */
        const double side = scene.camera.field_m / WIDTH * GM_SUN * scene.spacetime.mass_msun / (C * C) /
                            (scene.spacetime.distance_pc * 3.0856775814913673e18);
        const double jy = sum * 2 * K * pow(scene.volume.frequency_ghz * 1e9 / C, 2) * side * side / 1e-23;
        assert_true(fabs(kd_flux_jy(&scene, &frame) / jy - 1) < 1e-5);
        printf("%s: worst %.2g, brightest %.3g K, %.5g Jy\n", views[v].preset, worst, most, jy);
        kd_frame_finish(&frame);
    }
}

/* For extreme numbers, light is finite and not negative, and no ray is given up. */
static void test_adversarial(void **state)
{
    (void)state;
    static const char *const extremes[] = {
        "{\"volume\":{\"magnetisation\":0}}",
        "{\"volume\":{\"density_cm3\":0}}",
        "{\"volume\":{\"electron_temperature_k\":5930}}",
        "{\"volume\":{\"electron_temperature_k\":5.93e15}}",
        "{\"volume\":{\"electron_temperature_k\":1e30,\"density_cm3\":1e30,\"magnetisation\":1e12}}",
        "{\"volume\":{\"density_cm3\":1e30}}",
        "{\"volume\":{\"frequency_ghz\":1e-6}}",
        "{\"volume\":{\"frequency_ghz\":1e12}}",
        "{\"volume\":{\"density_index\":-10,\"temperature_index\":10,\"magnetisation_index\":-10,\"outer\":30000}}",
        "{\"volume\":{\"inner\":\"horizon\",\"height\":10}}",
        "{\"spacetime\":{\"spin\":0.999999},\"volume\":{\"inner\":\"horizon\"}}",
    };
    for (size_t i = 0; i < sizeof extremes / sizeof *extremes; i++) {
        const struct kd_scene scene = scene_of("riaf", extremes[i]);
        struct kd_frame frame = rendered(&scene);
        for (int p = 0; p < PIXELS; p++)
            if (!isfinite(kelvin_of(&frame)[p]) || kelvin_of(&frame)[p] < 0)
                fail_msg("%s, pixel %d: %g K", extremes[i], p, (double)kelvin_of(&frame)[p]);
        if (i < 2)
            assert_true(kd_flux_jy(&scene, &frame) == 0);
        kd_frame_finish(&frame);
    }
}

/* Optically thick matter has the light of a black body of its redshifted temperature. This holds for any density, up to
 * optical depths beyond single precision. */
static void test_deep(void **state)
{
    (void)state;
    static const char *const densities[] = { "1e12", "1e20", "1e30" };
    double first[PIXELS];
    for (size_t i = 0; i < 3; i++) {
        char json[200];
        snprintf(json, sizeof json,
                 "{\"volume\":{\"height\":0,\"temperature_index\":0,\"inner\":4,\"outer\":20,\"flow\":\"rest\","
                 "\"field\":\"vertical\",\"frequency_ghz\":30,\"density_cm3\":%s}}",
                 densities[i]);
        const struct kd_scene scene = scene_of("riaf", json);
        struct kd_frame frame = rendered(&scene);
        for (int p = 0; p < PIXELS; p++) {
            first[p] = i ? first[p] : (double)kelvin_of(&frame)[p];
            if (!(fabs(kelvin_of(&frame)[p] / first[p] - 1) < 5e-3))
                fail_msg("density %s, pixel %d: %g K, %g K at the least of them", densities[i], p,
                         (double)kelvin_of(&frame)[p], first[p]);
        }
        /* Matter at rest at 20 M, in the middle of the picture, appears with the temperature T sqrt(1 - 2/r), apart
         * from frame dragging. */
        assert_true(fabs(first[PIXELS / 2] / (3e11 * sqrt(0.9)) - 1) < 0.01);
        kd_frame_finish(&frame);
    }
}

/* The standard test sphere of such programs (ipole's model/sphere): R = 100 GM/c^2 of 4.1e6 suns, Theta = 10,
 * Thomson depth 1e-5, beta 20, the field along the axis. A hole of a hundredth of that mass hardly bends its light,
 * so that the closed form of flat space in the optical depth applies. */
static void test_sphere(void **state)
{
    (void)state;
    const double radius = 1e4 * GM_SUN * 4.1e4 / (C * C), n = 1e-5 / (6.6524587321e-25 * radius),
                 magnetisation = 2 * ME * (MP + ME) / (MP * MP);
    const double turn = sqrt(E2) * sqrt(8 * M_PI * magnetisation * n * MP * C * C) / (2 * M_PI * ME * C),
                 away = 8300 * 3.0856775814913673e18;
    char json[600];
    snprintf(json, sizeof json,
             "{\"spacetime\":{\"spin\":0,\"mass_msun\":4.1e4},\"camera\":{\"inclination_deg\":90,\"field_m\":20400},"
             "\"image\":{\"width\":64,\"height\":64},"
             "\"volume\":{\"inner\":\"horizon\",\"outer\":10000,\"density_cm3\":%.17g,\"density_index\":0,\"electron_"
             "temperature_k\":%.17g,\"temperature_index\":0,\"height\":0,"
             "\"magnetisation\":%.17g,\"magnetisation_index\":0,\"field\":\"vertical\",\"flow\":\"rest\"}}",
             n, 10 * ME * C * C / K, magnetisation);
    struct kd_scene scene = scene_of("riaf", json);
    for (double log_hz = 7.5; log_hz < 14; log_hz += 0.75) {
        double give[2], nu = pow(10, log_hz);
        scene.volume.frequency_ghz = nu * 1e-9;
        thermal(n, 10, turn, 1, nu, give);
        struct kd_frame frame = rendered(&scene);
        const double x = 2 * give[1] * radius,
                     deep = 0.5 * radius * radius - (1 - exp(-x) * (1 + x)) / (4 * give[1] * give[1]);
        const double seen = 2 * M_PI / (away * away) *
                            (x < 1e-3 ? give[0] * 2 * pow(radius, 3) / 3 : give[0] / give[1] * deep),
                     jy = kd_flux_jy(&scene, &frame);
        printf("sphere: 10^%g Hz, depth %.2g: %.5g Jy, %+.3f %%\n", log_hz, x, jy, 100 * (jy * 1e-23 / seen - 1));
        if (!(fabs(jy * 1e-23 / seen - 1) < 0.01))
            fail_msg("10^%g Hz: %g Jy, the closed form has %g", log_hz, jy, seen * 1e23);
        kd_frame_finish(&frame);
    }
}

/* Fluxes of whole pictures are compared with published values: Gold et al. 2020, table 1; the program Blacklight (White
 * 2022); ipole's model/riaf/riaf.txt. Blacklight's rays are parallel, but its observer is at rest at 1000 M. Its 230
 * GHz are 230 sqrt(1 - 2/1000) GHz at infinity, and I/nu^3 is invariant. */
static void test_published(void **state)
{
    (void)state;
    static const struct {
        const char *preset;
        double published, within, other, within_other;
    } fluxes[] = {
        { "gold-1", 1.6465, 0.02, 1.65940, 0.003 },   { "gold-2", 1.4360, 0.02, 1.44882, 0.003 },
        { "gold-3", 0.4418, 0.02, 0.446234, 0.003 },  { "gold-4", 0.2710, 0.02, 0.272950, 0.003 },
        { "gold-5", 0.0255, 0.02, 0.0257013, 0.003 }, { "riaf", 3.0425, 0.01, 3.0402553586, 0.01 },
    };
    for (size_t i = 0; i < sizeof fluxes / sizeof *fluxes; i++) {
        struct kd_scene scene;
        OK(kd_scene_preset(&scene, fluxes[i].preset, &error));
        scene.image.width = scene.image.height = 96;
        struct kd_frame frame = rendered(&scene);
        const double jy = kd_flux_jy(&scene, &frame),
                     lapse = scene.volume.model == KD_VOLUME_GOLD ? sqrt(1 - 2.0 / 1000) : 1;
        kd_frame_finish(&frame);
        scene.volume.frequency_ghz *= lapse;
        frame = rendered(&scene);
        const double there = kd_flux_jy(&scene, &frame) / pow(lapse, 3);
        printf("%s: %.6f Jy, %+.2f %% of the published, %+.2f %% of another program's\n", fluxes[i].preset, jy,
               100 * (jy / fluxes[i].published - 1), 100 * (there / fluxes[i].other - 1));
        if (!(fabs(jy / fluxes[i].published - 1) <= fluxes[i].within &&
              fabs(there / fluxes[i].other - 1) <= fluxes[i].within_other))
            fail_msg("%s: %.6f Jy, published are %.6f", fluxes[i].preset, jy, fluxes[i].published);
        kd_frame_finish(&frame);
    }
}

/* With ipole's camera, which is at 1000 M and moves inwards at 2/r, kerrd reproduces ipole's fluxes. Differences are
 * 0.2 % from its constants and steps, and 0.05 % from one ray a pixel (docs/physics/volume.md). For an observer at
 * infinity, fluxes are up to 0.9 % smaller. */
static void test_the_camera_of_ipole(void **state)
{
    (void)state;
    static const struct {
        double deg, jy, left;
    } fluxes[] = { { 30, 2.392769883648396, 2.7e-3 },
                   { 60, 3.0402553586023138, 2.5e-3 },
                   { 75, 3.021039735088821, 2.3e-3 } };
    for (size_t i = 0; i < sizeof fluxes / sizeof *fluxes; i++) {
        struct kd_scene scene;
        OK(kd_scene_preset(&scene, "riaf", &error));
        scene.image.width = scene.image.height = 160;
        scene.camera.inclination_deg = fluxes[i].deg;
        scene.camera.r = 1000;
        scene.camera.fov_deg = 2.24056;
        OK(kd_scene_set(&scene, "camera.observer", "velocity", &error));
        OK(kd_scene_set(&scene, "camera.velocity_r", "-0.002", &error));
        struct kd_frame frame = rendered(&scene);
        const double left = 1 - kd_flux_jy(&scene, &frame) / fluxes[i].jy;
        printf("riaf at %g degrees: %.3f %% are left\n", fluxes[i].deg, 100 * left);
        assert_true(fabs(left - fluxes[i].left) < 4e-4); /* these numbers are for one ray a pixel */
        kd_frame_finish(&frame);
    }
}

/* If there is no other light, the picture has a flux and layers in physical units. With other light it has no flux, and
 * such layers are refused. */
static void test_alone(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of("riaf", "{}");
    char text[KD_FLUX_TEXT];
    struct kd_frame frame = rendered(&scene);
    kd_flux_text(&scene, &frame, text);
    assert_true(!strncmp(text, "jy=", 3) && strstr(text, " ghz=223.005 kelvin=1e+10"));
    kd_frame_finish(&frame);
    scene.sky.model = KD_SKY_GRID;
    struct kd_capacity capacity;
    struct kd_plan plan;
    struct kd_error error = { 0 };
    kd_renderer_capacity(renderer, &capacity);
    assert_int_equal(kd_plan_make(&scene, &capacity, &plan, &error), KD_EINVAL);
    assert_string_equal(error.pointer, "/image/layers");
    assert_int_equal(kd_scene_set(&scene, "image.layers", "rgb", &error), KD_OK);
    frame = rendered(&scene);
    kd_flux_text(&scene, &frame, text);
    assert_true(!*text && isnan(kd_flux_jy(&scene, &frame)));
    kd_frame_finish(&frame);
}

static double flux_of(const struct kd_scene *scene, double *scale)
{
    struct kd_frame frame = rendered(scene);
    const double jy = kd_flux_jy(scene, &frame);
    *scale = frame.density_scale;
    kd_frame_finish(&frame);
    return jy;
}

/* A normalised density gives the requested flux, and is reported. A scene with the reported density gives the same
 * picture. */
static void test_normalised(void **state)
{
    (void)state;
    static const struct {
        const char *preset;
        double jy, ghz;
    } wanted[] = { { "riaf", 2.4, INFINITY }, { "gold-4", 0.35, INFINITY }, { "torus", 1, 86 } };
    for (size_t i = 0; i < sizeof wanted / sizeof *wanted; i++) {
        struct kd_scene scene;
        double scale, again, none;
        OK(kd_scene_preset(&scene, wanted[i].preset, &error));
        scene.image.width = scene.image.height = 128;
        scene.image.critical_factor = 1;
        scene.volume.normalise_to_jy = wanted[i].jy;
        scene.volume.normalise_ghz = wanted[i].ghz;
        const double jy = flux_of(&scene, &scale);
        assert_true(flux_of(&scene, &again) == jy && again == scale);
        scene.volume.normalise_to_jy = 0;
        *(scene.volume.model == KD_VOLUME_GOLD ? &scene.volume.gold_emission : &scene.volume.density_cm3) *= scale;
        assert_true(flux_of(&scene, &none) == jy && none == 1);
        scene.volume.frequency_ghz = isfinite(wanted[i].ghz) ? wanted[i].ghz : scene.volume.frequency_ghz;
        const double there = flux_of(&scene, &none);
        printf("%s: %.6g Jy, asked for %g; the density times %.6g\n", wanted[i].preset, there, wanted[i].jy, scale);
        if (!(fabs(there / wanted[i].jy - 1) < 1e-4))
            fail_msg("%s: %.6g Jy, asked for %g, by a factor of %.6g", wanted[i].preset, there, wanted[i].jy, scale);
    }
}

/* All pictures of an integral use one density, which is determined once. This is tested for sizes whose aspect ratios
 * differ after rounding to whole pixels, for visibilities, and for two frequencies. */
static void test_normalised_once(void **state)
{
    (void)state;
    static const char *const asked[] = {
        "{\"preset\":\"riaf\",\"scene\":{\"image\":{\"width\":1280,\"height\":720},\"volume\":{\"normalise_to_jy\":1.3}"
        "},"
        "\"u\":[1],\"v\":[2],\"pixels\":51}",
        "{\"preset\":\"riaf\",\"scene\":{\"image\":{\"width\":1280,\"height\":720},\"volume\":{\"normalise_to_jy\":1.4}"
        "},"
        "\"frequencies_hz\":[1e11,2e11],\"pixels\":51}",
    };
    for (int i = 0; i < 2; i++) {
        struct kd_integral_request request;
        const uint32_t before = renderer->normalised.n;
        double first = 0;
        kd_integral_request_init(&request, i ? KD_INTEGRAL_SPECTRUM : KD_INTEGRAL_VISIBILITY);
        OK(kd_integral_request_json(&request, asked[i], strlen(asked[i]), &error));
        for (unsigned picture = 0; picture < kd_integral_pictures(&request); picture++) {
            struct kd_scene scene = kd_integral_scene(&request, picture);
            struct kd_capacity capacity;
            struct kd_plan plan;
            struct kd_frame frame;
            kd_renderer_capacity(renderer, &capacity);
            OK(kd_integral_plan(&request, &scene, &capacity, &plan, &error));
            OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
            first = picture ? first : frame.density_scale;
            assert_true(frame.density_scale == first);
            kd_frame_finish(&frame);
        }
        kd_integral_request_finish(&request);
        assert_int_equal(renderer->normalised.n - before, 1);
    }
}

/* While a view is dragged, frames use the density last determined for the same matter. At rest a frame uses the density
 * determined for itself. */
static void test_held(void **state)
{
    (void)state;
    double first, turned, exact;
    struct kd_scene scene =
        scene_of("riaf", "{\"volume\":{\"normalise_to_jy\":1.7},\"image\":{\"width\":32,\"height\":32}}");
    struct kd_needs needs = kd_needs_of(&scene);
    needs.reuse_normalisation = true;
    double *const told[] = { &first, &turned, &exact };
    for (int i = 0; i < 3; i++) {
        struct kd_capacity capacity;
        struct kd_plan plan;
        struct kd_frame frame;
        scene.camera.inclination_deg = i ? 20 : 60;
        needs.reuse_normalisation = i < 2;
        kd_renderer_capacity(renderer, &capacity);
        OK(kd_plan_make_for(&scene, &needs, &capacity, &plan, &error));
        assert_int_equal(plan.light.reuse_normalisation, i < 2);
        OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
        *told[i] = frame.density_scale;
        kd_frame_finish(&frame);
    }
    assert_true(first == turned);
    assert_true(fabs(exact / first - 1) > 0.01);
}

/* No density can give the flux if there is no matter, or if the matter absorbs its own light. These cases are errors.
 * */
static void test_not_normalised(void **state)
{
    (void)state;
    static const struct {
        const char *preset, *json, *says;
    } refused[] = {
        { "gold-1", "{\"volume\":{\"gold_emission\":0,\"normalise_to_jy\":1}}",
          "volume.normalise_to_jy is 1 Jy, but there is no matter" },
        { "gold-5", "{\"volume\":{\"normalise_to_jy\":1e6}}", "at its largest density this matter has" },
        { "riaf", "{\"volume\":{\"magnetisation\":0,\"normalise_to_jy\":1}}",
          "at its largest density this matter has 0 Jy" },
    };
    for (size_t i = 0; i < sizeof refused / sizeof *refused; i++) {
        const struct kd_scene scene = scene_of(refused[i].preset, refused[i].json);
        struct kd_capacity capacity;
        struct kd_plan plan;
        struct kd_frame frame;
        struct kd_error refusal = { 0 };
        kd_renderer_capacity(renderer, &capacity);
        OK(kd_plan_make(&scene, &capacity, &plan, &error));
        assert_int_equal(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &refusal), KD_EINVAL);
        assert_string_equal(refusal.pointer, "/volume/normalise_to_jy");
        if (!strstr(refusal.message, refused[i].says))
            fail_msg("%s: %s", refused[i].json, refusal.message);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rays),
        cmocka_unit_test(test_adversarial),
        cmocka_unit_test(test_deep),
        cmocka_unit_test(test_sphere),
        cmocka_unit_test(test_published),
        cmocka_unit_test(test_the_camera_of_ipole),
        cmocka_unit_test(test_alone),
        cmocka_unit_test(test_normalised),
        cmocka_unit_test(test_normalised_once),
        cmocka_unit_test(test_held),
        cmocka_unit_test(test_not_normalised),
    };
    int skip = open_renderer();
    return skip ? skip : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

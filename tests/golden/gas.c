/* Tests of the appearance of the gas. Its angle of emission is compared with Kerr-Schild geodesics and the metric.
 * Turbulence conserves the flux, rotates as gas on orbits does, and gives the same picture for the same seed. */
#include "photon.h"
#include "studio.h"

#include "physics/disk/thin_disk.h"
#include "physics/spacetime/kerr.h"
#include "render/view/camera.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* ds^2/dt^2 of a circle at this angular velocity, in the plane: g_tt + 2 Omega g_tphi + Omega^2 g_phiphi. For a
 * circular geodesic, the derivative of this by r is 0, which gives Omega. */
static double line(double a, double r, double omega)
{
    return -(1 - 2 / r) - 4 * a / r * omega + (r * r + a * a + 2 * a * a / r) * omega * omega;
}
static double orbit_omega(double a, double r)
{
    double low = 0, high = 1 / r;
    for (int i = 0; i < 60; i++) {
        double o = 0.5 * (low + high), h = 1e-3 * r;
        double force = 8 * (line(a, r + h, o) - line(a, r - h, o)) - line(a, r + 2 * h, o) + line(a, r - 2 * h, o);
        *(force < 0 ? &low : &high) = o;
    }
    return 0.5 * (low + high);
}

/* Cosine of the angle to the plane's normal in the gas's frame: the component of the photon's momentum along the
 * normal, divided by the photon's energy. */
static double cosine(const struct ks_photon *p, const struct ks_path *path)
{
    double r = path->r[0], omega = orbit_omega(p->a, r);
    return path->p_z[0] * sqrt(-line(p->a, r, omega)) / (p->energy - omega * p->momentum);
}

#define DEPTH 3.0

/* The picture is divided by that of an opaque disk. The ratio is the fraction that a crossing absorbs: 1 - exp(-depth
 * F/F_max/cos). The dimmest pixels that are compared have a resolution of 1e-3 in 16 bits. */
static void emission_angle(void **state)
{
    (void)state;
    static const char *views[] = {
        "\"spacetime\":{\"spin\":0.9},\"camera\":{\"inclination_deg\":60,\"field_m\":30},\"style\":{\"exposure\":-1,",
        "\"spacetime\":{\"spin\":0.3},\"camera\":{\"inclination_deg\":84,\"field_m\":30},\"style\":{\"exposure\":-2,",
        "\"spacetime\":{\"spin\":-0.6},\"camera\":{\"inclination_deg\":110,\"field_m\":40},\"style\":{\"exposure\":-1,",
        "\"spacetime\":{\"spin\":0.7},\"camera\":{\"r\":25,\"inclination_deg\":75,\"fov_deg\":60},\"style\":{"
        "\"exposure\":-2,",
    };
    double worst = 0, least = 1, most = 0;
    for (size_t v = 0; v < sizeof views / sizeof *views; v++) {
        char json[600];
        snprintf(
            json, sizeof json,
            "{%s\"tone_map\":\"srgb\",\"dither\":false},\"disk\":{\"outer\":14,\"taper\":0},\"accuracy\":{\"orders\":1,"
            "\"profile\":\"high\"},\"image\":{\"width\":48,\"height\":36,\"bit_depth\":16,\"critical_factor\":1}}",
            views[v]);
        struct kd_scene scene = studio_scene(NULL, json);
        struct kd_frame opaque = studio_render(&scene);
        scene.disk.emission_opacity = DEPTH;
        struct kd_frame thin = studio_render(&scene);
        double a = scene.spacetime.spin,
               peak = kd_disk_flux_page_thorne(kd_hole(a), kd_disk_peak_page_thorne(kd_hole(a)));
        int looked_at = 0;
        for (uint32_t i = 0; i < thin.width * thin.height; i++) {
            uint32_t x = i % thin.width, y = i / thin.width;
            double all = studio_luminance(&opaque, x, y), seen = studio_luminance(&thin, x, y);
            if (all < 0.02)
                continue;
            struct ks_photon photon = photon_of(&scene, x, y);
            struct ks_path path = ks_trace(photon, 1);
            assert_int_equal(path.crossings, 1);
            double tilt = cosine(&photon, &path),
                   depth = DEPTH * kd_disk_flux_page_thorne(kd_hole(a), path.r[0]) / peak;
            double off = fabs(seen / all - (1 - exp(-depth / tilt)));
            if (!(off < 1.5e-3))
                fail_msg("view %zu, (%u, %u), r %g: %g of the light, expected %g", v, x, y, path.r[0], seen / all,
                         1 - exp(-depth / tilt));
            worst = fmax(worst, off);
            least = fmin(least, tilt);
            most = fmax(most, tilt);
            looked_at++;
        }
        assert_true(looked_at > 150);
        kd_frame_finish(&opaque);
        kd_frame_finish(&thin);
    }
    printf("share of light that gas gives off: off by %.1e at most, cosines from %.2f to %.2f\n", worst, least, most);
    assert_true(least < 0.15 && most > 0.9);
}

/* Sum of the light of all pixels. */
static double sum_of(const struct kd_scene *scene)
{
    struct kd_frame f = studio_render(scene);
    double sum = 0;
    for (uint32_t i = 0; i < f.width * f.height; i++) {
        double light = studio_luminance(&f, i % f.width, i / f.width);
        assert_true(light >= 0); /* nothing is clipped */
        sum += light;
    }
    kd_frame_finish(&f);
    return sum;
}

/* Averaged over seeds, an opaque turbulent disk has the light of the smooth one: turbulence redistributes light without
 * adding or removing any. This holds for each number of octaves. Each seed deviates by some percent. The mean may
 * deviate by its standard error, which follows from the scatter of the seeds. */
static void flux_is_kept(void **state)
{
    (void)state;
    enum { SEEDS = 60 };
    struct kd_scene scene = studio_scene(
        NULL, "{\"camera\":{\"inclination_deg\":30,\"field_m\":50},\"accuracy\":{\"orders\":1},\"style\":"
              "{\"exposure\":-5,\"tone_map\":\"srgb\",\"dither\":false},\"image\":{\"width\":96,\"height\":72,"
              "\"bit_depth\":16}}");
    double smooth = sum_of(&scene);
    scene.gas.amplitude = 0.8;
    for (scene.gas.octaves = 1; scene.gas.octaves <= 7; scene.gas.octaves += 3) {
        double mean = 0, square = 0;
        for (scene.gas.seed = 1; scene.gas.seed <= SEEDS; scene.gas.seed++) {
            double ratio = sum_of(&scene) / smooth;
            mean += ratio / SEEDS;
            square += ratio * ratio / SEEDS;
        }
        double scatter = sqrt((square - mean * mean) / SEEDS);
        printf("flux with %d octaves: %.4f of the smooth disk's, scatter of the mean %.4f\n", scene.gas.octaves, mean,
               scatter);
        assert_true(scatter > 1e-4 && scatter < 0.01);
        assert_true(fabs(mean - 1) < 3 * scatter + 2e-3);
    }
}

static bool same_pixels(const struct kd_scene *a, const struct kd_scene *b)
{
    struct kd_frame f = studio_render(a), g = studio_render(b);
    bool same = !memcmp(kd_frame_pixels(&f), kd_frame_pixels(&g), 3 * (size_t)f.width * f.height);
    kd_frame_finish(&f);
    kd_frame_finish(&g);
    return same;
}

/* A scene gives the same picture, whatever was rendered before it. Another seed or time gives another picture, except
 * when turbulence is off. */
static void one_scene_one_picture(void **state)
{
    (void)state;
    struct kd_scene smooth = studio_scene(NULL, "{\"image\":{\"width\":96,\"height\":54}}"), off = smooth, gas = smooth,
                    other;
    off.gas.octaves = 3;
    off.gas.scale = 1;
    off.gas.seed = 9;
    assert_true(same_pixels(&smooth, &off));
    gas.gas.amplitude = 0.8;
    gas.disk.emission_opacity = 20;
    other = gas;
    other.gas.seed = 2;
    assert_false(same_pixels(&smooth, &gas));
    assert_false(same_pixels(&other, &gas));
    assert_true(same_pixels(&gas, &gas));
    other = gas;
    other.top.time = 1e9;
    assert_false(same_pixels(&other, &gas));
    assert_true(same_pixels(&other, &other));
}

/* Brightness divided by that of the smooth disk, minus 1. This is a map of the pattern whose mean over seeds is 0. The
 * map's side is not a power of any integer. */
enum { SIDE = 60, BANDS = 6 };
struct map { double at[SIDE][SIDE]; };

static struct map pattern(struct kd_scene scene)
{
    struct map out;
    struct kd_frame gas = studio_render(&scene);
    scene.gas.amplitude = 0;
    struct kd_frame smooth = studio_render(&scene);
    for (int i = 0; i < SIDE * SIDE; i++) {
        uint32_t x = (uint32_t)(i % SIDE), y = (uint32_t)(i / SIDE);
        double light = studio_luminance(&gas, x, y), of = studio_luminance(&smooth, x, y);
        assert_true(light >= 0);
        out.at[y][x] = of > 1e-3 ? light / of - 1 : 0;
    }
    kd_frame_finish(&gas);
    kd_frame_finish(&smooth);
    return out;
}

/* |Fourier transform|^2. Rows are transformed first, then columns. */
static void power_of(const struct map *m, double out[SIDE][SIDE])
{
    static double c[SIDE], s[SIDE], re[SIDE][SIDE], im[SIDE][SIDE];
    for (int k = 0; k < SIDE; k++)
        c[k] = cos(2 * M_PI * k / SIDE), s[k] = sin(2 * M_PI * k / SIDE);
    memset(re, 0, sizeof re);
    memset(im, 0, sizeof im);
    for (int y = 0; y < SIDE; y++)
        for (int k = 0; k < SIDE; k++)
            for (int x = 0; x < SIDE; x++) {
                re[y][k] += m->at[y][x] * c[k * x % SIDE];
                im[y][k] -= m->at[y][x] * s[k * x % SIDE];
            }
    for (int l = 0; l < SIDE; l++)
        for (int k = 0; k < SIDE; k++) {
            double a = 0, b = 0;
            for (int y = 0; y < SIDE; y++) {
                a += re[y][k] * c[l * y % SIDE] + im[y][k] * s[l * y % SIDE];
                b += im[y][k] * c[l * y % SIDE] - re[y][k] * s[l * y % SIDE];
            }
            out[l][k] = a * a + b * b;
        }
}

/* Index of the band of a wave number, 0 to BANDS - 1. Waves along the picture's axes have their own band, because a
 * lattice would appear there. */
static int band_of(int l, int k)
{
    int y = l > SIDE / 2 ? SIDE - l : l, x = k > SIDE / 2 ? SIDE - k : k;
    if ((x == 0 || y == 0) && x + y > 3)
        return BANDS - 1;
    int band = (int)(sqrt(x * x + y * y) / (SIDE / 2.0) * (BANDS - 1));
    return band < BANDS - 1 ? band : BANDS - 2;
}

static struct kd_scene from_above(void)
{
    return studio_scene(
        NULL,
        "{\"camera\":{\"inclination_deg\":0,\"field_m\":44},\"accuracy\":{\"orders\":1},\"style\":"
        "{\"exposure\":-4,\"tone_map\":\"srgb\",\"dither\":false},\"disk\":{\"gas\":{\"amplitude\":0.8,\"octaves\":5}},"
        "\"image\":{\"width\":60,\"height\":60,\"samples\":2,\"bit_depth\":16}}");
}

/* The patterns of two hundred seeds are independent. The power of each wave in their mean is therefore a two-hundredth
 * of the power in one pattern. A ring, seam or lattice that all patterns share would remain. The ratio of powers over n
 * waves scatters by sqrt(1/n). In a real map each wave occurs twice, and some 4 neighbouring waves are correlated. */
static void nothing_in_common(void **state)
{
    (void)state;
    enum { SEEDS = 200 };
    static struct map mean, one;
    static double power[SIDE][SIDE], total[SIDE][SIDE], profile[SIDE / 2], scatter[SIDE / 2];
    struct kd_scene scene = from_above();
    memset(&mean, 0, sizeof mean);
    for (scene.gas.seed = 1; scene.gas.seed <= SEEDS; scene.gas.seed++) {
        double ring[SIDE / 2] = { 0 };
        int n[SIDE / 2] = { 0 };
        one = pattern(scene);
        power_of(&one, power);
        for (int i = 0; i < SIDE * SIDE; i++) {
            double r = hypot(i % SIDE - 0.5 * (SIDE - 1), (int)(i / SIDE) - 0.5 * (SIDE - 1));
            (&mean.at[0][0])[i] += (&one.at[0][0])[i] / SEEDS;
            (&total[0][0])[i] += (&power[0][0])[i] / SEEDS;
            if (r < SIDE / 2) {
                ring[(int)r] += (&one.at[0][0])[i];
                n[(int)r]++;
            }
        }
        for (int k = 0; k < SIDE / 2; k++) {
            profile[k] += ring[k] / n[k] / SEEDS;
            scatter[k] += pow(ring[k] / n[k], 2) / SEEDS;
        }
    }
    power_of(&mean, power);
    double sum[BANDS] = { 0 };
    int waves[BANDS] = { 0 };
    for (int l = 0; l < SIDE; l++)
        for (int k = 0; k < SIDE; k++) {
            int band = band_of(l, k);
            sum[band] += SEEDS * power[l][k] / total[l][k];
            waves[band]++;
        }
    for (int band = 0; band < BANDS; band++) {
        double ratio = sum[band] / waves[band], allowed = 4 * sqrt(8.0 / waves[band]);
        printf("waves of band %d: %.3f of the power that independence leaves, 1 within %.2f\n", band, ratio, allowed);
        assert_true(fabs(ratio - 1) < allowed);
    }
    for (int k = 0; k < SIDE / 2; k++) /* at each radius: the mean divided by its standard error */
        if (scatter[k] > 0 && !(fabs(profile[k]) < 4.5 * sqrt(scatter[k] / SEEDS)))
            fail_msg("at radius %d the mean is off by %g, its scatter is %g", k, profile[k], sqrt(scatter[k] / SEEDS));
}

/* Two measures are constant in time within the scatter of patterns: the power of the pattern's waves in bands, and the
 * pattern's change from pixel to pixel along a radius. If shear wound up the pattern, the change from pixel to pixel
 * would grow. */
static void nothing_winds_up(void **state)
{
    (void)state;
    enum { SEEDS = 24, MEASURES = BANDS + 1 };
    static const double times[] = { 0, 1e5, 1e9 };
    static double power[SIDE][SIDE];
    double mean[3][MEASURES] = { 0 }, square[3][MEASURES] = { 0 };
    struct kd_scene scene = from_above();
    for (int t = 0; t < 3; t++)
        for (scene.gas.seed = 1; scene.gas.seed <= SEEDS; scene.gas.seed++) {
            scene.top.time = times[t];
            const struct map m = pattern(scene);
            double of[MEASURES] = { 0 };
            power_of(&m, power);
            for (int i = 0; i < SIDE * SIDE; i++)
                of[band_of(i / SIDE, i % SIDE)] += (&power[0][0])[i];
            for (int x = 0; x + 1 < SIDE; x++)
                of[BANDS] += pow(m.at[SIDE / 2][x + 1] - m.at[SIDE / 2][x], 2) +
                             pow(m.at[x + 1][SIDE / 2] - m.at[x][SIDE / 2], 2);
            for (int k = 0; k < MEASURES; k++) {
                mean[t][k] += log(of[k]) / SEEDS;
                square[t][k] += pow(log(of[k]), 2) / SEEDS;
            }
        }
    for (int t = 1; t < 3; t++)
        for (int k = 0; k < MEASURES; k++) {
            double scatter = sqrt((square[0][k] - pow(mean[0][k], 2) + square[t][k] - pow(mean[t][k], 2)) / SEEDS);
            printf("t %g, measure %d: off by %.3f, scatter %.3f\n", times[t], k, mean[t][k] - mean[0][k], scatter);
            assert_true(scatter < 0.25 && fabs(mean[t][k] - mean[0][k]) < 4 * scatter);
        }
}

/* Almost edge-on, the gas varies from seed to seed as much with one ray a pixel as with 64, because unresolved
 * structure is faded to its mean. Without this fading the variation with one ray would be more than half as large
 * again. */
static void one_ray_varies_as_many(void **state)
{
    (void)state;
    enum { SEEDS = 24, WIDTH = 64, HEIGHT = 36 };
    struct kd_scene scene = studio_scene(
        NULL,
        "{\"camera\":{\"inclination_deg\":85,\"field_m\":4.6},\"accuracy\":{\"orders\":1},\"style\":{\"exposure\":-6.5,"
        "\"tone_map\":\"srgb\",\"dither\":false},\"disk\":{\"gas\":{\"amplitude\":0.8}},\"image\":"
        "{\"width\":64,\"height\":36,\"bit_depth\":16,\"critical_factor\":1}}");
    double variance[2] = { 0 };
    for (int v = 0; v < 4; v++) { /* two regions, each a tenth of the picture: beside the hole, and above it */
        int k = v % 2;
        static double sum[WIDTH * HEIGHT], square[WIDTH * HEIGHT];
        memset(sum, 0, sizeof sum);
        memset(square, 0, sizeof square);
        scene.image.samples = k ? 8 : 1;
        scene.camera.centre_alpha = v < 2 ? -10 : 1;
        scene.camera.centre_beta = v < 2 ? 0.5 : 6;
        for (scene.gas.seed = 1; scene.gas.seed <= SEEDS; scene.gas.seed++) {
            struct kd_frame f = studio_render(&scene);
            for (uint32_t i = 0; i < WIDTH * HEIGHT; i++) {
                double light = studio_luminance(&f, i % WIDTH, i / WIDTH);
                assert_true(light >= 0);
                sum[i] += light / SEEDS;
                square[i] += light * light / SEEDS;
            }
            kd_frame_finish(&f);
        }
        for (int i = 0; i < WIDTH * HEIGHT; i++)
            variance[k] += square[i] - sum[i] * sum[i];
    }
    printf("variance by one ray a pixel over that by 64: %.3f\n", variance[0] / variance[1]);
    assert_true(fabs(variance[0] / variance[1] - 1) < 0.2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(emission_angle),         cmocka_unit_test(flux_is_kept),
        cmocka_unit_test(nothing_in_common),      cmocka_unit_test(nothing_winds_up),
        cmocka_unit_test(one_ray_varies_as_many), cmocka_unit_test(one_scene_one_picture),
    };
    int status = studio_open();
    if (status)
        return status;
    status = cmocka_run_group_tests(tests, NULL, NULL);
    studio_close();
    return status;
}

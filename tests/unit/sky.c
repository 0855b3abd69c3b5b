/* Tests of skies: the catalogue and its star counts, orientations compared with published places, generated stars, the
 * panorama and its packing. */
#include "render/sky/frame.h"
#include "render/sky/panorama.h"
#include "render/sky/star.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define DEGREE (M_PI / 180)
#define NEAR(x, y, by) assert_true(fabs((x) - (y)) <= (by))

/* The number of stars of each magnitude, as counted in the package by other means; Sirius and Canopus from ESA, The
 * Hipparcos Catalogue. */
static void the_catalogue_is_whole(void **state)
{
    (void)state;
    static const struct {
        double magnitude;
        size_t n;
    } counts[] = { { 6, 4995 }, { 6.5, 8789 }, { 7.5, 25503 }, { 9, 83037 }, { 11, 115416 }, { 14, 118216 } };
    size_t k = 0;
    double before = -9;
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        while (k < KD_STARS_CATALOGUE && kd_catalogue_star(k).magnitude < counts[i].magnitude) {
            const struct kd_catalogue_star s = kd_catalogue_star(k++);
            assert_true(s.magnitude >= before && s.ra >= 0 && s.ra < 2 * M_PI && fabs(s.dec) <= M_PI / 2 &&
                        s.colour >= -0.4 && s.colour <= 3);
            before = s.magnitude;
        }
        assert_int_equal(k, counts[i].n);
    }
    const struct kd_catalogue_star sirius = kd_catalogue_star(0), canopus = kd_catalogue_star(1);
    NEAR(sirius.ra / DEGREE, 101.2872, 2e-3);
    NEAR(sirius.dec / DEGREE, -16.7161, 2e-3);
    NEAR(sirius.magnitude, -1.44, 1e-9);
    NEAR(sirius.colour, 0.009, 1e-9);
    NEAR(canopus.ra / DEGREE, 95.9880, 2e-3);
    NEAR(canopus.dec / DEGREE, -52.6957, 2e-3);
}

/* Flux computed by hand: five magnitudes are a factor of 100; a square arcsecond is 2.350443e-11 sr. The Sun's
 * colour, 0.65, is that of 5770 K (Ballesteros 2012, whose fit gives 5778 K for 0.648). */
static void light_and_colour(void **state)
{
    (void)state;
    NEAR(kd_star_flux(21) / 2.350443e-11, 1, 1e-6);
    NEAR(kd_star_flux(1) / kd_star_flux(21), 1e8, 1);
    NEAR(kd_star_kelvin(0.648), 5778, 10);
    assert_true(kd_star_kelvin(-0.3) > 15000 && kd_star_kelvin(1.6) < 3800);
}

/* Galactic coordinates l, b by SIMBAD: M42, omega Cen, M31, and the pole. */
static void galactic_places(void **state)
{
    (void)state;
    static const struct {
        double ra, dec, l, b;
    } places[] = {
        { 83.82208, -5.39111, 209.0137, -19.3816 }, { 201.69683, -47.47958, 309.1017, 14.9684 },
        { 10.68479, 41.26906, 121.1743, -21.5733 }, { 266.41684, -29.00781, 359.94423, -0.04616 },
        { 187.70593, 12.39112, 283.7777, 74.4912 },
    };
    const struct kd_rotation r = kd_rotation_galactic();
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const struct kd_vec n = kd_rotate(&r, kd_sky_direction(places[i].ra * DEGREE, places[i].dec * DEGREE));
        const struct kd_vec want = kd_sky_direction(places[i].l * DEGREE, places[i].b * DEGREE);
        NEAR(hypot(hypot(n.x - want.x, n.y - want.y), n.z - want.z), 0, 2e-5);
    }
}

static double determinant(const struct kd_rotation *r)
{
    const double (*m)[3] = r->m;
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/* No orientation mirrors the sky. The object after which an orientation is named lies at its stated place, whatever the
 * inclination. */
static void orientations(void **state)
{
    (void)state;
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    const struct kd_rotation galactic = kd_rotation_galactic();
    for (int o = KD_SKY_GALACTIC; o <= KD_SKY_M87; o++)
        for (double inclination = 5; inclination < 180; inclination += 34) {
            scene.sky.orientation = o;
            scene.camera.inclination_deg = inclination;
            const struct kd_rotation r = kd_sky_rotation(&scene);
            const double i = inclination * DEGREE;
            const struct kd_vec behind = kd_rotate(&r, (struct kd_vec) { -sin(i), 0, -cos(i) }),
                                pole = kd_rotate(&r, (struct kd_vec) { 0, 0, 1 });
            const struct kd_vec above = kd_rotate(&r, (struct kd_vec) { -cos(i), 0, sin(i) }),
                                right = kd_rotate(&r, (struct kd_vec) { 0, 1, 0 });
            NEAR(determinant(&r), 1, 1e-12);
            struct kd_vec want = { 0, 0, 1 };
            if (o == KD_SKY_EQUATORIAL)
                want = kd_rotate(&galactic, want);
            if (o == KD_SKY_GALACTIC || o == KD_SKY_EQUATORIAL)
                NEAR(hypot(hypot(pole.x - want.x, pole.y - want.y), pole.z - want.z), 0, 1e-12);
            if (o == KD_SKY_SGRA) /* l grows to the left, b upwards */
                assert_true(behind.x > 0.999998 && right.y < -0.99999 && above.z > 0.99999);
            if (o == KD_SKY_M87) {
                const struct kd_vec m87 = kd_rotate(&galactic, kd_sky_direction(187.70593 * DEGREE, 12.39112 * DEGREE));
                NEAR(hypot(hypot(behind.x - m87.x, behind.y - m87.y), behind.z - m87.z), 0, 1e-9);
            }
        }
}

static struct kd_stars stars_of(int model, int seed, double limit)
{
    struct kd_scene scene;
    struct kd_stars stars;
    struct kd_error error;
    kd_scene_defaults(&scene);
    scene.sky.model = model;
    scene.sky.seed = seed;
    scene.sky.limit_mag = limit;
    assert_int_equal(kd_stars_make(&scene, &stars, &error), KD_OK);
    return stars;
}

/* The number of generated stars is that of the catalogue where it is complete, within a quarter. One seed always gives
 * the same stars, and another seed gives others. */
static void made_up_stars(void **state)
{
    (void)state;
    struct kd_stars one = stars_of(KD_SKY_STARS, 1, 14), same = stars_of(KD_SKY_STARS, 1, 14),
                    other = stars_of(KD_SKY_STARS, 2, 14);
    struct kd_stars few = stars_of(KD_SKY_STARS, 1, 6), real = stars_of(KD_SKY_CATALOGUE, 1, 14);
    assert_true(one.n == same.n && one.n <= KD_STARS_MADE_UP && one.n > KD_STARS_MADE_UP - 100);
    assert_memory_equal(one.at, same.at, one.n * sizeof *one.at);
    assert_true(memcmp(one.at, other.at, 1000 * sizeof *one.at));
    assert_memory_equal(one.at, few.at, few.n * sizeof *one.at);
    for (double m = 4; m < 7.6; m += 0.5) {
        size_t a = 0, b = 0;
        while (one.at[a].flux > kd_star_flux(m))
            a++;
        while (real.at[b].flux > kd_star_flux(m))
            b++;
        assert_true((double)a > 0.75 * (double)b && (double)a < 1.33 * (double)b);
    }
    for (size_t i = 0; i < one.n; i++)
        assert_true(fabsf(one.at[i].x * one.at[i].x + one.at[i].y * one.at[i].y + one.at[i].z * one.at[i].z - 1) <
                        1e-5f &&
                    one.at[i].kelvin > 2000 && one.at[i].kelvin < 1e5f);
    kd_stars_finish(&one);
    kd_stars_finish(&same);
    kd_stars_finish(&other);
    kd_stars_finish(&few);
    kd_stars_finish(&real);
}

/* In the packed format the largest channel has nine bits. */
static void packing(void **state)
{
    (void)state;
    for (int i = 0; i < 20000; i++) {
        const float scale = ldexpf(1, i % 29 - 14),
                    in[3] = { scale * (float)(i % 97) / 96, scale * (float)(i % 89) / 88,
                              scale * (float)(i % 83) / 82 };
        float out[3], most = fmaxf(fmaxf(in[0], in[1]), in[2]);
        kd_panorama_unpack(kd_panorama_pack(in), out);
        for (int c = 0; c < 3; c++)
            NEAR(in[c], out[c], most * 0x1.01p-9f + 0x1p-25f);
    }
}

/* The Milky Way is black at the poles. In its plane it has on average some 22 magnitudes a square arcsecond. It is
 * nowhere negative, and the coarsest level is the mean. */
static void the_milky_way(void **state)
{
    (void)state;
    struct kd_sky_picture one, other;
    struct kd_error error;
    double polar = 0, plane = 0, mean[3] = { 0 };
    assert_int_equal(kd_milky_way(1, &one, &error), KD_OK);
    assert_int_equal(kd_milky_way(2, &other, &error), KD_OK);
    const size_t n = (size_t)one.width * one.height, bytes = 3 * n * sizeof *one.texels;
    assert_true(memcmp(one.texels, other.texels, bytes));
    for (size_t i = 0; i < n; i++) {
        const float *t = &one.texels[3 * i];
        size_t row = i / one.width;
        assert_true(t[0] >= 0 && t[1] >= 0 && t[2] >= 0 && t[0] < 10 && isfinite(t[0] + t[1] + t[2]));
        polar += row < one.height / 12 ? t[1] : 0;
        plane += row >= one.height / 2 - 32 && row < one.height / 2 + 32 ? t[1] : 0;
        for (int c = 0; c < 3; c++)
            mean[c] += t[c] / (double)n;
    }
    polar /= one.width * (one.height / 12);
    plane /= one.width * 64;
    assert_true(polar < 3e-3 && plane > 0.1 && plane < 1);
    for (uint32_t y = 0; y < one.height; y++) /* no seam at l = 180 degrees */
        NEAR(one.texels[3 * ((size_t)y * one.width)], one.texels[3 * ((size_t)y * one.width + one.width - 1)],
             0.2 * one.texels[3 * ((size_t)y * one.width)] + 0.02);
    const size_t words = kd_panorama_words(one.width, one.height);
    uint32_t *word = malloc(words * sizeof *word);
    float last[3], sum[3] = { 0 };
    assert_non_null(word);
    assert_int_equal(kd_panorama_fill(&one, word, &error), KD_OK);
    for (int k = 0; k < 8; k++) {
        kd_panorama_unpack(word[words - 8 + (size_t)k], last);
        for (int c = 0; c < 3; c++)
            sum[c] += last[c] / 8;
    }
    for (int c = 0; c < 3; c++)
        NEAR(sum[c] / mean[c], 1, 5e-3);
    free(word);
    kd_sky_picture_finish(&one);
    kd_sky_picture_finish(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_catalogue_is_whole), cmocka_unit_test(light_and_colour), cmocka_unit_test(galactic_places),
        cmocka_unit_test(orientations),           cmocka_unit_test(made_up_stars),    cmocka_unit_test(packing),
        cmocka_unit_test(the_milky_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

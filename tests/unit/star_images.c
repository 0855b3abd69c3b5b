/* Images of stars in maps of the sky that are written down here, and the names of stars by places of the literature. */
#include "render/sky/star_images.h"
#include "render/sky/star_names.h"
#include "render/sky/star.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define DEGREE (M_PI / 180)
enum { WIDTH = 160, HEIGHT = 90, STARS = 400 };

struct sky { float theta[WIDTH * HEIGHT], phi[WIDTH * HEIGHT]; struct kd_vec stars[STARS]; };
struct seen { struct kd_star_image of[4 * STARS]; size_t n; };

static enum kd_status keep(void *user, const struct kd_star_image *image)
{
    struct seen *seen = user;
    assert_true(seen->n < 4 * STARS);
    seen->of[seen->n++] = *image;
    return KD_OK;
}

/* A pinhole camera that looks along x, y to the left, z upwards, `wide` from the middle to the edge; side -1: in a mirror. */
static struct kd_vec seen_at(double x, double y, double wide, int side)
{
    const double unit = tan(wide) / (WIDTH / 2.0), right = side * (x - WIDTH / 2.0) * unit, up = (HEIGHT / 2.0 - y) * unit, n = 1 / sqrt(1 + right * right + up * up);
    return (struct kd_vec) { n, -n * right, n * up };
}

static void fill(struct sky *sky, double wide, int side, double azimuth)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++) {
            const struct kd_vec n = seen_at(x + 0.5, y + 0.5, wide, side);
            sky->theta[y * WIDTH + x] = (float)acos(n.z);
            sky->phi[y * WIDTH + x] = (float)remainder(atan2(n.y, n.x) + azimuth, 2 * M_PI);
        }
}

/* Each star that stands in the picture has one image, where the camera has it, of the pixel's own solid angle, cos^3 over the square of the
 * distance; left is left, but for a mirror. Whatever azimuth the map was turned by, also over the seam at pi. */
static void a_plain_camera(void **state)
{
    (void)state;
    static struct sky sky;
    static const struct { double wide; int side; double azimuth; } cases[] = { { 0.3, 1, 0 }, { 0.3, -1, 0 }, { 1.0, 1, 3 }, { 1.0, 1, -2 } };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double places[STARS][2];
        static struct seen seen;
        srand(7);
        seen.n = 0;
        fill(&sky, cases[c].wide, cases[c].side, cases[c].azimuth);
        for (int i = 0; i < STARS; i++) {
            places[i][0] = 0.6 + (WIDTH - 1.2) * rand() / RAND_MAX;
            places[i][1] = 0.6 + (HEIGHT - 1.2) * rand() / RAND_MAX;
            sky.stars[i] = seen_at(places[i][0], places[i][1], cases[c].wide, cases[c].side);
        }
        const struct kd_sky_places map = { WIDTH, HEIGHT, sky.theta, sky.phi, cases[c].azimuth };
        assert_int_equal(kd_star_images(&map, sky.stars, STARS, keep, &seen), KD_OK);
        assert_int_equal(seen.n, STARS);
        unsigned char found[STARS] = { 0 };
        for (size_t i = 0; i < seen.n; i++) {
            const struct kd_star_image *s = &seen.of[i];
            const double unit = tan(cases[c].wide) / (WIDTH / 2.0), cosine = sky.stars[s->star].x;
            assert_int_equal(found[s->star]++, 0);
            if (fabs(s->x - places[s->star][0]) > 0.01 || fabs(s->y - places[s->star][1]) > 0.01)
                fail_msg("star %zu is at %.3f, %.3f instead of %.3f, %.3f", s->star, s->x, s->y, places[s->star][0], places[s->star][1]);
            assert_true(fabs(s->solid_angle / (unit * unit * cosine * cosine * cosine) - 1) < 0.03);
            assert_int_equal(s->mirrored, cases[c].side < 0);
        }
    }
}

/* A map that takes two halves of the picture to the same sky shows each star twice, the second time mirrored; behind rays that do not escape, and
 * between those that are too far apart, there are none. */
static void folds_and_holes(void **state)
{
    (void)state;
    static struct sky sky;
    static struct seen seen;
    const struct kd_sky_places map = { WIDTH, HEIGHT, sky.theta, sky.phi, 0 };
    seen.n = 0;
    fill(&sky, 0.3, 1, 0);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH / 2; x++) {
            sky.theta[y * WIDTH + WIDTH - 1 - x] = sky.theta[y * WIDTH + x];
            sky.phi[y * WIDTH + WIDTH - 1 - x] = sky.phi[y * WIDTH + x];
        }
    sky.stars[0] = seen_at(30.2, 40.7, 0.3, 1);
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 2);
    assert_true(fabs(seen.of[0].x - 30.2) < 0.01 && !seen.of[0].mirrored && fabs(seen.of[1].x - (WIDTH - 30.2)) < 0.01 && seen.of[1].mirrored);
    for (int i = 0; i < 2; i++) /* the triangle that it lies in */
        sky.theta[(40 + i) * WIDTH + 30] = NAN;
    seen.n = 0;
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 1);
    fill(&sky, 1.45, 1, 0); /* a pixel of 0.1 in the tangent */
    sky.stars[0] = seen_at(WIDTH / 2.0 + 0.3, HEIGHT / 2.0 + 0.4, 1.45, 1);
    seen.n = 0;
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 1);
    fill(&sky, 1.53, 1, 0); /* and of 0.3, more than KD_IMAGES_COARSE */
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 1);
}

/* Stars by their places, J2000, of SIMBAD. */
static void names_are_of_their_stars(void **state)
{
    (void)state;
    static const struct { const char *name, *designation; double ra, dec; } known[] = {
        { "Sirius", "α CMa", 101.2872, -16.7161 }, { "Vega", "α Lyr", 279.2347, 38.7837 }, { "Polaris", "α UMi", 37.9546, 89.2641 },
        { "Betelgeuse", "α Ori", 88.7929, 7.4071 }, { "Deneb", "α Cyg", 310.3580, 45.2803 }, { "Acrux", "α¹ Cru", 186.6496, -63.0991 },
        { "Mizar", "ζ UMa", 200.9814, 54.9254 }, { "Alcor", "g UMa", 201.3064, 54.9880 },
    };
    const char *text = NULL;
    struct kd_star_name name;
    size_t n = 0, found = 0, before = 0;
    for (kd_star_name_next(&text, &name); text; kd_star_name_next(&text, &name)) {
        const struct kd_catalogue_star star = kd_catalogue_star(name.place);
        assert_true((n == 0 || name.place > before) && star.magnitude <= 4.5 && (*name.name || *name.designation));
        before = name.place;
        n++;
        for (size_t i = 0; i < sizeof known / sizeof *known; i++)
            if (!strcmp(known[i].name, name.name)) {
                assert_string_equal(name.designation, known[i].designation);
                assert_true(fabs(star.ra / DEGREE - known[i].ra) < 5e-3 && fabs(star.dec / DEGREE - known[i].dec) < 2e-3);
                found++;
            }
    }
    assert_int_equal(n, KD_STAR_NAMES);
    assert_int_equal(found, sizeof known / sizeof *known);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plain_camera),
        cmocka_unit_test(folds_and_holes),
        cmocka_unit_test(names_are_of_their_stars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

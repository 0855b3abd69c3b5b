/* Tests of images of stars, with synthetic maps of the sky; and of the names of stars, with published places. */
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

struct sky { struct kd_vec rays[WIDTH * HEIGHT], stars[STARS]; };
struct seen {
    struct kd_star_image of[4 * STARS];
    size_t n;
};

static enum kd_status keep(void *user, const struct kd_star_image *image)
{
    struct seen *seen = user;
    assert_true(seen->n < 4 * STARS);
    seen->of[seen->n++] = *image;
    return KD_OK;
}

/* A pinhole camera that looks along x, with y to the left and z upwards. wide: angle from the middle to the edge. side:
 * -1 mirrors the picture. */
static struct kd_vec seen_at(double x, double y, double wide, int side)
{
    const double unit = tan(wide) / (WIDTH / 2.0), right = side * (x - WIDTH / 2.0) * unit,
                 up = (HEIGHT / 2.0 - y) * unit, n = 1 / sqrt(1 + right * right + up * up);
    return (struct kd_vec) { n, -n * right, n * up };
}

static void fill(struct sky *sky, double wide, int side)
{
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH; x++)
            sky->rays[y * WIDTH + x] = seen_at(x + 0.5, y + 0.5, wide, side);
}

static void row_of(const void *of, uint32_t y, struct kd_vec *out)
{
    memcpy(out, ((const struct sky *)of)->rays + y * WIDTH, WIDTH * sizeof *out);
}

static struct kd_sky_map map_of(const struct sky *sky)
{
    return (struct kd_sky_map) { .width = WIDTH, .height = HEIGHT, .coarse = 0.15, .of = sky, .row = row_of };
}

/* Each star in the picture has one image, at the place that the camera gives. The image has the solid angle of its
 * pixel: cos^3 over the square of the distance. Left stays left unless the camera mirrors. If the observer circles the
 * hole, the star of an image is found after the rotation is undone. */
static void a_plain_camera(void **state)
{
    (void)state;
    static struct sky sky;
    static const struct {
        double wide;
        int side;
    } cases[] = { { 0.3, 1 }, { 0.3, -1 }, { 1.0, 1 } };
    for (size_t c = 0; c < sizeof cases / sizeof *cases; c++) {
        double places[STARS][2];
        static struct seen seen;
        srand(7);
        seen.n = 0;
        fill(&sky, cases[c].wide, cases[c].side);
        for (int i = 0; i < STARS; i++) {
            places[i][0] = 0.6 + (WIDTH - 1.2) * rand() / RAND_MAX;
            places[i][1] = 0.6 + (HEIGHT - 1.2) * rand() / RAND_MAX;
            sky.stars[i] = seen_at(places[i][0], places[i][1], cases[c].wide, cases[c].side);
        }
        const struct kd_sky_map map = map_of(&sky);
        assert_int_equal(kd_star_images(&map, sky.stars, STARS, keep, &seen), KD_OK);
        assert_int_equal(seen.n, STARS);
        unsigned char found[STARS] = { 0 };
        for (size_t i = 0; i < seen.n; i++) {
            const struct kd_star_image *s = &seen.of[i];
            const struct kd_vec n = sky.stars[s->star];
            const double unit = tan(cases[c].wide) / (WIDTH / 2.0), x = s->x + 0.5, y = s->y + 0.5, turn = 1e-6;
            assert_int_equal(found[s->star]++, 0);
            if (fabs(x - places[s->star][0]) > 0.01 || fabs(y - places[s->star][1]) > 0.01)
                fail_msg("star %zu is at %.3f, %.3f instead of %.3f, %.3f", s->star, x, y, places[s->star][0],
                         places[s->star][1]);
            assert_true(fabs(s->solid_angle / (unit * unit * n.x * n.x * n.x) - 1) < 0.03);
            assert_int_equal(s->mirrored, cases[c].side < 0);
            const struct kd_vec back = { n.x + turn * n.y, n.y - turn * n.x, n.z };
            const double by_x = (back.y / back.x - n.y / n.x) / turn * -cases[c].side / unit,
                         by_y = (n.z / n.x - back.z / back.x) / turn / unit;
            if (hypot(s->x_by_azimuth - by_x, s->y_by_azimuth - by_y) > 0.03 * hypot(by_x, by_y))
                fail_msg("star %zu goes by %g, %g a radian instead of %g, %g", s->star, s->x_by_azimuth,
                         s->y_by_azimuth, by_x, by_y);
        }
    }
}

/* A map that shows the same sky in both halves of the picture shows each star twice, the second time mirrored. No image
 * is found among rays that do not escape, or between rays that are too far apart. */
static void doubles_and_holes(void **state)
{
    (void)state;
    static struct sky sky;
    static struct seen seen;
    const struct kd_sky_map map = map_of(&sky);
    seen.n = 0;
    fill(&sky, 0.3, 1);
    for (int y = 0; y < HEIGHT; y++)
        for (int x = 0; x < WIDTH / 2; x++)
            sky.rays[y * WIDTH + WIDTH - 1 - x] = sky.rays[y * WIDTH + x];
    sky.stars[0] = seen_at(30.2, 40.7, 0.3, 1);
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 2);
    assert_true(fabs(seen.of[0].x - 29.7) < 0.01 && !seen.of[0].mirrored &&
                fabs(seen.of[1].x - (WIDTH - 30.7)) < 0.01 && seen.of[1].mirrored);
    for (int i = 0; i < 2; i++) /* rays of the triangle that contains the first image */
        sky.rays[(40 + i) * WIDTH + 30].x = NAN;
    seen.n = 0;
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 1);
    fill(&sky, 1.45, 1); /* a pixel is 0.1 in the tangent */
    sky.stars[0] = seen_at(WIDTH / 2.0 + 0.3, HEIGHT / 2.0 + 0.4, 1.45, 1);
    seen.n = 0;
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 1);
    fill(&sky, 1.53, 1); /* a pixel is 0.3, more than is accepted */
    assert_int_equal(kd_star_images(&map, sky.stars, 1, keep, &seen), KD_OK);
    assert_int_equal(seen.n, 1);
}

/* A sky folded along the column FOLD: x is mapped to (x - FOLD)^2. A star at a distance d on one side of the caustic
 * then has two images, at sqrt(d) on either side of the column; a star on the other side has none. */
#define FOLD 70.37
static struct kd_vec folded(double x, double y)
{
    const double right = 1e-3 * (x - FOLD) * (x - FOLD), up = 0.01 * (HEIGHT / 2.0 - y),
                 n = 1 / sqrt(1 + right * right + up * up);
    return (struct kd_vec) { n, -n * right, n * up };
}
static bool folded_exactly(const void *of, double x, double y, struct kd_vec *out)
{
    (void)of;
    *out = folded(x, y);
    return true;
}

/* Both images of a star next to the caustic are found, one of them mirrored, however close to each other. Beyond the
 * caustic there is no image. */
static void pairs_that_merge(void **state)
{
    (void)state;
    static struct sky sky;
    static struct seen seen;
    struct kd_sky_map map = map_of(&sky);
    map.exact = folded_exactly;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        sky.rays[i] = folded(i % WIDTH, i / WIDTH);
    for (double half = 3; half > 0.01; half *= 0.8)
        for (double y = 20.1; y < 21; y += 0.13) {
            sky.stars[0] = folded(FOLD + half, y);
            const double right = -1e-3 * half * half, up = 0.01 * (HEIGHT / 2.0 - y),
                         n = 1 / sqrt(1 + right * right + up * up);
            sky.stars[1] = (struct kd_vec) { n, -n * right, n * up };
            seen.n = 0;
            assert_int_equal(kd_star_images(&map, sky.stars, 2, keep, &seen), KD_OK);
            if (seen.n != 2)
                fail_msg("%zu images %g apart", seen.n, 2 * half);
            for (int k = 0; k < 2; k++) {
                const struct kd_star_image *s = &seen.of[k];
                assert_int_equal(s->star, 0);
                assert_true(fabs(s->x - (FOLD + (s->mirrored ? -half : half))) < 1e-4 && fabs(s->y - y) < 1e-6);
                assert_true(fabs(s->solid_angle / (2e-3 * half * 0.01 * pow(sky.stars[0].x, 3)) - 1) < 1e-2);
            }
            assert_true(seen.of[0].mirrored != seen.of[1].mirrored);
        }
}

/* Stars by their places, J2000, from SIMBAD. */
static void names_are_of_their_stars(void **state)
{
    (void)state;
    static const struct {
        const char *name, *designation;
        double ra, dec;
    } known[] = {
        { "Sirius", "α CMa", 101.2872, -16.7161 }, { "Vega", "α Lyr", 279.2347, 38.7837 },
        { "Polaris", "α UMi", 37.9546, 89.2641 },  { "Betelgeuse", "α Ori", 88.7929, 7.4071 },
        { "Deneb", "α Cyg", 310.3580, 45.2803 },   { "Acrux", "α¹ Cru", 186.6496, -63.0991 },
        { "Mizar", "ζ UMa", 200.9814, 54.9254 },   { "Alcor", "g UMa", 201.3064, 54.9880 },
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
                assert_true(fabs(star.ra / DEGREE - known[i].ra) < 5e-3 &&
                            fabs(star.dec / DEGREE - known[i].dec) < 2e-3);
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
        cmocka_unit_test(doubles_and_holes),
        cmocka_unit_test(pairs_that_merge),
        cmocka_unit_test(names_are_of_their_stars),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

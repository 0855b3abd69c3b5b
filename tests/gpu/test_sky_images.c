/* Tests of sky.image: positions of a panorama's points in the picture, their brightness, the order in which emitters
 * cover each other, and missing panoramas. The panorama is synthetic, with a mark at each of some bright stars. */
#include "image/png.h"
#include "render/output/png.h"
#include "render/render.h"
#include "render/sky/star.h"
#include "scene/asset.h"

#include "render_support.h"

#include <math.h>

#define DEGREE (M_PI / 180)
enum { WIDTH = 960, HEIGHT = 480, COLUMNS = 2048, ROWS = 1024, MARKS = 12 };

/* Pictures that this test provides under invented hashes. kerrd does not check these. */
static struct keeper {
    struct {
        char hash[KD_ASSET_NAME];
        struct kd_buffer png;
    } at[8];
    size_t n, held, taken;
} keeper;

static bool take(void *user, const char *hash, struct kd_asset_bytes *out)
{
    struct keeper *k = user;
    for (size_t i = 0; i < k->n; i++)
        if (!strcmp(k->at[i].hash, hash)) {
            *out = (struct kd_asset_bytes) { k->at[i].png.data, k->at[i].png.size, k };
            k->held++;
            k->taken++;
            return true;
        }
    return false;
}
static void give_back(void *user, struct kd_asset_bytes *bytes)
{
    assert_ptr_equal(bytes->held, user);
    ((struct keeper *)user)->held--;
}
static const struct kd_assets assets = { NULL, take, give_back, "those of this test", &keeper };

static const char *keep(uint32_t width, uint32_t height, const uint8_t *pixels, const char *copyright)
{
    const struct kd_png_text text = { "Copyright", copyright };
    const struct kd_png_params params = { width, height, 8, 1, pixels, &text, *copyright ? 1 : 0 };
    size_t i = keeper.n++;
    assert_true(i < sizeof keeper.at / sizeof *keeper.at);
    snprintf(keeper.at[i].hash, KD_ASSET_NAME, "%064zx", i + 1);
    OK(kd_png_encode(&params, &keeper.at[i].png, &error));
    return keeper.at[i].hash;
}

/* Galactic coordinates by spherical trigonometry (J. Meeus, Astronomical Algorithms, chapter 13, with the pole of
 * J2000). */
static void galactic(double ra, double dec, double *l, double *b)
{
    const double pole_ra = 192.85948 * DEGREE, pole_dec = 27.12825 * DEGREE, node = 122.93192 * DEGREE,
                 x = ra - pole_ra;
    *b = asin(sin(dec) * sin(pole_dec) + cos(dec) * cos(pole_dec) * cos(x));
    *l = node - atan2(cos(dec) * sin(x), sin(dec) * cos(pole_dec) - cos(dec) * sin(pole_dec) * cos(x));
}

/* Stars without an equally bright neighbour, far from the galactic poles. */
static size_t chosen(struct kd_catalogue_star out[MARKS])
{
    size_t n = 0;
    for (size_t k = 0; k < 60 && n < MARKS; k++) {
        const struct kd_catalogue_star s = kd_catalogue_star(k);
        bool alone = true;
        double l, b;
        for (size_t j = 0; j < 60; j++) {
            const struct kd_catalogue_star o = kd_catalogue_star(j);
            alone &= j == k || sin(s.dec) * sin(o.dec) + cos(s.dec) * cos(o.dec) * cos(s.ra - o.ra) < cos(7 * DEGREE);
        }
        galactic(s.ra, s.dec, &l, &b);
        if (alone && fabs(b) < 60 * DEGREE)
            out[n++] = s;
    }
    return n;
}

static const char *marked(void)
{
    static uint8_t pixels[3 * COLUMNS * ROWS];
    struct kd_catalogue_star stars[MARKS];
    size_t n = chosen(stars);
    assert_int_equal(n, MARKS);
    for (size_t i = 0; i < n; i++) {
        double l, b;
        galactic(stars[i].ra, stars[i].dec, &l, &b);
        const double column = (0.5 - l / (2 * M_PI) - floor(0.5 - l / (2 * M_PI))) * COLUMNS,
                     row = (0.5 - b / M_PI) * ROWS;
        for (int y = (int)row - 6; y <= (int)row + 6; y++)
            for (int x = (int)column - 12; x <= (int)column + 12; x++) {
                const double dx = (x + 0.5 - column) * cos(b), dy = y + 0.5 - row,
                             light = exp(-(dx * dx + dy * dy) / (2 * 1.4 * 1.4));
                const double v = light <= 0.0031308 ? 12.92 * light : 1.055 * pow(light, 1 / 2.4) - 0.055;
                uint8_t *p = &pixels[3 * ((size_t)y * COLUMNS + (size_t)(x + COLUMNS) % COLUMNS)];
                p[0] = p[1] = p[2] = (uint8_t)lrint(255 * v);
            }
    }
    return keep(COLUMNS, ROWS, pixels, "Nobody, made for a test");
}

static struct kd_scene scene_of(int model, const char *image)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.camera.r = 1e5;
    scene.camera.inclination_deg = 90;
    scene.camera.projection = KD_PROJECTION_EQUIRECTANGULAR;
    scene.disk.model = KD_DISK_NONE;
    scene.sky.model = model;
    scene.sky.brightness = 1;
    scene.sky.limit_mag = 2.5;
    snprintf(scene.sky.image, sizeof scene.sky.image, "%s", image);
    scene.style.exposure = 0;
    scene.image.width = WIDTH;
    scene.image.height = HEIGHT;
    return scene;
}

static struct kd_frame shot(const struct kd_scene *scene)
{
    struct kd_needs needs = kd_needs_of(scene);
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    needs.radiance = true;
    kd_renderer_capacity(renderer, &c);
    OK(kd_scene_validate(scene, &error));
    OK(kd_plan_make_for(scene, &needs, &c, &plan, &error));
    OK(kd_render(renderer, scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

static const float *light_of(const struct kd_frame *frame) { return frame->layers[1].data; }

struct place { double x, y, light; };
static struct place centre(const struct kd_frame *frame, double x, double y, int reach)
{
    struct place p = { 0 };
    for (int py = (int)floor(y) - reach; py <= (int)floor(y) + reach; py++)
        for (int px = (int)floor(x) - reach; px <= (int)floor(x) + reach; px++) {
            const int row = py < 0 ? 0 : py >= HEIGHT ? HEIGHT - 1 : py;
            const double l = light_of(frame)[3 * ((size_t)row * WIDTH + (size_t)((px + WIDTH) % WIDTH)) + 1];
            p.light += l;
            p.x += l * (px + 0.5);
            p.y += l * (py + 0.5);
        }
    p.x /= p.light;
    p.y /= p.light;
    return p;
}

/* Expected position in the picture. The observer sees the hole at galactic longitude 180, with longitudes growing to
 * the left. From 1e5 M, and more than 30 degrees from the hole, light is bent by less than 0.01 degrees. */
static struct place expected(double l, double b)
{
    const double left = l - M_PI - 2 * M_PI * floor((l - M_PI) / (2 * M_PI) + 0.5);
    return (struct place) { (0.5 - left / (2 * M_PI)) * WIDTH, (0.5 - b / M_PI) * HEIGHT, 0 };
}

/* Marks and catalogue stars coincide, at the places that trigonometry gives. */
static void marks_and_stars(void **state)
{
    const char *image = *state;
    struct kd_catalogue_star stars[MARKS];
    struct kd_scene over = scene_of(KD_SKY_IMAGE, image), under = scene_of(KD_SKY_CATALOGUE, "");
    under.sky.milky_way = 0;
    struct kd_frame picture = shot(&over), points = shot(&under);
    size_t n = chosen(stars), seen = 0;
    double together = 0, alone = 0;
    for (size_t i = 0; i < n; i++) {
        double l, b;
        galactic(stars[i].ra, stars[i].dec, &l, &b);
        const struct place want = expected(l, b);
        if (hypot(want.x - 0.5 * WIDTH, want.y - 0.5 * HEIGHT) < WIDTH / 12.0)
            continue;
        const struct place mark = centre(&picture, want.x, want.y, 6), star = centre(&points, want.x, want.y, 6);
        const double across = cos(b);
        assert_true(mark.light > 1 && star.light > 1);
        seen++;
        together = fmax(together, hypot(across * (mark.x - star.x), mark.y - star.y));
        alone = fmax(alone, hypot(across * (mark.x - want.x), mark.y - want.y));
    }
    printf("%zu marks: within %.3f pixels of their stars, within %.3f of their places\n", seen, together, alone);
    assert_true(seen >= 9 && together < 0.1 && alone < 0.1); /* a pixel is 0.375 degrees wide */
    kd_frame_finish(&picture);
    kd_frame_finish(&points);
}

/* A white sky has the requested brightness, with and without lensing. Near the hole g = 1/sqrt(1 - 2/r): the bolometric
 * light of a black body is multiplied by g^4, and is bluer. */
static void white(void **state)
{
    (void)state;
    static uint8_t pixels[3 * 64 * 32];
    memset(pixels, 255, sizeof pixels);
    const char *image = keep(64, 32, pixels, "");
    static const double radii[] = { INFINITY, 1000, 20, 5 }, bounds[] = { 1e-3, 1e-3, 3e-3, 0.01 };
    for (size_t i = 0; i < sizeof radii / sizeof *radii; i++) {
        struct kd_scene scene = scene_of(KD_SKY_IMAGE, image);
        const double g = isinf(radii[i]) ? 1 : 1 / sqrt(1 - 2 / radii[i]);
        scene.spacetime.spin = 0;
        scene.camera.r = radii[i];
        scene.camera.projection = KD_PROJECTION_AUTO;
        scene.camera.field_m = 60;
        scene.camera.fov_deg = 130;
        scene.sky.brightness = 0.5;
        scene.sky.milky_way = 3;
        struct kd_frame frame = shot(&scene);
        const float *corner = light_of(&frame) + 3 * (size_t)(3 * WIDTH + 5);
        const double luminance = 0.2126 * corner[0] + 0.7152 * corner[1] + 0.0722 * corner[2];
        printf("white from %g M: %.5f of %.5f, blue over red %.3f\n", radii[i], luminance / 1.5, pow(g, 4),
               corner[2] / corner[0]);
        /* A white sky of 5600 K appears with g 5600 K. Its luminance differs from that of the black body by the
         * difference of the two colours. */
        assert_true(fabs(luminance / 1.5 / pow(g, 4) - 1) < bounds[i]);
        assert_true(i < 2 ? fabs(corner[2] / corner[0] - 1) < 0.01 : corner[2] / corner[0] > 1.05);
        assert_string_equal(frame.credit, "");
        kd_frame_finish(&frame);
    }
}

/* Automatic exposure does not brighten a scene that has only a sky. Away from the Milky Way most of such a picture is
 * black, with stars. */
static void space_is_black(void **state)
{
    (void)state;
    static const int models[] = { KD_SKY_STARS, KD_SKY_CATALOGUE, KD_SKY_IMAGE };
    for (size_t i = 0; i < sizeof models / sizeof *models; i++) {
        struct kd_scene scene = scene_of(models[i], "");
        uint32_t counts[256] = { 0 }, below = 0, median = 0;
        scene.camera.r = 40;
        scene.camera.projection = KD_PROJECTION_AUTO;
        scene.camera.pitch_deg = 80;
        scene.sky.limit_mag = 14;
        scene.sky.brightness = i ? 1 : INFINITY; /* tests both a given brightness and the default */
        scene.style.exposure = INFINITY;
        struct kd_frame frame = shot(&scene);
        const uint8_t *shown = frame.layers[0].data;
        for (size_t k = 0; k < (size_t)WIDTH * HEIGHT; k++)
            counts[shown[3 * k + 1]]++;
        for (; (below += counts[median]) < (uint32_t)WIDTH * HEIGHT / 2;)
            median++;
        uint32_t bright = 0;
        for (int level = 128; level < 256; level++)
            bright += counts[level];
        printf("model %d: %.3f stops, median %u of 255, %u pixels above 127\n", models[i], frame.exposure, median,
               bright);
        assert_true(frame.exposure <= log2(0.25 / (i ? 1 : 0.2)) + 1e-12 && median <= 8 &&
                    (models[i] == KD_SKY_IMAGE || bright > 500));
        kd_frame_finish(&frame);
    }
}

/* Automatic exposure does brighten other pictures: false colour, the grid, and a sky whose brightness is given beside a
 * disk. */
static void lifted_all_the_same(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(KD_SKY_CATALOGUE, "");
    /* with brightness 1, exposed down to a quarter of white */
    assert_true(fabs(kd_scene_exposure_most(&scene) + 2) < 1e-15);
    scene.style.palette = KD_PALETTE_HEAT;
    assert_true(isinf(kd_scene_exposure_most(&scene)));
    scene = scene_of(KD_SKY_GRID, "");
    assert_true(isinf(kd_scene_exposure_most(&scene)));
    scene = scene_of(KD_SKY_CATALOGUE, "");
    scene.disk.model = KD_DISK_NOVIKOV_THORNE;
    assert_true(isinf(kd_scene_exposure_most(&scene)));
    scene.sky.brightness = INFINITY; /* the brightness is a hundredth beside a disk */
    assert_true(fabs(kd_scene_exposure_most(&scene) - log2(25)) < 1e-12);
    scene.disk.model = KD_DISK_NONE;
    assert_true(fabs(kd_scene_exposure_most(&scene) - log2(1.25)) < 1e-12);
    scene.volume.model = KD_VOLUME_UNIFORM; /* beside a volume the brightness is a hundredth */
    assert_true(fabs(kd_scene_exposure_most(&scene) - log2(25)) < 1e-12);
}

static double largest(const struct kd_frame *a, const struct kd_frame *b, const struct kd_frame *sum)
{
    double worst = 0;
    for (size_t i = 0; i < 3 * WIDTH * HEIGHT; i++) {
        const double one = light_of(a)[i] + light_of(b)[i], other = light_of(sum)[i];
        worst = fmax(worst, fabs(one - other) / fmax(other, 1e-3));
    }
    return worst;
}

/* Stars are added to a panorama in the same way as to the Milky Way. */
static void stars_over_pictures(void **state)
{
    for (int model = KD_SKY_STARS; model <= KD_SKY_CATALOGUE; model++)
        for (int with = 0; with < 2; with++) {
            const char *image = with ? *state : "";
            struct kd_scene scenes[] = { scene_of(KD_SKY_IMAGE, image), scene_of(model, image),
                                         scene_of(model, image) };
            struct kd_frame frames[3];
            scenes[1].sky.milky_way = 0;
            for (int k = 0; k < 3; k++) {
                scenes[k].camera.r = 12;
                scenes[k].spacetime.spin = 0.9;
                frames[k] = shot(&scenes[k]);
                assert_string_equal(frames[k].credit, with && k != 1 ? "sky: Nobody, made for a test" : "");
            }
            assert_true(largest(&frames[0], &frames[1], &frames[2]) < 1e-5);
            for (int k = 0; k < 3; k++)
                kd_frame_finish(&frames[k]);
        }
}

/* A missing panorama, or a file that is not a picture, is an error at the field, and has no other effect. A file that
 * was missing is read when it exists. A panorama that was evicted from the cache gives the same picture again. */
static void here_and_gone(void **state)
{
    const char *image = *state;
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    struct kd_error why;
    static uint8_t pixels[3 * 32 * 16];
    struct kd_scene scene = scene_of(KD_SKY_IMAGE, image),
                    none = scene_of(KD_SKY_IMAGE, "00000000000000000000000000000000000000000000000000000000000000ff");
    struct kd_frame first = shot(&scene);
    kd_renderer_capacity(renderer, &c);
    OK(kd_plan_make(&none, &c, &plan, &error));
    assert_int_equal(kd_render(renderer, &none, &plan, NULL, NULL, &frame, &why), KD_EINVAL);
    assert_string_equal(why.pointer, "/sky/image");
    assert_string_equal(why.message,
                        "sky.image is \"00000000000000000000000000000000000000000000000000000000000000ff\", whose file "
                        "is missing; it must be those of this test");
    char later[KD_ASSET_NAME];
    snprintf(later, sizeof later, "%064zx", keeper.n + 1);
    none = scene_of(KD_SKY_IMAGE, later);
    assert_int_equal(kd_render(renderer, &none, &plan, NULL, NULL, &frame, &why), KD_EINVAL);
    pixels[5] = 200;
    assert_string_equal(keep(32, 16, pixels, ""), later);
    OK(kd_render(renderer, &none, &plan, NULL, NULL, &frame, &error));
    kd_frame_finish(&frame);
    pixels[5] = 0;
    const char *damaged = keep(32, 16, pixels, "");
    keeper.at[keeper.n - 1].png.data[keeper.at[keeper.n - 1].png.size - 20] ^= 1;
    none = scene_of(KD_SKY_IMAGE, damaged);
    size_t taken = keeper.taken + 1;
    for (int k = 0; k < 2; k++) { /* the file is checked both times */
        memset(&why, 0, sizeof why);
        assert_int_equal(kd_render(renderer, &none, &plan, NULL, NULL, &frame, &why), KD_EINVAL);
        assert_string_equal(why.pointer, "/sky/image");
        assert_non_null(strstr(why.message, "damaged PNG file"));
        assert_int_equal(keeper.taken, taken);
    }
    for (int k = 0; k < 3; k++) { /* other panoramas are read between the two pictures */
        pixels[3 * 40 + k] = 255;
        struct kd_scene other = scene_of(KD_SKY_IMAGE, k < 2 ? keep(32, 16, pixels, "") : "");
        struct kd_frame between = shot(&other);
        assert_true(memcmp(light_of(&between), light_of(&first), 12ull * WIDTH * HEIGHT));
        kd_frame_finish(&between);
    }
    struct kd_frame again = shot(&scene);
    assert_memory_equal(light_of(&again), light_of(&first), 12ull * WIDTH * HEIGHT);
    assert_int_equal(keeper.held, 0);
    kd_frame_finish(&first);
    kd_frame_finish(&again);
}

/* A plan counts the memory for reading a panorama, whose size is not in the scene. */
static void memory(void **state)
{
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_error why;
    struct kd_scene made_up = scene_of(KD_SKY_IMAGE, ""), scene = scene_of(KD_SKY_IMAGE, *state),
                    none = scene_of(KD_SKY_GRID, *state);
    kd_renderer_capacity(renderer, &c);
    c.memory_bytes = 300u << 20;
    OK(kd_plan_make(&made_up, &c, &plan, &error));
    assert_true(plan.cost.making_bytes == 12ull * 2048 * 1024);
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &why), KD_ETOOBIG);
    OK(kd_plan_make(&none, &c, &plan, &error));
    assert_int_equal(plan.cost.making_bytes, 0);
    c.memory_bytes = 600u << 20;
    OK(kd_plan_make(&scene, &c, &plan, &error));
    assert_true(plan.cost.making_bytes == 12ull * 4096 * 2048 + 6ull * 8192 * 4096);
}

/* A picture's file credits the authors whose work it contains, and no others. */
static void credit_in_files(void **state)
{
    for (int with = 0; with < 2; with++) {
        struct kd_scene scene = scene_of(KD_SKY_IMAGE, with ? *state : "");
        struct kd_frame frame = shot(&scene);
        struct kd_buffer file = { 0 };
        struct kd_png png;
        const struct kd_plan none = { 0 };
        const struct kd_picture picture = { &frame, &scene, &none, "here", 0 };
        OK(kd_png_of_picture(&picture, 1, &file, &error));
        OK(kd_png_decode(file.data, file.size, &png, &error));
        const char *text = kd_png_text_find(&png, "Copyright");
        if (with)
            assert_string_equal(text, "sky: Nobody, made for a test");
        else
            assert_null(text);
        kd_png_finish(&png);
        kd_buffer_finish(&file);
        kd_frame_finish(&frame);
    }
}

int main(void)
{
    renderer_assets = &assets;
    int skip = open_renderer();
    if (skip)
        return skip;
    void *image = (void *)marked();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(marks_and_stars, image),
        cmocka_unit_test(white),
        cmocka_unit_test(space_is_black),
        cmocka_unit_test(lifted_all_the_same),
        cmocka_unit_test_prestate(stars_over_pictures, image),
        cmocka_unit_test_prestate(here_and_gone, image),
        cmocka_unit_test_prestate(credit_in_files, image),
        cmocka_unit_test_prestate(memory, image),
    };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (size_t i = 0; i < keeper.n; i++)
        kd_buffer_finish(&keeper.at[i].png);
    return close_renderer(failed);
}

/* Tests that a tile has the same bytes as the same part of the whole picture, for each emitter and projection. The same
 * is tested for the strips of a picture that is too large for the device. */
#include "render/output/format.h"

#include "render_support.h"

enum { WIDTH = 203, HEIGHT = 117, ACROSS = 3, DOWN = 2, STRIPS_W = 64, STRIPS_H = 300 };

static const struct {
    const char *name, *document;
} scenes[] = {
    { "gas", "{}" },
    { "samples", "{\"image\":{\"samples\":2,\"bit_depth\":16}}" },
    { "spots", "{\"spots\":[{\"brightness\":4}]}" },
    { "flash", "{\"flash\":{\"brightness\":4},\"time\":10,\"disk\":{\"slow_light\":true}}" },
    { "pinhole", "{\"camera\":{\"r\":20,\"fov_deg\":70},\"bodies\":[{\"radius\":2}]}" },
    { "sphere", "{\"camera\":{\"r\":20,\"projection\":\"equirectangular\"},\"sky\":{\"model\":\"grid\"}}" },
    { "stars all round",
      "{\"camera\":{\"r\":20,\"projection\":\"equirectangular\"},\"sky\":{\"model\":\"catalogue\"}}" },
    { "falling", "{\"camera\":{\"r\":2.5,\"observer\":\"infall\",\"fov_deg\":90}}" },
    { "listed rays", "{\"disk\":{\"slow_light\":true}}" },
    { "volume", "{\"disk\":{\"model\":\"none\"},\"volume\":{\"model\":\"uniform\"}}" },
    { "stars", "{\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"stars\"}}" },
    { "catalogue", "{\"sky\":{\"model\":\"catalogue\"},\"camera\":{\"r\":15,\"projection\":\"fulldome\"},\"style\":{"
                   "\"exposure\":6}}" },
};

static struct kd_scene scene_of(const char *document, int width, int height)
{
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.style.exposure = scene.style.bloom = 0;
    scene.image.width = width;
    scene.image.height = height;
    OK(kd_scene_from_json(&scene, document, strlen(document), &error));
    return scene;
}

static struct kd_frame by_format(struct kd_scene scene, const struct kd_format *format, uint64_t memory_bytes,
                                 uint32_t *strips)
{
    struct kd_capacity c;
    struct kd_plan plan;
    struct kd_frame frame;
    kd_renderer_capacity(renderer, &c);
    c.memory_bytes = memory_bytes ? memory_bytes : c.memory_bytes;
    OK(kd_scene_validate(&scene, &error));
    OK(kd_format_plan(format, &scene, &c, &plan, &error));
    *strips = plan.picture.strips;
    OK(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, &error));
    return frame;
}

/* Counts the bytes of a tile that differ from the whole picture's. The displayed picture of layers is not in the file.
 */
static size_t off(const struct kd_frame *whole, const struct kd_frame *tile, uint32_t left, uint32_t top)
{
    size_t n = 0;
    assert_int_equal(whole->n_layers, tile->n_layers);
    for (size_t i = tile->n_layers > 1 ? 1 : 0; i < tile->n_layers; i++) {
        const size_t pixel = kd_layer_pixel_bytes(&tile->layers[i]);
        const unsigned char *from = whole->layers[i].data, *to = tile->layers[i].data;
        for (uint32_t y = 0; y < tile->height; y++)
            for (size_t b = 0; b < tile->width * pixel; b++)
                n += from[((top + y) * whole->width + left) * pixel + b] != to[y * tile->width * pixel + b];
    }
    return n;
}

static void compare(const char *name, const struct kd_scene *scene, const struct kd_format *format)
{
    uint32_t none;
    struct kd_frame whole = by_format(*scene, format, 0, &none);
    size_t different = 0;
    for (uint32_t k = 0; k < ACROSS * DOWN; k++) {
        const uint32_t x[] = { k % ACROSS * WIDTH / ACROSS, (k % ACROSS + 1) * WIDTH / ACROSS },
                       y[] = { k / ACROSS * HEIGHT / DOWN, (k / ACROSS + 1) * HEIGHT / DOWN };
        struct kd_frame tile = by_format(
            kd_scene_tile(scene, (struct kd_window) { x[0], y[0], x[1] - x[0], y[1] - y[0] }), format, 0, &none);
        assert_int_equal(tile.width, x[1] - x[0]);
        assert_int_equal(tile.height, y[1] - y[0]);
        different += off(&whole, &tile, x[0], y[0]);
        kd_frame_finish(&tile);
    }
    kd_frame_finish(&whole);
    if (different)
        fail_msg("%s: %zu bytes of tiles are not those of the whole picture", name, different);
}

static void test_tiles_of_pictures(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        const struct kd_scene scene = scene_of(scenes[i].document, WIDTH, HEIGHT);
        compare(scenes[i].name, &scene, &kd_format_png);
    }
}

/* A small tile searches for stars only in a part of the shadow's rim. Its light equals that of the whole picture: where
 * the critical curve crosses the tile, beside the curve, and where the rays of the rim begin and end. */
static void test_small_tiles_of_stars(void **state)
{
    (void)state;
    static const char *const documents[] = {
        "{\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"stars\"},\"camera\":{\"field_m\":16}}",
        "{\"spacetime\":{\"spin\":0.998},\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"stars\"},"
        "\"camera\":{\"r\":15,\"inclination_deg\":89,\"fov_deg\":70}}",
        "{\"spacetime\":{\"spin\":0.998},\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"stars\"},"
        "\"camera\":{\"r\":15,\"inclination_deg\":89,\"projection\":\"equirectangular\",\"yaw_deg\":180}}",
    };
    enum { SIDE = 5, TILES = 24 };
    for (size_t i = 0; i < sizeof documents / sizeof *documents; i++) {
        uint32_t none;
        const struct kd_scene scene = scene_of(documents[i], WIDTH, HEIGHT);
        struct kd_frame whole = by_format(scene, &kd_format_png, 0, &none);
        size_t lit = 0;
        for (uint32_t k = 0; k < 5 * TILES; k++) { /* tiles along a row, a column, a diagonal and both edges */
            const uint32_t step = k % TILES, line = k / TILES,
                           x = line == 1   ? WIDTH / 2
                               : line == 3 ? 0
                               : line == 4 ? WIDTH - SIDE
                                           : step * (WIDTH - SIDE) / (TILES - 1),
                           y = line == 0 ? HEIGHT / 2 : step * (HEIGHT - SIDE) / (TILES - 1);
            const uint32_t left = x < WIDTH - SIDE ? x : WIDTH - SIDE, top = y < HEIGHT - SIDE ? y : HEIGHT - SIDE;
            const struct kd_window window = { left, top, SIDE, SIDE };
            struct kd_frame tile = by_format(kd_scene_tile(&scene, window), &kd_format_png, 0, &none);
            const size_t different = off(&whole, &tile, left, top);
            const unsigned char *bytes = tile.layers[0].data;
            for (uint32_t b = 0; b < 3 * SIDE * SIDE; b++)
                lit += bytes[b] > 8;
            kd_frame_finish(&tile);
            if (different)
                fail_msg("scene %zu: %zu bytes of the tile at %u, %u differ", i, different, left, top);
        }
        kd_frame_finish(&whole);
        assert_true(lit > 300); /* the tiles must contain stars */
    }
}

/* Exposure "auto" and the glare of a lens need the whole picture. */
static void test_tiles_of_numbers(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of("{\"style\":{\"exposure\":\"auto\",\"bloom\":0.4},\"image\":{\"layers\":[\"rgb\","
                                     "\"g\",\"sky_theta\",\"footprint\"]}}",
                                     WIDTH, HEIGHT);
    compare("numbers", &scene, &kd_format_npy);
}

/* Reduces the memory until the picture does not fit on the device in one piece. */
static void test_strips(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of("{\"image\":{\"samples\":3}}", STRIPS_W, STRIPS_H);
    uint32_t none, strips;
    struct kd_frame whole = by_format(scene, &kd_format_png, 0, &none), made;
    uint64_t bytes = 64ull << 20;
    for (made = by_format(scene, &kd_format_png, bytes, &strips); !strips;
         made = by_format(scene, &kd_format_png, bytes, &strips)) {
        kd_frame_finish(&made);
        bytes = bytes / 10 * 9;
    }
    assert_int_equal(none, 0);
    assert_int_equal(made.width, STRIPS_W);
    assert_int_equal(made.height, STRIPS_H);
    assert_int_equal(off(&whole, &made, 0, 0), 0);
    kd_frame_finish(&whole);
    kd_frame_finish(&made);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_tiles_of_pictures),
                                        cmocka_unit_test(test_small_tiles_of_stars),
                                        cmocka_unit_test(test_tiles_of_numbers), cmocka_unit_test(test_strips) };
    int closed = open_renderer();
    return closed ? closed : close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

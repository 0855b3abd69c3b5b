/* Tests that two paths of the transfer kernel give the same light for the same rays. For pixels of one ray, the kernel
 * processes columns, and skips crossings that no emitter reaches. For pixels of several rays, it visits each crossing.
 * */
#include "render/device/device_internal.h"
#include "render/render.h"

#include "render_support.h"

#include <math.h>

/* Compares a picture with 2 x 2 rays a pixel with a picture twice as wide and high with one ray a pixel. */
static void assert_same_light(struct kd_scene scene)
{
    const int w = 96, h = 61; /* the last column of pixels has two rows */
    scene.image.width = w;
    scene.image.height = h;
    scene.image.samples = 2;
    scene.image.critical_factor = 1;
    scene.image.bit_depth = 16;
    scene.style.tone_map = KD_TONE_SRGB;
    scene.style.exposure = -4;
    scene.style.dither = false;
    struct kd_frame coarse = rendered(&scene);
    scene.image.width = 2 * w;
    scene.image.height = 2 * h;
    scene.image.samples = 1;
    struct kd_frame fine = rendered(&scene);
    const uint16_t *a = (const uint16_t *)kd_frame_pixels(&coarse), *b = (const uint16_t *)kd_frame_pixels(&fine);
    double lit = 0;
    for (int y = 0; y < h; y++)
        for (int x = 0; x < w; x++)
            for (int c = 0; c < 3; c++) {
                double sum = 0, one = shown(a, 3 * (size_t)(y * w + x) + (size_t)c);
                for (int i = 0; i < 4; i++)
                    sum += shown(b, 3 * (size_t)((2 * y + i / 2) * 2 * w + 2 * x + i % 2) + (size_t)c);
                lit += one;
                if (fabs(one - sum / 4) > 2e-5 + 1e-4 * one) /* half a step of 16 bits is at most 1.7e-5 here */
                    fail_msg("pixel (%d, %d), channel %d: %.7f by four rays, %.7f by four pixels", x, y, c, one,
                             sum / 4);
            }
    assert_true(lit > 1);
    kd_frame_finish(&coarse);
    kd_frame_finish(&fine);
}

static struct kd_scene scene_of(const char *json)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    OK(kd_scene_from_json(&scene, json, strlen(json), &error));
    return scene;
}

static void test_disk(void **state)
{
    (void)state;
    assert_same_light(scene_of("{\"disk\":{\"opacity\":0.6}}"));
    assert_same_light(scene_of("{\"disk\":{\"opacity\":0.6},\"sky\":{\"model\":\"grid\"}}"));
    assert_same_light(
        scene_of("{\"disk\":{\"inner\":12,\"outer\":15,\"taper\":0},\"camera\":{\"r\":20,\"inclination_deg\":60}}"));
}

/* The bits of one word stand for the crossings of a column: eight rows of three image orders, six rows of five, or four
 * rows of eight. */
static void test_many_orders(void **state)
{
    (void)state;
    assert_same_light(scene_of("{\"disk\":{\"opacity\":0.3},\"accuracy\":{\"orders\":1}}"));
    assert_same_light(scene_of("{\"disk\":{\"opacity\":0.3},\"accuracy\":{\"orders\":5}}"));
    assert_same_light(scene_of("{\"disk\":{\"opacity\":0.3},\"accuracy\":{\"orders\":8}}"));
}

static void test_spots(void **state)
{
    (void)state;
    assert_same_light(scene_of("{\"disk\":{\"model\":\"none\"},\"spots\":[{\"brightness\":3,\"size\":2},{"
                               "\"brightness\":1,\"r\":15,\"phase_deg\":120}]}"));
}

static void test_plunging(void **state)
{
    (void)state;
    assert_same_light(scene_of("{\"spacetime\":{\"spin\":0},\"camera\":{\"inclination_deg\":50,\"field_m\":20},"
                               "\"disk\":{\"model\":\"particles\","
                               "\"plunging\":0.3,\"particles\":50000,\"opacity\":0.9},\"sky\":{\"model\":\"grid\"}}"));
}

static void test_nothing_but_sky(void **state)
{
    (void)state;
    assert_same_light(scene_of("{\"disk\":{\"model\":\"none\"},\"sky\":{\"model\":\"grid\",\"brightness\":5}}"));
}

static void assert_same_readers(struct kd_scene scene)
{
    struct kd_vk_info *info = (struct kd_vk_info *)kd_vk_info(renderer->vk);
    const uint64_t texels = info->max_texels;
    struct kd_scene other;
    scene.image.width = 161;
    scene.image.height = 90;
    scene.image.bit_depth = 16;
    struct kd_frame of_texels = rendered(&scene);
    other = scene;
    for (int i = 0; i < 4; i++) { /* the cache holds four lens maps */
        other.camera.inclination_deg += 1;
        struct kd_frame between = rendered(&other);
        kd_frame_finish(&between);
    }
    /* the device can bind the texels of the emitters' tables, but not those of the lens map */
    info->max_texels = 1u << 17;
    assert_false(kd_kernels_map_as_texels(renderer->vk));
    struct kd_frame of_storage = rendered(&scene);
    info->max_texels = texels;
    assert_false(of_storage.lens_reused);
    assert_memory_equal(kd_frame_pixels(&of_texels), kd_frame_pixels(&of_storage), 6ull * 161 * 90);
    kd_frame_finish(&of_texels);
    kd_frame_finish(&of_storage);
}

/* Footprints and light are the same to the byte whether the lens map and the emitters' buffers are read as texels or as
 * storage. This is tested for pixels of the grid and pixels at the critical curve, and for crossings, the sky, stars
 * (alone, and with other light), and particles. */
static void test_readers(void **state)
{
    (void)state;
    struct kd_scene scene;
    if (!kd_kernels_map_as_texels(renderer->vk))
        skip();
    kd_scene_defaults(&scene);
    scene.sky.model = KD_SKY_GRID;
    assert_same_readers(scene);
    scene.sky.model = KD_SKY_STARS;
    scene.sky.milky_way = 0;
    scene.sky.limit_mag = 7;
    assert_same_readers(scene);
    scene.sky.milky_way = 1;
    scene.disk.model = KD_DISK_PARTICLES;
    scene.disk.particles = 20000;
    assert_same_readers(scene);
}

int main(void)
{
    int status = open_renderer();
    if (status)
        return status;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_disk),     cmocka_unit_test(test_many_orders),     cmocka_unit_test(test_spots),
        cmocka_unit_test(test_plunging), cmocka_unit_test(test_nothing_but_sky), cmocka_unit_test(test_readers),
    };
    return close_renderer(cmocka_run_group_tests(tests, NULL, NULL));
}

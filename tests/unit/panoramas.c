/* Panoramas on the host: which are made ahead of who asks for them, and what that costs those that are asked for. */
#include "image/png.h"
#include "render/device/panoramas.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Assets are all the same picture; one that is named "none" is not there. */
struct shelf { struct kd_buffer file; atomic_int taken; };

static bool take(void *user, const char *hash, struct kd_asset_bytes *out)
{
    struct shelf *shelf = user;
    shelf->taken++;
    out->data = shelf->file.data;
    out->size = shelf->file.size;
    return strcmp(hash, "none") != 0;
}

static void give_back(void *user, struct kd_asset_bytes *bytes) { (void)user, (void)bytes; }

static struct shelf shelf;
static const struct kd_assets assets = { .take = take, .give_back = give_back, .allowed = "names of this test", .user = &shelf };

static int fill_shelf(void **state)
{
    static uint8_t pixels[32 * 16 * 3];
    struct kd_error error;
    (void)state;
    return (int)kd_png_encode(&(struct kd_png_params) { 32, 16, 8, 1, pixels, NULL, 0 }, &shelf.file, &error);
}

static int empty_shelf(void **state)
{
    (void)state;
    kd_buffer_finish(&shelf.file);
    return 0;
}

static struct kd_scene scene_of(const char *image)
{
    struct kd_scene scene = { .sky = { .model = KD_SKY_IMAGE, .milky_way = 1 } };
    snprintf(scene.sky.image, sizeof scene.sky.image, "%s", image);
    return scene;
}

/* How often the asset was taken to have its panorama. */
static int fetch(struct kd_panoramas *all, const char *image, enum kd_status want)
{
    const struct kd_scene scene = scene_of(image);
    const struct kd_panorama *out = NULL;
    struct kd_error error = { 0 };
    const int before = shelf.taken;
    assert_int_equal(kd_panorama_of(all, &scene, &out, &error), want);
    return shelf.taken - before;
}

static void ahead(struct kd_panoramas *all, const char *image)
{
    kd_panorama_ahead(all, image);
    kd_panoramas_stop(all); /* waits for it */
}

static void is_there_when_it_is_asked_for(void **state)
{
    struct kd_panoramas all;
    (void)state;
    kd_panoramas_init(&all, &assets, NULL, NULL);
    ahead(&all, "a");
    assert_int_equal(fetch(&all, "a", KD_OK), 0);
    ahead(&all, "a"); /* is no more than there already */
    assert_int_equal(fetch(&all, "a", KD_OK), 0);
    assert_int_equal(fetch(&all, "b", KD_OK), 1);
    kd_panoramas_finish(&all);
}

/* It takes no place of what somebody has had, and gives its own to who wants one. */
static void has_a_free_place_only(void **state)
{
    struct kd_panoramas all;
    (void)state;
    kd_panoramas_init(&all, &assets, NULL, NULL);
    assert_int_equal(fetch(&all, "a", KD_OK) + fetch(&all, "b", KD_OK) + fetch(&all, "c", KD_OK), 3);
    const int before = shelf.taken;
    ahead(&all, "d");
    assert_int_equal(shelf.taken, before);
    assert_int_equal(fetch(&all, "a", KD_OK) + fetch(&all, "b", KD_OK) + fetch(&all, "c", KD_OK), 0);
    kd_panoramas_finish(&all);

    kd_panoramas_init(&all, &assets, NULL, NULL);
    ahead(&all, "a");
    ahead(&all, "b");
    ahead(&all, "c");
    assert_int_equal(fetch(&all, "d", KD_OK), 1);
    assert_int_equal(fetch(&all, "b", KD_OK) + fetch(&all, "c", KD_OK), 0); /* "a" was the oldest */
    kd_panoramas_finish(&all);
}

/* Nobody is told of one that could not be had but who asks for it, as it is then. */
static void what_fails_is_tried_again(void **state)
{
    struct kd_panoramas all;
    (void)state;
    kd_panoramas_init(&all, &assets, NULL, NULL);
    ahead(&all, "none");
    assert_int_equal(fetch(&all, "none", KD_EINVAL), 1);
    kd_panoramas_finish(&all);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(is_there_when_it_is_asked_for), cmocka_unit_test(has_a_free_place_only),
                                        cmocka_unit_test(what_fails_is_tried_again) };
    return cmocka_run_group_tests(tests, fill_shelf, empty_shelf);
}

/* Tests of panoramas on the host: which panoramas are made ahead of requests, and that this does not evict panoramas
 * that were requested. */
#include "image/png.h"
#include "render/device/panoramas.h"
#include "render/sky/milky_way_file.h"
#include "render/sky/panorama.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

/* A store of assets that all contain the same picture. An asset with the name "none" does not exist. */
struct shelf {
    struct kd_buffer file;
    atomic_int taken;
};

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
static const struct kd_assets assets = {
    .take = take, .give_back = give_back, .allowed = "names of this test", .user = &shelf
};

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

/* Gets the panorama of an image. Returns how often the asset was read for this. */
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
    kd_panoramas_stop(all); /* waits for the thread */
}

static void is_there_when_it_is_asked_for(void **state)
{
    struct kd_panoramas all;
    (void)state;
    kd_panoramas_init(&all, &assets, NULL, NULL);
    ahead(&all, "a");
    assert_int_equal(fetch(&all, "a", KD_OK), 0);
    ahead(&all, "a"); /* has no effect, since the panorama exists already */
    assert_int_equal(fetch(&all, "a", KD_OK), 0);
    assert_int_equal(fetch(&all, "b", KD_OK), 1);
    kd_panoramas_finish(&all);
}

/* A panorama that is made ahead of requests uses only a free entry, and never evicts a requested one. It may itself be
 * evicted by a requested panorama. */
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
    /* "a" was evicted, because it was the oldest */
    assert_int_equal(fetch(&all, "b", KD_OK) + fetch(&all, "c", KD_OK), 0);
    kd_panoramas_finish(&all);
}

/* If making a panorama ahead fails, this is not reported. The next request tries again and reports the result of its
 * own attempt. */
static void what_fails_is_tried_again(void **state)
{
    struct kd_panoramas all;
    (void)state;
    kd_panoramas_init(&all, &assets, NULL, NULL);
    ahead(&all, "none");
    assert_int_equal(fetch(&all, "none", KD_EINVAL), 1);
    kd_panoramas_finish(&all);
}

/* The texels of the Milky Way with this seed. They are made by a process that stores its file at this path. */
static uint32_t *milky_way(const char *path, int32_t seed)
{
    const size_t bytes = kd_panorama_words(KD_MILKY_WAY_WIDTH, KD_MILKY_WAY_HEIGHT) * sizeof(uint32_t);
    const struct kd_scene scene = { .sky = { .model = KD_SKY_STARS, .milky_way = 1, .seed = seed } };
    const struct kd_panorama *out = NULL;
    struct kd_error error = { 0 };
    struct kd_panoramas all;
    uint32_t *words = malloc(bytes);
    kd_panoramas_init(&all, NULL, NULL, NULL);
    kd_panoramas_keep_at(&all, strdup(path));
    assert_non_null(words);
    assert_int_equal(kd_panorama_of(&all, &scene, &out, &error), KD_OK);
    memcpy(words, out->words, bytes);
    kd_panoramas_finish(&all);
    return words;
}

static void put(const char *path, long at, uint8_t byte)
{
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, at, SEEK_SET), 0);
    assert_int_equal(fputc(byte, file), byte);
    assert_int_equal(fclose(file), 0);
}

/* Offset in the file of the first word of a texel. */
static long place(uint32_t row, uint32_t column) { return 32 + 4 * ((long)row * KD_MILKY_WAY_WIDTH + column); }

/* A Milky Way read from the stored file equals the one that was made, to the bit. If the file is of another seed,
 * damaged, cut short, or has other values than the program computes, the Milky Way is made anew and the file is
 * replaced. */
static void what_is_kept_is_what_was_made(void **state)
{
    (void)state;
    const size_t n = kd_panorama_words(KD_MILKY_WAY_WIDTH, KD_MILKY_WAY_HEIGHT), bytes = n * sizeof(uint32_t);
    char folder[] = "/tmp/kerrd-milky-way-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/milky-way", folder);
    uint32_t *made = milky_way(path, 1), *kept = calloc(n, sizeof *kept);
    assert_non_null(kept);
    assert_true(kd_milky_way_recall(path, 1, kept) && !memcmp(kept, made, bytes));
    uint32_t *again = milky_way(path, 1);
    assert_memory_equal(again, made, bytes);
    assert_false(kd_milky_way_recall(path, 2, kept));

    put(path, place(300, 7), 0xa5); /* damages a row that kerrd does not compare with a computed one */
    assert_false(kd_milky_way_recall(path, 1, kept));
    memcpy(kept, made, bytes);
    /* the file is intact, but its values differ from those that the program computes */
    kept[(size_t)512 * KD_MILKY_WAY_WIDTH + 9] ^= 1;
    kd_milky_way_keep(path, 1, kept);
    assert_false(kd_milky_way_recall(path, 1, kept));
    free(again);
    again = milky_way(path, 1);
    assert_memory_equal(again, made, bytes);
    assert_true(kd_milky_way_recall(path, 1, kept)); /* the good file has replaced it */

    assert_int_equal(truncate(path, place(1000, 0)), 0);
    assert_false(kd_milky_way_recall(path, 1, kept));
    assert_int_equal(unlink(path), 0);
    assert_false(kd_milky_way_recall(path, 1, kept));
    assert_int_equal(rmdir(folder), 0);
    free(again);
    free(kept);
    free(made);
}

/* If the folder is not writable, the Milky Way is made anew each time, and nothing fails. */
static void nowhere_to_keep_it(void **state)
{
    (void)state;
    uint32_t *words = milky_way("/proc/self/nowhere/milky-way", 1);
    assert_true(words[(size_t)512 * KD_MILKY_WAY_WIDTH] != 0);
    free(words);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(what_is_kept_is_what_was_made),
                                        cmocka_unit_test(nowhere_to_keep_it),
                                        cmocka_unit_test(is_there_when_it_is_asked_for),
                                        cmocka_unit_test(has_a_free_place_only),
                                        cmocka_unit_test(what_fails_is_tried_again) };
    return cmocka_run_group_tests(tests, fill_shelf, empty_shelf);
}

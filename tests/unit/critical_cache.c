/* Tests of the cached list of a camera. The list is computed once and is eventually evicted. It equals the result of
 * kd_critical_pixels_of, whatever was cached before. */
#include "render/view/critical_cache.h"

#include "scene/table.h"

#include <pthread.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static struct kd_scene scene_of(double spin, int32_t width)
{
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    scene.spacetime.spin = spin;
    scene.image.width = width;
    scene.image.height = width / 2;
    return scene;
}

/* Checks that the cached list equals a new one. Returns the number of lists that were computed. */
static uint64_t check(const struct kd_scene *scene)
{
    struct kd_critical_pixels kept, fresh;
    struct kd_error error;
    uint64_t before = kd_critical_pixels_made();
    assert_int_equal(kd_critical_cache(scene, &kept, &error), KD_OK);
    uint64_t made = kd_critical_pixels_made() - before;
    assert_int_equal(kd_critical_pixels_of(scene, &fresh, &error), KD_OK);
    assert_int_equal(kept.n, fresh.n);
    if (fresh.n)
        assert_memory_equal(kept.pixels, fresh.pixels, fresh.n * sizeof *fresh.pixels);
    kd_critical_pixels_finish(&kept);
    kd_critical_pixels_finish(&fresh);
    return made;
}

static void made_once(void **state)
{
    (void)state;
    struct kd_scene scene = scene_of(0.31, 320);
    assert_int_equal(check(&scene), 1);
    assert_int_equal(check(&scene), 0);
    scene.camera.azimuth_deg = 77;
    scene.disk.outer = 12;
    scene.top.time = 5;
    scene.image.samples = 3;
    scene.style.exposure = 1;
    assert_int_equal(check(&scene), 0);
    scene.camera.field_m = 1e-6; /* no pixel is on the curve; the empty list is cached too */
    assert_int_equal(check(&scene), 1);
    assert_int_equal(check(&scene), 0);
}

/* Every field of the document that moves the curve in the picture is part of the key: after each change the list is
 * correct. */
static void every_field_counts(void **state)
{
    (void)state;
    for (int near = 0; near < 2; near++)
        for (size_t i = 0; i < KD_FIELD_COUNT; i++) {
            struct kd_scene scene = scene_of(0.5, 160);
            if (near)
                scene.camera.r = 20;
            check(&scene);
            const struct kd_row *field = &kd_fields[i];
            if (kd_section_find(field->object)->most || field->kind == KD_KIND_ASSET)
                continue; /* skips fields of lists and names, because the camera has none */
            double value = kd_field_get(&scene, field, 0);
            const double others[] = { value * 0.9 + 0.05, value + 1, 1 - value };
            for (size_t k = 0; k < 3; k++) {
                struct kd_scene other = scene;
                kd_field_put(&other, field, 0, others[k]);
                if (!kd_scene_validate(&other, NULL) && other.image.width <= 400 && other.image.height <= 400 &&
                    other.camera.projection != KD_PROJECTION_RING)
                    check(&other);
            }
        }
}

static void the_oldest_goes(void **state)
{
    (void)state;
    struct kd_scene first = scene_of(0.11, 64), second = scene_of(0.12, 64);
    check(&first);
    check(&second);
    for (int i = 0; i < KD_CRITICAL_KEPT - 1; i++) {
        struct kd_scene other = scene_of(0.6 + 0.001 * i, 64);
        assert_int_equal(check(&other), 1);
        assert_int_equal(check(&first), 0); /* the list stays cached, because it was used recently */
    }
    assert_int_equal(check(&second), 1);
}

/* Long lists evict others, because the cache is also limited in bytes. */
static void long_lists_are_few(void **state)
{
    (void)state;
    struct kd_scene small = scene_of(0.21, 64);
    check(&small);
    size_t bytes = 0;
    for (int i = 0; bytes <= KD_CRITICAL_CACHE_BYTES; i++) {
        assert_true(i < KD_CRITICAL_KEPT - 2);
        struct kd_scene large = scene_of(0.7 + 0.001 * i, 32768);
        struct kd_critical_pixels list;
        struct kd_error error;
        assert_int_equal(kd_critical_cache(&large, &list, &error), KD_OK);
        bytes += list.n * sizeof *list.pixels;
        kd_critical_pixels_finish(&list);
    }
    assert_int_equal(check(&small), 1);
}

static void *many(void *wrong)
{
    for (unsigned i = 0; i < 400; i++) {
        const struct kd_scene scene = scene_of(0.01 * (i * 7 % 23), 32 + 2 * (int32_t)(i % 5));
        struct kd_critical_pixels kept, fresh;
        if (kd_critical_cache(&scene, &kept, NULL) || kd_critical_pixels_of(&scene, &fresh, NULL))
            return wrong;
        bool same =
            kept.n == fresh.n && (!fresh.n || !memcmp(kept.pixels, fresh.pixels, fresh.n * sizeof *fresh.pixels));
        kd_critical_pixels_finish(&kept);
        kd_critical_pixels_finish(&fresh);
        if (!same)
            return wrong;
    }
    return NULL;
}

static void threads_share_it(void **state)
{
    pthread_t threads[4];
    (void)state;
    for (int i = 0; i < 4; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, many, threads), 0);
    for (int i = 0; i < 4; i++) {
        void *wrong;
        pthread_join(threads[i], &wrong);
        assert_null(wrong);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(made_once),          cmocka_unit_test(every_field_counts), cmocka_unit_test(the_oldest_goes),
        cmocka_unit_test(long_lists_are_few), cmocka_unit_test(threads_share_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

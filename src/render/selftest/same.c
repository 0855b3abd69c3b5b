/* Self-test of reproducibility: a picture must not change when it is rendered again, or in pieces. */
#include "render/selftest/parts.h"

#include "render/device/device_internal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The sizes are odd, so that pieces end inside a workgroup. The scene has a sky, so that every ray is traced to its
 * end. */
static struct kd_scene scene_of(void)
{
    struct kd_scene scene;
    kd_scene_smooth(&scene);
    scene.image.width = 157;
    scene.image.height = 91;
    scene.sky.model = KD_SKY_GRID;
    return scene;
}

/* Renders a frame whose lens map is traced: the cache is emptied first. */
static enum kd_status draw(const struct kd_selftest *test, const struct kd_capacity *capacity, struct kd_frame *out,
                           uint32_t *bands)
{
    const struct kd_scene scene = scene_of();
    struct kd_plan plan;
    for (size_t i = 0; i < KD_LENS_MAPS_KEPT; i++)
        test->renderer->store.maps[i].key[0] = '\0';
    enum kd_status status;
    KD_TRY(kd_plan_make(&scene, capacity, &plan, test->error));
    KD_TRY(kd_render(test->renderer, &scene, &plan, NULL, NULL, out, test->error));
    if (bands)
        *bands = plan.picture.bands;
done:
    return status;
}

static double differing(const struct kd_frame *a, const struct kd_frame *b)
{
    const unsigned char *x = kd_frame_pixels(a), *y = kd_frame_pixels(b);
    double n = 0;
    for (size_t i = 0; i < (size_t)a->width * a->height; i++)
        n += memcmp(x + 3 * i, y + 3 * i, 3) != 0;
    return n;
}

/* Renders with one row in each submission, as the renderer does on a very slow device. */
static enum kd_status draw_by_rows(const struct kd_selftest *test, const struct kd_capacity *capacity,
                                   struct kd_frame *out)
{
    struct kd_renderer *r = test->renderer;
    pthread_mutex_lock(&r->lock);
    struct kd_capacity kept = r->capacity;
    r->capacity.ns[KD_NS_RAY_FULL] = r->capacity.ns[KD_NS_RAY_RADIUS] = r->capacity.ns[KD_NS_SAMPLE_TRANSFER] = 1e9;
    pthread_mutex_unlock(&r->lock);
    enum kd_status status = draw(test, capacity, out, NULL);
    pthread_mutex_lock(&r->lock);
    r->capacity = kept;
    pthread_mutex_unlock(&r->lock);
    return status;
}

enum kd_status kd_selftest_same(const struct kd_selftest *test)
{
    static const char *const what[] = { "the same frame twice", "a frame in bands", "a frame in slices of one row" };
    struct kd_capacity whole, narrow;
    struct kd_frame first = { 0 };
    kd_renderer_capacity(test->renderer, &whole);
    narrow = whole;
    narrow.max_binding_bytes = 24 * 157 * 7 + 64; /* room for seven rows */
    enum kd_status status = draw(test, &whole, &first, NULL);
    for (int i = 0; i < 3 && !status; i++) {
        struct kd_frame again = { 0 };
        struct kd_selftest_row row;
        uint32_t bands = 0;
        status = i == 2 ? draw_by_rows(test, &whole, &again) : draw(test, i ? &narrow : &whole, &again, &bands);
        if (status)
            break;
        kd_selftest_begin(&row, "the first frame", "pictures f32", "%s: pixels that differ", what[i]);
        kd_selftest_compare(&row, i == 1 && bands < 2 ? NAN : differing(&first, &again), 0);
        kd_frame_finish(&again);
        status = kd_selftest_end(test, &row);
    }
    kd_frame_finish(&first);
    return status;
}

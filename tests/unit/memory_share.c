/* Tests of the memory that a picture may take, on devices that share the host's memory and on devices with their
 * own. */
#include "render/device/memory_share.h"

#include "render/accuracy/table.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

#define GIB (UINT64_C(1) << 30)

static struct kd_capacity device(uint64_t bytes, bool host_memory)
{
    return (struct kd_capacity) { .max_binding_bytes = 128 << 20,
                                  .max_allocation_bytes = GIB,
                                  .memory_bytes = bytes,
                                  .host_memory = host_memory,
                                  .ns[KD_NS_RAY_RADIUS] = 30,
                                  .ns[KD_NS_RAY_FULL] = 150,
                                  .ns[KD_NS_SAMPLE_TRANSFER] = 20,
                                  .ns[KD_NS_PIXEL_POST] = 30,
                                  .accuracy = kd_accuracy_built_in() };
}

static const struct kd_memory_limit container = { .left = 2 * GIB,
                                                  .own = GIB / 8,
                                                  .by = "the memory.max of a control group" };

static void a_device_that_is_the_host(void **state)
{
    (void)state;
    struct kd_capacity c = device(18 * GIB, true);
    kd_memory_narrow(&c, &container, 0);
    /* three quarters of the memory, if the host has half as much */
    assert_true(c.memory_bytes <= GIB && c.memory_bytes > GIB * 9 / 10);
    assert_string_equal(c.memory_by, "the memory.max of a control group");
    c = device(GIB / 2, true); /* the device has less memory than is free on the host */
    kd_memory_narrow(&c, &container, 0);
    assert_int_equal(c.memory_bytes, GIB / 2);
    assert_null(c.memory_by);
}

/* Memory held for the last picture is available to the next, but only the part that has been written. */
static void what_is_held_counts_once(void **state)
{
    (void)state;
    struct kd_capacity idle = device(18 * GIB, true), working = idle, untouched = idle;
    kd_memory_narrow(&idle, &container, 0);
    kd_memory_narrow(&working, &(struct kd_memory_limit) { GIB, GIB * 9 / 8, container.by }, GIB);
    assert_int_equal(idle.memory_bytes, working.memory_bytes);
    kd_memory_narrow(&untouched, &(struct kd_memory_limit) { 2 * GIB, 0, container.by }, GIB);
    assert_int_equal(untouched.memory_bytes, idle.memory_bytes);
}

static void a_card_has_memory_of_its_own(void **state)
{
    (void)state;
    struct kd_capacity c = device(18 * GIB, false);
    kd_memory_narrow(&c, &container, 5 * GIB);
    assert_int_equal(c.memory_bytes, 18 * GIB);
    assert_true(c.host_bytes > GIB && c.host_bytes < 2 * GIB);
}

static enum kd_status plan_of(uint32_t width, uint32_t height, const struct kd_capacity *c, struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_plan plan;
    kd_scene_defaults(&scene);
    scene.image.width = (int32_t)width;
    scene.image.height = (int32_t)height;
    return kd_plan_make(&scene, c, &plan, error);
}

static void plans_keep_to_it(void **state)
{
    (void)state;
    struct kd_error error = { 0 };
    struct kd_capacity c = device(18 * GIB, true);
    assert_int_equal(plan_of(16384, 12288, &c, &error), KD_OK);
    kd_memory_narrow(&c, &container, 0);
    assert_int_equal(plan_of(16384, 12288, &c, &error), KD_ETOOBIG);
    assert_non_null(strstr(error.message, "GiB of device memory"));
    assert_non_null(strstr(error.message, "the memory.max of a control group"));
    assert_int_equal(plan_of(3840, 2160, &c, &error), KD_OK);
    c = device(18 * GIB, false);
    kd_memory_narrow(&c, &container, 0);
    assert_int_equal(plan_of(8192, 8192, &c, &error), KD_OK); /* the pixels and the file take 0.4 GiB */
    kd_memory_narrow(&c, &(struct kd_memory_limit) { GIB / 2, 0, container.by }, 0);
    assert_int_equal(plan_of(8192, 8192, &c, &error), KD_ETOOBIG);
    assert_non_null(strstr(error.message, "GiB of host memory"));
}

/* Pixels on the host count against the device's memory if the device is the host. */
static void frames_count(void **state)
{
    (void)state;
    struct kd_error error = { 0 };
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_capacity c = device(18 * GIB, false);
    kd_scene_defaults(&scene);
    scene.image.width = scene.image.height = 4096;
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &error), KD_OK);
    c.memory_bytes = plan.cost.device_bytes - 1; /* the lens map is made in bands */
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &error), KD_OK);
    c.memory_bytes = plan.cost.device_bytes;
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &error), KD_OK);
    c.host_memory = true;
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &error), KD_ETOOBIG);
    c.memory_bytes += 2 * plan.cost.host_bytes;
    assert_int_equal(kd_plan_make(&scene, &c, &plan, &error), KD_OK);
}

static void the_watch_reads_this_machine(void **state)
{
    (void)state;
    struct kd_memory_watch watch = { 0 };
    kd_memory_watch(&watch, 0);
    assert_true(watch.known && watch.limit.left > 0 && watch.limit.own > 0);
    watch.limit.left = 7;
    kd_memory_watch(&watch, KD_MEMORY_FRESH_MS / 2);
    assert_int_equal(watch.limit.left, 7);
    kd_memory_watch(&watch, KD_MEMORY_FRESH_MS * 2);
    assert_int_not_equal(watch.limit.left, 7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_device_that_is_the_host),
        cmocka_unit_test(what_is_held_counts_once),
        cmocka_unit_test(a_card_has_memory_of_its_own),
        cmocka_unit_test(plans_keep_to_it),
        cmocka_unit_test(frames_count),
        cmocka_unit_test(the_watch_reads_this_machine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

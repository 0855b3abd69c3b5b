/* Tests of listing and choosing the devices of this machine. */
#include "support.h"
#include "vk/functions.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

static struct kd_vk_info *infos;
static size_t n_infos;

static enum kd_status open_as(const char *device, struct kd_vk **vk, struct kd_error *error)
{
    return kd_vk_create(&(struct kd_vk_params) { .device = device, .cache_dir = "" }, vk, error);
}

static void listed(void **state)
{
    (void)state;
    assert_true(n_infos > 0);
    for (size_t i = 0; i < n_infos; i++) {
        const struct kd_vk_info *info = &infos[i];
        print_message("%zu: %s (%s), %s %s, Vulkan %u.%u, %.0f MiB, subgroup %u%s%s%s\n", i, info->name,
                      kd_vk_type_name(info->type), info->driver, info->driver_info,
                      VK_API_VERSION_MAJOR(info->api_version), VK_API_VERSION_MINOR(info->api_version),
                      (double)info->heap_bytes / 0x1p20, info->subgroup_size, info->float64 ? ", float64" : "",
                      info->timestamps ? ", timestamps" : "", info->missing[0] ? ", unusable" : "");
        assert_int_equal(info->index, i);
        assert_true(info->name[0]);
        if (info->missing[0])
            continue;
        assert_true(info->driver[0] && info->subgroup_size && info->heap_bytes);
        assert_true(info->api_version >= VK_API_VERSION_1_2);
        assert_true(info->max_push_bytes >= 128 && info->max_workgroup >= 128); /* Vulkan guarantees these limits */
        assert_true(info->max_groups_x >= 65535 && info->max_binding_bytes >= 1u << 27);
        assert_true(info->max_allocation_bytes >= 1u << 30);
    }
}

static void by_index_and_name(void **state)
{
    (void)state;
    for (size_t i = 0; i < n_infos; i++) {
        struct kd_vk *vk;
        char text[24];
        snprintf(text, sizeof text, "%zu", i);
        if (infos[i].missing[0]) {
            FAILS(KD_EDEVICE, "lacks", open_as(text, &vk, &error));
            continue;
        }
        OK(open_as(text, &vk, &error));
        assert_string_equal(kd_vk_info(vk)->name, infos[i].name);
        assert_non_null(strstr(kd_vk_choice(vk), infos[i].name));
        kd_vk_destroy(vk);
        OK(open_as(infos[i].name, &vk, &error));
        assert_string_equal(kd_vk_info(vk)->name, infos[i].name);
        kd_vk_destroy(vk);
    }
}

static void automatic(void **state)
{
    struct kd_vk *vk;
    (void)state;
    OK(open_as("auto", &vk, &error));
    print_message("auto: %s\n", kd_vk_choice(vk));
    for (size_t i = 0; i < n_infos; i++)
        assert_true(infos[i].missing[0] || infos[i].type <= kd_vk_info(vk)->type);
    kd_vk_destroy(vk);
    kd_vk_destroy(NULL);
}

static void refused(void **state)
{
    struct kd_vk *vk;
    (void)state;
    FAILS(KD_EINVAL, "there is no device 77", open_as("77", &vk, &error));
    assert_null(vk);
    FAILS(KD_EINVAL, "no device has the name 'no such thing'", open_as("no such thing", &vk, &error));
    FAILS(KD_EINVAL, infos[0].name, open_as("no such thing", &vk, &error));
    assert_null(vk);
}

/* A device for pipelines only can create pipelines, and refuses everything else. */
static void for_pipelines_alone(void **state)
{
    struct kd_vk *vk;
    struct kd_vk_buffer *buffer;
    (void)state;
    OK(kd_vk_create(
        &(struct kd_vk_params) { .device = "auto", .cache_dir = "", .validate = true, .pipelines_only = true }, &vk,
        &error));
    struct kd_vk_pipeline *pipeline = make_mix(vk, 3);
    assert_non_null(pipeline);
    FAILS(KD_EINTERNAL, "only for pipelines", kd_vk_buffer_create(vk, 64, KD_VK_UPLOAD, "x", &buffer, &error));
    assert_null(buffer);
    OK(kd_vk_submit(vk, NULL, &error)); /* works, because no command is recorded */
    OK(kd_vk_wait(vk, 0, &error));
    kd_vk_pipeline_destroy(vk, pipeline);
    assert_int_equal(kd_vk_validation_messages(vk), 0);
    kd_vk_destroy(vk);
}

enum { OPENERS = 3, OPENINGS = 6 };

static struct kd_vk_functions real;
static atomic_int inside, most;

/* Counts the threads that are within the functions below. */
static void enter(void)
{
    int now = atomic_fetch_add(&inside, 1) + 1, before = atomic_load(&most);
    while (now > before && !atomic_compare_exchange_weak(&most, &before, now))
        ;
    usleep(2000);
}

static VkResult create_device(VkPhysicalDevice physical, const VkDeviceCreateInfo *info,
                              const VkAllocationCallbacks *allocator, VkDevice *device)
{
    enter();
    VkResult result = real.CreateDevice(physical, info, allocator, device);
    atomic_fetch_sub(&inside, 1);
    return result;
}

static void destroy_device(VkDevice device, const VkAllocationCallbacks *allocator)
{
    enter();
    real.DestroyDevice(device, allocator);
    atomic_fetch_sub(&inside, 1);
}

static VkResult create_instance(const VkInstanceCreateInfo *info, const VkAllocationCallbacks *allocator,
                                VkInstance *instance)
{
    enter();
    VkResult result = real.CreateInstance(info, allocator, instance);
    atomic_fetch_sub(&inside, 1);
    return result;
}

static void destroy_instance(VkInstance instance, const VkAllocationCallbacks *allocator)
{
    enter();
    real.DestroyInstance(instance, allocator);
    atomic_fetch_sub(&inside, 1);
}

static void count(struct kd_vk_functions *fn)
{
    fn->CreateInstance = create_instance;
    fn->DestroyInstance = fn->DestroyInstance ? destroy_instance : NULL;
    fn->CreateDevice = fn->CreateDevice ? create_device : NULL;
    fn->DestroyDevice = fn->DestroyDevice ? destroy_device : NULL;
}

/* Opens and closes a device several times. Returns NULL on success. */
static void *open_and_close(void *user)
{
    (void)user;
    for (int i = 0; i < OPENINGS; i++) {
        struct kd_vk *vk;
        struct kd_error reason;
        if (kd_vk_create(&(struct kd_vk_params) { .device = "auto", .cache_dir = "", .pipelines_only = true }, &vk,
                         &reason))
            return "a device could not be opened";
        kd_vk_destroy(vk);
    }
    return NULL;
}

/* Only one thread at a time opens or closes a device. The loader would crash if two threads changed its list of devices
 * (vk/functions.h). */
static void one_at_a_time(void **state)
{
    struct kd_vk *vk;
    pthread_t threads[OPENERS];
    (void)state;
    OK(open_as("auto", &vk, &error));
    real = vk->core.fn;
    kd_vk_functions_hook = count;
    for (int i = 0; i < OPENERS; i++)
        assert_int_equal(pthread_create(&threads[i], NULL, open_and_close, NULL), 0);
    for (int i = 0; i < OPENERS; i++) {
        void *failure;
        assert_int_equal(pthread_join(threads[i], &failure), 0);
        if (failure)
            fail_msg("%s", (const char *)failure);
    }
    kd_vk_functions_hook = NULL;
    assert_int_equal(atomic_load(&most), 1);
    kd_vk_destroy(vk);
}

/* Without validation no object gets a name, because naming makes the loader walk its list of devices each time. */
static void names_only_for_validation(void **state)
{
    struct kd_vk *vk;
    (void)state;
    OK(open_as("auto", &vk, &error));
    assert_null(vk->core.fn.SetDebugUtilsObjectNameEXT);
    kd_vk_destroy(vk);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(listed),
                                        cmocka_unit_test(by_index_and_name),
                                        cmocka_unit_test(automatic),
                                        cmocka_unit_test(refused),
                                        cmocka_unit_test(for_pipelines_alone),
                                        cmocka_unit_test(one_at_a_time),
                                        cmocka_unit_test(names_only_for_validation) };
    if (skip_without_device() || kd_vk_list(&infos, &n_infos, NULL))
        return SKIPPED;
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    free(infos);
    return failed != 0;
}

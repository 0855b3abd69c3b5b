/* Tests with a driver that fails. Each call that can fail fails once. In another test the device hangs. */
#include "support.h"

#include "base/log.h"

#include <time.h>

static struct kd_vk_functions real;
static int countdown;     /* number of calls before the one that fails */
static VkResult injected; /* result of the failing call */
static const char *tripped;
static int teardown_calls, layer_messages;

static bool trips(const char *name)
{
    if (tripped || countdown-- > 0)
        return false;
    tripped = name;
    return true;
}

#define FAULTS(X) \
    X(EnumeratePhysicalDevices, (VkInstance a, uint32_t *b, VkPhysicalDevice *c), (a, b, c)) \
    X(CreateDevice, (VkPhysicalDevice a, const VkDeviceCreateInfo *b, const VkAllocationCallbacks *c, VkDevice *d), \
      (a, b, c, d)) \
    CREATES(X, Buffer, BufferCreateInfo) \
    CREATES(X, BufferView, BufferViewCreateInfo) \
    CREATES(X, ShaderModule, ShaderModuleCreateInfo) \
    CREATES(X, DescriptorSetLayout, DescriptorSetLayoutCreateInfo) \
    CREATES(X, PipelineLayout, PipelineLayoutCreateInfo) \
    CREATES(X, PipelineCache, PipelineCacheCreateInfo) \
    CREATES(X, DescriptorPool, DescriptorPoolCreateInfo) \
    CREATES(X, CommandPool, CommandPoolCreateInfo) \
    CREATES(X, Semaphore, SemaphoreCreateInfo) \
    CREATES(X, QueryPool, QueryPoolCreateInfo) \
    X(AllocateMemory, (VkDevice a, const VkMemoryAllocateInfo *b, const VkAllocationCallbacks *c, VkDeviceMemory *d), \
      (a, b, c, d)) \
    X(MapMemory, (VkDevice a, VkDeviceMemory b, VkDeviceSize c, VkDeviceSize d, VkMemoryMapFlags e, void **f), \
      (a, b, c, d, e, f)) \
    X(BindBufferMemory, (VkDevice a, VkBuffer b, VkDeviceMemory c, VkDeviceSize d), (a, b, c, d)) \
    X(CreateComputePipelines, \
      (VkDevice a, VkPipelineCache b, uint32_t c, const VkComputePipelineCreateInfo *d, \
       const VkAllocationCallbacks *e, VkPipeline *f), \
      (a, b, c, d, e, f)) \
    X(AllocateDescriptorSets, (VkDevice a, const VkDescriptorSetAllocateInfo *b, VkDescriptorSet *c), (a, b, c)) \
    X(AllocateCommandBuffers, (VkDevice a, const VkCommandBufferAllocateInfo *b, VkCommandBuffer *c), (a, b, c)) \
    X(ResetCommandPool, (VkDevice a, VkCommandPool b, VkCommandPoolResetFlags c), (a, b, c)) \
    X(BeginCommandBuffer, (VkCommandBuffer a, const VkCommandBufferBeginInfo *b), (a, b)) \
    X(EndCommandBuffer, (VkCommandBuffer a), (a)) \
    X(QueueSubmit, (VkQueue a, uint32_t b, const VkSubmitInfo *c, VkFence d), (a, b, c, d)) \
    X(GetSemaphoreCounterValue, (VkDevice a, VkSemaphore b, uint64_t *c), (a, b, c)) \
    X(WaitSemaphores, (VkDevice a, const VkSemaphoreWaitInfo *b, uint64_t c), (a, b, c))
#define CREATES(X, object, info) \
    X(Create##object, (VkDevice a, const Vk##info *b, const VkAllocationCallbacks *c, Vk##object *d), (a, b, c, d))

#define DEFINE(name, parameters, arguments) \
    static VKAPI_ATTR VkResult VKAPI_CALL faulty_##name parameters \
    { \
        return trips(#name) ? injected : real.name arguments; \
    }
FAULTS(DEFINE)

static VKAPI_ATTR VkBool32 VKAPI_CALL count_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                                    VkDebugUtilsMessageTypeFlagsEXT types,
                                                    const VkDebugUtilsMessengerCallbackDataEXT *data, void *user)
{
    (void)severity, (void)types, (void)user;
    print_message("%s\n", data->pMessage);
    layer_messages++;
    return VK_FALSE;
}

/* Replaces the device's own messenger by one that counts messages even while the device is destroyed and leaked objects
 * are reported. */
static VKAPI_ATTR VkResult VKAPI_CALL listen(VkInstance instance, const VkDebugUtilsMessengerCreateInfoEXT *info,
                                             const VkAllocationCallbacks *allocator,
                                             VkDebugUtilsMessengerEXT *messenger)
{
    VkDebugUtilsMessengerCreateInfoEXT ours = *info;
    ours.pfnUserCallback = count_message;
    return real.CreateDebugUtilsMessengerEXT(instance, &ours, allocator, messenger);
}

static void plant(struct kd_vk_functions *fn)
{
    real = *fn;
#define REPLACE(name, parameters, arguments) \
    if (fn->name) \
        fn->name = faulty_##name;
    if (fn->CmdFillBuffer) { /* the third and last step, after which all functions are loaded */
        FAULTS(REPLACE)
    } else if (fn->CreateDevice) {
        fn->CreateDevice = faulty_CreateDevice;
        fn->EnumeratePhysicalDevices = faulty_EnumeratePhysicalDevices;
        fn->CreateDebugUtilsMessengerEXT = listen;
    }
}

/* `real` is a copy of the table after the first steps. It must be made before the third step puts our functions into
 * the table. */
static void plant_once(struct kd_vk_functions *fn)
{
    struct kd_vk_functions before = real;
    plant(fn);
    if (fn->CmdFillBuffer) {
        real.CreateDevice = before.CreateDevice;
        real.EnumeratePhysicalDevices = before.EnumeratePhysicalDevices;
        real.CreateDebugUtilsMessengerEXT = before.CreateDebugUtilsMessengerEXT;
    }
}

/* Uses all functions of a device, up to the first failure. */
static enum kd_status life(struct kd_error *error)
{
    enum { n = 64 };
    struct kd_vk *vk = NULL;
    struct kd_vk_pipeline *pipeline = NULL, *kinds = NULL;
    struct kd_vk_buffer *x = NULL, *y = NULL;
    const struct kd_vk_spec spec = { 0, MIX_GROUP };
    const struct mix_push push = { n, 1 };
    enum kd_status status = kd_vk_create(
        &(struct kd_vk_params) { .device = getenv("KERRD_TEST_DEVICE"), .cache_dir = "", .validate = true }, &vk,
        error);
    if (!status)
        status = kd_vk_buffer_create(vk, n * 4, KD_VK_UPLOAD, "x", &x, error);
    if (!status)
        status = kd_vk_buffer_create(vk, n * 4, KD_VK_DEVICE, "y", &y, error);
    if (!status)
        status = kd_vk_pipeline_create(vk,
                                       &(struct kd_vk_pipeline_params) { .name = "mix",
                                                                         .spirv = mix_spv,
                                                                         .spirv_bytes = sizeof mix_spv,
                                                                         .n_buffers = 2,
                                                                         .push_bytes = sizeof push,
                                                                         .spec = &spec,
                                                                         .n_spec = 1 },
                                       &pipeline, error);
    if (!status)
        status = kd_vk_pipeline_create(vk, &(struct kd_vk_pipeline_params)KINDS_PARAMS, &kinds, error);
    if (!status)
        memset(kd_vk_buffer_map(x), 0, n * 4); /* a block of zero elements */
    if (!status)
        status = kd_vk_dispatch(vk,
                                &(struct kd_vk_dispatch) { .pass = "kinds",
                                                           .pipeline = kinds,
                                                           .bindings = { { .buffer = x },
                                                                         { .buffer = x },
                                                                         { .buffer = x },
                                                                         { .buffer = y, .write = true },
                                                                         { .buffer = x },
                                                                         { .buffer = x } } },
                                error);
    for (int i = 0; i < 7 && !status; i++) { /* more than may be in flight */
        status =
            kd_vk_dispatch(vk,
                           &(struct kd_vk_dispatch) { .pass = "mix",
                                                      .pipeline = pipeline,
                                                      .bindings = { { .buffer = x }, { .buffer = y, .write = true } },
                                                      .push = &push },
                           error);
        if (!status)
            status = kd_vk_submit(vk, NULL, error);
    }
    if (!status)
        status = kd_vk_wait(vk, 0, error);
    if (vk) {
        kd_vk_buffer_destroy(vk, x);
        kd_vk_buffer_destroy(vk, y);
        kd_vk_pipeline_destroy(vk, pipeline);
        kd_vk_pipeline_destroy(vk, kinds);
        kd_vk_destroy(vk);
    }
    return status;
}

/* Lets call 0, 1, 2, ... fail until a run passes without a fault. */
static void sweep(VkResult result, enum kd_status expected)
{
    int n = 0;
    injected = result;
    layer_messages = 0;
    for (;; n++) {
        struct kd_error error = { 0 };
        countdown = n;
        tripped = NULL;
        enum kd_status status = life(&error);
        if (!tripped)
            break;
        /* These failures must be harmless: without a query pool there are no times, and if a block cannot be
         * allocated or mapped, a smaller one is tried. */
        bool harmless =
            !strcmp(tripped, "CreateQueryPool") || !strcmp(tripped, "AllocateMemory") || !strcmp(tripped, "MapMemory");
        if (status ? status != expected || !error.message[0] : !harmless)
            fail_msg("call %d, %s: %s, '%s'", n, tripped, kd_status_name(status), error.message);
    }
    print_message("%d calls failed one by one with %s\n", n, kd_vk_result_name(result));
    assert_true(n > 40);
    assert_int_equal(layer_messages, 0);
}

static void out_of_memory(void **state)
{
    (void)state;
    sweep(VK_ERROR_OUT_OF_DEVICE_MEMORY, KD_ENOMEM);
}

/* A lost device is abandoned together with all memory that the driver has for it; this is not counted as a leak. */
void __lsan_disable(void) __attribute__((weak));
void __lsan_enable(void) __attribute__((weak));

static void device_lost(void **state)
{
    (void)state;
    if (__lsan_disable)
        __lsan_disable();
    sweep(VK_ERROR_DEVICE_LOST, KD_EDEVICE);
    if (__lsan_enable)
        __lsan_enable();
}

static int waits;     /* calls of `hang` */
static bool busy;     /* the hanging call uses processor time */
static bool finishes; /* the third call of `hang` succeeds */
static VKAPI_ATTR VkResult VKAPI_CALL hang(VkDevice device, const VkSemaphoreWaitInfo *info, uint64_t timeout)
{
    (void)device, (void)info;
    assert_true(timeout <= 1500000000);
    for (const clock_t from = clock(); busy && (double)(clock() - from) / CLOCKS_PER_SEC < 0.6e-9 * (double)timeout;)
        ;
    return ++waits == 3 && finishes ? VK_SUCCESS : VK_TIMEOUT;
}
static VKAPI_ATTR VkResult VKAPI_CALL unfinished(VkDevice device, VkSemaphore semaphore, uint64_t *value)
{
    (void)device, (void)semaphore;
    *value = 0;
    return VK_SUCCESS;
}
static VKAPI_ATTR VkResult VKAPI_CALL idle_called(VkDevice device)
{
    (void)device;
    teardown_calls++;
    return VK_SUCCESS;
}
static VKAPI_ATTR void VKAPI_CALL destroy_called(VkDevice device, const VkAllocationCallbacks *allocator)
{
    (void)device, (void)allocator;
    teardown_calls++;
}

static void deadline(void **state)
{
    struct kd_vk *vk;
    struct kd_vk_buffer *buffer, *none;
    uint64_t ticket;
    (void)state;
    OK(kd_vk_create(&(struct kd_vk_params) { .cache_dir = "", .deadline_ms = 1500 }, &vk, &error));
    buffer = make_buffer(vk, 64, KD_VK_READBACK, "b");
    OK(kd_vk_fill(vk, "fill", buffer, 0, 256, 1, &error));
    OK(kd_vk_submit(vk, &ticket, &error));
    OK(kd_vk_wait(vk, ticket, &error)); /* the device must be idle, so that none of its threads runs after the test */
    vk->core.fn.WaitSemaphores = hang;
    vk->core.fn.GetSemaphoreCounterValue = unfinished;
    vk->core.fn.DeviceWaitIdle = idle_called;
    vk->core.fn.DestroyDevice = destroy_called;
    OK(kd_vk_fill(vk, "fill", buffer, 0, 256, 2, &error));
    OK(kd_vk_submit(vk, &ticket, &error));
    /* The wait is repeated if a software device did not get processor time. */
    const bool software = kd_vk_info(vk)->type == KD_VK_CPU;
    finishes = true;
    if (software) {
        OK(kd_vk_wait(vk, ticket, &error));
        assert_int_equal(waits, 3);
        OK(kd_vk_fill(vk, "fill", buffer, 0, 256, 2, &error));
        OK(kd_vk_submit(vk, &ticket, &error));
    }
    finishes = false, busy = true,
    waits = 0; /* a device that got processor time counts as lost after the watchdog's grace of a second */
    FAILS(KD_EDEVICE, "missed its deadline of 1500 ms", kd_vk_wait(vk, ticket, &error));
    assert_int_equal(waits, 2);

    vk->core.fn.WaitSemaphores = NULL; /* set to NULL, because from here on no call may reach the driver */
    FAILS(KD_EDEVICE, "lost", kd_vk_wait(vk, 0, &error));
    FAILS(KD_EDEVICE, "lost", kd_vk_submit(vk, NULL, &error));
    FAILS(KD_EDEVICE, "lost", kd_vk_fill(vk, "fill", buffer, 0, 256, 3, &error));
    FAILS(KD_EDEVICE, "lost", kd_vk_copy(vk, "c", buffer, 0, buffer, 128, 64, &error));
    FAILS(KD_EDEVICE, "lost", kd_vk_buffer_create(vk, 64, KD_VK_DEVICE, "n", &none, &error));
    kd_vk_buffer_destroy(vk, buffer);
    kd_vk_destroy(vk);
    assert_int_equal(teardown_calls, 0);
}

int main(void)
{
    if (skip_without_device())
        return SKIPPED;
    const struct CMUnitTest hanging[] = { cmocka_unit_test(deadline) };
    const struct CMUnitTest failing[] = { cmocka_unit_test(out_of_memory), cmocka_unit_test(device_lost) };
    int failed = cmocka_run_group_tests(hanging, NULL, NULL);
    kd_vk_functions_hook = plant_once;
    return (cmocka_run_group_tests(failing, NULL, NULL) || failed);
}

/* Tests that kerrd tests a device at its first use only. A start counts as a first use if the driver or kerrd has
 * another version, or if the file was damaged. A device that computes wrongly causes a warning, and is tested again at
 * each start. */
#include "render_support.h"

#include "render/selftest/first_start.h"
#include "render/device/device_internal.h"

#include <unistd.h>

static char folder[64];

static struct kd_renderer *start(bool prove)
{
    struct kd_renderer *r = NULL;
    const char *device = getenv("KERRD_TEST_DEVICE");
    const struct kd_renderer_params params = { .device = device ? device : "auto",
                                               .cache_dir = folder,
                                               .prove = prove ? kd_first_start : NULL };
    OK(kd_renderer_create(&params, &r, &error));
    return r;
}

static char *path_of(struct kd_renderer *r) { return kd_vk_cache_file(r->vk, ".selftest.json"); }

static void write_all(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && !fclose(file));
}

static char text[4096];
static void read_all(const char *path)
{
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof text - 1, file)] = 0;
    fclose(file);
}

static void test_once(void **state)
{
    (void)state;
    struct kd_renderer *r = start(false);
    const struct kd_verdict *known = kd_renderer_verdict(r);
    assert_int_equal(known->result, KD_UNTESTED);
    assert_false(r->capacity.measured);
    kd_renderer_destroy(r);

    r = start(true);
    known = kd_renderer_verdict(r);
    assert_true(known->result == KD_PASSED && known->now && known->checks > 50 && !known->failed);
    assert_true(r->capacity.measured && r->capacity.ns[KD_NS_PIXEL_POST] > 0 && r->capacity.ns[KD_NS_PIXEL_POST] < 1e6);
    char *path = path_of(r);
    kd_renderer_destroy(r);
    read_all(path);
    assert_non_null(strstr(text, "kerrd " KD_VERSION));

    for (int prove = 0; prove < 2; prove++) { /* each caller gets the test's results and the costs of the passes */
        r = start(prove);
        known = kd_renderer_verdict(r);
        assert_true(known->result == KD_PASSED && !known->now && known->checks > 50 && r->capacity.measured);
        kd_renderer_destroy(r);
    }
    free(path);
}

static void test_not_this_one(void **state)
{
    (void)state;
    struct kd_renderer *r = start(false);
    char *path = path_of(r), other[4096];
    kd_renderer_destroy(r);
    read_all(path);
    const char *version = strstr(text, "kerrd " KD_VERSION);
    assert_non_null(version);
    for (int k = 0; k < 4; k++) {
        snprintf(other, sizeof other, "%s", text);
        if (k == 0)
            other[strlen(other) / 2] = 0;
        else if (k == 1)
            other[version - text + 6] = '9'; /* a record by another version */
        else if (k == 2)
            snprintf(other, sizeof other, "[1, 2]");
        else
            memcpy(strstr(other, "\"of\": \"") + 7, "ffffffff", 8); /* a record of another device */
        write_all(path, other);
        r = start(false);
        assert_int_equal(kd_renderer_verdict(r)->result, KD_UNTESTED);
        kd_renderer_destroy(r);
    }
    write_all(path, text);
    r = start(false);
    assert_int_equal(kd_renderer_verdict(r)->result, KD_PASSED);
    kd_renderer_destroy(r);
    free(path);
}

/* A device that executes only the first workgroup of a dispatch. */
static PFN_vkCmdDispatch dispatch;
static VKAPI_ATTR void VKAPI_CALL only_one(VkCommandBuffer commands, uint32_t x, uint32_t y, uint32_t z)
{
    (void)x, (void)y, (void)z;
    dispatch(commands, 1, 1, 1);
}
static void plant(struct kd_vk_functions *fn)
{
    if (fn->CmdDispatch && fn->CmdDispatch != only_one) {
        dispatch = fn->CmdDispatch;
        fn->CmdDispatch = only_one;
    }
}

static void test_failed(void **state)
{
    (void)state;
    struct kd_renderer *r = start(false);
    char *path = path_of(r);
    kd_renderer_destroy(r);
    assert_int_equal(unlink(path), 0);
    kd_vk_functions_hook = plant;
    for (int k = 0; k < 2; k++) { /* the warning is repeated */
        struct kd_buffer json = { 0 };
        r = start(true);
        const struct kd_verdict *known = kd_renderer_verdict(r);
        assert_true(known->result == KD_FAILED && known->now && known->failed && known->worst[0]);
        OK(kd_renderer_device_json(r, &json));
        assert_int_equal(kd_buffer_append(&json, "", 1), KD_OK);
        assert_non_null(strstr((const char *)json.data, "\"result\": \"failed\""));
        assert_non_null(strstr((const char *)json.data, known->worst));
        kd_buffer_finish(&json);
        kd_renderer_destroy(r);
        assert_int_equal(access(path, F_OK), -1);
    }
    kd_vk_functions_hook = NULL;
    free(path);
}

int main(void)
{
    int skip = skip_without_device();
    if (skip)
        return skip;
    snprintf(folder, sizeof folder, "/tmp/kerrd-first-start-XXXXXX");
    if (!mkdtemp(folder))
        return 1;
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_once), cmocka_unit_test(test_not_this_one),
                                        cmocka_unit_test(test_failed) };
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    char command[100];
    snprintf(command, sizeof command, "rm -r %s", folder);
    return failed || system(command);
}

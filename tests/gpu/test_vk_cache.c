/* Tests of the pipeline cache on disk: written, read, damaged, and in folders that cannot be written. */
#include "support.h"

#include <dirent.h>
#include <sys/stat.h>
#include <unistd.h>

static char directory[256];
static size_t given; /* number of bytes that the driver received when the cache was created */
static PFN_vkCreatePipelineCache real_create;

static VKAPI_ATTR VkResult VKAPI_CALL watching(VkDevice device, const VkPipelineCacheCreateInfo *info,
                                               const VkAllocationCallbacks *allocator, VkPipelineCache *cache)
{
    given = info->initialDataSize;
    return real_create(device, info, allocator, cache);
}

static void watch(struct kd_vk_functions *fn)
{
    if (fn->CreatePipelineCache && fn->CreatePipelineCache != watching) {
        real_create = fn->CreatePipelineCache;
        fn->CreatePipelineCache = watching;
    }
}

/* Opens and closes a device, with or without making a pipeline. */
static void live(const char *dir, bool pipeline)
{
    struct kd_vk *vk;
    OK(kd_vk_create(
        &(struct kd_vk_params) { .device = getenv("KERRD_TEST_DEVICE"), .cache_dir = dir, .validate = true }, &vk,
        &error));
    if (pipeline)
        kd_vk_pipeline_destroy(vk, make_mix(vk, 1));
    assert_int_equal(kd_vk_validation_messages(vk), 0);
    kd_vk_destroy(vk);
}

/* Finds the only file in dir, and returns its size. */
static size_t only_file(const char *dir, char path[600])
{
    DIR *d = opendir(dir);
    size_t n = 0;
    if (!d)
        return 0;
    for (struct dirent *e; (e = readdir(d));)
        if (e->d_name[0] != '.' && ++n)
            snprintf(path, 600, "%s/%s", dir, e->d_name);
    closedir(d);
    return n;
}

static void written_and_read(void **state)
{
    char path[600];
    struct stat first, second;
    (void)state;
    live(directory, false);
    assert_int_equal(given, 0);
    assert_int_equal(only_file(directory, path), 0); /* no file is written, because no pipeline was made */
    live(directory, true);
    assert_int_equal(only_file(directory, path), 1);
    assert_int_equal(stat(path, &first), 0);
    assert_true(first.st_size >= 24 + 32);
    live(directory, true);
    assert_int_equal(given, first.st_size - 24);
    assert_int_equal(only_file(directory, path), 1);
    assert_int_equal(stat(path, &second), 0);
    print_message("%s: %lld bytes\n", path, (long long)second.st_size);
}

static void damaged(void **state)
{
    char path[600];
    uint8_t data[65536];
    (void)state;
    live(directory, true);
    assert_int_equal(only_file(directory, path), 1);
    FILE *file = fopen(path, "rb");
    size_t size = fread(data, 1, sizeof data, file);
    fclose(file);
    for (size_t at = 0; at < 64 && at < size; at += 3) { /* damages bytes of kerrd's header and of Vulkan's header */
        file = fopen(path, "wb");
        data[at] ^= 0x40;
        fwrite(data, 1, size, file);
        data[at] ^= 0x40;
        fclose(file);
        live(directory, false);
        assert_int_equal(given, 0);
    }
    static const size_t sizes[] = { 0, 1, 23, 24, 40, 55 };
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        assert_int_equal(truncate(path, (off_t)sizes[i]), 0);
        live(directory, false);
        assert_int_equal(given, 0);
    }
    live(directory, true); /* the damaged file must be replaced by a valid one */
    live(directory, true);
    assert_true(given > 0);
}

/* One component of the path is a file, so that not even the superuser can write there. */
static void unwritable(void **state)
{
    char path[600], file[300], below[310];
    (void)state;
    snprintf(file, sizeof file, "%s.file", directory);
    snprintf(below, sizeof below, "%s/deeper", file);
    fclose(fopen(file, "wb"));
    live(below, true);
    assert_int_equal(given, 0);
    assert_int_equal(only_file(below, path), 0);
    unlink(file);
    live("", true); /* no cache requested */
    assert_int_equal(given, 0);
}

static void default_place(void **state)
{
    char base[300], path[600];
    (void)state;
    snprintf(base, sizeof base, "%s/new/xdg", directory);
    setenv("XDG_CACHE_HOME", base, 1);
    live(NULL, true); /* creates missing directories */
    snprintf(base, sizeof base, "%s/new/xdg/kerrd", directory);
    assert_int_equal(only_file(base, path), 1);
    unsetenv("XDG_CACHE_HOME");
    snprintf(base, sizeof base, "%s/home", directory);
    setenv("HOME", base, 1);
    live(NULL, true);
    snprintf(base, sizeof base, "%s/home/.cache/kerrd", directory);
    assert_int_equal(only_file(base, path), 1);
    unsetenv("HOME");
    live(NULL, true);
    assert_int_equal(given, 0);
}

/* Each test has a directory of its own, which is removed with its contents. */
static int enter(void **state)
{
    const char *tmp = getenv("TMPDIR");
    (void)state;
    snprintf(directory, sizeof directory, "%s/kerrd-cache-XXXXXX", tmp ? tmp : "/tmp");
    return !mkdtemp(directory);
}

static int leave(void **state)
{
    char command[300];
    (void)state;
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    return system(command) != 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(written_and_read, enter, leave),
        cmocka_unit_test_setup_teardown(damaged, enter, leave),
        cmocka_unit_test_setup_teardown(unwritable, enter, leave),
        cmocka_unit_test_setup_teardown(default_place, enter, leave),
    };
    if (skip_without_device())
        return SKIPPED;
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1); /* Mesa's cache uses the same folders */
    kd_vk_functions_hook = watch;
    return cmocka_run_group_tests(tests, NULL, NULL) != 0;
}

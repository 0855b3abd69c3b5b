/* Tests of writing whole files: the order of the operations on the disk, and the removal of files that killed processes
 * left behind. */
#include "base/replace.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/kerrd-replace-XXXXXX";

/* The calls made, in order: "file" and "folder" for the two kinds of fsync, and "rename". The linker redirects the
 * calls here. */
static char calls[200];
static int folder_sync_errno; /* errno of fsync of a folder; 0: it succeeds */
int __real_fsync(int fd);
int __real_renameat(int from_folder, const char *from, int to_folder, const char *to);
int __wrap_fsync(int fd);
int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to);

static void note(const char *call)
{
    strncat(calls, call, sizeof calls - strlen(calls) - 1);
    strncat(calls, " ", sizeof calls - strlen(calls) - 1);
}

int __wrap_fsync(int fd)
{
    struct stat about;
    assert_int_equal(fstat(fd, &about), 0);
    note(S_ISDIR(about.st_mode) ? "folder" : "file");
    if (S_ISDIR(about.st_mode) && folder_sync_errno) {
        errno = folder_sync_errno;
        return -1;
    }
    return __real_fsync(fd);
}

int __wrap_renameat(int from_folder, const char *from, int to_folder, const char *to)
{
    note("rename");
    return __real_renameat(from_folder, from, to_folder, to);
}

static const char *path_of(const char *name)
{
    static char path[PATH_MAX];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void expect(const char *name, const char *text)
{
    char found[32] = "";
    FILE *file = fopen(path_of(name), "r");
    assert_non_null(file);
    found[fread(found, 1, sizeof found - 1, file)] = 0;
    fclose(file);
    assert_string_equal(found, text);
}

/* After a power cut there is the old file or the new one: the bytes reach the disk before the file is renamed, and the
 * new name before success is reported. */
static void test_order(void **state)
{
    (void)state;
    *calls = 0;
    assert_true(kd_replace_file(path_of("a"), "one", 3));
    assert_string_equal(calls, "file rename folder ");
    expect("a", "one");
    folder_sync_errno = EIO;
    errno = 0;
    assert_false(kd_replace_file(path_of("a"), "two", 3));
    assert_int_equal(errno, EIO);
    folder_sync_errno = EINVAL; /* a file system on which fsync of a folder is not supported */
    assert_true(kd_replace_file(path_of("a"), "three", 5));
    folder_sync_errno = 0;
    expect("a", "three");
}

static void age(const char *name, int64_t age_s)
{
    struct timespec times[2] = { { .tv_nsec = UTIME_NOW } };
    clock_gettime(CLOCK_REALTIME, &times[1]);
    times[1].tv_sec -= age_s;
    assert_int_equal(utimensat(AT_FDCWD, path_of(name), times, AT_SYMLINK_NOFOLLOW), 0);
}

static void make(const char *name, int64_t age_s)
{
    FILE *file = fopen(path_of(name), "w");
    assert_non_null(file);
    assert_int_equal(fclose(file), 0);
    age(name, age_s);
}

static bool there(const char *name) { return !access(path_of(name), F_OK); }

/* Only old temporary files of kerrd are removed. A recent one may be in use by another process, and others do not
 * belong to kerrd. */
static void test_leftovers(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        int64_t age_s;
        bool stays;
    } files[] = {
        { "cache.kerrd-abcdef", 7200, false }, { "cache.kerrd-Zz09Aa", 86400, false },
        { "cache.kerrd-ghijkl", 60, true },    { "cache.kerrd-abcde", 7200, true },
        { "cache.kerrd-abcdefg", 7200, true }, { "cache.kerrd-abc-ef", 7200, true },
        { "cache-kerrd-abcdef", 7200, true },  { "other.kerrd-abcdef", 7200, true },
        { "cache.kerrd-", 7200, true },        { "xcache.kerrd-abcdef", 7200, true },
        { "cache.backup", 7200, true },
    };
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        make(files[i].name, files[i].age_s);
    assert_int_equal(mkdir(path_of("cache.kerrd-folder"), 0700), 0);
    make("victim", 7200);
    assert_int_equal(symlink("victim", path_of("cache.kerrd-linked")), 0);
    age("cache.kerrd-folder", 7200);
    age("cache.kerrd-linked", 7200);
    assert_true(kd_replace_file(path_of("cache"), "new", 3));
    expect("cache", "new");
    for (size_t i = 0; i < sizeof files / sizeof *files; i++)
        if (there(files[i].name) != files[i].stays)
            fail_msg("%s, %d s old, should %s", files[i].name, (int)files[i].age_s, files[i].stays ? "stay" : "go");
    assert_true(there("cache.kerrd-folder") && there("cache.kerrd-linked") && there("victim"));
    assert_int_equal(rmdir(path_of("cache.kerrd-folder")), 0);
}

static int finish(void **state)
{
    (void)state;
    DIR *d = opendir(folder);
    for (struct dirent *entry; d && (entry = readdir(d));)
        unlink(path_of(entry->d_name));
    if (d)
        closedir(d);
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_order), cmocka_unit_test(test_leftovers) };
    if (!mkdtemp(folder))
        return 1;
    return cmocka_run_group_tests(tests, NULL, finish);
}

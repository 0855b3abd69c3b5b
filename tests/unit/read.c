/* Tests of reading whole files: a file that is not regular does not block the reader, and a file that is too large is
 * not read into memory. */
#include "base/read.h"
#include "base/replace.h"

#include <errno.h>
#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

static char folder[] = "/tmp/kerrd-read-XXXXXX";
static int at = -1;

static void expect(const char *name, int flags, size_t most, int cause)
{
    struct kd_buffer out = { 0 };
    assert_int_equal(kd_buffer_append(&out, "before", 6), KD_OK);
    errno = 0;
    assert_false(kd_read_file(at, name, flags, most, &out));
    assert_int_equal(errno, cause);
    assert_int_equal(out.size, 6);
    assert_true(out.capacity < 1024);
    kd_buffer_finish(&out);
}

static void test_no_files(void **state)
{
    (void)state;
    assert_int_equal(mkfifoat(at, "pipe", 0600), 0); /* a pipe to which nobody ever writes */
    assert_int_equal(symlinkat("data", at, "link"), 0);
    int fd = openat(at, "huge", O_CREAT | O_WRONLY, 0600);
    assert_int_equal(ftruncate(fd, (off_t)3 << 30), 0);
    close(fd);
    expect("pipe", 0, 1 << 20, EINVAL);
    expect("huge", 0, 1 << 20, EFBIG);
    expect(".", 0, 1 << 20, EINVAL);
    expect("/dev/zero", 0, 1 << 20, EINVAL);
    expect("/proc/self/cmdline", 0, 1, EFBIG); /* a file whose size the kernel reports as 0 */
    expect("link", O_NOFOLLOW, 1 << 20, ELOOP);
    expect("nothing", 0, 1 << 20, ENOENT);
}

static void test_there_and_back(void **state)
{
    static char data[100000];
    struct kd_buffer out = { 0 };
    (void)state;
    for (size_t i = 0; i < sizeof data; i++)
        data[i] = (char)(i * 7);
    assert_true(kd_replace_file_at(at, "data", "old", 3));
    assert_true(kd_replace_file_at(at, "data", data, sizeof data));
    assert_false(kd_read_file(at, "data", 0, sizeof data - 1, &out));
    assert_true(kd_read_file(at, "data", O_NOFOLLOW, sizeof data, &out));
    assert_int_equal(out.size, sizeof data);
    assert_memory_equal(out.data, data, sizeof data);
    kd_buffer_finish(&out);
    assert_true(kd_replace_is_temporary("data.kerrd-aB3xyZ", "data"));
    assert_false(kd_replace_is_temporary("data.kerrd-aB3xy", "data") ||
                 kd_replace_is_temporary("data.kerrd-aB3xy.", "data") ||
                 kd_replace_is_temporary("dat.kerrd-aB3xyZ", "data") || kd_replace_is_temporary("data", "data") ||
                 kd_replace_is_temporary("data.backup", "data"));
}

static int begin(void **state)
{
    (void)state;
    at = mkdtemp(folder) ? open(folder, O_RDONLY | O_DIRECTORY) : -1;
    return at < 0;
}

static int end(void **state)
{
    (void)state;
    static const char *const names[] = { "pipe", "link", "huge", "data" };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        unlinkat(at, names[i], 0);
    close(at);
    return rmdir(folder); /* rmdir fails if the folder is not empty */
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_no_files), cmocka_unit_test(test_there_and_back) };
    return cmocka_run_group_tests(tests, begin, end);
}

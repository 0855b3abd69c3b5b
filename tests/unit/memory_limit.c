/* Tests how the memory limit of a process is determined. /proc and /sys are simulated, in the forms of real machines
 * and of containers. */
#include "base/memory_limit.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#define MIB (UINT64_C(1) << 20)
#define STATUS \
    "Name:\tkerrd\nVmRSS:\t  300000 kB\nRssAnon:\t    8192 kB\nRssFile:\t  100000 kB\nRssShmem:\t    2048 kB\n"
#define V2 "30 23 0:26 / /sys/fs/cgroup rw,nosuid shared:9 - cgroup2 cgroup2 rw,nsdelegate\n"
#define V1 "35 31 0:32 / /sys/fs/cgroup/memory rw shared:12 - cgroup cgroup rw,memory\n"

static char root[] = "/tmp/kerrd-memory-limit-XXXXXX";

static void put(const char *path, const char *text)
{
    char name[512];
    snprintf(name, sizeof name, "%s%s", root, path);
    for (char *slash = strchr(name + 1, '/'); slash; slash = strchr(slash + 1, '/')) {
        *slash = 0;
        mkdir(name, 0700);
        *slash = '/';
    }
    FILE *file = fopen(name, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static int clear(void **state)
{
    (void)state;
    char command[64];
    snprintf(command, sizeof command, "rm -rf %s/*", root);
    return system(command);
}

static int make_root(void **state)
{
    (void)state;
    return mkdtemp(root) ? 0 : 1;
}

static int remove_root(void **state) { return clear(state) || remove(root); }

static void machine(const char *mounts, const char *groups)
{
    put("/proc/meminfo", "MemTotal:       16000000 kB\nMemFree:          100000 kB\nMemAvailable:    4194304 kB\n");
    put("/proc/self/status", STATUS);
    put("/proc/self/mountinfo", mounts);
    put("/proc/self/cgroup", groups);
}

static struct kd_memory_limit limit(void)
{
    struct kd_memory_limit out;
    assert_true(kd_memory_limit_read(root, &out));
    return out;
}

static void nothing_known(void **state)
{
    (void)state;
    struct kd_memory_limit out = { .left = 7 };
    assert_false(kd_memory_limit_read(root, &out));
    assert_int_equal(out.left, 7);
}

static void a_machine_without_groups(void **state)
{
    (void)state;
    put("/proc/meminfo", "MemAvailable:    4194304 kB\n");
    assert_int_equal(limit().left, 4096 * MIB);
    assert_string_equal(limit().by, "the memory that is available");
    assert_int_equal(limit().own, 0);
    machine("", "");
    assert_int_equal(limit().left, 4096 * MIB);
    assert_int_equal(limit().own, 10 * MIB);
}

static void version_2(void **state)
{
    (void)state;
    machine(V2, "0::/a/b\n");
    put("/sys/fs/cgroup/a/b/memory.max", "max\n");
    put("/sys/fs/cgroup/a/memory.max", "max\n");
    assert_int_equal(limit().left, 4096 * MIB);
    put("/sys/fs/cgroup/a/b/memory.max", "2147483648\n");
    put("/sys/fs/cgroup/a/b/memory.current", "1073741824\n");
    assert_int_equal(limit().left, 1024 * MIB);
    assert_string_equal(limit().by, "the memory.max of a control group");
    put("/sys/fs/cgroup/a/b/memory.stat",
        "anon 5\nfile 9\nworkingset_inactive_file 1\ninactive_file 536870912\nactive_file 3\n");
    assert_int_equal(limit().left, 1536 * MIB);
    put("/sys/fs/cgroup/a/memory.max", "1073741824\n"); /* a parent group may have the lower limit */
    put("/sys/fs/cgroup/a/memory.current", "943718400\n");
    assert_int_equal(limit().left, 124 * MIB);
    put("/sys/fs/cgroup/a/memory.current", "1073745920\n"); /* more than the limit is in use, so nothing is left */
    assert_int_equal(limit().left, 0);
}

/* In a container with its own namespace the group is "/", and its files are at the mount point. */
static void the_root_of_a_namespace(void **state)
{
    (void)state;
    machine(V2, "0::/\n");
    put("/sys/fs/cgroup/memory.max", "1073741824\n");
    assert_int_equal(limit().left, 1024 * MIB);
}

static void version_1(void **state)
{
    (void)state;
    machine("34 31 0:31 / /sys/fs/cgroup/cpu rw - cgroup cgroup rw,cpu\n" V1,
            "9:name=systemd:/x\n4:hugetlb,memory:/docker/c0ffee\n0::/elsewhere\n");
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "9223372036854771712\n");
    put("/sys/fs/cgroup/memory/memory.usage_in_bytes", "5000000000\n");
    assert_int_equal(limit().left, 4096 * MIB);
    put("/sys/fs/cgroup/memory/docker/c0ffee/memory.limit_in_bytes", "2147483648\n");
    put("/sys/fs/cgroup/memory/docker/c0ffee/memory.usage_in_bytes", "536870912\n");
    put("/sys/fs/cgroup/memory/docker/c0ffee/memory.stat", "inactive_file 1\ntotal_inactive_file 268435456\n");
    assert_int_equal(limit().left, 1792 * MIB);
    assert_string_equal(limit().by, "the memory.limit_in_bytes of a control group");
}

/* Docker without a cgroup namespace: only the container's group is mounted, while the path is that of the host. */
static void a_mount_of_a_part(void **state)
{
    (void)state;
    machine("35 31 0:32 /docker/c0ffee /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n",
            "4:memory:/docker/c0ffee\n");
    put("/sys/fs/cgroup/memory/memory.limit_in_bytes", "1073741824\n");
    assert_int_equal(limit().left, 1024 * MIB);
    machine("35 31 0:32 /docker/c0ffee /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n",
            "4:memory:/docker/c0ffee/inner\n");
    put("/sys/fs/cgroup/memory/inner/memory.limit_in_bytes", "536870912\n");
    assert_int_equal(limit().left, 512 * MIB);
    machine("35 31 0:32 /docker/c0ffee /sys/fs/cgroup/memory ro - cgroup cgroup rw,memory\n",
            "4:memory:/docker/c0ffee00\n");
    assert_int_equal(limit().left, 1024 * MIB); /* the limit of another group, whose name begins with this one's,
                                                 * does not apply */
    machine(V2, "0::/../../user.slice\n");      /* outside the namespace */
    put("/sys/fs/cgroup/memory.max", "805306368\n");
    assert_int_equal(limit().left, 768 * MIB);
}

static void this_machine(void **state)
{
    (void)state;
    struct kd_memory_limit out;
    assert_true(kd_memory_limit_read("", &out));
    assert_true(out.left > MIB && out.left < UINT64_C(1) << 50 && out.own > 4096);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(nothing_known, clear),
        cmocka_unit_test_teardown(a_machine_without_groups, clear),
        cmocka_unit_test_teardown(version_2, clear),
        cmocka_unit_test_teardown(the_root_of_a_namespace, clear),
        cmocka_unit_test_teardown(version_1, clear),
        cmocka_unit_test_teardown(a_mount_of_a_part, clear),
        cmocka_unit_test(this_machine),
    };
    return cmocka_run_group_tests(tests, make_root, remove_root);
}

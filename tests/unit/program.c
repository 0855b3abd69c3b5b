/* Tests of running external programs: how they and their children end, their output, and how an idle program is
 * detected. */
#include "base/program.h"

#include <fcntl.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

static struct kd_program start(const char *script)
{
    struct kd_program p;
    struct kd_error error;
    int out = open("/dev/null", O_WRONLY);
    assert_int_equal(kd_program_start((const char *const[]) { "sh", "-c", script, NULL }, out, 1 << 20, &p, &error),
                     KD_OK);
    close(out);
    return p;
}

static void doze(void) { nanosleep(&(struct timespec) { .tv_nsec = 1000000 }, NULL); }

/* Checks that the process whose number is the last word of the output has ended: it no longer exists, or is a zombie
 * that its new parent has not reaped yet. */
static void expect_gone(const struct kd_program *p)
{
    char path[64], state = 0;
    const char *number = strrchr(p->said, ' ');
    assert_non_null(number);
    snprintf(path, sizeof path, "/proc/%ld/stat", strtol(number, NULL, 10));
    for (FILE *stat = NULL; state != 'Z' && (stat = fopen(path, "r")); doze()) {
        const int read = fscanf(stat, "%*d %*s %c", &state);
        fclose(stat);
        if (read != 1)
            break; /* the process went after its file was opened */
    }
}

static int end_of(struct kd_program *p)
{
    int code;
    while (!kd_program_over(p, &code))
        doze();
    return code;
}

/* A child of the program keeps its standard error open and sleeps. The caller must not wait for it, and the child must
 * not live on. */
static void test_a_child_that_stays(void **state)
{
    (void)state;
    struct kd_program p = start("sleep 600 & echo oops $! >&2; exit 3");
    char reason[300];
    assert_int_equal(end_of(&p), 3);
    kd_program_reason(&p, reason);
    assert_memory_equal(reason, "oops ", 5);
    expect_gone(&p);
    assert_true(p.told < 0 && p.in < 0 && !p.pid);
    int code;
    /* a second call kills nothing, in particular not our own process group */
    assert_true(kd_program_over(&p, &code) && code == -1);
}

/* The program does not inherit a descriptor that a library has opened without close-on-exec. */
static void test_it_has_four_descriptors(void **state)
{
    (void)state;
    char open_fd[64];
    const int null = open("/dev/null", O_RDONLY), left = fcntl(null, F_DUPFD, 10); /* without FD_CLOEXEC */
    close(null);
    assert_true(left >= 10);
    snprintf(open_fd, sizeof open_fd, "test ! -e /proc/self/fd/%d", left);
    struct kd_program p = start(open_fd);
    assert_int_equal(end_of(&p), 0);
    close(left);
    p = start("test -e /proc/self/fd/3");
    assert_int_equal(end_of(&p), 0);
}

/* The beginning and the end of long output are kept. */
static void test_a_long_story(void **state)
{
    (void)state;
    struct kd_program p = start("for i in $(seq 500); do echo warning $i >&2; done; echo No space left >&2; exit 1");
    assert_int_equal(end_of(&p), 1);
    assert_memory_equal(p.said, "warning 1\nwarning 2\n", 20);
    assert_true(strlen(p.last) < sizeof p.last && strlen(p.last) >= sizeof p.last / 2);
    assert_string_equal(p.last + strlen(p.last) - 26, "warning 500\nNo space left\n");
}

static void test_its_group_ends_with_it(void **state)
{
    (void)state;
    struct kd_program p = start("sleep 600 & echo ready $! >&2; wait");
    int code;
    while (!p.n_said)
        assert_false(kd_program_over(&p, &code));
    kd_program_end(&p);
    expect_gone(&p);
}

/* Time passes only by the numbers that are given to the functions. */
static void test_one_that_does_nothing(void **state)
{
    (void)state;
    struct kd_program p = start("read line; while :; do :; done");
    double now = 1e6, before = -1;
    for (int still = 0; still < 5; doze()) { /* until the program waits for its input line */
        still = p.used_ms == before ? still + 1 : 0;
        before = p.used_ms;
        kd_program_idle_ms(&p, false, now);
    }
    assert_true(kd_program_idle_ms(&p, true, now) == 0);
    for (int i = 1; i <= 40; i++)
        assert_true(kd_program_idle_ms(&p, false, now += 500) == 500 * i);
    assert_true(kd_program_idle_ms(&p, false, now += 3600e3) == 21e3); /* the machine was suspended */
    assert_true(kd_program_idle_ms(&p, true, now += 500) == 0);
    kd_program_idle_ms(&p, false, now += 500);
    assert_int_equal(kd_program_write(&p, "go\n", 3), 3);
    while (kd_program_idle_ms(&p, false, now) > 0) /* not idle, because it uses the processor */
        doze();
    kd_program_end(&p);
}

static void test_what_is_told(void **state)
{
    (void)state;
    static const struct {
        const char *said, *told;
    } lines[] = {
        { "", "" },
        { "\n first line\nUnknown encoder", "first line" },
        { "/tmp/kerrd-film-abc: No space left on device\n", "FILE: No space left on device" },
        { "cannot open '/home/me/a b', nor ./x or ../y (~/z)\r\n", "cannot open 'FILE b', nor FILE or FILE (FILE)" },
        { "\x1b[31m[libx264 @ 0x5581aabb]\x1b[0m broken\x07 at 30/1 and/or 1 / 2",
          "[libx264] broken at 30/1 and/or 1 / 2" },
        { "file:/etc/passwd says \xff\xc3", "file:FILE says ??" },
    };
    for (size_t i = 0; i < sizeof lines / sizeof *lines; i++) {
        struct kd_program p = KD_PROGRAM_NONE;
        char reason[300];
        snprintf(p.said, sizeof p.said, "%s", lines[i].said);
        kd_program_reason(&p, reason);
        assert_string_equal(reason, lines[i].told);
    }
    struct kd_program p = KD_PROGRAM_NONE;
    char reason[300];
    memset(p.said, 'x', sizeof p.said - 1);
    kd_program_reason(&p, reason);
    assert_true(strlen(reason) < sizeof reason && strlen(reason) > 250);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_child_that_stays),    cmocka_unit_test(test_it_has_four_descriptors),
        cmocka_unit_test(test_a_long_story),          cmocka_unit_test(test_its_group_ends_with_it),
        cmocka_unit_test(test_one_that_does_nothing), cmocka_unit_test(test_what_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Tests that a build that checks its threads aborts when a thread breaks a rule, and only then. Each rule is broken
 * once, in a process of its own. */
#include "base/watch.h"

#include <fcntl.h>
#include <pthread.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <time.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER, other = PTHREAD_MUTEX_INITIALIZER;

static void use_ms(double ms)
{
    struct timespec begun, now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &begun);
    do
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    while ((double)(now.tv_sec - begun.tv_sec) * 1e3 + (double)(now.tv_nsec - begun.tv_nsec) * 1e-6 < ms);
}

static void sync_disk(void) { fsync(open("/tmp", O_RDONLY)); }

static void *answer(void *user)
{
    kd_watch_answers();
    pthread_mutex_lock(&lock);
    pthread_mutex_unlock(&lock);
    return user;
}

static void answer_elsewhere(void)
{
    pthread_t thread;
    pthread_create(&thread, NULL, answer, NULL);
    pthread_join(thread, NULL);
}

static void sound(void)
{
    answer_elsewhere();
    pthread_mutex_lock(&other);
    sync_disk();
    pthread_mutex_unlock(&other);
    kd_watch_turn_begins();
    pthread_mutex_lock(&lock);
    pthread_mutex_unlock(&lock);
    sync_disk();
    unlink("/nowhere/at/all");
    kd_watch_turn_ends();
}

static void waits(void)
{
    kd_watch_answers();
    sync_disk();
}
static void removes(void)
{
    kd_watch_answers();
    unlinkat(AT_FDCWD, "/nowhere/at/all", 0);
}
static void long_turn(void)
{
    kd_watch_turn_begins();
    use_ms(210);
    kd_watch_turn_ends();
}
static void long_lock(void)
{
    pthread_mutex_lock(&lock);
    use_ms(9);
    pthread_mutex_unlock(&lock);
}
static void slow_lock(void)
{
    pthread_mutex_lock(&lock);
    kd_watch_slow_lock();
    pthread_mutex_lock(&other);
    pthread_mutex_unlock(&other);
    use_ms(9);
    pthread_mutex_unlock(&lock);
}
static void long_after_slow(void)
{
    slow_lock();
    long_lock();
}
static void answers_by_slow_lock(void)
{
    kd_watch_answers();
    slow_lock();
}
static void often(void)
{
    for (int i = 0; i < 3; i++) {
        pthread_mutex_lock(&lock);
        use_ms(3);
        pthread_mutex_unlock(&lock);
    }
}
static void holds(void)
{
    answer_elsewhere();
    pthread_mutex_lock(&lock);
    sync_disk();
}
static void held_before(void)
{
    pthread_mutex_lock(&lock);
    sync_disk();
    pthread_mutex_unlock(&lock);
    answer_elsewhere();
}

static void test_rules(void **state)
{
    (void)state;
    static const struct {
        void (*run)(void);
        int signal;
    } cases[] = {
        { sound, 0 },
        { waits, SIGABRT },
        { removes, SIGABRT },
        { long_turn, SIGABRT },
        { long_lock, SIGABRT },
        { often, SIGABRT },
        { holds, SIGABRT },
        { held_before, SIGABRT },
        { slow_lock, 0 },
        { long_after_slow, SIGABRT },
        { answers_by_slow_lock, SIGABRT },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int status;
        pid_t child = fork();
        if (!child) {
            setrlimit(RLIMIT_CORE, &(struct rlimit) { 0, 0 });
            cases[i].run();
            _exit(0);
        }
        assert_int_equal(waitpid(child, &status, 0), child);
        if ((WIFSIGNALED(status) ? WTERMSIG(status) : 0) != cases[i].signal)
            fail_msg("case %zu ended with %d", i, status);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_rules) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

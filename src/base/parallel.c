#include "base/parallel.h"

#include "base/cores.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>

struct work {
    size_t n;
    void (*each)(void *user, size_t item);
    void *user;
    _Atomic size_t next;
    bool yields; /* true for kd_parallel_idle: the threads end when other work needs their cores */
    pthread_t threads[KD_PARALLEL_THREADS - 1];
    size_t begun;
};

_Thread_local unsigned kd_parallel_threads;

static atomic_uint yielding; /* number of threads of all kd_parallel_idle calls that run now */

/* Runs the next item. Returns false if no item is left to start. */
static bool do_one(struct work *w)
{
    const size_t item = atomic_fetch_add(&w->next, 1);
    if (item >= w->n)
        return false;
    w->each(w->user, item);
    return true;
}

static void *run(void *work)
{
    struct work *w = work;
    while (do_one(w) && (!w->yields || kd_cores_idle() >= 0))
        ;
    if (w->yields)
        atomic_fetch_sub(&yielding, 1);
    return NULL;
}

static bool start(struct work *w)
{
    if (w->begun == KD_PARALLEL_THREADS - 1 || pthread_create(&w->threads[w->begun], NULL, run, w))
        return false;
    w->begun++;
    return true;
}

static void finish(struct work *w)
{
    while (do_one(w))
        ;
    for (size_t i = 0; i < w->begun; i++)
        pthread_join(w->threads[i], NULL);
}

/* Starts threads until there are `wanted` of them, but not more than one for each item. */
static void start_some(struct work *w, size_t wanted)
{
    wanted = wanted > w->n ? w->n : wanted;
    while (w->begun + 1 < wanted && start(w))
        ;
}

void kd_parallel(size_t n, void (*each)(void *user, size_t item), void *user)
{
    struct work work = { .n = n, .each = each, .user = user };
    start_some(&work, kd_cores());
    finish(&work);
}

/* Starts a thread for each idle core, but not more than there are items left. Starts none if the threads of other
 * calls already use all cores. */
static void start_where_idle(struct work *w)
{
    const size_t next = atomic_load(&w->next), left = next < w->n ? w->n - next : 0;
    if (left < 2)
        return;
    const int idle = kd_cores_idle();
    for (int i = 0; i < idle && (size_t)i + 1 < left; i++)
        if (atomic_fetch_add(&yielding, 1) + 1 >= kd_cores() || !start(w)) {
            atomic_fetch_sub(&yielding, 1);
            return;
        }
}

void kd_parallel_idle(size_t n, void (*each)(void *user, size_t item), void *user)
{
    struct work work = { .n = n, .each = each, .user = user, .yields = !kd_parallel_threads };
    start_some(&work, kd_parallel_threads);
    do {
        if (work.yields)
            start_where_idle(&work);
    } while (do_one(&work));
    finish(&work);
}

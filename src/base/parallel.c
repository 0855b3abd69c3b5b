#include "base/parallel.h"

#include "base/cores.h"

#include <pthread.h>
#include <stdatomic.h>

struct work {
    size_t n;
    void (*each)(void *user, size_t item);
    void *user;
    _Atomic size_t next;
};

static void *run(void *work)
{
    struct work *w = work;
    for (size_t item = atomic_fetch_add(&w->next, 1); item < w->n; item = atomic_fetch_add(&w->next, 1))
        w->each(w->user, item);
    return NULL;
}

void kd_parallel(size_t n, void (*each)(void *user, size_t item), void *user)
{
    struct work work = { .n = n, .each = each, .user = user };
    pthread_t threads[KD_PARALLEL_THREADS - 1];
    size_t wanted = kd_cores(), begun = 0;
    wanted = wanted > KD_PARALLEL_THREADS ? KD_PARALLEL_THREADS : wanted;
    wanted = wanted > n ? n : wanted;
    while (begun + 1 < wanted && !pthread_create(&threads[begun], NULL, run, &work))
        begun++;
    run(&work);
    for (size_t i = 0; i < begun; i++)
        pthread_join(threads[i], NULL);
}

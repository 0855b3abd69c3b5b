#include "orbit/batch.h"

#include <stdlib.h>

#define FEW 64         /* number of orbits that one slice computes; ten periods of each take some 10 ms in all */
#define STEPS 1000000u /* number of steps between two calls of `stop` */

size_t kd_orbit_batch_bytes(const struct kd_orbit_request *request)
{
    size_t series = request->params.series ? request->params.samples * sizeof(struct kd_orbit_sample) : 0;
    return request->n * (sizeof(struct kd_orbit_run) + series);
}

enum kd_status kd_orbit_batch_init(struct kd_orbit_batch *batch, const struct kd_orbit_request *request,
                                   struct kd_error *error)
{
    *batch = (struct kd_orbit_batch) { .request = request, .n = request->n };
    bool series = request->params.series && request->params.samples;
    batch->runs = calloc(request->n, sizeof *batch->runs);
    if (series)
        batch->samples = calloc(request->n * request->params.samples, sizeof *batch->samples);
    enum kd_status status = KD_OK;
    if (!batch->runs || (series && !batch->samples))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for %zu orbits", request->n);
    for (size_t i = 0; i < request->n && !status; i++)
        status = kd_orbit_run_init(&batch->runs[i], request, i, error);
    if (status)
        kd_orbit_batch_finish(batch);
    return status;
}

void kd_orbit_batch_finish(struct kd_orbit_batch *batch)
{
    free(batch->runs);
    free(batch->samples);
    batch->runs = NULL;
    batch->samples = NULL;
}

static bool given_up(const struct kd_orbit_batch *batch) { return batch->stop && batch->stop(batch->user); }

static enum kd_status follow(struct kd_orbit_batch *batch, size_t i, struct kd_error *error)
{
    struct kd_orbit_run *run = &batch->runs[i];
    struct kd_orbit_sample *samples = batch->samples ? batch->samples + i * run->samples : NULL;
    while (!kd_orbit_run_done(run)) {
        if (given_up(batch))
            return kd_error_set(error, KD_ECANCELLED, "stopped");
        kd_orbit_run_advance(run, STEPS, samples ? samples + run->sampled : NULL, run->samples - run->sampled);
    }
    return KD_OK;
}

static enum kd_status follow_abreast(struct kd_orbit_batch *batch, struct kd_orbit_run *const *runs, int n,
                                     struct kd_error *error)
{
    bool done = false;
    while (!done) {
        if (given_up(batch))
            return kd_error_set(error, KD_ECANCELLED, "stopped");
        kd_orbit_run_advance_abreast(runs, n, STEPS);
        done = true;
        for (int i = 0; i < n; i++)
            done &= kd_orbit_run_done(runs[i]);
    }
    return KD_OK;
}

static int by_steps(const void *a, const void *b)
{
    const struct kd_orbit_run *x = *(struct kd_orbit_run *const *)a, *y = *(struct kd_orbit_run *const *)b;
    return (x->steps > y->steps) - (x->steps < y->steps);
}

/* Follows a few orbits. Orbits that fit in SIMD lanes run there, in groups of similar duration. */
static enum kd_status follow_few(struct kd_orbit_batch *batch, size_t first, size_t last, struct kd_error *error)
{
    struct kd_orbit_run *all[FEW], *abreast[FEW];
    size_t n = 0;
    for (size_t i = first; i < last; i++)
        all[i - first] = &batch->runs[i];
    enum kd_status status = kd_orbit_run_prepare(all, last - first, error);
    for (size_t i = first; i < last && !status; i++) {
        if (kd_orbit_run_abreast(&batch->runs[i]))
            abreast[n++] = &batch->runs[i];
        else
            status = follow(batch, i, error);
    }
    qsort(abreast, n, sizeof *abreast, by_steps);
    for (size_t i = 0; i < n && !status; i += KD_ORBIT_LANES)
        status = follow_abreast(batch, abreast + i, (int)(n - i < KD_ORBIT_LANES ? n - i : KD_ORBIT_LANES), error);
    return status;
}

bool kd_orbit_batch_turn(struct kd_orbit_batch *batch)
{
    size_t first = atomic_fetch_add(&batch->next, FEW), last = first + FEW < batch->n ? first + FEW : batch->n;
    if (first >= batch->n)
        return false;
    struct kd_error error = { 0 };
    if (!atomic_load(&batch->failed) && follow_few(batch, first, last, &error) &&
        !atomic_exchange(&batch->failed, true))
        batch->error = error;
    atomic_fetch_add(&batch->finished, last - first);
    return last < batch->n;
}

bool kd_orbit_batch_done(const struct kd_orbit_batch *batch) { return atomic_load(&batch->finished) == batch->n; }

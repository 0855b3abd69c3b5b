#include "orbit/batch.h"

#include <stdlib.h>

#define FEW 16         /* some milliseconds at ten periods each */
#define STEPS 1000000u /* between two looks at whether to go on */

size_t kd_orbit_batch_bytes(const struct kd_orbit_request *request)
{
    size_t series = request->params.series ? request->params.samples * sizeof(struct kd_orbit_sample) : 0;
    return request->n * (sizeof(struct kd_orbit_run) + series);
}

enum kd_status kd_orbit_batch_init(struct kd_orbit_batch *batch, const struct kd_orbit_request *request, struct kd_error *error)
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

static enum kd_status follow(struct kd_orbit_batch *batch, size_t i, struct kd_error *error)
{
    struct kd_orbit_run *run = &batch->runs[i];
    struct kd_orbit_sample *samples = batch->samples ? batch->samples + i * run->samples : NULL;
    enum kd_status status = kd_orbit_run_prepare(run, error);
    while (!status && !kd_orbit_run_done(run)) {
        if (batch->stop && batch->stop(batch->user))
            return kd_error_set(error, KD_ECANCELLED, "stopped");
        kd_orbit_run_advance(run, STEPS, samples ? samples + run->sampled : NULL, run->samples - run->sampled);
    }
    return status;
}

bool kd_orbit_batch_turn(struct kd_orbit_batch *batch)
{
    size_t first = atomic_fetch_add(&batch->next, FEW), last = first + FEW < batch->n ? first + FEW : batch->n;
    if (first >= batch->n)
        return false;
    for (size_t i = first; i < last; i++) {
        struct kd_error error = { 0 };
        if (!atomic_load(&batch->failed) && follow(batch, i, &error) && !atomic_exchange(&batch->failed, true))
            batch->error = error;
    }
    atomic_fetch_add(&batch->finished, last - first);
    return last < batch->n;
}

bool kd_orbit_batch_done(const struct kd_orbit_batch *batch)
{
    return atomic_load(&batch->finished) == batch->n;
}

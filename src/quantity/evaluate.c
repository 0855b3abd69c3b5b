#include "quantity/quantity.h"

#include <stdlib.h>
#include <string.h>

/* Advances to the next combination of the parameters' values; the last parameter varies fastest. Returns true if a
 * parameter other than those along a curve has changed. */
static bool advance(const struct kd_quantity_request *request, size_t at[KD_QUANTITY_PARAMETERS])
{
    bool fresh = false;
    for (size_t i = request->quantity->n_parameters; i-- > 0;) {
        fresh |= !kd_quantity_is_along(request->quantity, i) && request->axes[i].count > 1;
        if (++at[i] < request->axes[i].count)
            return fresh;
        at[i] = 0;
    }
    return true;
}

enum kd_status kd_quantity_run_begin(struct kd_quantity_run *run, const struct kd_quantity_request *request,
                                     struct kd_error *error)
{
    const struct kd_quantity *quantity = request->quantity;
    size_t points = kd_quantity_points(request);
    *run = (struct kd_quantity_run) { .answer = { .request = *request, .points = points }, .fresh = true };
    if (points > KD_QUANTITY_POINTS)
        return kd_error_set(error, KD_EINVAL, "the ranges make more than %d points together", KD_QUANTITY_POINTS);
    run->answer.values = malloc(points * quantity->n_outputs * sizeof *run->answer.values);
    run->memory = quantity->memory_size ? calloc(1, quantity->memory_size) : NULL;
    if (run->answer.values && (run->memory || !quantity->memory_size))
        return KD_OK;
    kd_quantity_run_finish(run);
    return kd_error_set(error, KD_ENOMEM, "out of memory for %zu points", points);
}

enum kd_status kd_quantity_run_next(struct kd_quantity_run *run, struct kd_error *error)
{
    const struct kd_quantity_request *request = &run->answer.request;
    const struct kd_quantity *quantity = request->quantity;
    double in[KD_QUANTITY_PARAMETERS];
    for (size_t i = 0; i < quantity->n_parameters; i++)
        in[i] = kd_range_at(&request->axes[i], run->at[i]);
    enum kd_status status = quantity->evaluate(in, run->out, run->memory, run->fresh, error);
    if (status)
        return status;
    memcpy(run->answer.values + run->point++ * quantity->n_outputs, run->out, quantity->n_outputs * sizeof *run->out);
    run->fresh = advance(request, run->at);
    return KD_OK;
}

void kd_quantity_run_finish(struct kd_quantity_run *run)
{
    free(run->memory);
    kd_quantity_answer_finish(&run->answer);
    *run = (struct kd_quantity_run) { 0 };
}

enum kd_status kd_quantity_evaluate(const struct kd_quantity_request *request, struct kd_quantity_answer *answer,
                                    struct kd_error *error)
{
    struct kd_quantity_run run;
    enum kd_status status = kd_quantity_run_begin(&run, request, error);
    while (!status && run.point < run.answer.points)
        status = kd_quantity_run_next(&run, error);
    *answer = run.answer;
    run.answer = (struct kd_quantity_answer) { 0 };
    kd_quantity_run_finish(&run);
    if (status)
        kd_quantity_answer_finish(answer);
    return status;
}

void kd_quantity_answer_finish(struct kd_quantity_answer *answer)
{
    free(answer->values);
    *answer = (struct kd_quantity_answer) { 0 };
}

#include "quantity/quantity.h"

#include <stdlib.h>
#include <string.h>

/* The next combination, the last parameter fastest; true if one that is not `along` has changed. */
static bool advance(const struct kd_quantity_request *request, size_t at[KD_QUANTITY_PARAMETERS])
{
    bool fresh = false;
    for (size_t i = request->quantity->n_parameters; i-- > 0;) {
        fresh |= !request->quantity->parameters[i].along && request->axes[i].count > 1;
        if (++at[i] < request->axes[i].count)
            return fresh;
        at[i] = 0;
    }
    return true;
}

static enum kd_status fill(struct kd_quantity_answer *answer, void *memory, struct kd_error *error)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    double in[KD_QUANTITY_PARAMETERS], out[KD_QUANTITY_OUTPUTS] = { 0 };
    size_t at[KD_QUANTITY_PARAMETERS] = { 0 };
    bool fresh = true;
    for (size_t point = 0; point < answer->points; point++) {
        for (size_t i = 0; i < quantity->n_parameters; i++)
            in[i] = kd_axis_at(&answer->request.axes[i], at[i]);
        enum kd_status status = quantity->evaluate(in, out, memory, fresh, error);
        if (status)
            return status;
        memcpy(answer->values + point * quantity->n_outputs, out, quantity->n_outputs * sizeof *out);
        fresh = advance(&answer->request, at);
    }
    return KD_OK;
}

enum kd_status kd_quantity_evaluate(const struct kd_quantity_request *request, struct kd_quantity_answer *answer,
                                    struct kd_error *error)
{
    const struct kd_quantity *quantity = request->quantity;
    *answer = (struct kd_quantity_answer) { .request = *request, .points = kd_quantity_points(request) };
    if (answer->points > KD_QUANTITY_POINTS)
        return kd_error_set(error, KD_EINVAL, "the ranges make more than %d points together", KD_QUANTITY_POINTS);
    answer->values = malloc(answer->points * quantity->n_outputs * sizeof *answer->values);
    void *memory = quantity->memory_size ? calloc(1, quantity->memory_size) : NULL;
    enum kd_status status = answer->values && (memory || !quantity->memory_size)
                                ? fill(answer, memory, error)
                                : kd_error_set(error, KD_ENOMEM, "out of memory for %zu points", answer->points);
    free(memory);
    if (status)
        kd_quantity_answer_finish(answer);
    return status;
}

void kd_quantity_answer_finish(struct kd_quantity_answer *answer)
{
    free(answer->values);
    *answer = (struct kd_quantity_answer) { 0 };
}

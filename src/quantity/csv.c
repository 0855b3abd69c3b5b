/* Writes an answer as comma-separated values. */
#include "quantity/text.h"

#include "base/decimal.h"
#include "base/pause.h"

static void write_point(struct kd_writer *w, const struct kd_quantity_answer *answer, size_t point)
{
    const struct kd_quantity_request *request = &answer->request;
    const struct kd_quantity *quantity = request->quantity;
    size_t at[KD_QUANTITY_PARAMETERS];
    for (size_t i = quantity->n_parameters, rest = point; i-- > 0; rest /= request->axes[i].count)
        at[i] = rest % request->axes[i].count;
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        kd_write(w, i ? "," : "");
        kd_quantity_write_value(w, &quantity->parameters[i],
                                kd_decimal_round(kd_range_at(&request->axes[i], at[i]), (int)request->digits), "");
    }
    for (size_t k = 0; k < quantity->n_outputs; k++) {
        kd_write(w, ",");
        kd_quantity_write_number(
            w, kd_decimal_round(answer->values[point * quantity->n_outputs + k], (int)request->digits), "");
    }
    kd_write(w, "\n");
}

enum kd_status kd_quantity_csv(const struct kd_quantity_answer *answer, struct kd_buffer *out)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    struct kd_writer writer = { .out = out }, *w = &writer;
    for (size_t i = 0; i < quantity->n_parameters; i++)
        kd_write(w, "%s%s", i ? "," : "", quantity->parameters[i].name);
    for (size_t k = 0; k < quantity->n_outputs; k++)
        kd_write(w, ",%s", quantity->outputs[k].name);
    kd_write(w, "\n");
    for (size_t point = 0; point < answer->points && !writer.status; point++) {
        kd_pause_every(point, 256);
        write_point(w, answer, point);
    }
    return writer.status;
}

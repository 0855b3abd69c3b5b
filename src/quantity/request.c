/* Reads requests for quantities: the value or range of a parameter, from text. */
#include "quantity/quantity.h"

#include "base/decimal.h"
#include "document/text.h"

#include <string.h>

const struct kd_row kd_quantity_digits = {
    .name = "digits",
    .kind = KD_KIND_INT,
    .offset = offsetof(struct kd_quantity_request, digits),
    .least = 1,
    .most = KD_DECIMAL_DIGITS,
    .help = "significant digits of numbers in lists, and of all numbers in CSV; 17: full double precision",
};

bool kd_quantity_is_along(const struct kd_quantity *quantity, size_t i)
{
    return i + quantity->along >= quantity->n_parameters;
}

enum kd_status kd_quantity_request_set(struct kd_quantity_request *request, const char *name, const char *text,
                                       struct kd_error *error)
{
    const struct kd_document asked = { .rows = request->quantity->parameters, .n = request->quantity->n_parameters };
    const struct kd_value value = kd_value_typed(text);
    char pointer[120] = "";
    kd_text_pointer(pointer, sizeof pointer, name);
    for (size_t i = 0; i < asked.n; i++)
        if (!strcmp(asked.rows[i].name, name))
            return kd_row_range(&asked.rows[i], text, pointer, &request->axes[i], error);
    return strcmp(name, kd_quantity_digits.name)
               ? kd_document_unknown(&asked, name, error)
               : kd_row_put(&kd_quantity_digits, request, &value, name, pointer, error);
}

void kd_quantity_request_init(struct kd_quantity_request *request, const struct kd_quantity *quantity)
{
    *request = (struct kd_quantity_request) { .quantity = quantity, .digits = KD_DECIMAL_DIGITS };
    for (size_t i = 0; i < quantity->n_parameters; i++)
        kd_quantity_request_set(request, quantity->parameters[i].name, quantity->parameters[i].typed, NULL);
}

/* Counts the combinations of values, either of all parameters or of those that are not along a curve. */
static size_t combinations(const struct kd_quantity_request *request, bool all)
{
    size_t n = 1;
    for (size_t i = 0; i < request->quantity->n_parameters; i++)
        if (all || !kd_quantity_is_along(request->quantity, i))
            n = n * request->axes[i].count > KD_QUANTITY_POINTS ? KD_QUANTITY_POINTS + 1 : n * request->axes[i].count;
    return n;
}

size_t kd_quantity_points(const struct kd_quantity_request *request) { return combinations(request, true); }

double kd_quantity_cost_ms(const struct kd_quantity_request *request)
{
    return 1e-3 * ((double)combinations(request, true) * request->quantity->point_us +
                   (double)combinations(request, false) * request->quantity->fresh_us);
}

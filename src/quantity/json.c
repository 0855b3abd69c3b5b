/* Writes an answer as JSON, and the list of quantities. */
#include "quantity/text.h"

#include "base/decimal.h"
#include "base/pause.h"
#include "physics/spacetime/hole.h"

#include <string.h>

static void write_axis(struct kd_writer *w, const struct kd_row *p, const struct kd_range *axis, int digits)
{
    if (axis->count == 1) {
        kd_quantity_write_value(w, p, axis->first, "\"");
        return;
    }
    for (size_t i = 0; i < axis->count; i++) {
        kd_write(w, i ? "," : "[");
        kd_quantity_write_number(w, kd_decimal_round(kd_range_at(axis, i), digits), "null");
    }
    kd_write(w, "]");
}

/* If several parameters are ranges, writes their names and their numbers of values, the outermost range first. */
static void write_shape(struct kd_writer *w, const struct kd_quantity_request *request)
{
    const struct kd_quantity *quantity = request->quantity;
    size_t ranges = 0;
    for (size_t i = 0; i < quantity->n_parameters; i++)
        ranges += request->axes[i].count > 1;
    for (int pass = 0; ranges > 1 && pass < 2; pass++) {
        const char *separator = pass ? "],\"shape\":[" : ",\"ranges\":[";
        for (size_t i = 0; i < quantity->n_parameters; i++)
            if (request->axes[i].count > 1) {
                if (pass)
                    kd_write(w, "%s%zu", separator, request->axes[i].count);
                else
                    kd_write(w, "%s\"%s\"", separator, quantity->parameters[i].name);
                separator = ",";
            }
    }
    kd_write(w, "%s", ranges > 1 ? "]" : "");
}

/* True if the output depends on a parameter that is a range. */
static bool varies(const struct kd_quantity_request *request, const struct kd_output *output)
{
    for (size_t i = 0; i < request->quantity->n_parameters; i++)
        if (request->axes[i].count > 1 && !(output->fixed && kd_quantity_is_along(request->quantity, i)))
            return true;
    return false;
}

static void write_values(struct kd_writer *w, const struct kd_quantity_answer *answer)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    for (size_t k = 0; k < quantity->n_outputs; k++) {
        kd_write(w, "%s\"%s\":", k ? "," : "", quantity->outputs[k].name);
        bool list = varies(&answer->request, &quantity->outputs[k]);
        for (size_t i = 0; i < (list ? answer->points : 1); i++) {
            if (list && !w->status)
                w->status = kd_buffer_append(w->out, i ? "," : "[", 1);
            kd_pause_every(i, 1024);
            double value = answer->values[i * quantity->n_outputs + k];
            kd_quantity_write_number(w, list ? kd_decimal_round(value, (int)answer->request.digits) : value, "null");
        }
        kd_write(w, list ? "]" : "");
    }
}

/* Writes "name":"unit" for each parameter and output that has a unit. */
static void write_units(struct kd_writer *w, const struct kd_quantity *quantity)
{
    const char *separator = "";
    for (size_t i = 0; i < quantity->n_parameters; i++)
        if (quantity->parameters[i].kind != KD_KIND_WORD) {
            kd_write(w, "%s\"%s\":\"%s\"", separator, quantity->parameters[i].name, quantity->parameters[i].unit);
            separator = ",";
        }
    for (size_t i = 0; i < quantity->n_outputs; i++, separator = ",")
        kd_write(w, "%s\"%s\":\"%s\"", separator, quantity->outputs[i].name, quantity->outputs[i].unit);
}

/* The value of a parameter. For a range it is a value of the range that is not 0. If the quantity does not have the
 * parameter, it is 0. */
static double value_of(const struct kd_quantity_request *request, const char *name)
{
    for (size_t i = 0; i < request->quantity->n_parameters; i++) {
        const struct kd_range *axis = &request->axes[i];
        if (!strcmp(request->quantity->parameters[i].name, name))
            return axis->first != 0 ? axis->first : kd_range_at(axis, axis->count - 1);
    }
    return 0;
}

/* Writes the quantity's approximations, and those of the hole. */
static void write_approximations(struct kd_writer *w, const struct kd_quantity_request *request)
{
    const char *const *own = request->quantity->approximations;
    const struct kd_hole_sentence *of_hole;
#define VALUE(x, of, ...) .of = value_of(request, #of),
    const struct kd_hole_given hole = { KD_HOLE_MORE(VALUE, ) };
#undef VALUE
    const char *separator = "[";
    for (size_t i = 0; own[i]; i++, separator = ",") {
        kd_write(w, "%s", separator);
        kd_write_string(w, own[i]);
    }
    for (size_t i = 0; (of_hole = kd_hole_sentence(hole, i)); i++, separator = ",") {
        kd_write(w, "%s", separator);
        kd_write_string(w, of_hole->text);
    }
    kd_write(w, *separator == '[' ? "[]" : "]");
}

enum kd_status kd_quantity_json(const struct kd_quantity_answer *answer, struct kd_buffer *out)
{
    const struct kd_quantity *quantity = answer->request.quantity;
    struct kd_writer writer = { .out = out }, *w = &writer;
    kd_write(w, "{\"quantity\":\"%s\",\"parameters\":{", quantity->name);
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        kd_write(w, "%s\"%s\":", i ? "," : "", quantity->parameters[i].name);
        write_axis(w, &quantity->parameters[i], &answer->request.axes[i], (int)answer->request.digits);
    }
    kd_write(w, "}");
    write_shape(w, &answer->request);
    kd_write(w, ",\"values\":{");
    write_values(w, answer);
    kd_write(w, "},\"units\":{");
    write_units(w, quantity);
    kd_write(w, "},\"sources\":");
    kd_quantity_write_sentences(w, quantity->sources);
    kd_write(w, ",\"approximations\":");
    write_approximations(w, &answer->request);
    kd_write(w, "}\n");
    return writer.status;
}

static void write_member(struct kd_writer *w, const char *name, const char *text)
{
    kd_write(w, ",\"%s\":", name);
    kd_write_string(w, text);
}

static void list_parameter(struct kd_writer *w, const struct kd_row *p)
{
    kd_write(w, "{\"name\":\"%s\"", p->name);
    if (p->kind != KD_KIND_WORD)
        write_member(w, "unit", p->unit);
    write_member(w, "default", p->typed);
    char allowed[KD_ALLOWED_SIZE];
    kd_row_allowed(p, allowed);
    write_member(w, "allowed", allowed);
    write_member(w, "help", p->help);
    kd_write(w, "}");
}

static void list_quantity(struct kd_writer *w, const struct kd_quantity *quantity)
{
    kd_write(w, "{\"name\":\"%s\"", quantity->name);
    write_member(w, "summary", quantity->summary);
    kd_write(w, ",\"parameters\":[");
    for (size_t i = 0; i < quantity->n_parameters; i++) {
        kd_write(w, "%s", i ? "," : "");
        list_parameter(w, &quantity->parameters[i]);
    }
    kd_write(w, "],\"outputs\":[");
    for (size_t i = 0; i < quantity->n_outputs; i++) {
        kd_write(w, "%s{\"name\":\"%s\"", i ? "," : "", quantity->outputs[i].name);
        write_member(w, "unit", quantity->outputs[i].unit);
        write_member(w, "help", quantity->outputs[i].help);
        kd_write(w, "}");
    }
    kd_write(w, "],\"sources\":");
    kd_quantity_write_sentences(w, quantity->sources);
    kd_write(w, ",\"approximations\":");
    kd_quantity_write_sentences(w, quantity->approximations);
    kd_write(w, "}");
}

enum kd_status kd_quantity_list_json(struct kd_buffer *out)
{
    struct kd_writer writer = { .out = out }, *w = &writer;
    for (size_t i = 0; i < kd_quantity_count; i++) {
        kd_write(w, i ? "," : "{\"quantities\":[");
        list_quantity(w, kd_quantities[i]);
    }
    kd_write(w, "]}\n");
    return writer.status;
}

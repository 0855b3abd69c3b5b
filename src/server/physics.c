/* GET /v1/physics and /v1/physics/NAME: quantities by name (quantity/quantity.h). */
#include "server/negotiate.h"
#include "server/reply.h"

#include "quantity/quantity.h"

#include <stdio.h>
#include <string.h>

#define JSON_TYPE "application/json"
#define CSV_TYPE "text/csv"
#define OFFERED JSON_TYPE ", " CSV_TYPE
#define LONGEST_MS 50. /* of this thread, which serves everybody */

enum form { FORM_JSON, FORM_CSV, FORM_NONE };

enum MHD_Result kd_handle_quantities(struct kd_request *request)
{
    struct kd_buffer json = { 0 };
    return kd_reply_json(request, kd_quantity_list_json(&json), &json, request->route->answer);
}

static enum form accepted(struct kd_request *request)
{
    struct kd_buffer accept = kd_reply_header_list(request, "Accept");
    int json = kd_accept_weight((const char *)accept.data, JSON_TYPE);
    int csv = kd_accept_weight((const char *)accept.data, CSV_TYPE);
    kd_buffer_finish(&accept);
    return csv > json ? FORM_CSV : json ? FORM_JSON : FORM_NONE;
}

/* What the query says; `format` is ours, for links that cannot say Accept. */
static enum kd_status read_query(const struct kd_target *target, struct kd_quantity_request *quantity, enum form *form,
                                 struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < target->n_pairs && !status; i++) {
        const char *name = target->pairs[i].name, *value = target->pairs[i].value;
        for (size_t k = 0; k < i && !status; k++)
            if (!strcmp(target->pairs[k].name, name))
                status = kd_error_field(error, "", "the query gives %.100s twice", name);
        if (status)
            break;
        if (strcmp(name, "format"))
            status = kd_quantity_request_set(quantity, name, value, error);
        else if (!strcmp(value, "json") || !strcmp(value, "csv"))
            *form = *value == 'c' ? FORM_CSV : FORM_JSON;
        else
            status = kd_error_field(error, "/format", "format is \"%.40s\", allowed are \"json\", \"csv\"", value);
    }
    if (!status && kd_quantity_points(quantity) <= KD_QUANTITY_POINTS && kd_quantity_cost_ms(quantity) > LONGEST_MS)
        status = kd_error_field(error, "",
                                "%zu points of %s take about %.0f ms, more than the %.0f ms that are given here: ask for fewer, or "
                                "`kerrd physics`", kd_quantity_points(quantity), quantity->quantity->name,
                                kd_quantity_cost_ms(quantity), LONGEST_MS);
    return status;
}

static enum MHD_Result refuse(struct kd_request *request, const struct kd_error *error)
{
    struct kd_problem problem = kd_problem_from(error);
    if (error->status == KD_EINVAL)
        problem.type = KD_PROBLEM_INVALID_PARAMETERS;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result unknown(struct kd_request *request)
{
    char names[300], detail[400];
    kd_quantity_names(names, sizeof names);
    snprintf(detail, sizeof detail, "there is no quantity of this name; known are %s", names);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = detail });
}

static enum MHD_Result deliver(struct kd_request *request, const struct kd_quantity_answer *answer, enum form form)
{
    struct kd_buffer text = { 0 };
    struct kd_error error;
    enum kd_status status = form == FORM_CSV ? kd_quantity_csv(answer, &text) : kd_quantity_json(answer, &text);
    if (status) {
        kd_buffer_finish(&text);
        kd_error_set(&error, status, "out of memory for %zu points", answer->points);
        return refuse(request, &error);
    }
    request->reply_bytes = text.size;
    struct MHD_Response *response = kd_reply_take(&text, form == FORM_CSV ? CSV_TYPE "; charset=utf-8; header=present" : JSON_TYPE);
    if (response)
        MHD_add_response_header(response, "Vary", "Accept");
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

enum MHD_Result kd_handle_quantity(struct kd_request *request)
{
    const struct kd_quantity *quantity = kd_quantity_find(request->rest);
    struct kd_quantity_request asked;
    struct kd_quantity_answer answer;
    struct kd_error error = { 0 };
    if (!quantity)
        return unknown(request);
    enum form form = accepted(request);
    kd_quantity_request_init(&asked, quantity);
    if (read_query(&request->target, &asked, &form, &error))
        return refuse(request, &error);
    if (form == FORM_NONE)
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                                .offered = OFFERED,
                                                                .detail = "quantities are offered as " OFFERED });
    if (kd_quantity_evaluate(&asked, &answer, &error))
        return refuse(request, &error);
    enum MHD_Result result = deliver(request, &answer, form);
    kd_quantity_answer_finish(&answer);
    return result;
}

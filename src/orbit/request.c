#include "orbit/request.h"

#include "base/decimal.h"
#include "orbit/cases.h"
#include "document/members.h"
#include "orbit/fields.h"
#include "physics/math/angle.h"
#include "physics/spacetime/hole.h"
#include "document/number.h"
#include "document/text.h"
#include "document/tree.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const form_texts[KD_ORBIT_FORMS] = {
    "p, e and inclination_deg",
    "energy, angular_momentum and carter",
    "position and velocity",
    "case",
};

void kd_orbit_request_init(struct kd_orbit_request *request)
{
    *request = (struct kd_orbit_request) {
        .params = { KD_HOLE_ALL(NAN), .periods = NAN, .time = NAN, .r_max = 100, .tolerance = 1e-12, .mass_msun = NAN,
                    .samples = 1000, .digits = KD_DECIMAL_DIGITS, .seen = { INFINITY, NAN, 0, KD_OBSERVER_STATIC } }
    };
}

void kd_orbit_request_finish(struct kd_orbit_request *request)
{
    free(request->specs);
    *request = (struct kd_orbit_request) { 0 };
}

static struct kd_orbit_spec empty_spec(void)
{
    return (struct kd_orbit_spec) {
        .form = KD_ORBIT_FORMS, KD_HOLE_ALL(NAN), .r = NAN, .theta_deg = 90, .frame = KD_OBSERVER_ZAMO
    };
}

#define FORMS "an orbit must be defined by %s, by %s, by %s, or by %s"
#define FORM_TEXTS form_texts[0], form_texts[1], form_texts[2], form_texts[3]

/* Refuses a field that does not belong to the orbit's form. */
static enum kd_status mixed(const struct kd_orbit_spec *spec, const struct kd_row *field, const char *pointer,
                            struct kd_error *error)
{
    size_t i = 0;
    while (!(spec->seen & 1u << i) || kd_orbit_document.rows[i].of != 1u << spec->form)
        i++;
    return kd_error_field(error, pointer, "%s cannot be used with %s; " FORMS, field->name,
                          kd_orbit_document.rows[i].name, FORM_TEXTS);
}

/* The form of an orbit to which a field belongs. */
static enum kd_orbit_form form_of(const struct kd_row *row)
{
    enum kd_orbit_form form = KD_ORBIT_SHAPE;
    while (form < KD_ORBIT_FORMS && row->of != 1u << form)
        form++;
    return form;
}

/* Checks that an orbit is complete in exactly one form. */
static enum kd_status settle(struct kd_orbit_spec *spec, const char *pointer, struct kd_error *error)
{
    const uint64_t seen = spec->seen;
    for (size_t i = 0; i < kd_orbit_document.n; i++) {
        const struct kd_row *row = &kd_orbit_document.rows[i];
        if (!(seen & 1u << i) || !row->of)
            continue;
        if (spec->form != KD_ORBIT_FORMS && row->of != 1u << spec->form)
            return mixed(spec, row, pointer, error);
        spec->form = form_of(row);
    }
    if (spec->form == KD_ORBIT_FORMS)
        return kd_error_field(error, pointer, FORMS, FORM_TEXTS);
    for (size_t i = 0; i < kd_orbit_document.n; i++) {
        const struct kd_row *row = &kd_orbit_document.rows[i];
        if (row->of != 1u << spec->form || !row->needed || seen & 1u << i)
            continue;
        char missing[sizeof error->pointer];
        snprintf(missing, sizeof missing, "%s", pointer);
        if (row->object)
            kd_text_pointer(missing, sizeof missing, row->object);
        kd_text_pointer(missing, sizeof missing, row->name);
        return kd_error_field(error, missing, "%s is missing", row->name);
    }
    return KD_OK;
}

static enum kd_status read_orbit(struct kd_orbit_spec *spec, const cJSON *object, const char *pointer,
                                 struct kd_error *error)
{
    *spec = empty_spec();
    enum kd_status status = kd_document_read(&kd_orbit_document, spec, object, pointer, &spec->seen, error);
    return status ? status : settle(spec, pointer, error);
}

static enum kd_status read_orbits(struct kd_orbit_request *request, const cJSON *item, struct kd_error *error)
{
    size_t n = 1, i = 0;
    enum kd_status status = KD_OK;
    request->many = !strcmp(item->string, "orbits");
    if (request->many) {
        if (!cJSON_IsArray(item))
            return kd_member_refuse(item, "/orbits", "an array of orbits", error);
        n = (size_t)cJSON_GetArraySize(item);
        if (!n || n > KD_ORBITS_MAX)
            return kd_error_field(error, "/orbits", "there are %zu orbits; there must be 1 to %u", n, KD_ORBITS_MAX);
    }
    if (!(request->specs = calloc(n, sizeof *request->specs)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu orbits", n);
    request->n = n;
    if (!request->many)
        return read_orbit(request->specs, item, "/orbit", error);
    for (const cJSON *one = item->child; one && !status; one = one->next, i++) {
        char pointer[40];
        snprintf(pointer, sizeof pointer, "/orbits/%zu", i);
        status = read_orbit(&request->specs[i], one, pointer, error);
    }
    return status;
}

static enum kd_status read_tree(struct kd_orbit_request *request, const cJSON *root, struct kd_error *error)
{
    const cJSON *one = cJSON_GetObjectItemCaseSensitive(root, "orbit"),
                *many = cJSON_GetObjectItemCaseSensitive(root, "orbits");
    if (one && many)
        return kd_error_field(error, "/orbits",
                              "orbits are given twice; a request must have either orbit or orbits, once");
    enum kd_status status = kd_document_read(&kd_orbit_request_document, &request->params, root, "", NULL, error);
    return status || !(one || many) ? status : read_orbits(request, one ? one : many, error);
}

enum kd_status kd_orbit_request_json(struct kd_orbit_request *request, const char *text, size_t length,
                                     struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status;
    KD_TRY(kd_tree_parse(text, length, KD_ORBIT_BODY_MAX, 16 * KD_ORBITS_MAX, &root, error));
    KD_TRY(read_tree(request, root, error));
    KD_TRY(kd_orbit_request_check(request, error));
done:
    kd_tree_free(root);
    return status;
}

/* Sets a field of an orbit. "r" means position.r if the orbit's form has a position. */
static enum kd_status set_field(struct kd_orbit_request *request, const struct kd_row *field, const char *text,
                                const char *pointer, struct kd_error *error)
{
    const struct kd_value value = kd_value_typed(text);
    if (!request->specs) {
        if (!(request->specs = malloc(sizeof *request->specs)))
            return kd_error_set(error, KD_ENOMEM, "out of memory for an orbit");
        *request->specs = empty_spec();
        request->n = 1;
    }
    struct kd_orbit_spec *spec = request->specs;
    if (request->many)
        return kd_error_field(error, pointer,
                              "%s cannot be used with a list of %zu orbits, because it belongs to a single orbit",
                              field->name, request->n);
    if (!strcmp(field->name, "r") && spec->form != KD_ORBIT_CONSTANTS)
        field = kd_document_find(&kd_orbit_document, "position.r");
    enum kd_status status = kd_row_put(field, spec, &value, field->name, pointer, error);
    bool other = spec->form != KD_ORBIT_FORMS && field->of && field->of != 1u << spec->form;
    if (!status && other)
        return mixed(spec, field, pointer, error);
    if (!status && field->of)
        spec->form = form_of(field);
    spec->seen |= UINT64_C(1) << (field - kd_orbit_document.rows);
    return status;
}

enum kd_status kd_orbit_request_set(struct kd_orbit_request *request, const char *name, const char *text,
                                    struct kd_error *error)
{
    char pointer[sizeof error->pointer] = "";
    const struct kd_row *field = kd_document_find(&kd_orbit_document, name);
    kd_text_pointer(pointer, sizeof pointer, name);
    if (field && !kd_document_find(&kd_orbit_request_document, name))
        return set_field(request, field, text, pointer, error);
    return kd_document_set(&kd_orbit_request_document, &request->params, name, text, NULL, error);
}

enum kd_status kd_orbit_request_check(const struct kd_orbit_request *request, struct kd_error *error)
{
    const struct kd_orbit_params *p = &request->params;
    if (!request->n)
        return kd_error_field(error, "/orbit", "orbit is missing; a request must have orbit, or orbits with a list");
    if (!request->many) { /* fields were set by name, one at a time, so the orbit may be incomplete */
        struct kd_orbit_spec spec = *request->specs;
        enum kd_status status = settle(&spec, "/orbit", error);
        if (status)
            return status;
    }
    if (!isnan(p->periods) && !isnan(p->time))
        return kd_error_field(error, "/duration",
                              "periods cannot be used with time, because a duration is either of them");
    if (p->or_end && isnan(p->periods))
        return kd_error_field(error, "/duration/or_end",
                              "or_end is true without periods; it must be false, because an orbit without a duration "
                              "is always followed to its end");
    if (!kd_orbit_is_seen(p) &&
        (isfinite(p->seen.r) || p->seen.azimuth_deg != 0 || p->seen.motion != KD_OBSERVER_STATIC))
        return kd_error_field(error, "/seen/observer_inclination_deg",
                              "observer_inclination_deg is missing; seen needs the observer's polar angle");
    if (kd_orbit_is_seen(p) && request->many)
        return kd_error_field(error, "/seen",
                              "seen cannot be used with a list of %zu orbits, because it belongs to a single orbit",
                              request->n);
    if (kd_orbit_is_seen(p) && p->samples > KD_ORBIT_SEEN_MAX)
        return kd_error_field(error, "/samples", "samples is %u; with seen it must be at most %u", p->samples,
                              KD_ORBIT_SEEN_MAX);
    if (p->samples == 1)
        return kd_error_field(
            error, "/samples",
            "samples is 1; it must be 0 for none, or at least 2, because both ends of the path are samples");
    if (request->many && p->series && (double)p->samples * (double)request->n > KD_ORBIT_SAMPLES_MAX)
        return kd_error_field(error, "/samples",
                              "samples is %u for each of %zu orbits; there must be at most %u samples in all",
                              p->samples, request->n, KD_ORBIT_SAMPLES_MAX);
    return KD_OK;
}

/* Error of a whirl that rounding of the constants of motion causes: 4 ulp times kd_orbit_whirl. */
static double rounding_of(const struct kd_orbit_spec *s, const struct kd_orbit *orbit,
                          const struct kd_orbit_state *start)
{
    /* false for an orbit given by p and e, whose turning points are known exactly */
    bool given = s->form == KD_ORBIT_CONSTANTS || s->form == KD_ORBIT_STATE;
    return given ? 4 * DBL_EPSILON * kd_orbit_whirl(orbit, start, NULL) : 0;
}

static enum kd_status check_whirl(const struct kd_orbit_spec *s, const struct kd_orbit *orbit,
                                  const struct kd_orbit_state *start, double *rounding, struct kd_error *error)
{
    double r;
    char energy[KD_NUMBER_SIZE], momentum[KD_NUMBER_SIZE];
    *rounding = rounding_of(s, orbit, start);
    if (*rounding <= KD_ORBIT_ROUNDING_MAX)
        return KD_OK;
    kd_orbit_whirl(orbit, start, &r);
    kd_number_format(energy, orbit->energy);
    kd_number_format(momentum, orbit->momentum);
    return kd_error_field(error, s->form == KD_ORBIT_CONSTANTS ? "/angular_momentum" : "/velocity",
                          "energy %s and angular_momentum %s are too close to those of the unstable circular orbit at "
                          "r = %.9g: double precision cannot decide how long the body whirls there, or whether it "
                          "falls in or returns; they must differ from these by some parts in 1e12",
                          energy, momentum, r);
}

static enum kd_status solve(const struct kd_orbit_spec *s, const struct kd_orbit_params *params, struct kd_orbit *orbit,
                            struct kd_orbit_state *start, double *rounding, struct kd_error *error)
{
    const struct kd_hole hole = kd_hole_in(s);
    double x = kd_cos_deg(s->inclination_deg), r = s->r;
    enum kd_status status;
    switch (s->form) {
    case KD_ORBIT_SHAPE: status = kd_orbit_from_shape(&hole, s->p, s->e, x, orbit, error); break;
    case KD_ORBIT_CONSTANTS:
        if (isnan(r) && s->energy >= 1)
            r = params->r_max;
        status = kd_orbit_from_constants(&hole, s->energy, s->momentum, s->carter, r, orbit, error);
        break;
    default: status = kd_orbit_from_state(&hole, s->place_r, s->theta_deg, s->frame, s->v, orbit, start, error);
    }
    if (!status && s->form != KD_ORBIT_STATE)
        *start = kd_orbit_start(orbit, s->form == KD_ORBIT_SHAPE ? NAN : r, s->outward);
    if (!status && s->form == KD_ORBIT_CONSTANTS && s->outward && orbit->fate == KD_ORBIT_PLUNGE && !orbit->turns_out)
        orbit->fate = KD_ORBIT_ESCAPE;
    return status ? status : check_whirl(s, orbit, start, rounding, error);
}

/* Sets the parameters of the hole that the orbit does not give. It does not set the spin of a named case, which may
 * have its own. */
static void inherit(struct kd_orbit_spec *spec, const struct kd_orbit_params *params)
{
    if (isnan(spec->spin))
        spec->spin = params->spin;
#define INHERIT(x, name, ...) \
    if (isnan(spec->name)) \
        spec->name = isnan(params->name) ? 0 : params->name;
    KD_HOLE_MORE(INHERIT, )
#undef INHERIT
}

/* True if an error about the hole concerns a parameter that the orbit takes from the request. */
static bool is_of_request(const char *pointer, const struct kd_orbit_spec *spec)
{
#define OR_MORE(x, name, ...) || (!strcmp(pointer, "/" #name) && isnan(spec->name))
    return (!strcmp(pointer, "/spin") && isnan(spec->spin)) KD_HOLE_MORE(OR_MORE, );
#undef OR_MORE
}

enum kd_status kd_orbit_request_solve(const struct kd_orbit_request *request, size_t index, struct kd_orbit *orbit,
                                      struct kd_orbit_state *start, double *rounding, struct kd_error *error)
{
    struct kd_orbit_spec spec = request->specs[index];
    struct kd_error why = { 0 };
    inherit(&spec, &request->params);
    if (spec.form == KD_ORBIT_CASE)
        spec = kd_orbit_case_spec(spec.named, kd_hole_given(&spec));
    if (isnan(spec.spin))
        spec.spin = 0;
    enum kd_status status = solve(&spec, &request->params, orbit, start, rounding, &why);
    if (!status)
        return KD_OK;
    char pointer[sizeof why.pointer + 40];
    if (request->many)
        snprintf(pointer, sizeof pointer, "/orbits/%zu%s", index, why.pointer);
    else if (is_of_request(why.pointer, &request->specs[0]))
        snprintf(pointer, sizeof pointer, "%s", why.pointer);
    else
        snprintf(pointer, sizeof pointer, "/orbit%s", why.pointer);
    return kd_error_field(error, pointer, "%s", why.message);
}

#include "orbit/request.h"

#include "base/decimal.h"
#include "base/spelling.h"
#include "orbit/cases.h"
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
    *request = (struct kd_orbit_request) { .params = { .spin = NAN,
                                                       .periods = NAN,
                                                       .time = NAN,
                                                       .r_max = 100,
                                                       .tolerance = 1e-12,
                                                       .mass_msun = NAN,
                                                       .samples = 1000,
                                                       .digits = KD_DECIMAL_DIGITS,
                                                       .seen = { INFINITY, NAN, 0, KD_OBSERVER_STATIC } } };
}

void kd_orbit_request_finish(struct kd_orbit_request *request)
{
    free(request->specs);
    *request = (struct kd_orbit_request) { 0 };
}

static struct kd_orbit_spec empty_spec(void)
{
    return (struct kd_orbit_spec) {
        .form = KD_ORBIT_FORMS, .spin = NAN, .r = NAN, .theta_deg = 90, .frame = KD_OBSERVER_ZAMO
    };
}

/* A table of fields and the struct that it fills. */
struct target {
    const struct kd_orbit_field *fields;
    size_t n;
    void *to;
    unsigned seen;     /* bit mask: a bit a field, then a bit a section */
    const char *extra; /* further known names, for messages */
};

static const struct kd_orbit_field *find(const struct target *t, const char *section, const char *name)
{
    for (size_t i = 0; i < t->n; i++)
        if (!strcmp(t->fields[i].section, section) && !strcmp(t->fields[i].name, name))
            return &t->fields[i];
    return NULL;
}

static bool has_section(const struct target *t, const char *name)
{
    for (size_t i = 0; i < t->n; i++)
        if (*t->fields[i].section && !strcmp(t->fields[i].section, name))
            return true;
    return false;
}

static enum kd_status unknown(const struct target *t, const char *section, const char *name, const char *pointer,
                              struct kd_error *error)
{
    char shown[60], known[240] = "";
    struct kd_spelling_best meant = { 0 };
    kd_text_clip(shown, sizeof shown, name);
    for (size_t i = 0; i < t->n; i++) {
        const struct kd_orbit_field *f = &t->fields[i];
        bool own = !strcmp(f->section, section),
             inner = !*section && *f->section && (!i || strcmp(f[-1].section, f->section));
        size_t used = strlen(known);
        if (own || inner)
            kd_spelling_offer(&meant, name, own ? f->name : f->section);
        if (own || inner)
            snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", own ? f->name : f->section);
    }
    if (meant.name)
        return kd_error_field(error, pointer, "there is no field %s here; did you mean %s? Known are %s%s", shown,
                              meant.name, known, *section ? "" : t->extra);
    return kd_error_field(error, pointer, "there is no field %s here; known are %s%s", shown, known,
                          *section ? "" : t->extra);
}

static enum kd_status read_field(struct target *t, const char *section, const cJSON *item, const char *pointer,
                                 struct kd_error *error)
{
    const struct kd_orbit_field *field = find(t, section, item->string);
    if (!field)
        return unknown(t, section, item->string, pointer, error);
    unsigned bit = 1u << (field - t->fields);
    if (t->seen & bit)
        return kd_error_field(error, pointer, "%s is given twice", field->name);
    t->seen |= bit;
    struct kd_value value = kd_tree_value(item);
    return kd_orbit_field_put(t->to, field, &value, pointer, error);
}

static enum kd_status not_a(const cJSON *item, const char *pointer, const char *allowed, struct kd_error *error)
{
    char given[KD_VALUE_SIZE];
    struct kd_value value = kd_tree_value(item);
    kd_value_describe(&value, given);
    return kd_error_field(error, pointer, "%s is %s; it must be %s", *pointer ? pointer + 1 : "the document", given,
                          allowed);
}

/* Reads a field, or a section with its fields. */
static enum kd_status read_item(struct target *t, const cJSON *item, const char *parent, struct kd_error *error)
{
    char pointer[sizeof error->pointer];
    snprintf(pointer, sizeof pointer, "%s", parent);
    kd_text_pointer(pointer, sizeof pointer, item->string);
    if (!has_section(t, item->string))
        return read_field(t, "", item, pointer, error);
    if (!cJSON_IsObject(item))
        return not_a(item, pointer, "an object with fields", error);
    enum kd_status status = KD_OK;
    for (const cJSON *one = item->child; one && !status; one = one->next) {
        char inner[sizeof error->pointer];
        snprintf(inner, sizeof inner, "%s", pointer);
        kd_text_pointer(inner, sizeof inner, one->string);
        status = read_field(t, item->string, one, inner, error);
    }
    return status;
}

#define FORMS "an orbit must be defined by %s, by %s, by %s, or by %s"
#define FORM_TEXTS form_texts[0], form_texts[1], form_texts[2], form_texts[3]

/* Refuses a field that does not belong to the orbit's form. */
static enum kd_status mixed(const struct kd_orbit_spec *spec, const struct kd_orbit_field *field, const char *pointer,
                            struct kd_error *error)
{
    size_t i = 0;
    while (!(spec->seen & 1u << i) || kd_orbit_fields[i].form != spec->form)
        i++;
    return kd_error_field(error, pointer, "%s cannot be used with %s; " FORMS, field->name, kd_orbit_fields[i].name,
                          FORM_TEXTS);
}

/* Checks that an orbit is given in exactly one form, completely. */
static enum kd_status settle(struct kd_orbit_spec *spec, const char *pointer, struct kd_error *error)
{
    unsigned seen = spec->seen;
    for (size_t i = 0; i < KD_ORBIT_N_FIELDS; i++) {
        enum kd_orbit_form form = kd_orbit_fields[i].form;
        if (!(seen & 1u << i) || form == KD_ORBIT_FORMS)
            continue;
        if (spec->form != KD_ORBIT_FORMS && spec->form != form)
            return mixed(spec, &kd_orbit_fields[i], pointer, error);
        spec->form = form;
    }
    if (spec->form == KD_ORBIT_FORMS)
        return kd_error_field(error, pointer, FORMS, FORM_TEXTS);
    for (size_t i = 0; i < KD_ORBIT_N_FIELDS; i++)
        if (kd_orbit_fields[i].form == spec->form && kd_orbit_fields[i].needed && !(seen & 1u << i)) {
            char missing[sizeof error->pointer];
            snprintf(missing, sizeof missing, "%s", pointer);
            if (*kd_orbit_fields[i].section)
                kd_text_pointer(missing, sizeof missing, kd_orbit_fields[i].section);
            kd_text_pointer(missing, sizeof missing, kd_orbit_fields[i].name);
            return kd_error_field(error, missing, "%s is missing", kd_orbit_fields[i].name);
        }
    return KD_OK;
}

static enum kd_status read_orbit(struct kd_orbit_spec *spec, const cJSON *object, const char *pointer,
                                 struct kd_error *error)
{
    struct target target = { kd_orbit_fields, KD_ORBIT_N_FIELDS, spec, 0, "" };
    enum kd_status status = KD_OK;
    *spec = empty_spec();
    if (!cJSON_IsObject(object))
        return not_a(object, pointer, "an object with fields", error);
    for (const cJSON *item = object->child; item; item = item->next)
        KD_TRY(read_item(&target, item, pointer, error));
    spec->seen = target.seen;
    KD_TRY(settle(spec, pointer, error));
done:
    return status;
}

static enum kd_status read_orbits(struct kd_orbit_request *request, const cJSON *item, struct kd_error *error)
{
    size_t n = 1, i = 0;
    enum kd_status status = KD_OK;
    if (request->specs)
        return kd_error_field(error, "/orbits", "orbits are given twice; there must be one of orbit and orbits, once");
    request->many = !strcmp(item->string, "orbits");
    if (request->many) {
        if (!cJSON_IsArray(item))
            return not_a(item, "/orbits", "an array of orbits", error);
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
    struct target target = { kd_orbit_settings, KD_ORBIT_N_SETTINGS, &request->params, 0, ", orbit and orbits" };
    enum kd_status status = KD_OK;
    if (!cJSON_IsObject(root)) {
        not_a(root, "", "an object", error);
        return KD_EINVAL;
    }
    for (const cJSON *item = root->child; item && !status; item = item->next)
        status = !strcmp(item->string, "orbit") || !strcmp(item->string, "orbits")
                     ? read_orbits(request, item, error)
                     : read_item(&target, item, "", error);
    return status;
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

static const struct kd_orbit_field *by_name(const struct kd_orbit_field *table, size_t n, const char *name)
{
    for (size_t i = 0; i < n; i++)
        if (!strcmp(table[i].name, name))
            return &table[i];
    return NULL;
}

/* Sets a field. "r" also means position.r, according to the orbit's form. */
static enum kd_status set_field(struct kd_orbit_request *request, const struct kd_orbit_field *field,
                                const struct kd_value *value, const char *pointer, struct kd_error *error)
{
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
        field = find(&(struct target) { kd_orbit_fields, KD_ORBIT_N_FIELDS, spec, 0, "" }, "position", "r");
    enum kd_status status = kd_orbit_field_put(spec, field, value, pointer, error);
    bool other = spec->form != KD_ORBIT_FORMS && field->form != spec->form && field->form != KD_ORBIT_FORMS;
    if (!status && other)
        return mixed(spec, field, pointer, error);
    if (!status && field->form != KD_ORBIT_FORMS)
        spec->form = field->form;
    spec->seen |= 1u << (field - kd_orbit_fields);
    return status;
}

enum kd_status kd_orbit_request_set(struct kd_orbit_request *request, const char *name, const char *text,
                                    struct kd_error *error)
{
    struct kd_value value = kd_value_typed(text);
    char pointer[sizeof error->pointer] = "", shown[60];
    kd_text_pointer(pointer, sizeof pointer, name);
    const struct kd_orbit_field *field = by_name(kd_orbit_settings, KD_ORBIT_N_SETTINGS, name);
    if (field)
        return kd_orbit_field_put(&request->params, field, &value, pointer, error);
    if ((field = by_name(kd_orbit_fields, KD_ORBIT_N_FIELDS, name)))
        return set_field(request, field, &value, pointer, error);
    kd_text_clip(shown, sizeof shown, name);
    return kd_error_field(error, pointer, "there is no parameter %s", shown);
}

enum kd_status kd_orbit_request_check(const struct kd_orbit_request *request, struct kd_error *error)
{
    const struct kd_orbit_params *p = &request->params;
    if (!request->n)
        return kd_error_field(error, "/orbit", "orbit is missing: one orbit, or orbits with a list");
    if (!request->many) { /* fields come by name, one at a time: check whether the orbit is complete */
        struct kd_orbit_spec spec = *request->specs;
        enum kd_status status = settle(&spec, "/orbit", error);
        if (status)
            return status;
    }
    if (!isnan(p->periods) && !isnan(p->time))
        return kd_error_field(error, "/duration",
                              "duration is given as periods and as time: only one of them may be given");
    if (p->or_end && isnan(p->periods))
        return kd_error_field(error, "/duration/or_end",
                              "or_end is true without periods; it must be false: without periods or a time, an orbit "
                              "that plunges or escapes is followed to its end anyway");
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
        return kd_error_field(error, "/samples",
                              "samples is 1; it must be 0 for none, or 2 or more: both ends of the path are samples");
    if (request->many && p->series && (double)p->samples * (double)request->n > KD_ORBIT_SAMPLES_MAX)
        return kd_error_field(error, "/samples", "%u samples of %zu orbits are too many (limit %u in all)", p->samples,
                              request->n, KD_ORBIT_SAMPLES_MAX);
    return KD_OK;
}

/* Error of a whirl that is caused by rounding of the constants: 4 ulp times kd_orbit_whirl. */
static double rounding_of(const struct kd_orbit_spec *s, const struct kd_orbit *orbit,
                          const struct kd_orbit_state *start)
{
    /* p and e give the turning points exactly */
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
                          "energy %s and angular_momentum %s are too close to those of the unstable circle at r = %.9g "
                          "for double precision to decide how long the body whirls there, and whether it falls or "
                          "returns; they must differ from these by some parts in 1e12",
                          energy, momentum, r);
}

static enum kd_status solve(const struct kd_orbit_spec *s, const struct kd_orbit_params *params, struct kd_orbit *orbit,
                            struct kd_orbit_state *start, double *rounding, struct kd_error *error)
{
    double x = kd_cos_deg(s->inclination_deg), r = s->r;
    enum kd_status status;
    switch (s->form) {
    case KD_ORBIT_SHAPE: status = kd_orbit_from_shape(kd_hole(s->spin), s->p, s->e, x, orbit, error); break;
    case KD_ORBIT_CONSTANTS:
        if (isnan(r) && s->energy >= 1)
            r = params->r_max;
        status = kd_orbit_from_constants(kd_hole(s->spin), s->energy, s->momentum, s->carter, r, orbit, error);
        break;
    default:
        status = kd_orbit_from_state(kd_hole(s->spin), s->place_r, s->theta_deg, s->frame, s->v, orbit, start, error);
    }
    if (!status && s->form != KD_ORBIT_STATE)
        *start = kd_orbit_start(orbit, s->form == KD_ORBIT_SHAPE ? NAN : r, s->outward);
    if (!status && s->form == KD_ORBIT_CONSTANTS && s->outward && orbit->fate == KD_ORBIT_PLUNGE && !orbit->turns_out)
        orbit->fate = KD_ORBIT_ESCAPE;
    return status ? status : check_whirl(s, orbit, start, rounding, error);
}

enum kd_status kd_orbit_request_solve(const struct kd_orbit_request *request, size_t index, struct kd_orbit *orbit,
                                      struct kd_orbit_state *start, double *rounding, struct kd_error *error)
{
    struct kd_orbit_spec spec = request->specs[index];
    struct kd_error why = { 0 };
    if (isnan(spec.spin))
        spec.spin = request->params.spin;
    if (spec.form == KD_ORBIT_CASE)
        spec = kd_orbit_case_spec(spec.named, spec.spin);
    if (isnan(spec.spin))
        spec.spin = 0;
    enum kd_status status = solve(&spec, &request->params, orbit, start, rounding, &why);
    if (!status)
        return KD_OK;
    char pointer[sizeof why.pointer + 40];
    if (request->many)
        snprintf(pointer, sizeof pointer, "/orbits/%zu%s", index, why.pointer);
    else if (!strcmp(why.pointer, "/spin") && isnan(request->specs[0].spin))
        snprintf(pointer, sizeof pointer, "/spin");
    else
        snprintf(pointer, sizeof pointer, "/orbit%s", why.pointer);
    return kd_error_field(error, pointer, "%s", why.message);
}

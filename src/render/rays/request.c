#include "render/rays/request.h"

#include "image/npy.h"
#include "render/rays/check.h"
#include "render/rays/fields.h"
#include "render/rays/list.h"
#include "document/number.h"
#include "document/scan.h"
#include "scene/table.h"
#include "document/text.h"
#include "document/tree.h"
#include "scene/value.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void kd_rays_request_init(struct kd_rays_request *request)
{
    struct kd_scene scene;
    kd_scene_defaults(&scene);
    *request = (struct kd_rays_request) {
        .params = { .spin = scene.spacetime.spin,
                    .r = scene.camera.r,
                    .inclination_deg = scene.camera.inclination_deg,
                    .fall_from = scene.camera.infall_from,
                    .fall_energy = scene.camera.infall_energy,
                    .orders = 3 },
        .asked_accuracy = KD_WISH_NONE,
    };
}

void kd_rays_request_finish(struct kd_rays_request *request)
{
    free(request->alpha_beta);
    *request = (struct kd_rays_request) { 0 };
}

static bool store_word(int *at, const struct kd_rays_field *field, const struct kd_value *value)
{
    int index = value->kind == KD_VALUE_STRING ? kd_field_word_index(kd_rays_field_words(field), value->text) : -1;
    if (index < 0)
        return false;
    *at = field->kind == KD_RAYS_PROFILE        ? index
          : field->kind == KD_RAYS_WORD_OR_NONE ? index + 1
                                                : index - 1; /* "auto" is the first word */
    return true;
}

static bool store(struct kd_rays_request *request, const struct kd_rays_field *field, const struct kd_value *value)
{
    void *at = (char *)request + field->offset;
    bool number = value->kind == KD_VALUE_NUMBER && isfinite(value->number);
    switch (field->kind) {
    case KD_RAYS_REAL_OR_WORD:
        if (value->kind == KD_VALUE_STRING && !strcmp(value->text, field->word)) {
            *(double *)at = INFINITY;
            return true;
        }
        /* fall through */
    case KD_RAYS_REAL:
        if (number)
            *(double *)at = value->number;
        return number;
    case KD_RAYS_INT:
        if (!number || value->number != floor(value->number) || value->number < 0 || value->number > 1e9)
            return false;
        *(uint32_t *)at = (uint32_t)value->number;
        return true;
    case KD_RAYS_PROFILE:
    case KD_RAYS_WORD_OR_NONE:
    case KD_RAYS_WORD_OR_AUTO: return store_word(at, field, value);
    }
    return false;
}

static enum kd_status put(struct kd_rays_request *request, const struct kd_rays_field *field,
                          const struct kd_value *value, struct kd_error *error)
{
    char given[KD_VALUE_SIZE], words[KD_ALLOWED_SIZE];
    if (store(request, field, value))
        return KD_OK;
    kd_value_describe(value, given);
    if (!field->allowed)
        kd_value_allowed(kd_rays_field_words(field), words);
    return kd_error_field(error, field->pointer, "%s is %s%s; it must be %s", field->name, given,
                          field->kind == KD_RAYS_REAL || field->kind == KD_RAYS_INT ? kd_value_unwanted(value) : "",
                          field->allowed ? field->allowed : words);
}

enum kd_status kd_rays_request_set(struct kd_rays_request *request, const char *name, const char *text,
                                   struct kd_error *error)
{
    struct kd_value value = kd_value_typed(text);
    const struct kd_rays_field *field = kd_rays_field_find(name);
    if (field)
        return put(request, field, &value, error);
    char pointer[sizeof error->pointer] = "", shown[60], known[320] = "";
    for (size_t i = 0; i < KD_RAYS_FIELDS; i++)
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s",
                 !i                       ? ""
                 : i + 1 < KD_RAYS_FIELDS ? ", "
                                          : " and ",
                 kd_rays_fields[i].name);
    kd_text_pointer(pointer, sizeof pointer, name);
    kd_text_clip(shown, sizeof shown, name);
    return kd_error_field(error, pointer, "there is no parameter %s; known are %s", shown, known);
}

enum kd_status kd_rays_request_add(struct kd_rays_request *request, double alpha, double beta, struct kd_error *error)
{
    struct kd_rays_list list = { request->alpha_beta, request->n, request->n };
    enum kd_status status = kd_rays_list_add(&list, alpha, beta, error);
    request->alpha_beta = list.alpha_beta;
    request->n = list.n;
    return status;
}

struct document {
    struct kd_rays_request *request;
    unsigned seen; /* what was seen so far, as bits: one a field, then one a section, and one for the rays */
    struct kd_error *error;
};

/* Rejects a field that is given twice: the second would silently win. */
static enum kd_status once(struct document *d, size_t bit, const char *pointer)
{
    if (d->seen & 1u << bit)
        return kd_error_field(d->error, pointer, "%s is given twice", pointer + 1);
    d->seen |= 1u << bit;
    return KD_OK;
}

static enum kd_status unknown(struct document *d, const char *section, const char *name)
{
    char pointer[sizeof d->error->pointer] = "", shown[60], known[320] = "";
    if (*section)
        kd_text_pointer(pointer, sizeof pointer, section);
    kd_text_pointer(pointer, sizeof pointer, name);
    kd_text_clip(shown, sizeof shown, name);
    for (size_t i = 0; i < KD_RAYS_FIELDS; i++)
        if (!strcmp(kd_rays_fields[i].section, section))
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s, ", kd_rays_fields[i].name);
    if (*section)
        known[strlen(known) - 2] = 0;
    return kd_error_field(d->error, pointer, "there is no field %s here; known are %s%s", shown, known,
                          *section ? "" : "observer, accuracy and rays");
}

static enum kd_status read_member(struct document *d, const char *section, const cJSON *item)
{
    for (size_t i = 0; i < KD_RAYS_FIELDS; i++) {
        if (strcmp(kd_rays_fields[i].section, section) || strcmp(kd_rays_fields[i].name, item->string))
            continue;
        struct kd_value value = kd_tree_value(item);
        enum kd_status status = once(d, i, kd_rays_fields[i].pointer);
        return status ? status : put(d->request, &kd_rays_fields[i], &value, d->error);
    }
    return unknown(d, section, item->string);
}

static enum kd_status wrong_type(struct document *d, const cJSON *item, const char *pointer, const char *allowed)
{
    char given[KD_VALUE_SIZE];
    struct kd_value value = kd_tree_value(item);
    kd_value_describe(&value, given);
    return kd_error_field(d->error, pointer, "%s is %s; it must be %s", *pointer ? pointer + 1 : "the document", given,
                          allowed);
}

/* Reads the outermost object. The rays have been read already and are replaced by an empty array in this document. */
static enum kd_status read_outermost(struct document *d, const cJSON *item)
{
    static const char *const sections[] = { "/observer", "/accuracy" };
    enum kd_status status;
    if (!strcmp(item->string, "rays")) {
        status = once(d, KD_RAYS_FIELDS + 2, "/rays");
        if (!status && !cJSON_IsArray(item))
            status = wrong_type(d, item, "/rays", "an array of pairs of numbers [alpha, beta]");
        if (!status && item->child)
            status =
                kd_error_field(d->error, "/rays", "the name of the array must be written as \"rays\", without escapes");
        return status;
    }
    for (size_t i = 0; i < 2; i++) {
        if (strcmp(item->string, sections[i] + 1))
            continue;
        status = once(d, KD_RAYS_FIELDS + i, sections[i]);
        if (!status && !cJSON_IsObject(item))
            status = wrong_type(d, item, sections[i], "an object with fields");
        for (const cJSON *one = item->child; one && !status; one = one->next)
            status = read_member(d, item->string, one);
        return status;
    }
    return read_member(d, "", item);
}

static enum kd_status read_tree(struct document *d, const cJSON *root)
{
    enum kd_status status = KD_OK;
    if (!cJSON_IsObject(root)) {
        wrong_type(d, root, "", "an object");
        return KD_EINVAL;
    }
    for (const cJSON *item = root->child; item; item = item->next)
        KD_TRY(read_outermost(d, item));
    if (!(d->seen & 1u << (KD_RAYS_FIELDS + 2)))
        KD_TRY(kd_error_field(d->error, "/rays", "rays is missing: an array of pairs of numbers [alpha, beta]"));
done:
    return status;
}

/* rest: the document `text` with `cut` bytes at `where` removed; NUL-terminated. */
static enum kd_status read_rest(struct document *d, const char *text, const char *rest, size_t length, size_t where,
                                size_t cut)
{
    const char *end = rest;
    struct kd_number_locale locale = kd_number_locale_enter();
    errno = 0;
    cJSON *root = cJSON_ParseWithLengthOpts(rest, length + 1, &end, 0);
    bool starved = !root && errno == ENOMEM; /* as in scene/tree.c */
    kd_number_locale_leave(locale);
    if (starved)
        return kd_error_set(d->error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    size_t at = (size_t)(end - rest), after = at + strspn(end, " \t\n\r"),
           bad = root          ? after
                 : at < length ? at
                               : length;
    bad += bad > where ? cut : 0;
    struct kd_text_place place = { 0 };
    if (!root || after < length)
        place = kd_text_place_of(text, bad);
    enum kd_status status = KD_OK;
    if (!root && at >= length)
        status = kd_error_set(d->error, KD_EINVAL,
                              "the document is not valid JSON: it ends too early, after %zu bytes, in line %zu", bad,
                              place.line);
    else if (!root)
        status = kd_error_set(d->error, KD_EINVAL, "the document is not valid JSON near byte %zu, line %zu, column %zu",
                              bad, place.line, place.column);
    else if (after < length)
        status = kd_error_set(d->error, KD_EINVAL, "text follows the document at byte %zu, line %zu, column %zu", bad,
                              place.line, place.column);
    else
        status = read_tree(d, root);
    cJSON_Delete(root);
    return status;
}

/* Parses the document with an empty array in place of the array from start to end. */
static enum kd_status read_without_rays(struct document *d, const char *text, size_t length, size_t start, size_t end)
{
    size_t kept = start < end ? 2 : 0, rest_length = start + kept + length - end;
    if (rest_length > KD_SCENE_JSON_MAX)
        return kd_error_set(d->error, KD_EINVAL, "the document has %zu bytes without its rays; it must have at most %u",
                            rest_length, KD_SCENE_JSON_MAX);
    enum kd_status status = kd_scan_json_part(text, 0, start, d->error);
    if (!status)
        status = kd_scan_json_part(text, end, length, d->error);
    if (status)
        return status;
    char *rest = malloc(rest_length + 1);
    if (!rest)
        return kd_error_set(d->error, KD_ENOMEM, "out of memory for a document of %zu bytes", length);
    memcpy(rest, text, start);
    memcpy(rest + start, "[]", kept);
    memcpy(rest + start + kept, text + end, length - end + 1);
    status = read_rest(d, text, rest, rest_length, start, end - start - kept);
    free(rest);
    return status;
}

enum kd_status kd_rays_request_json(struct kd_rays_request *request, const char *text, size_t length,
                                    struct kd_error *error)
{
    struct document document = { .request = request, .error = error };
    struct kd_rays_list list = { 0 };
    size_t start, end;
    enum kd_status status = KD_OK;
    if (length > KD_RAYS_BODY_MAX)
        return kd_error_set(error, KD_EINVAL, "the document has %zu bytes; it must have at most %zu", length,
                            KD_RAYS_BODY_MAX);
    kd_scan_skip_mark(&text, &length);
    start = end = length;
    if (kd_rays_list_find(text, length, &start)) {
        end = start;
        status = kd_rays_list_read(&list, text, length, &end, error);
    } else {
        start = length;
    }
    if (!status)
        status = read_without_rays(&document, text, length, start, end);
    request->alpha_beta = list.alpha_beta;
    request->n = list.n;
    return status;
}

bool kd_rays_request_is_npy(const void *data, size_t size) { return size >= 6 && !memcmp(data, "\x93NUMPY", 6); }

/* Reads the header and checks that it describes pairs of doubles. */
static enum kd_status read_pairs(const void *data, size_t size, struct kd_npy *array, struct kd_error *error)
{
    enum kd_status status = kd_npy_read(data, size, array, error);
    if (status)
        return status;
    if (array->n_fields != 1 || array->fields[0].name[0] || array->fields[0].type != KD_NPY_F8)
        return kd_error_set(error, KD_EINVAL, "the elements of the array are not 8-byte floats, <f8");
    if (array->n_dimensions != 2 || array->shape[1] != 2)
        return kd_error_set(error, KD_EINVAL, "the shape of the array is not (n, 2)");
    if (array->shape[0] > KD_RAYS_MAX)
        return kd_error_set(error, KD_EINVAL, "there are %llu rays; there must be 1 to %d",
                            (unsigned long long)array->shape[0], KD_RAYS_MAX);
    return KD_OK;
}

enum kd_status kd_rays_request_npy(struct kd_rays_request *request, const void *data, size_t size,
                                   struct kd_error *error)
{
    struct kd_npy array;
    enum kd_status status = read_pairs(data, size, &array, error);
    if (status) {
        if (error)
            snprintf(error->pointer, sizeof error->pointer, "/rays");
        return status;
    }
    size_t bytes = (size_t)array.items * sizeof *request->alpha_beta;
    request->alpha_beta = malloc(bytes ? bytes : 1);
    if (!request->alpha_beta)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu bytes of rays", bytes);
    memcpy(request->alpha_beta, (const char *)data + array.header_size, bytes);
    request->n = (size_t)array.shape[0];
    return KD_OK;
}

enum kd_status kd_rays_request_settle(struct kd_rays_request *request, const struct kd_capacity *capacity,
                                      struct kd_error *error)
{
    struct kd_setting by;
    bool float64 = capacity && capacity->float64;
    enum kd_status status =
        kd_setting_of(&request->asked_accuracy, capacity ? capacity->accuracy : NULL, float64, &by, error);
    if (status)
        return status;
    request->params.engine = by.engine;
    request->params.precision = by.precision;
    request->params.steps = by.steps;
    request->params.holds = by.holds > 0 ? by.holds : 0;
    request->params.tolerance = isfinite(request->asked_accuracy.tolerance) ? request->asked_accuracy.tolerance : 0;
    return KD_OK;
}

/* Rejects parameters of one motion together with another motion, where they would have no effect. */
static enum kd_status check_belongings(const struct kd_rays_params *p, struct kd_error *error)
{
    const struct {
        const char *name;
        double value, idle;
        enum kd_observer of;
    } belongs[] = {
        { "velocity_r", p->velocity[0], 0, KD_OBSERVER_VELOCITY },
        { "velocity_theta", p->velocity[1], 0, KD_OBSERVER_VELOCITY },
        { "velocity_phi", p->velocity[2], 0, KD_OBSERVER_VELOCITY },
        { "infall_from", p->fall_from, INFINITY, KD_OBSERVER_INFALL },
        { "infall_energy", p->fall_energy, INFINITY, KD_OBSERVER_INFALL },
        { "infall_momentum", p->fall_momentum, 0, KD_OBSERVER_INFALL },
    };
    for (size_t i = 0; i < sizeof belongs / sizeof *belongs; i++) {
        const struct kd_rays_field *f = kd_rays_field_find(belongs[i].name);
        if (belongs[i].value == belongs[i].idle)
            continue;
        if (p->observer != 1 + (int)belongs[i].of)
            return kd_error_field(error, f->pointer, "%s is %.9g; it can be used only with motion \"%s\"", f->name,
                                  belongs[i].value, kd_observers[belongs[i].of].word);
        enum kd_status status = kd_rays_field_check(f->name, belongs[i].value, error);
        if (status)
            return status;
    }
    return KD_OK;
}

enum kd_status kd_rays_request_check(const struct kd_rays_request *request, struct kd_error *error)
{
    enum kd_status status = check_belongings(&request->params, error);
    if (status)
        return status;
    return kd_rays_check(&request->params, request->alpha_beta, request->n, error);
}

#include "render/rays/request.h"

#include "image/npy.h"
#include "render/rays/check.h"
#include "render/rays/fields.h"
#include "render/rays/list.h"
#include "document/members.h"
#include "document/number.h"
#include "document/scan.h"
#include "scene/table.h"
#include "document/text.h"
#include "document/tree.h"

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

enum kd_status kd_rays_request_set(struct kd_rays_request *request, const char *name, const char *text,
                                   struct kd_error *error)
{
    return strchr(name, '.') ? kd_document_unknown(&kd_rays_document, name, error) /* names of fields are relative to
                                                                                    * their object */
                             : kd_document_set(&kd_rays_document, request, name, text, NULL, error);
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
    struct kd_error *error;
};

/* The rays were read before; this document has an empty array in their place. */
static enum kd_status read_tree(struct document *d, const cJSON *root)
{
    const cJSON *rays = cJSON_GetObjectItemCaseSensitive(root, "rays");
    enum kd_status status = kd_document_read(&kd_rays_document, d->request, root, "", NULL, d->error);
    if (status)
        return status;
    if (!rays)
        return kd_error_field(d->error, "/rays",
                              "rays is missing; it must be an array of pairs of numbers [alpha, beta]");
    if (!cJSON_IsArray(rays))
        return kd_member_refuse(rays, "/rays", "an array of pairs of numbers [alpha, beta]", d->error);
    return !rays->child ? KD_OK
                        : kd_error_field(d->error, "/rays",
                                         "the name of the array must be written as \"rays\", without escapes");
}

/* rest: the document `text` with `cut` bytes at `where` removed; NUL-terminated. */
static enum kd_status read_rest(struct document *d, const char *text, const char *rest, size_t length, size_t where,
                                size_t cut)
{
    const char *end = rest;
    struct kd_number_locale locale = kd_number_locale_enter();
    errno = 0;
    cJSON *root = cJSON_ParseWithLengthOpts(rest, length + 1, &end, 0);
    bool starved = !root && errno == ENOMEM; /* cJSON reports lack of memory by errno only, as in document/tree.c */
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
        return kd_error_set(error, KD_EINVAL, "the elements of the array must be 8-byte floats, <f8");
    if (array->n_dimensions != 2 || array->shape[1] != 2)
        return kd_error_set(error, KD_EINVAL, "the shape of the array must be (n, 2)");
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

/* Rejects parameters of a motion other than the requested one, because they would have no effect. */
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
        const struct kd_row *f = kd_document_find(&kd_rays_document, belongs[i].name);
        char pointer[64];
        snprintf(pointer, sizeof pointer, "/observer/%s", f->name);
        if (belongs[i].value == belongs[i].idle)
            continue;
        if (p->observer != 1 + (int)belongs[i].of)
            return kd_error_field(error, pointer, "%s is %.9g; it can be used only with motion \"%s\"", f->name,
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

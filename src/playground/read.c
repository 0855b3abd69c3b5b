/* Reads documents that create or change a playground. */
#include "base/pause.h"
#include "playground/fields.h"
#include "playground/hole.h"
#include "playground/json.h"
#include "playground/preset.h"
#include "playground/state.h"

#include "document/text.h"
#include "document/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PIECES 16384 /* number of pieces of debris that are copied at a time, which takes a millisecond */
/* largest number of values in a document: some fifty for each of 4 096 bodies, and the counts of the debris' sources */
#define VALUES 4000000

static enum kd_status read_name(struct kd_playground_body *body, const cJSON *item, const char *pointer,
                                struct kd_error *error)
{
    if (!cJSON_IsString(item) || strlen(item->valuestring) >= sizeof body->name)
        return kd_error_field(error, pointer, "name is not a string of at most %zu bytes", sizeof body->name - 1);
    snprintf(body->name, sizeof body->name, "%s", item->valuestring);
    return KD_OK;
}

/* Reads the given fields of a body. All other fields keep their values. id: receives the member "id"; NULL if the body
 * must not have this member. grown: factor by which mass and radius may exceed the limits of a new body, because merged
 * bodies may be larger. */
static enum kd_status read_body(struct kd_playground_body *body, const cJSON *item, const char *pointer, uint32_t *id,
                                double grown, struct kd_error *error)
{
    static const struct kd_row id_row = { .name = "id", .kind = KD_KIND_INT, .least = 1, .most = UINT32_MAX };
    enum kd_status status = KD_OK;
    if (!cJSON_IsObject(item))
        return kd_error_field(error, pointer, "a body must be an object");
    for (const cJSON *one = item->child; one; one = one->next) {
        const struct kd_row *row = kd_document_find(&kd_playground_body_fields, one->string);
        const struct kd_value value = kd_tree_value(one);
        char at[160];
        kd_playground_pointer(at, pointer, one->string);
        struct kd_row wide = row ? *row : id_row;
        wide.most *= grown;
        if (row)
            KD_TRY(kd_row_put(&wide, body, &value, wide.name, at, error));
        else if (!strcmp(one->string, "name"))
            KD_TRY(read_name(body, one, at, error));
        else if (!strcmp(one->string, "position"))
            KD_TRY(kd_playground_numbers(body->x, 3, 1e18, one, at,
                                         error)); /* the distance of a new body is checked when it is added */
        else if (!strcmp(one->string, "velocity"))
            KD_TRY(kd_playground_numbers(body->v, 3, 1 + 1e-12, one, at, error));
        else if (id && !strcmp(one->string, "id"))
            KD_TRY(kd_row_put(&id_row, id, &value, id_row.name, at, error));
        else
            KD_TRY(kd_playground_unknown(pointer, one->string, error));
    }
done:
    return status;
}

/* Completes an error about a body with the body's place in the list, as the error's pointer. */
static enum kd_status in_list(enum kd_status status, const char *pointer, struct kd_error *error)
{
    if (status && error && strncmp(error->pointer, pointer, strlen(pointer)))
        kd_error_inside(error, pointer);
    return status;
}

static struct kd_playground_body plain(void)
{
    struct kd_playground_body body = { .x = { NAN, NAN, NAN } };
    kd_document_defaults(&kd_playground_body_fields, &body);
    return body;
}

enum list { ADD, CHANGE, REMOVE };

static enum kd_status do_one(struct kd_playground *p, enum list what, const cJSON *item, const char *pointer,
                             struct kd_error *error)
{
    struct kd_playground_body body = plain();
    uint32_t id = 0;
    enum kd_status status;
    if (what == REMOVE) {
        if (!cJSON_IsNumber(item) || !(item->valuedouble >= 1 && item->valuedouble <= UINT32_MAX) ||
            item->valuedouble != floor(item->valuedouble))
            return kd_error_field(error, pointer, "the number of a body must be whole, 1 to 4294967295");
        status = kd_playground_remove(p, (uint32_t)item->valuedouble, error);
        return status
                   ? kd_error_field(error, pointer, "there is no body %.0f, or it no longer exists", item->valuedouble)
                   : KD_OK;
    }
    if (what == CHANGE) {
        const cJSON *given = cJSON_GetObjectItemCaseSensitive(item, "id");
        const struct kd_playground_body *old =
            kd_playground_find(p, cJSON_IsNumber(given) && given->valuedouble >= 1 && given->valuedouble <= UINT32_MAX
                                      ? (uint32_t)given->valuedouble
                                      : 0);
        if (!old)
            return kd_error_field(error, pointer, "there is no body with this id, or it no longer exists");
        body = *old;
        if (cJSON_HasObjectItem(item, "mass") || cJSON_HasObjectItem(item, "radius"))
            body.whole_mass = 0; /* the changed body counts as another star, whose tidal pass starts afresh */
    }
    KD_TRY(read_body(&body, item, pointer, what == CHANGE ? &id : NULL, 1, error));
    if (isnan(body.x[0]))
        KD_TRY(kd_error_field(error, pointer, "position is missing; a body must have one"));
    KD_TRY(
        in_list(what == CHANGE ? kd_playground_change(p, id, &body, error) : kd_playground_add(p, &body, NULL, error),
                pointer, error));
done:
    return status;
}

static enum kd_status do_list(struct kd_playground *p, enum list what, const cJSON *list, const char *name,
                              struct kd_error *error)
{
    char pointer[160], index[12];
    unsigned i = 0;
    enum kd_status status = KD_OK;
    snprintf(pointer, sizeof pointer, "/%s", name);
    if (list && !cJSON_IsArray(list))
        return kd_error_field(error, pointer, "%s is not an array", name);
    if (list && what != ADD &&
        /* the pointer of the error names the first body beyond the limit */
        cJSON_GetArraySize(list) > (int)KD_PLAYGROUND_BODIES_MAX)
        return kd_error_field(error, pointer, "%s has %d elements; it must have at most %u", name,
                              cJSON_GetArraySize(list), KD_PLAYGROUND_BODIES_MAX);
    for (const cJSON *one = list ? list->child : NULL; one; one = one->next) {
        kd_pause_every(i, 16);
        snprintf(pointer, sizeof pointer, "/%s", name);
        snprintf(index, sizeof index, "%u", i++);
        kd_text_pointer(pointer, sizeof pointer, index);
        KD_TRY(do_one(p, what, one, pointer, error));
    }
done:
    return status;
}

/* Reads the given settings. A member that is neither a setting nor listed in `others` is an error. */
static enum kd_status read_settings(struct kd_playground_params *params, const cJSON *tree, const char *others,
                                    struct kd_error *error)
{
    struct kd_document document = kd_playground_settings;
    document.others = others;
    return kd_document_read(&document, params, tree, "", NULL, error);
}

enum kd_status kd_playground_parse(const char *text, size_t length, cJSON **tree, struct kd_error *error)
{
    enum kd_status status = kd_tree_parse(text, length, KD_PLAYGROUND_JSON_MAX, VALUES, tree, error);
    return !status && !cJSON_IsObject(*tree) ? kd_error_set(error, KD_EINVAL, "the document must be a JSON object")
                                             : status;
}

const struct kd_playground_preset *kd_playground_preset_in(const cJSON *tree)
{
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(tree, "preset");
    return cJSON_IsString(name) ? kd_playground_preset_of(name->valuestring) : NULL;
}

static enum kd_status read_preset(const cJSON *tree, const struct kd_playground_preset **preset, struct kd_error *error)
{
    const cJSON *name = cJSON_GetObjectItemCaseSensitive(tree, "preset");
    char clipped[60] = "no string";
    *preset = kd_playground_preset_in(tree);
    if (!name || *preset)
        return KD_OK;
    if (cJSON_IsString(name))
        kd_text_clip(clipped, sizeof clipped, name->valuestring);
    return kd_error_field(
        error, "/preset",
        "preset is %s; it must be \"disruption\", \"system\", \"binary\", \"emri\", \"swarm\" or \"figure-eight\"",
        clipped);
}

/* Reads the bodies of a snapshot. They may be farther out than new bodies, because they have moved. */
static enum kd_status take_bodies(struct kd_playground *p, const cJSON *list, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    unsigned i = 0;
    for (const cJSON *one = cJSON_IsArray(list) ? list->child : NULL; one; one = one->next) {
        struct kd_playground_body body = plain(), held = { .x = { 100, 0, 0 }, .v = { 0, 0.1, 0 } };
        char pointer[40];
        kd_pause_every(i, 16);
        snprintf(pointer, sizeof pointer, "/bodies/%u", i++);
        KD_TRY(read_body(&body, one, pointer, NULL, KD_PLAYGROUND_BODIES_MAX, error));
        if (isnan(body.x[0]))
            KD_TRY(kd_error_field(error, pointer, "position is missing; a body must have one"));
        if (!(kd_playground_radius(body.x) > KD_PLAYGROUND_CAPTURE && kd_playground_radius(body.v) <= 1 + 1e-12) &&
            p->params.gravity != KD_GRAVITY_KERR)
            KD_TRY(kd_error_field(
                error, pointer,
                "a snapshot cannot have this body, because it is captured by the hole or faster than c"));
        KD_TRY(in_list(kd_playground_add(p, &held, NULL, error), pointer, error));
        body.id = p->bodies[p->n - 1].id;
        p->bodies[p->n - 1] = body;
    }
done:
    return status;
}

enum kd_status kd_playground_read_tree(const cJSON *tree, struct kd_playground **out, struct kd_error *error)
{
    struct kd_playground_params params = kd_playground_defaults();
    const struct kd_playground_preset *preset = NULL;
    struct kd_playground *p = NULL;
    enum kd_status status;
    KD_TRY(read_preset(tree, &preset, error));
    if (preset)
        preset->settings(&params);
    KD_TRY(read_settings(&params, tree, "preset|bodies|state", error));
    const cJSON *state = cJSON_GetObjectItemCaseSensitive(tree, "state"),
                *bodies = cJSON_GetObjectItemCaseSensitive(tree, "bodies");
    if (state && preset)
        KD_TRY(kd_error_field(error, "/preset",
                              "preset cannot be used with a snapshot, because a snapshot has its own bodies"));
    KD_TRY(kd_playground_create(&params, &p, error));
    if (preset)
        KD_TRY(preset->fill(p, error));
    KD_TRY(state ? take_bodies(p, bodies, error) : do_list(p, ADD, bodies, "bodies", error));
    p->disturbed = false; /* cleared, because the sums for the energy balance start at this time */
    if (state)
        KD_TRY(kd_state_read(p, state, error));
done:
    if (status)
        kd_playground_destroy(p);
    else
        *out = p;
    return status;
}

enum kd_status kd_playground_read(const char *text, size_t length, struct kd_playground **out, struct kd_error *error)
{
    cJSON *tree = NULL;
    enum kd_status status = kd_playground_parse(text, length, &tree, error);
    status = status ? status : kd_playground_read_tree(tree, out, error);
    kd_tree_free(tree);
    return status;
}

/* Makes a copy of a playground, which can be modified and discarded. */
static enum kd_status copy(const struct kd_playground *from, struct kd_playground **out, struct kd_error *error)
{
    struct kd_playground *p = malloc(sizeof *p);
    if (p) {
        *p = *from;
        p->mutual = (struct kd_playground_mutual) { 0 };
        p->forced = false;
        p->bodies = from->room ? malloc(from->room * sizeof *p->bodies) : NULL;
        p->geodesics = from->geodesics ? malloc(from->room * sizeof *p->geodesics) : NULL;
        p->debris.pieces = calloc((size_t)from->debris.capacity + 1, sizeof *p->debris.pieces);
    }
    if (!p || !p->debris.pieces || (from->room && !p->bodies) || (from->geodesics && !p->geodesics) ||
        kd_playground_mutual_reserve(&p->mutual, from->room ? from->room : 1, NULL)) {
        kd_playground_destroy(p);
        return kd_error_set(error, KD_ENOMEM, "no memory for a copy of the playground");
    }
    if (from->n) /* an empty list has NULL as its array */
        memcpy(p->bodies, from->bodies, from->n * sizeof *p->bodies);
    if (from->geodesics)
        memcpy(p->geodesics, from->geodesics, from->n * sizeof *p->geodesics);
    for (size_t at = 0; at < from->debris.used; at += PIECES) {
        kd_pause();
        const size_t left = from->debris.used - at;
        memcpy(p->debris.pieces + at, from->debris.pieces + at,
               (left < PIECES ? left : PIECES) * sizeof *from->debris.pieces);
    }
    *out = p;
    return KD_OK;
}

enum kd_status kd_playground_patch_tree(struct kd_playground **p, const cJSON *tree, struct kd_error *error)
{
    struct kd_playground_params params = (*p)->params;
    struct kd_playground *changed = NULL;
    enum kd_status status;
    KD_TRY(read_settings(&params, tree, "add|change|remove", error));
    KD_TRY(copy(*p, &changed, error));
    if (!kd_playground_params_same(&params, &changed->params))
        KD_TRY(kd_playground_set(changed, &params, error));
    KD_TRY(do_list(changed, ADD, cJSON_GetObjectItemCaseSensitive(tree, "add"), "add", error));
    KD_TRY(do_list(changed, CHANGE, cJSON_GetObjectItemCaseSensitive(tree, "change"), "change", error));
    KD_TRY(do_list(changed, REMOVE, cJSON_GetObjectItemCaseSensitive(tree, "remove"), "remove", error));
done:
    if (status) {
        kd_playground_destroy(changed);
    } else {
        kd_playground_destroy(*p);
        *p = changed;
    }
    return status;
}

enum kd_status kd_playground_patch(struct kd_playground **p, const char *text, size_t length, struct kd_error *error)
{
    cJSON *tree = NULL;
    enum kd_status status = kd_playground_parse(text, length, &tree, error);
    status = status ? status : kd_playground_patch_tree(p, tree, error);
    kd_tree_free(tree);
    return status;
}

enum kd_status kd_playground_params_set(struct kd_playground_params *params, const char *name, const char *text,
                                        struct kd_error *error)
{
    return kd_document_set(&kd_playground_settings, params, name, text, NULL, error);
}

#include "server/render/scene_source.h"

#include "scene/table.h"
#include "server/asset/store.h"

#include <stdio.h>
#include <string.h>

/* Converts a parameter's name to a JSON pointer: "camera.r" becomes /camera/r. ~ and / are escaped, because clients
 * may send any name. */
static void pointer_of(const char *name, char *out, size_t size)
{
    size_t n = 0;
    out[n++] = '/';
    for (; *name && n + 3 < size; name++) {
        if (*name == '.') {
            out[n++] = '/';
        } else if (*name == '~' || *name == '/') {
            out[n++] = '~';
            out[n++] = *name == '~' ? '0' : '1';
        } else {
            out[n++] = *name;
        }
    }
    out[n] = 0;
}

static enum kd_status refuse_name(const struct kd_route *route, const char *name, const char *pointer,
                                  struct kd_error *error)
{
    const struct kd_query *queries = route && route->queries ? route->queries : &(const struct kd_query) { 0 };
    char known[120] = "preset";
    size_t used = strlen(known);
    for (const struct kd_query *query = queries; query->name && used < sizeof known; query++)
        used +=
            (size_t)snprintf(known + used, sizeof known - used, "%s%s", query[1].name ? ", " : " and ", query->name);
    return kd_error_field(error, pointer, "the query of a POST may have %s, not %.100s", known, name);
}

enum kd_status kd_scene_query_check(const struct kd_target *target, bool fields, const struct kd_route *route,
                                    struct kd_error *error)
{
    struct {
        const struct kd_row *row;
        size_t index;
    } at[KD_TARGET_PAIRS]; /* row is NULL if the name is not that of a field */
    char pointer[sizeof error->pointer];
    for (size_t i = 0; i < target->n_pairs; i++) {
        const char *name = target->pairs[i].name;
        pointer_of(name, pointer, sizeof pointer);
        if (!fields || kd_field_at(name, &at[i].row, &at[i].index, NULL))
            at[i].row = NULL;
        for (size_t k = 0; k < i; k++)
            if (at[i].row ? at[k].row == at[i].row && at[k].index == at[i].index : !strcmp(target->pairs[k].name, name))
                return kd_error_field(error, pointer, "the query has %.100s twice", name);
        if (!fields && strcmp(name, "preset") && !kd_route_has_query(route, name))
            return refuse_name(route, name, pointer, error);
    }
    return KD_OK;
}

static enum kd_status apply_preset(const struct kd_target *target, struct kd_scene *scene, struct kd_error *error)
{
    for (size_t i = 0; i < target->n_pairs; i++) {
        if (strcmp(target->pairs[i].name, "preset"))
            continue;
        enum kd_status status = kd_scene_preset(scene, target->pairs[i].value, error);
        if (status == KD_EINVAL)
            snprintf(error->pointer, sizeof error->pointer, "/preset");
        return status;
    }
    return KD_OK;
}

/* Applies the fields of a query, the style first, because the order of the parameters must not matter. */
static enum kd_status apply_fields(const struct kd_target *target, const struct kd_route *route, struct kd_scene *scene,
                                   struct kd_error *error)
{
    char pointer[sizeof error->pointer];
    for (size_t i = 0; i < 2 * target->n_pairs; i++) {
        const struct kd_target_pair *pair = &target->pairs[i % target->n_pairs];
        if (!strcmp(pair->name, "preset") || kd_route_has_query(route, pair->name) ||
            !strcmp(pair->name, "style.name") != (i < target->n_pairs))
            continue;
        enum kd_status status = kd_scene_set(scene, pair->name, pair->value, error);
        if (status == KD_EINVAL && !*error->pointer) {
            pointer_of(pair->name, pointer, sizeof pointer);
            kd_error_inside(error, pointer);
        }
        if (status)
            return status;
    }
    return KD_OK;
}

enum kd_status kd_scene_of_query(const struct kd_target *target, const struct kd_route *route, struct kd_scene *scene,
                                 struct kd_error *error)
{
    enum kd_status status;
    kd_scene_defaults(scene);
    KD_TRY(kd_scene_query_check(target, true, route, error));
    KD_TRY(apply_preset(target, scene, error));
    KD_TRY(apply_fields(target, route, scene, error));
done:
    return status;
}

bool kd_scene_of_request(const struct kd_request *request, struct kd_scene *scene, struct kd_problem *problem,
                         struct kd_error *error)
{
    bool post = !strcmp(request->method, "POST"), malformed = false;

    enum kd_status status;
    if (post) {
        kd_scene_defaults(scene);
        KD_TRY(kd_scene_query_check(&request->target, false, request->route, error));
        KD_TRY(apply_preset(&request->target, scene, error));
        status = kd_scene_from_json(scene, request->body.data ? (const char *)request->body.data : "",
                                    request->body.size, error);
        /* if the error has no pointer, the text is not JSON */
        malformed = status == KD_EINVAL && !*error->pointer;
        KD_TRY(status);
    } else {
        KD_TRY(kd_scene_of_query(&request->target, request->route, scene, error));
    }
    KD_TRY(kd_scene_resolve(scene, kd_asset_store_assets(request->server->assets), error));
    KD_TRY(kd_scene_validate(scene, error));
done:
    if (status) {
        *problem = kd_problem_from(error);
        if (malformed)
            problem->type = KD_PROBLEM_MALFORMED_JSON;
    }
    return !status;
}

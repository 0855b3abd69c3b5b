#include "integral/integral_internal.h"
#include "integral/request.h"
#include "integral/sets.h"

#include "document/tree.h"

#include <stdlib.h>

void kd_integral_request_finish(struct kd_integral_request *request)
{
    struct kd_number_list *const lists[] = {
        &request->edges, &request->radii, &request->g_star,  &request->frequencies_hz, &request->frequencies_m,
        &request->u,     &request->v,     &request->lengths, &request->angles_deg
    };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        free(lists[i]->at);
        *lists[i] = (struct kd_number_list) { 0 };
    }
    free(request->scene);
    request->scene = NULL;
    kd_integral_drop_observation(request);
    kd_integral_drop_sets(request);
}

struct kd_document kd_integral_document(enum kd_integral what)
{
    return (struct kd_document) { .rows = kd_integral_fields,
                                  .n = kd_n_integral_fields,
                                  .of = 1u << what,
                                  .others = kd_integral_is_compared(what)   ? "preset|scene|observation|sets"
                                            : kd_integral_is_observed(what) ? "preset|scene|observation"
                                            : kd_integral_is_pictured(what) || what == KD_INTEGRAL_SPECTRUM
                                                ? "preset|scene"
                                                : NULL };
}

const struct kd_row *kd_integral_field_named(const struct kd_integral_request *request, const char *name)
{
    const struct kd_document document = kd_integral_document(request->what);
    return kd_document_find(&document, name);
}

enum kd_status kd_integral_make_room(struct kd_integral_request *request, const struct kd_row *f, size_t n,
                                     const char *pointer, struct kd_number_list **list, struct kd_error *error)
{
    return kd_row_make_room(f, request, n, pointer, list, error);
}

/* Reads the members of a document that are not fields. */
static enum kd_status read_others(struct kd_integral_request *request, cJSON *root, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (request->what == KD_INTEGRAL_SPECTRUM && cJSON_HasObjectItem(root, "volume"))
        KD_TRY(kd_error_field(error, "/volume",
                              "volume cannot be a member here; it belongs to a scene, as in \"scene\": {\"volume\": "
                              "...}, or a preset such as \"preset\": \"riaf\""));
    KD_TRY(kd_integral_read_scene(request, root, error));
    KD_TRY(kd_integral_read_observation(request, root, error));
    KD_TRY(kd_integral_read_sets(request, root, error));
done:
    return status;
}

enum kd_status kd_integral_request_read(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status;
    KD_TRY(kd_tree_parse(text, length, KD_INTEGRAL_BODY_MAX, 4 * KD_INTEGRAL_LIST, &root, error));
    if (cJSON_IsObject(root))
        KD_TRY(read_others(request, root, error));
    const struct kd_document document = kd_integral_document(request->what);
    KD_TRY(kd_document_read(&document, request, root, "", request->seen, error));
done:
    kd_tree_free(root);
    return status;
}

enum kd_status kd_integral_request_json(struct kd_integral_request *request, const char *text, size_t length,
                                        struct kd_error *error)
{
    enum kd_status status = kd_integral_request_read(request, text, length, error);
    return status ? status : kd_integral_request_check(request, error);
}

enum kd_status kd_integral_request_set(struct kd_integral_request *request, const char *name, const char *text,
                                       struct kd_error *error)
{
    const struct kd_document document = kd_integral_document(request->what);
    return kd_document_set(&document, request, name, text, request->seen, error);
}

/* Places in a document: pointers, and typed paths such as "spots.0.r". */
#include "document/document_internal.h"

#include "document/text.h"

#include <stdio.h>
#include <string.h>

enum { TOKEN_SIZE = 80 };

struct kd_mention kd_mention_of(const char *pointer, const struct kd_object *object, const char *name)
{
    struct kd_mention place;
    char token[TOKEN_SIZE], element[24] = "", shown[60] = "";
    snprintf(place.pointer, sizeof place.pointer, "%s", pointer);
    for (const char *at = object->name; *at;) {
        const size_t n = strcspn(at, ".");
        snprintf(token, sizeof token, "%.*s", (int)n, at);
        kd_text_pointer(place.pointer, sizeof place.pointer, token);
        at += n + (at[n] == '.');
    }
    if (object->list) {
        snprintf(element, sizeof element, ".%zu", object->index);
        kd_text_pointer(place.pointer, sizeof place.pointer, element + 1);
    }
    if (name) {
        kd_text_pointer(place.pointer, sizeof place.pointer, name);
        kd_text_clip(shown, sizeof shown, name);
    }
    snprintf(place.called, sizeof place.called, "%.50s%s%s%s", object->name, element, name && *object->name ? "." : "",
             shown);
    return place;
}

/* Copies the part of the path up to the next dot; copies "" if there is no dot, or if the part is too long. *rest:
 * the text after the dot. */
static void next_token(const char **rest, char out[TOKEN_SIZE])
{
    const char *dot = strchr(*rest, '.');
    const size_t length = dot ? (size_t)(dot - *rest) : 0;
    out[0] = 0;
    if (!length || length >= TOKEN_SIZE)
        return;
    memcpy(out, *rest, length);
    out[length] = 0;
    *rest = dot + 1;
}

/* Refuses a path that ends at an object, a list or an element instead of a field. */
static enum kd_status whole(const struct kd_document *document, const struct kd_object *object, const char *what,
                            struct kd_error *error)
{
    const struct kd_list *list = kd_document_list(document, object->name);
    const struct kd_object first = { object->name, list, object->index };
    const struct kd_row *row = document->rows;
    while (!kd_row_is_of(document, row, object->name))
        row++;
    const struct kd_mention place = kd_mention_of("", object, NULL);
    return kd_error_field(error, place.pointer, "%s is %s, as in %s", place.called, what,
                          kd_mention_of("", &first, row->name).called);
}

static enum kd_status whole_object(const struct kd_document *document, const char *name, struct kd_error *error)
{
    const struct kd_object object = { .name = name };
    return whole(document, &object,
                 kd_document_list(document, name) ? "a list; name a field of one of its elements"
                                                  : "a section; name one of its fields",
                 error);
}

static enum kd_status whole_element(const struct kd_document *document, const struct kd_object *object,
                                    struct kd_error *error)
{
    return whole(document, object, "an element; name one of its fields", error);
}

/* Finds the object to which a path leads, and the name after it. */
static enum kd_status find_object(const struct kd_document *document, const char *path, struct kd_object *object,
                                  struct kd_typed_place *out, const char **name, struct kd_error *error)
{
    char token[TOKEN_SIZE];
    *name = path;
    next_token(name, token);
    const struct kd_former *former = kd_find_former(document, *token ? token : path);
    if (former) {
        *object = (struct kd_object) { former->object, kd_document_list(document, former->object), former->index };
        out->former = true;
        return *token ? KD_OK : whole_element(document, object, error);
    }
    const char *found = kd_find_object(document, "", *token ? token : path);
    if (!*token && found)
        return whole_object(document, found, error);
    *object = (struct kd_object) { .name = "" };
    if (!*token)
        return KD_OK;
    if (!found) {
        object->name = token;
        return kd_unknown(document, object, *name, true, kd_mention_of("", object, *name).pointer, error);
    }
    *object = (struct kd_object) { found, kd_document_list(document, found), 0 };
    next_token(name, token);
    const char *inner = kd_find_object(document, found, *token ? token : *name);
    if (inner && !*token)
        return whole_object(document, inner, error);
    if (inner)
        object->name = inner;
    else if (object->list) {
        enum kd_status status = kd_list_index(object->list, *token ? token : *name, "", &object->index, error);
        return status || *token ? status : whole_element(document, object, error);
    } else if (*token)
        /* the path is not split here: the object has no such member, so the dot is part of the name */
        *name = *name - strlen(token) - 1;
    return KD_OK;
}

enum kd_status kd_document_place(const struct kd_document *document, const char *path, struct kd_typed_place *out,
                                 struct kd_error *error)
{
    struct kd_object object;
    const char *name;
    *out = (struct kd_typed_place) { .row = NULL };
    enum kd_status status = find_object(document, path, &object, out, &name, error);
    if (status)
        return status;
    out->row = kd_find_row(document, object.name, name, NULL);
    out->list = object.list;
    out->index = object.index;
    return out->row ? KD_OK
                    : kd_unknown(document, &object, name, true, kd_mention_of("", &object, name).pointer, error);
}

/* Lists of objects. */
#include "document/document_internal.h"

#include "document/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t kd_list_size(const struct kd_list *list, const void *from)
{
    return *(const size_t *)(const void *)((const char *)from + list->size_at);
}

void kd_list_resize(const struct kd_document *document, const struct kd_list *list, void *to, size_t size)
{
    const size_t old = kd_list_size(list, to);
    for (size_t i = old < size ? old : size; i < list->most; i++)
        for (size_t k = 0; k < document->n; k++)
            if (kd_row_is_of(document, &document->rows[k], list->object))
                kd_row_reset(&document->rows[k], (char *)to + i * list->stride);
    *(size_t *)(void *)((char *)to + list->size_at) = size;
}

static bool is_initial(const struct kd_document *document, const struct kd_list *list, const void *element)
{
    for (size_t k = 0; k < document->n; k++)
        if (kd_row_is_of(document, &document->rows[k], list->object) &&
            kd_row_get(&document->rows[k], element) != document->rows[k].initial)
            return false;
    return true;
}

void kd_list_trim(const struct kd_document *document, const struct kd_list *list, void *to, size_t least)
{
    size_t size = kd_list_size(list, to);
    while (size > least && is_initial(document, list, (const char *)to + (size - 1) * list->stride))
        size--;
    kd_list_resize(document, list, to, size);
}

enum kd_status kd_list_index(const struct kd_list *list, const char *token, const char *pointer, size_t *index,
                             struct kd_error *error)
{
    const size_t digits = strspn(token, "0123456789");
    if (digits && digits < 6 && !token[digits] && (token[0] != '0' || digits == 1)) {
        const size_t value = strtoul(token, NULL, 10);
        if (value < list->most) {
            *index = value;
            return KD_OK;
        }
    }
    char shown[48];
    const struct kd_mention place = kd_mention_of(pointer, &(struct kd_object) { .name = list->object }, token);
    kd_text_clip(shown, sizeof shown, token);
    return kd_error_field(error, place.pointer, "there is no %s.%s: %s is a list with elements from %s.0 to %s.%zu",
                          list->object, shown, list->object, list->object, list->object, list->most - 1);
}

enum kd_status kd_list_reach(const struct kd_list *list, size_t size, size_t index, const char *pointer,
                             struct kd_error *error)
{
    if (index <= size)
        return KD_OK;
    const struct kd_mention place = kd_mention_of(pointer, &(struct kd_object) { list->object, list, index }, NULL);
    return kd_error_field(error, place.pointer,
                          "there is no %s.%zu: the list has %zu element%s, and the next free index is %zu",
                          list->object, index, size, size == 1 ? "" : "s", size);
}

enum kd_status kd_list_check(const struct kd_list *list, size_t size, struct kd_error *error)
{
    if (size <= list->most)
        return KD_OK;
    const struct kd_mention place = kd_mention_of("", &(struct kd_object) { list->object, list, list->most }, NULL);
    return kd_error_field(error, place.pointer, "%s has %zu elements; it must have at most %zu", list->object, size,
                          list->most);
}

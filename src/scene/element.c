#include "scene/element.h"

#include "document/text.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void kd_element_pointer(const struct kd_section *list, size_t index, char out[KD_PATH_SIZE])
{
    snprintf(out, KD_PATH_SIZE, "/%s/%zu", list->name, index);
}

enum kd_status kd_element_find(const struct kd_section *list, const char *token, size_t *index, struct kd_error *error)
{
    size_t digits = strspn(token, "0123456789");
    if (digits && digits < 6 && !token[digits] && (token[0] != '0' || digits == 1)) {
        size_t value = strtoul(token, NULL, 10);
        if (value < list->most) {
            *index = value;
            return KD_OK;
        }
    }
    char pointer[sizeof error->pointer] = "", shown[48];
    kd_text_pointer(pointer, sizeof pointer, list->name);
    kd_text_pointer(pointer, sizeof pointer, token);
    kd_text_clip(shown, sizeof shown, token);
    return kd_error_field(error, pointer, "there is no %s.%s: %s is a list with elements from %s.0 to %s.%zu",
                          list->name, shown, list->name, list->name, list->name, list->most - 1);
}

enum kd_status kd_element_reach(const struct kd_section *list, size_t size, size_t index, struct kd_error *error)
{
    if (index <= size)
        return KD_OK;
    char pointer[KD_PATH_SIZE];
    kd_element_pointer(list, index, pointer);
    return kd_error_field(error, pointer,
                          "there is no %s.%zu: the list has %zu element%s, and the next free index is %zu", list->name,
                          index, size, size == 1 ? "" : "s", size);
}

enum kd_status kd_element_count(const struct kd_section *list, size_t size, struct kd_error *error)
{
    if (size <= list->most)
        return KD_OK;
    char pointer[KD_PATH_SIZE];
    kd_element_pointer(list, list->most, pointer);
    return kd_error_field(error, pointer, "%s has %zu elements; it must have at most %zu", list->name, size,
                          list->most);
}

#include "playground/fields.h"

#include "document/text.h"
#include "document/tree.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

void kd_playground_pointer(char to[160], const char *pointer, const char *name)
{
    snprintf(to, 160, "%s", pointer);
    kd_text_pointer(to, 160, name);
}

enum kd_status kd_playground_unknown(const char *pointer, const char *name, struct kd_error *error)
{
    char clipped[60], at[160];
    kd_text_clip(clipped, sizeof clipped, name);
    kd_playground_pointer(at, pointer, name);
    return kd_error_field(error, at, "there is no field %s here", clipped);
}

enum kd_status kd_playground_numbers(double *to, int n, double most, const cJSON *item, const char *pointer,
                                     struct kd_error *error)
{
    if (!cJSON_IsArray(item) || cJSON_GetArraySize(item) != n)
        return kd_error_field(error, pointer, "this is not an array of %d numbers", n);
    int i = 0;
    for (const cJSON *one = item->child; one; one = one->next, i++) {
        const struct kd_value value = kd_tree_value(one);
        char given[KD_VALUE_SIZE], index[12], at[160];
        if (value.kind == KD_VALUE_NUMBER && fabs(value.number) <= most) {
            to[i] = value.number;
            continue;
        }
        snprintf(index, sizeof index, "%d", i);
        kd_playground_pointer(at, pointer, index);
        kd_value_describe(&value, given);
        return kd_error_field(error, at, "this is %s%s; it must be %g to %g", given, kd_value_unwanted(&value), -most,
                              most);
    }
    return KD_OK;
}

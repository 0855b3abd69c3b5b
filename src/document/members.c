#include "document/members.h"

#include "document/text.h"
#include "document/tree.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum kd_status kd_member_refuse(const cJSON *item, const char *pointer, const char *allowed, struct kd_error *error)
{
    char given[KD_VALUE_SIZE];
    struct kd_value value = kd_tree_value(item);
    kd_value_describe(&value, given);
    return kd_error_field(error, pointer, "%s is %s; it must be %s", *pointer ? pointer + 1 : "the document", given,
                          allowed);
}

enum kd_status kd_member_whole(const cJSON *item, const char *pointer, unsigned least, unsigned most, unsigned *out,
                               struct kd_error *error)
{
    char allowed[60];
    double value = cJSON_IsNumber(item) ? item->valuedouble : -1;
    snprintf(allowed, sizeof allowed, "a whole number from %u to %u", least, most);
    if (!(value >= least && value <= most) || value != floor(value))
        return kd_member_refuse(item, pointer, allowed, error);
    *out = (unsigned)value;
    return KD_OK;
}

enum kd_status kd_member_word(const cJSON *item, const char *pointer, const char *const *words, size_t n, unsigned *out,
                              struct kd_error *error)
{
    char allowed[100];
    size_t length = 0;
    if (!item)
        return KD_OK;
    for (size_t i = 0; i < n; i++) {
        if (cJSON_IsString(item) && !strcmp(item->valuestring, words[i])) {
            *out = (unsigned)i;
            return KD_OK;
        }
        length += (size_t)snprintf(allowed + length, sizeof allowed - length, "%s\"%s\"", kd_text_or(i, n), words[i]);
    }
    return kd_member_refuse(item, pointer, allowed, error);
}

enum kd_status kd_member_inside(enum kd_status status, const char *pointer, struct kd_error *error)
{
    if (status)
        kd_error_inside(error, pointer);
    return status;
}

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

static enum kd_status refuse_name(const cJSON *item, const char *pointer, const struct kd_member *members, size_t n,
                                  bool twice, struct kd_error *error)
{
    char at[sizeof error->pointer], name[60], known[240] = "";
    snprintf(at, sizeof at, "%s", pointer);
    kd_text_pointer(at, sizeof at, item->string);
    kd_text_clip(name, sizeof name, item->string);
    if (twice)
        return kd_error_field(error, at, "%s is given twice", name);
    for (size_t i = 0; i < n; i++)
        snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", i ? ", " : "", members[i].name);
    return kd_error_field(error, at, "there is no field %s here; known are %s", name, known);
}

enum kd_status kd_members_read(const cJSON *object, const char *pointer, const struct kd_member *members, size_t n,
                               struct kd_error *error)
{
    for (const cJSON *item = object->child; item; item = item->next) {
        size_t i = 0;
        while (i < n && strcmp(members[i].name, item->string))
            i++;
        if (i == n || *members[i].to)
            return refuse_name(item, pointer, members, n, i < n, error);
        *members[i].to = item;
    }
    return KD_OK;
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

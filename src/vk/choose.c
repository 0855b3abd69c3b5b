#include "vk/choose.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void list_names(const struct kd_vk_info *infos, size_t count, char *out, size_t size)
{
    size_t used = 0;
    out[0] = 0;
    for (size_t i = 0; i < count && used < size; i++)
        used += (size_t)snprintf(out + used, size - used, "%s%zu: %.80s%s", i ? "; " : "", i, infos[i].name,
                                 infos[i].missing[0] ? " (unusable)" : "");
}

/* True if a is better than b, which has the same type. Double precision counts first, then the subgroup width. */
static bool better(const struct kd_vk_info *a, const struct kd_vk_info *b)
{
    if (a->type != b->type)
        return a->type > b->type;
    if (a->float64 != b->float64)
        return a->float64;
    return a->subgroup_size > b->subgroup_size;
}

/* Finds the best usable device whose name contains `part`; "" matches any name. Among equal devices, the first one is
 * taken. Returns count if there is none. */
static size_t best(const struct kd_vk_info *infos, size_t count, const char *part, size_t *matches)
{
    size_t found = count;
    *matches = 0;
    for (size_t i = 0; i < count; i++) {
        if (!strcasestr(infos[i].name, part))
            continue;
        ++*matches;
        if (!infos[i].missing[0] && (found == count || better(&infos[i], &infos[found])))
            found = i;
    }
    return found;
}

static enum kd_status unusable(const struct kd_vk_info *info, struct kd_error *error)
{
    return kd_error_set(error, KD_EDEVICE, "device %u (%s) lacks %s", info->index, info->name, info->missing);
}

static enum kd_status by_index(const struct kd_vk_info *infos, size_t count, const char *wish, size_t *index,
                               struct kd_error *error)
{
    char names[320];
    unsigned long n = strtoul(wish, NULL, 10); /* saturates for large numbers, which are out of range in any case */
    list_names(infos, count, names, sizeof names);
    if (n >= count)
        return kd_error_set(error, KD_EINVAL, "there is no device %s; there are %s", wish, names);
    *index = n;
    return infos[n].missing[0] ? unusable(&infos[n], error) : KD_OK;
}

static enum kd_status by_name(const struct kd_vk_info *infos, size_t count, const char *wish, size_t *index,
                              size_t *matches, struct kd_error *error)
{
    char names[320];
    *index = best(infos, count, wish, matches);
    if (*index < count)
        return KD_OK;
    list_names(infos, count, names, sizeof names);
    for (size_t i = 0; i < count; i++)
        if (strcasestr(infos[i].name, wish))
            return unusable(&infos[i], error);
    return kd_error_set(error, KD_EINVAL, "no device has the name '%.60s'; there are %s", wish, names);
}

static enum kd_status any(const struct kd_vk_info *infos, size_t count, size_t *index, size_t *usable,
                          struct kd_error *error)
{
    size_t matches;
    *usable = 0;
    for (size_t i = 0; i < count; i++)
        *usable += !infos[i].missing[0];
    *index = best(infos, count, "", &matches);
    if (*index < count)
        return KD_OK;
    return count ? unusable(&infos[0], error) : kd_error_set(error, KD_EDEVICE, "there is no Vulkan device");
}

enum kd_status kd_vk_choose(const struct kd_vk_info *infos, size_t count, const char *wish, size_t *index, char *why,
                            size_t why_size, struct kd_error *error)
{
    size_t n = 0;
    enum kd_status status;
    char reason[160];
    if (!wish || !wish[0] || !strcmp(wish, "auto")) {
        status = any(infos, count, index, &n, error);
        if (n > 1 && !status)
            snprintf(reason, sizeof reason, "the best %s among %zu usable devices", kd_vk_type_name(infos[*index].type),
                     n);
        else
            snprintf(reason, sizeof reason, "the only usable device");
    } else if (wish[strspn(wish, "0123456789")] == 0) {
        status = by_index(infos, count, wish, index, error);
        snprintf(reason, sizeof reason, "chosen by its index");
    } else {
        status = by_name(infos, count, wish, index, &n, error);
        snprintf(reason, sizeof reason, "%s '%.80s'",
                 n > 1 ? "the best of those whose names contain" : "its name contains", wish);
    }
    if (!status)
        snprintf(why, why_size, "device %u, %s (%s): %s", infos[*index].index, infos[*index].name,
                 kd_vk_type_name(infos[*index].type), reason);
    return status;
}

#include "integral/sets.h"

#include "base/pause.h"
#include "integral/integral_internal.h"
#include "render/plan/plan.h"
#include "document/members.h"
#include "document/text.h"
#include "document/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum kd_status kd_integral_read_sets(struct kd_integral_request *r, cJSON *root, struct kd_error *error)
{
    cJSON *given = NULL;
    for (cJSON *item = root->child; item; item = item->next) {
        if (strcmp(item->string, "sets") || !kd_integral_is_compared(r->what))
            continue;
        if (given)
            return kd_error_field(error, "/sets", "sets is given twice");
        given = item;
    }
    if (!given)
        return KD_OK;
    const int n = cJSON_IsArray(given) ? cJSON_GetArraySize(given) : 0;
    if (!cJSON_IsArray(given))
        return kd_member_refuse(given, "/sets", "an array of objects", error);
    if (n < 1 || n > KD_INTEGRAL_SETS_MOST)
        return kd_error_field(error, "/sets", "sets has %d objects; it must have 1 to %d", n, KD_INTEGRAL_SETS_MOST);
    if (!r->sets && !(r->sets = calloc(1, sizeof *r->sets)))
        return kd_error_set(error, KD_ENOMEM, "out of memory for %d sets", n);
    kd_tree_free(r->sets->tree);
    r->sets->tree = cJSON_DetachItemViaPointer(root, given);
    r->what = KD_INTEGRAL_SETS;
    return KD_OK;
}

void kd_integral_drop_sets(struct kd_integral_request *r)
{
    if (!r->sets)
        return;
    kd_tree_free(r->sets->tree);
    free(r->sets->at);
    free(r->sets->first);
    free(r->sets);
    r->sets = NULL;
}

static enum kd_status read_own(struct kd_integral_set *set, const cJSON *item, bool *is_own, struct kd_error *error)
{
    static const struct {
        const char *name;
        size_t offset;
        double least, most;
    } own[] = { { "flux_jy", offsetof(struct kd_integral_set, flux_jy), 1e-12, 1e12 },
                { "size", offsetof(struct kd_integral_set, size), 1e-3, 1e3 },
                { "position_angle_deg", offsetof(struct kd_integral_set, angle_deg), -1e6, 1e6 } };
    *is_own = false;
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
        if (strcmp(item->string, own[i].name))
            continue;
        const struct kd_value value = kd_tree_value(item);
        *is_own = true;
        if (value.kind != KD_VALUE_NUMBER || !(value.number >= own[i].least && value.number <= own[i].most)) {
            char given[KD_VALUE_SIZE];
            kd_value_describe(&value, given);
            return kd_error_field(error, "", "%s is %s; it must be a number from %g to %g", own[i].name, given,
                                  own[i].least, own[i].most);
        }
        *(double *)(void *)((char *)set + own[i].offset) = value.number;
    }
    return KD_OK;
}

/* Checks that a set gives no value for a quantity that the request solves for, because the solution would replace it.
 */
static enum kd_status check_solved(const struct kd_integral_request *r, const cJSON *item, struct kd_error *error)
{
    static const struct {
        const char *name, *word;
        unsigned bit;
    } known[] = { { "flux_jy", "flux", KD_ALIGN_FLUX },
                  { "size", "size", KD_ALIGN_SIZE },
                  { "position_angle_deg", "position_angle", KD_ALIGN_ANGLE } };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (!strcmp(item->string, known[i].name) && r->solve & known[i].bit)
            return kd_error_field(error, "", "%s cannot be used with solve %s, which would replace it", known[i].name,
                                  known[i].word);
    return KD_OK;
}

static enum kd_status set_field(struct kd_integral_set *set, const cJSON *item, struct kd_error *error)
{
    char text[64];
    if (!strncmp(item->string, "image.", 6))
        return kd_error_field(error, "", "%.40s cannot be in a set, because all sets have the same picture",
                              item->string);
    if (cJSON_IsNumber(item))
        snprintf(text, sizeof text, "%.17g", item->valuedouble);
    else if (!cJSON_IsBool(item) && !cJSON_IsString(item))
        return kd_member_refuse(item, "", "a number, a word, true or false", error);
    return kd_scene_set(&set->scene, item->string,
                        cJSON_IsNumber(item)   ? text
                        : cJSON_IsString(item) ? item->valuestring
                        : cJSON_IsTrue(item)   ? "true"
                                               : "false",
                        error);
}

static enum kd_status make_set(const struct kd_integral_request *r, const cJSON *given, struct kd_integral_set *set,
                               struct kd_error *error)
{
    enum kd_status status = KD_OK;
    if (!cJSON_IsObject(given))
        return kd_member_refuse(given, "", "an object", error);
    for (const cJSON *item = given->child; item; item = item->next) {
        bool is_own;
        for (const cJSON *before = given->child; before != item; before = before->next)
            if (!strcmp(before->string, item->string) || kd_scene_same_path(before->string, item->string))
                KD_TRY(kd_error_field(error, "", "%.40s is given twice", item->string));
        KD_TRY(check_solved(r, item, error));
        KD_TRY(read_own(set, item, &is_own, error));
        if (!is_own)
            KD_TRY(set_field(set, item, error));
    }
    if (r->assets)
        KD_TRY(kd_scene_resolve(&set->scene, r->assets, error));
    KD_TRY(kd_scene_validate(&set->scene, error));
    KD_TRY(kd_integral_check_flat(&set->scene, error));
    if (isnan(set->flux_jy))
        set->flux_jy = r->flux_jy;
    KD_TRY(kd_plan_lens_group(&set->scene, &set->group));
done:
    return status;
}

static int by_group(const void *a, const void *b)
{
    const struct kd_integral_set *x = a, *y = b;
    if (x->group != y->group)
        return x->group < y->group ? -1 : 1;
    const int scenes = memcmp(&x->scene, &y->scene, sizeof x->scene);
    return scenes ? scenes : x->row < y->row ? -1 : 1;
}

enum kd_status kd_integral_make_sets(struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_integral_sets *s = r->sets;
    enum kd_status status = KD_OK;
    const size_t n = (size_t)cJSON_GetArraySize(s->tree);
    free(s->at), free(s->first);
    s->at = malloc(n * sizeof *s->at), s->first = malloc((n + 1) * sizeof *s->first);
    s->n = 0, s->pictures = 0;
    if (!s->at || !s->first)
        return kd_error_set(error, KD_ENOMEM, "out of memory for %zu sets", n);
    for (const cJSON *item = s->tree->child; item; item = item->next) {
        struct kd_integral_set *set = &s->at[s->n];
        /* sets are copied as bytes, including padding, because equal scenes are recognised by their bytes */
        memset(set, 0, sizeof *set);
        memcpy(&set->scene, r->scene, sizeof set->scene);
        set->flux_jy = NAN, set->size = 1, set->row = (uint32_t)s->n;
        if (kd_pause_every(s->n, 16))
            return kd_error_set(error, KD_ECANCELLED, "the computation of the sets was cancelled");
        status = make_set(r, item, set, error);
        if (status == KD_EINVAL) {
            struct kd_error inner = error ? *error : (struct kd_error) { 0 };
            char pointer[40];
            snprintf(pointer, sizeof pointer, "/sets/%zu", s->n);
            return kd_error_field(error, pointer, "set %zu: %.400s", s->n, inner.message);
        }
        if (status)
            return status;
        s->n++;
    }
    qsort(s->at, s->n, sizeof *s->at, by_group);
    for (size_t i = 0; i < s->n; i++)
        if (!i || memcmp(&s->at[i].scene, &s->at[i - 1].scene, sizeof s->at[i].scene))
            s->first[s->pictures++] = (uint32_t)i;
    s->first[s->pictures] = (uint32_t)s->n;
    return KD_OK;
}

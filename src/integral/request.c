#include "integral/request.h"

#include "base/slip.h"
#include "physics/constants.h"
#include "physics/disk.h"
#include "physics/kerr.h"
#include "scene/number.h"
#include "scene/text.h"
#include "scene/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void kd_integral_request_finish(struct kd_integral_request *request)
{
    struct kd_integral_list *const lists[] = { &request->edges, &request->radii, &request->g_star, &request->frequencies_hz };
    for (size_t i = 0; i < sizeof lists / sizeof *lists; i++) {
        free(lists[i]->at);
        *lists[i] = (struct kd_integral_list) { 0 };
    }
}

static bool has(const struct kd_integral_request *request, const struct kd_integral_field *field) { return field->of & 1u << request->what; }

static enum kd_status unknown(const struct kd_integral_request *request, const char *name, const char *pointer, struct kd_error *error)
{
    char shown[60], known[400] = ""; /* kd_error_field clips what is longer */
    struct kd_slip_best meant = { 0 };
    if (request->what == KD_INTEGRAL_SPECTRUM && (!strcmp(name, "volume") || !strcmp(name, "scene")))
        return kd_error_field(error, pointer, "%s is given, and spectra of volumes are not computed yet for any model: this is that of the thin disk", name);
    kd_text_clip(shown, sizeof shown, name);
    for (size_t i = 0; i < kd_n_integral_fields; i++) {
        const struct kd_integral_field *f = &kd_integral_fields[i];
        size_t used = strlen(known);
        if (!has(request, f))
            continue;
        kd_slip_offer(&meant, name, f->name);
        snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", f->name);
    }
    return kd_error_field(error, pointer, "there is no field %s here%s%s; known are %s", shown, meant.name ? "; did you mean " : "", meant.name ? meant.name : "",
                          known);
}

/* The text up to a mark, cut where there is no room for it. */
static const char *part(const char *text, const char *mark, char out[64])
{
    size_t length = strcspn(text, mark);
    length = length < 63 ? length : 63;
    memcpy(out, text, length);
    out[length] = 0;
    return out;
}

static void describe_allowed(const struct kd_integral_field *f, char out[KD_ALLOWED_SIZE])
{
    char low[KD_NUMBER_SIZE], high[KD_NUMBER_SIZE];
    kd_number_format(low, f->least);
    kd_number_format(high, f->most);
    if (f->kind == KD_INTEGRAL_WORD) {
        char one[64];
        size_t used = 0;
        for (const char *word = f->words; *word; word += word[strcspn(word, "|")] ? strcspn(word, "|") + 1 : strlen(word))
            used += (size_t)snprintf(out + used, KD_ALLOWED_SIZE - used, "%s\"%s\"", used ? ", " : "", part(word, "|", one));
        return;
    }
    snprintf(out, KD_ALLOWED_SIZE, f->open ? "%snumbers above %s and below %s%s%s%s" : "%s%s to %s%s%s%s", f->kind == KD_INTEGRAL_WHOLE ? "whole numbers from " : "", low,
             high, f->words ? ", and \"" : "", f->words ? f->words : "", f->words ? "\"" : "");
}

static enum kd_status refuse(const struct kd_integral_field *f, const struct kd_value *value, const char *pointer, struct kd_error *error)
{
    char given[KD_VALUE_SIZE], allowed[KD_ALLOWED_SIZE];
    kd_value_describe(value, given);
    describe_allowed(f, allowed);
    return kd_error_field(error, pointer, "%s is %s%s, allowed are %s", f->name, given, f->kind == KD_INTEGRAL_WORD ? "" : kd_value_unwanted(value), allowed);
}

static bool inside(const struct kd_integral_field *f, const struct kd_value *value)
{
    double x = value->number;
    if (value->kind != KD_VALUE_NUMBER)
        return false;
    return f->open ? x > f->least && x < f->most : x >= f->least && x <= f->most;
}

static bool store_word(void *at, const char *words, const char *text)
{
    int i = 0;
    for (const char *word = words; *word; i++) {
        size_t n = strcspn(word, "|");
        if (strlen(text) == n && !strncmp(word, text, n)) {
            memcpy(at, &i, sizeof i); /* an enum of ours: as wide as int */
            return true;
        }
        word += n + (word[n] == '|');
    }
    return false;
}

static bool store(struct kd_integral_request *request, const struct kd_integral_field *f, const struct kd_value *value)
{
    void *at = (char *)request + f->offset;
    switch (f->kind) {
    case KD_INTEGRAL_REAL:
        if (f->words && value->kind == KD_VALUE_STRING && !strcmp(value->text, f->words)) {
            *(double *)at = NAN;
            return true;
        }
        if (inside(f, value))
            *(double *)at = value->number;
        return inside(f, value);
    case KD_INTEGRAL_WHOLE:
        if (!inside(f, value) || value->number != floor(value->number))
            return false;
        *(uint32_t *)at = (uint32_t)value->number;
        return true;
    case KD_INTEGRAL_WORD: return value->kind == KD_VALUE_STRING && store_word(at, f->words, value->text);
    case KD_INTEGRAL_NUMBERS: break;
    }
    return false;
}

/* Room for n numbers of a list, in place of what it had. */
static enum kd_status make_room(struct kd_integral_request *request, const struct kd_integral_field *f, size_t n, const char *pointer, struct kd_integral_list **list,
                                struct kd_error *error)
{
    *list = (struct kd_integral_list *)(void *)((char *)request + f->offset);
    if (!n || n > KD_INTEGRAL_LIST)
        return kd_error_field(error, pointer, "%s has %zu numbers, allowed are 1 to %u", f->name, n, KD_INTEGRAL_LIST);
    free((*list)->at);
    **list = (struct kd_integral_list) { malloc(n * sizeof(double)), n };
    return (*list)->at ? KD_OK : kd_error_set(error, KD_ENOMEM, "out of memory for %zu numbers", n);
}

static enum kd_status put_number(struct kd_integral_list *list, size_t i, const struct kd_integral_field *f, const struct kd_value *value, const char *pointer,
                                 struct kd_error *error)
{
    char at[sizeof error->pointer];
    snprintf(at, sizeof at, "%s/%zu", pointer, i);
    if (!inside(f, value))
        return refuse(f, value, at, error);
    list->at[i] = value->number;
    return KD_OK;
}

static enum kd_status read_list(struct kd_integral_request *request, const struct kd_integral_field *f, const cJSON *item, const char *pointer, struct kd_error *error)
{
    struct kd_integral_list *list;
    size_t i = 0;
    enum kd_status status = KD_OK;
    if (!cJSON_IsArray(item)) {
        char given[KD_VALUE_SIZE];
        struct kd_value value = kd_tree_value(item);
        kd_value_describe(&value, given);
        return kd_error_field(error, pointer, "%s is %s, allowed is an array of numbers", f->name, given);
    }
    KD_TRY(make_room(request, f, (size_t)cJSON_GetArraySize(item), pointer, &list, error));
    for (const cJSON *one = item->child; one; one = one->next, i++) {
        struct kd_value value = kd_tree_value(one);
        KD_TRY(put_number(list, i, f, &value, pointer, error));
    }
done:
    return status;
}

/* Numbers with commas between them. */
static enum kd_status read_typed(struct kd_integral_request *request, const struct kd_integral_field *f, const char *text, const char *pointer, struct kd_error *error)
{
    struct kd_integral_list *list;
    size_t n = 1, i = 0;
    enum kd_status status = KD_OK;
    for (const char *c = text; *c; c++)
        n += *c == ',';
    KD_TRY(make_room(request, f, n, pointer, &list, error));
    for (const char *c = text; i < n; i++, c += strcspn(c, ",") + 1) {
        char one[64];
        struct kd_value value = kd_value_typed(part(c, ",", one));
        KD_TRY(put_number(list, i, f, &value, pointer, error));
    }
done:
    return status;
}

static const struct kd_integral_field *find(const struct kd_integral_request *request, const char *name)
{
    for (size_t i = 0; i < kd_n_integral_fields; i++)
        if (has(request, &kd_integral_fields[i]) && !strcmp(kd_integral_fields[i].name, name))
            return &kd_integral_fields[i];
    return NULL;
}

static enum kd_status read_item(struct kd_integral_request *request, const cJSON *item, struct kd_error *error)
{
    char pointer[sizeof error->pointer] = "";
    kd_text_pointer(pointer, sizeof pointer, item->string);
    const struct kd_integral_field *f = find(request, item->string);
    if (!f)
        return unknown(request, item->string, pointer, error);
    uint64_t bit = UINT64_C(1) << (f - kd_integral_fields);
    if (request->seen & bit)
        return kd_error_field(error, pointer, "%s is given twice", f->name);
    request->seen |= bit;
    if (f->kind == KD_INTEGRAL_NUMBERS)
        return read_list(request, f, item, pointer, error);
    struct kd_value value = kd_tree_value(item);
    return store(request, f, &value) ? KD_OK : refuse(f, &value, pointer, error);
}

enum kd_status kd_integral_request_read(struct kd_integral_request *request, const char *text, size_t length, struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status;
    KD_TRY(kd_tree_parse(text, length, KD_INTEGRAL_BODY_MAX, 4 * KD_INTEGRAL_LIST, &root, error));
    if (!cJSON_IsObject(root))
        KD_TRY(kd_error_field(error, "", "the document is no object with fields"));
    for (const cJSON *item = root->child; item; item = item->next)
        KD_TRY(read_item(request, item, error));
done:
    cJSON_Delete(root);
    return status;
}

enum kd_status kd_integral_request_json(struct kd_integral_request *request, const char *text, size_t length, struct kd_error *error)
{
    enum kd_status status = kd_integral_request_read(request, text, length, error);
    return status ? status : kd_integral_request_check(request, error);
}

enum kd_status kd_integral_request_set(struct kd_integral_request *request, const char *name, const char *text, struct kd_error *error)
{
    char pointer[sizeof error->pointer] = "";
    kd_text_pointer(pointer, sizeof pointer, name);
    const struct kd_integral_field *f = find(request, name);
    if (!f)
        return unknown(request, name, pointer, error);
    request->seen |= UINT64_C(1) << (f - kd_integral_fields);
    if (f->kind == KD_INTEGRAL_NUMBERS)
        return read_typed(request, f, text, pointer, error);
    struct kd_value value = kd_value_typed(text);
    return store(request, f, &value) ? KD_OK : refuse(f, &value, pointer, error);
}

static bool given(const struct kd_integral_request *request, const char *name)
{
    const struct kd_integral_field *f = find(request, name);
    return f && request->seen & UINT64_C(1) << (f - kd_integral_fields);
}

static enum kd_status check_disk(struct kd_integral_request *r, struct kd_error *error)
{
    double isco = kd_kerr_isco(r->spin);
    if (fabs(r->inclination_deg - 90) < KD_DISK_IMAGE_EDGE_ON)
        return kd_error_field(error, "/inclination_deg", "inclination_deg is %.9g, where the disk is seen edge on; allowed are 0 to 87 and 93 to 180", r->inclination_deg);
    if (isnan(r->inner))
        r->inner = isco;
    if (r->inner < isco * (1 - 1e-9))
        return kd_error_field(error, "/inner", "inner is %.9g, within the ISCO of this spin, %.9g M; allowed are that and larger radii, and \"isco\"", r->inner, isco);
    r->inner = fmax(r->inner, isco);
    if (r->outer <= r->inner * (1 + 1e-6))
        return kd_error_field(error, "/outer", "outer is %.9g and inner is %.9g; allowed are larger radii than that", r->outer, r->inner);
    return KD_OK;
}

/* A list that grows. */
static enum kd_status check_growth(const struct kd_integral_list *list, const char *name, struct kd_error *error)
{
    for (size_t i = 1; i < list->n; i++)
        if (!(list->at[i] > list->at[i - 1])) {
            char pointer[60];
            snprintf(pointer, sizeof pointer, "/%s/%zu", name, i);
            return kd_error_field(error, pointer, "%s is %.9g after %.9g; allowed are numbers that grow", name, list->at[i], list->at[i - 1]);
        }
    return KD_OK;
}

/* What belongs to one emissivity is refused beside another, as it would do nothing. */
static enum kd_status check_emissivity(const struct kd_integral_request *r, struct kd_error *error)
{
    static const struct {
        const char *name, *words;
        unsigned of;
    } belongs[] = {
        { "index", "power and broken", 1u << KD_LINE_POWER | 1u << KD_LINE_BROKEN },
        { "outer_index", "broken", 1u << KD_LINE_BROKEN },
        { "break_r", "broken", 1u << KD_LINE_BROKEN },
        { "height", "lamppost", 1u << KD_LINE_LAMPPOST },
        { "photon_index", "lamppost", 1u << KD_LINE_LAMPPOST },
    };
    for (size_t i = 0; i < sizeof belongs / sizeof *belongs; i++)
        if (given(r, belongs[i].name) && !(belongs[i].of & 1u << r->emissivity)) {
            char pointer[40];
            snprintf(pointer, sizeof pointer, "/%s", belongs[i].name);
            return kd_error_field(error, pointer, "%s is given, and belongs to emissivity %s", belongs[i].name, belongs[i].words);
        }
    double least = 1.05 * kd_kerr_horizon(r->spin);
    if (r->emissivity == KD_LINE_LAMPPOST && r->height < least)
        return kd_error_field(error, "/height", "height is %.9g, allowed are %.9g, 1.05 times the horizon of this spin, and more", r->height, least);
    return KD_OK;
}

static enum kd_status fill_edges(struct kd_integral_request *r, struct kd_error *error)
{
    struct kd_integral_list *list;
    const struct kd_integral_field *f = find(r, "edges");
    if (isnan(r->energy_max))
        r->energy_max = 1.7 * r->rest_energy;
    if (!(r->energy_max > r->energy_min))
        return kd_error_field(error, "/energy_max", "energy_max is %.9g and energy_min %.9g; allowed are larger values than that", r->energy_max, r->energy_min);
    enum kd_status status = make_room(r, f, (size_t)r->bins + 1, "/bins", &list, error);
    for (size_t i = 0; !status && i <= r->bins; i++)
        list->at[i] = i == r->bins ? r->energy_max : r->energy_min + (r->energy_max - r->energy_min) * (double)i / r->bins;
    return status;
}

static enum kd_status check_edges(struct kd_integral_request *r, struct kd_error *error)
{
    static const char *const even[] = { "energy_min", "energy_max", "bins" };
    if (!r->edges.n)
        return fill_edges(r, error);
    for (size_t i = 0; i < 3; i++)
        if (given(r, even[i]))
            return kd_error_field(error, "/edges", "edges are given beside %s: allowed is one of the two", even[i]);
    if (r->edges.n < 2)
        return kd_error_field(error, "/edges", "edges has one number, allowed are 2 to %u: both ends of each bin", KD_INTEGRAL_LIST);
    r->bins = (uint32_t)r->edges.n - 1, r->energy_min = r->edges.at[0], r->energy_max = r->edges.at[r->bins];
    return check_growth(&r->edges, "edges", error);
}

/* n numbers at equal ratios, or at the middles of n parts of 0 to 1. */
static enum kd_status fill_list(struct kd_integral_request *r, const char *name, uint32_t n, double first, double last, struct kd_error *error)
{
    struct kd_integral_list *list;
    enum kd_status status = make_room(r, find(r, name), n, "", &list, error);
    for (size_t i = 0; !status && i < n; i++)
        list->at[i] = !(first > 0) ? ((double)i + 0.5) / n : n == 1 ? first : i + 1 == n ? last : first * pow(last / first, (double)i / (n - 1));
    return status;
}

/* A list is refused beside what would have made it. */
static enum kd_status check_beside(const struct kd_integral_request *r, const char *list, const char *const *others, size_t n, struct kd_error *error)
{
    char pointer[40];
    snprintf(pointer, sizeof pointer, "/%s", list);
    for (size_t i = 0; i < n; i++)
        if (given(r, others[i]))
            return kd_error_field(error, pointer, "%s is given beside %s: allowed is one of the two", list, others[i]);
    return KD_OK;
}

static enum kd_status check_transfer(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    const double tilt = 90 - fabs(r->inclination_deg - 90);
    if (tilt < 0.1)
        return kd_error_field(error, "/inclination_deg", "inclination_deg is %.9g: seen face on each ring has one redshift and no transfer function; allowed are 0.1 to 87 and 93 to 179.9",
                              r->inclination_deg);
    if (r->radii.n) {
        KD_TRY(check_beside(r, "radii", (const char *const[]) { "rings" }, 1, error));
        r->rings = (uint32_t)r->radii.n;
    } else {
        KD_TRY(fill_list(r, "radii", r->rings, r->inner, r->outer, error));
    }
    if (r->g_star.n) {
        KD_TRY(check_beside(r, "g_star", (const char *const[]) { "g_stars" }, 1, error));
        r->g_stars = (uint32_t)r->g_star.n;
    } else {
        KD_TRY(fill_list(r, "g_star", r->g_stars, 0, 0, error));
    }
    for (size_t i = 0; i < r->radii.n; i++)
        if (r->radii.at[i] < r->inner * (1 - 1e-12) || r->radii.at[i] > r->outer) {
            char pointer[60];
            snprintf(pointer, sizeof pointer, "/radii/%zu", i);
            return kd_error_field(error, pointer, "a radius is %.9g, allowed are %.9g to %.9g, from inner to outer", r->radii.at[i], r->inner, r->outer);
        }
    if (r->radii.n * r->g_star.n > KD_INTEGRAL_TRANSFERS)
        return kd_error_field(error, r->radii.n > r->g_star.n ? "/radii" : "/g_star", "%zu radii with %zu g* are more than %u places", r->radii.n, r->g_star.n, KD_INTEGRAL_TRANSFERS);
done:
    return status;
}

static enum kd_status check_frequencies(struct kd_integral_request *r, struct kd_error *error)
{
    static const char *const even[] = { "frequency_min_hz", "frequency_max_hz", "frequencies" };
    enum kd_status status = KD_OK;
    if (r->frequencies_hz.n) {
        KD_TRY(check_beside(r, "frequencies_hz", even, 3, error));
        if (r->frequencies_hz.n > KD_INTEGRAL_FREQUENCIES)
            return kd_error_field(error, "/frequencies_hz", "frequencies_hz has %zu numbers, allowed are 1 to %u", r->frequencies_hz.n, KD_INTEGRAL_FREQUENCIES);
        r->frequencies = (uint32_t)r->frequencies_hz.n, r->frequency_min_hz = r->frequencies_hz.at[0], r->frequency_max_hz = r->frequencies_hz.at[r->frequencies - 1];
        return check_growth(&r->frequencies_hz, "frequencies_hz", error);
    }
    double hottest = fmax(r->inner, kd_disk_peak_page_thorne(r->spin));
    double t = r->colour_correction * kd_disk_temperature(kd_disk_flux_page_thorne(r->spin, hottest), r->spin, r->mass_msun, r->mdot_edd);
    if (isnan(r->frequency_min_hz))
        r->frequency_min_hz = 1e-3 * t * KD_K_J_K / KD_H_J_S;
    if (isnan(r->frequency_max_hz))
        r->frequency_max_hz = 30 * t * KD_K_J_K / KD_H_J_S;
    if (!(r->frequency_max_hz > r->frequency_min_hz))
        return kd_error_field(error, "/frequency_max_hz", "frequency_max_hz is %.9g and frequency_min_hz %.9g; allowed are larger values than that", r->frequency_max_hz,
                              r->frequency_min_hz);
    KD_TRY(fill_list(r, "frequencies_hz", r->frequencies, r->frequency_min_hz, r->frequency_max_hz, error));
done:
    return status;
}

size_t kd_integral_rows(const struct kd_integral_request *r)
{
    return r->what == KD_INTEGRAL_LINE ? r->bins : r->what == KD_INTEGRAL_SPECTRUM ? r->frequencies : (size_t)r->rings * r->g_stars;
}

enum kd_status kd_integral_request_check(struct kd_integral_request *r, struct kd_error *error)
{
    enum kd_status status;
    KD_TRY(check_disk(r, error));
    if (r->what == KD_INTEGRAL_LINE) {
        KD_TRY(check_emissivity(r, error));
        KD_TRY(check_edges(r, error));
    }
    if (r->what == KD_INTEGRAL_TRANSFER)
        KD_TRY(check_transfer(r, error));
    if (r->what == KD_INTEGRAL_SPECTRUM)
        KD_TRY(check_frequencies(r, error));
done:
    return status;
}

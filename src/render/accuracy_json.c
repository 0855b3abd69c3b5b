#include "render/accuracy.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FORMAT 1 /* of the document; another one is measured anew */

/* Four digits: more would be the weather of the day. */
static void add_figure(cJSON *object, const char *name, double value)
{
    char text[32];
    if (!isfinite(value))
        return;
    snprintf(text, sizeof text, "%.4g", value);
    cJSON_AddNumberToObject(object, name, strtod(text, NULL));
}

static void add_entry(cJSON *sets, const char *name, const struct kd_accuracy_entry *e, uint32_t cores)
{
    cJSON *o = cJSON_AddObjectToObject(sets, name);
    add_figure(o, "rays_per_s", e->rays_per_s);
    if (cores)
        add_figure(o, "rays_per_s_per_core", e->rays_per_s / cores);
    cJSON_AddNumberToObject(o, "rays", e->rays);
    cJSON_AddNumberToObject(o, "crossings", e->crossings);
    cJSON_AddNumberToObject(o, "differ", e->differ);
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
        if (!isfinite(e->of[q].median))
            continue;
        cJSON *errors = cJSON_AddObjectToObject(o, kd_accuracy_quantity_names[q]);
        add_figure(errors, "median", e->of[q].median);
        add_figure(errors, "p99", e->of[q].p99);
        add_figure(errors, "worst", e->of[q].worst);
    }
}

static cJSON *row_to_json(const struct kd_accuracy_table *table, const struct kd_accuracy_row *row)
{
    cJSON *o = cJSON_CreateObject();
    bool closed = row->engine == KD_ENGINE_CLOSED;
    cJSON_AddStringToObject(o, "engine", kd_engine_name(row->engine));
    cJSON_AddStringToObject(o, "precision", kd_precision_name(row->precision));
    cJSON_AddNumberToObject(o, "steps", row->steps);
    add_figure(o, "holds", kd_accuracy_holds(row)); /* for readers; derived from the rest */
    cJSON *sets = cJSON_AddObjectToObject(o, "sets");
    for (int k = 0; k < KD_ACCURACY_SETS; k++)
        if (row->sets[k].rays)
            add_entry(sets, kd_accuracy_set_names[k], &row->sets[k], closed ? 1 : table->cores);
    return o;
}

enum kd_status kd_accuracy_to_json(const struct kd_accuracy_table *table, struct kd_buffer *out)
{
    cJSON *root = cJSON_CreateObject();
    cJSON_AddNumberToObject(root, "format", FORMAT);
    cJSON_AddStringToObject(root, "kerrd", table->version);
    cJSON_AddStringToObject(root, "date", table->date);
    cJSON_AddStringToObject(root, "command", table->command);
    cJSON_AddStringToObject(root, "machine", table->machine);
    cJSON_AddStringToObject(root, "device", table->device);
    cJSON_AddNumberToObject(root, "cores", table->cores);
    cJSON_AddStringToObject(root, "clock", table->device_clock ? "device" : "host");
    cJSON_AddBoolToObject(root, "quick", table->quick);
    add_figure(root, "seconds", table->seconds);
    cJSON_AddStringToObject(root, "skipped", table->skipped);
    cJSON_AddStringToObject(root, "reference", kd_engine_name(KD_ENGINE_CLOSED));
    cJSON_AddNumberToObject(root, "orders", KD_ACCURACY_ORDERS);
    cJSON_AddNumberToObject(root, "safety", KD_ACCURACY_SAFETY);
    cJSON *sets = cJSON_AddObjectToObject(root, "sets");
    for (int k = 0; k < KD_ACCURACY_SETS; k++)
        cJSON_AddStringToObject(sets, kd_accuracy_set_names[k], kd_accuracy_set_rays[k]);
    cJSON *rows = cJSON_AddArrayToObject(root, "rows");
    for (uint32_t i = 0; i < table->n; i++)
        cJSON_AddItemToArray(rows, row_to_json(table, &table->rows[i]));
    char *text = root ? cJSON_Print(root) : NULL;
    enum kd_status status = text ? kd_buffer_printf(out, "%s\n", text) : KD_ENOMEM;
    cJSON_free(text);
    cJSON_Delete(root);
    return status;
}

static double figure(const cJSON *object, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* Whole numbers of the document; what is none, or too large, is UINT32_MAX, which no reader of it accepts. */
static uint32_t whole(const cJSON *object, const char *name)
{
    double value = figure(object, name);
    return value >= 0 && value <= 1e9 && value == floor(value) ? (uint32_t)value : UINT32_MAX;
}

static bool text_of(const cJSON *object, const char *name, char *out, size_t size)
{
    const char *text = cJSON_GetStringValue(cJSON_GetObjectItemCaseSensitive(object, name));
    if (text)
        snprintf(out, size, "%s", text);
    return text;
}

static bool entry_from_json(const cJSON *o, struct kd_accuracy_entry *e)
{
    e->rays_per_s = figure(o, "rays_per_s");
    e->rays = whole(o, "rays");
    e->crossings = whole(o, "crossings");
    e->differ = whole(o, "differ");
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
        const cJSON *errors = cJSON_GetObjectItemCaseSensitive(o, kd_accuracy_quantity_names[q]);
        e->of[q] = (struct kd_accuracy_errors) { figure(errors, "median"), figure(errors, "p99"), figure(errors, "worst") };
    }
    return e->rays < UINT32_MAX && e->crossings < UINT32_MAX && e->differ <= e->rays;
}

static bool row_from_json(const cJSON *o, struct kd_accuracy_row *row)
{
    char engine[16], precision[8];
    int found = KD_ENGINE_COUNT;
    if (!text_of(o, "engine", engine, sizeof engine) || !text_of(o, "precision", precision, sizeof precision))
        return false;
    while (found-- && strcmp(engine, kd_engine_name((enum kd_engine)found)))
        ;
    bool wide = !strcmp(precision, kd_precision_name(KD_PRECISION_F64));
    if (found < 0 || (!wide && strcmp(precision, kd_precision_name(KD_PRECISION_F32))))
        return false;
    *row = (struct kd_accuracy_row) { (enum kd_engine)found, wide ? KD_PRECISION_F64 : KD_PRECISION_F32, whole(o, "steps"), { { 0 } } };
    const cJSON *sets = cJSON_GetObjectItemCaseSensitive(o, "sets");
    for (int k = 0; k < KD_ACCURACY_SETS; k++) {
        const cJSON *entry = cJSON_GetObjectItemCaseSensitive(sets, kd_accuracy_set_names[k]);
        if (entry && !entry_from_json(entry, &row->sets[k]))
            return false;
    }
    return row->steps < UINT32_MAX;
}

static bool head_from_json(const cJSON *root, struct kd_accuracy_table *t)
{
    char clock[8];
    bool good = whole(root, "format") == FORMAT && text_of(root, "kerrd", t->version, sizeof t->version) &&
                text_of(root, "date", t->date, sizeof t->date) && text_of(root, "command", t->command, sizeof t->command) &&
                text_of(root, "machine", t->machine, sizeof t->machine) &&
                text_of(root, "device", t->device, sizeof t->device) && text_of(root, "clock", clock, sizeof clock) &&
                text_of(root, "skipped", t->skipped, sizeof t->skipped);
    if (!good)
        return false;
    t->cores = whole(root, "cores");
    t->device_clock = !strcmp(clock, "device");
    t->quick = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(root, "quick"));
    t->seconds = figure(root, "seconds");
    return t->cores < UINT32_MAX;
}

enum kd_status kd_accuracy_from_json(const char *text, size_t length, struct kd_accuracy_table *out,
                                     struct kd_error *error)
{
    cJSON *root = cJSON_ParseWithLength(text, length);
    *out = (struct kd_accuracy_table) { 0 };
    bool good = head_from_json(root, out);
    const cJSON *item, *rows = cJSON_GetObjectItemCaseSensitive(root, "rows");
    cJSON_ArrayForEach(item, rows)
        good = good && out->n < KD_ACCURACY_ROWS && row_from_json(item, &out->rows[out->n++]);
    cJSON_Delete(root);
    return good && out->n ? KD_OK : kd_error_set(error, KD_EINVAL, "this is no accuracy table of format %d", FORMAT);
}

/* Writes the accuracy table as a JSON document, and reads it back. */
#include "render/accuracy/table.h"

#include "base/json.h"

#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FORMAT 1 /* version of the document; a table of another version is rejected */

/* Writes a number with four digits, because further digits vary from run to run. */
static void add_figure(struct kd_json *json, const char *name, double value)
{
    char text[32];
    if (!isfinite(value))
        return;
    snprintf(text, sizeof text, "%.4g", value);
    kd_json_number(json, name, strtod(text, NULL));
}

static void add_entry(struct kd_json *json, const char *name, const struct kd_accuracy_entry *e, uint32_t cores)
{
    kd_json_object(json, name);
    add_figure(json, "rays_per_s", e->rays_per_s);
    if (cores)
        add_figure(json, "rays_per_s_per_core", e->rays_per_s / cores);
    kd_json_number(json, "rays", e->rays);
    kd_json_number(json, "crossings", e->crossings);
    kd_json_number(json, "differ", e->differ);
    for (int q = 0; q < KD_ACCURACY_QUANTITIES; q++) {
        if (!isfinite(e->of[q].median))
            continue;
        kd_json_object(json, kd_accuracy_quantity_names[q]);
        add_figure(json, "median", e->of[q].median);
        add_figure(json, "p99", e->of[q].p99);
        add_figure(json, "worst", e->of[q].worst);
        kd_json_end(json);
    }
    kd_json_end(json);
}

static void add_row(struct kd_json *json, const struct kd_accuracy_table *table, const struct kd_accuracy_row *row)
{
    bool closed = row->engine == KD_ENGINE_CLOSED;
    kd_json_object(json, NULL);
    kd_json_string(json, "engine", kd_engine_name(row->engine));
    kd_json_string(json, "precision", kd_precision_name(row->precision));
    kd_json_number(json, "steps", row->steps);
    /* for human readers only; computed from the row's other numbers */
    add_figure(json, "holds", kd_accuracy_holds(row));
    kd_json_object(json, "sets");
    for (int k = 0; k < KD_ACCURACY_SETS; k++)
        if (row->sets[k].rays)
            add_entry(json, kd_accuracy_set_names[k], &row->sets[k], closed ? 1 : table->cores);
    kd_json_end(json);
    kd_json_end(json);
}

enum kd_status kd_accuracy_to_json(const struct kd_accuracy_table *table, struct kd_buffer *out)
{
    struct kd_json whole = kd_json_begin_lines(out), *json = &whole;
    kd_json_object(json, NULL);
    kd_json_number(json, "format", FORMAT);
    kd_json_string(json, "kerrd", table->version);
    kd_json_string(json, "date", table->date);
    kd_json_string(json, "command", table->command);
    kd_json_string(json, "machine", table->machine);
    kd_json_string(json, "device", table->device);
    kd_json_number(json, "cores", table->cores);
    kd_json_string(json, "clock", table->device_clock ? "device" : "host");
    kd_json_bool(json, "quick", table->quick);
    add_figure(json, "seconds", table->seconds);
    kd_json_string(json, "skipped", table->skipped);
    kd_json_string(json, "reference", kd_engine_name(KD_ENGINE_CLOSED));
    kd_json_number(json, "orders", KD_ACCURACY_ORDERS);
    kd_json_number(json, "quantile", 0.99); /* "holds" is this quantile of the bulk set's errors */
    kd_json_object(json, "sets");
    for (int k = 0; k < KD_ACCURACY_SETS; k++)
        kd_json_string(json, kd_accuracy_set_names[k], kd_accuracy_set_rays[k]);
    kd_json_end(json);
    kd_json_array(json, "rows");
    for (uint32_t i = 0; i < table->n; i++)
        add_row(json, table, &table->rows[i]);
    kd_json_end(json);
    kd_json_end(json);
    return kd_json_finish_line(json);
}

static double figure(const cJSON *object, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, name);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* Reads a whole number of the document. Any other value, and a number that is too large, becomes UINT32_MAX, which
 * every caller rejects. */
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
        e->of[q] =
            (struct kd_accuracy_errors) { figure(errors, "median"), figure(errors, "p99"), figure(errors, "worst") };
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
    *row = (struct kd_accuracy_row) {
        (enum kd_engine)found, wide ? KD_PRECISION_F64 : KD_PRECISION_F32, whole(o, "steps"), { { 0 } }
    };
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
                text_of(root, "date", t->date, sizeof t->date) &&
                text_of(root, "command", t->command, sizeof t->command) &&
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
    cJSON_ArrayForEach(item, rows) good =
        good && out->n < KD_ACCURACY_ROWS && row_from_json(item, &out->rows[out->n++]);
    cJSON_Delete(root);
    return good && out->n ? KD_OK
                          : kd_error_set(error, KD_EINVAL, "this is not an accuracy table of format %d", FORMAT);
}

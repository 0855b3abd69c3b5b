#include "render/plan.h"

#include <cJSON.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static cJSON *pass_json(const struct kd_plan_pass *pass)
{
    cJSON *o = cJSON_CreateObject();
    cJSON_AddStringToObject(o, "name", pass->name);
    if (*pass->kernel)
        cJSON_AddStringToObject(o, "kernel", pass->kernel);
    cJSON_AddNumberToObject(o, "invocations", (double)pass->invocations);
    cJSON_AddNumberToObject(o, "estimate_ms", pass->estimate_ms);
    return o;
}

static void add_constants(cJSON *root, const struct kd_plan *plan)
{
    cJSON *o = cJSON_AddObjectToObject(root, "specialisation");
    cJSON_AddNumberToObject(o, "orders", plan->orders);
    cJSON_AddNumberToObject(o, "steps", plan->setting.steps);
    cJSON_AddNumberToObject(o, "samples", plan->side);
    cJSON_AddBoolToObject(o, "radius_only", plan->path == KD_LENS_RADIUS);
    cJSON_AddBoolToObject(o, "phi", plan->phi);
    cJSON_AddBoolToObject(o, "sky", plan->sky);
}

static void add_accuracy(cJSON *root, const struct kd_plan *plan)
{
    const struct kd_setting *by = &plan->setting;
    cJSON *o = cJSON_AddObjectToObject(root, "accuracy");
    cJSON_AddStringToObject(o, "engine", kd_engine_name(by->engine));
    cJSON_AddStringToObject(o, "precision", kd_precision_name(by->precision));
    cJSON_AddNumberToObject(o, "steps", by->steps);
    if (isfinite(by->holds))
        cJSON_AddNumberToObject(o, "holds", by->holds);
    cJSON_AddStringToObject(o, "table", plan->accuracy_measured ? "measured" : "built-in");
}

enum kd_status kd_plan_to_json(const struct kd_plan *plan, struct kd_buffer *out)
{
    cJSON *root = cJSON_CreateObject();
    cJSON_AddNumberToObject(root, "rays", (double)plan->rays);
    cJSON_AddNumberToObject(root, "critical_pixels", (double)plan->critical_pixels);
    cJSON_AddNumberToObject(root, "critical_rays", (double)(kd_plan_rays(plan) - plan->rays));
    cJSON_AddNumberToObject(root, "width", plan->width);
    cJSON_AddNumberToObject(root, "height", plan->height);
    cJSON *list = cJSON_AddArrayToObject(root, "passes");
    for (size_t i = 0; i < plan->n_passes; i++)
        cJSON_AddItemToArray(list, pass_json(&plan->passes[i]));
    add_constants(root, plan);
    add_accuracy(root, plan);
    cJSON *bytes = cJSON_AddObjectToObject(root, "bytes");
    cJSON_AddNumberToObject(bytes, "lens_map", (double)plan->lens_bytes);
    cJSON_AddNumberToObject(bytes, "device", (double)plan->device_bytes);
    cJSON_AddNumberToObject(bytes, "host", (double)plan->host_bytes);
    cJSON_AddNumberToObject(root, "bands", plan->bands);
    cJSON_AddBoolToObject(root, "lens_map_cacheable", plan->cacheable);
    cJSON_AddStringToObject(root, "lens_map_key", plan->lens_key);
    cJSON_AddNumberToObject(root, "estimate_ms", plan->estimate_ms);
    cJSON_AddStringToObject(root, "estimate_basis", plan->measured ? "measured" : "guess");
    list = cJSON_AddArrayToObject(root, "approximations");
    for (size_t i = 0; i < plan->n_approximations; i++)
        cJSON_AddItemToArray(list, cJSON_CreateString(plan->approximations[i]));

    char *text = root ? cJSON_Print(root) : NULL;
    enum kd_status status = text ? kd_buffer_append(out, text, strlen(text)) : KD_ENOMEM;
    cJSON_free(text);
    cJSON_Delete(root);
    return status;
}

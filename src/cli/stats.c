#include "cli/stats.h"

#include <cJSON.h>

/* The scene's own words for its accuracy, and what the plan makes of them. */
static void add_accuracy(cJSON *root, const struct kd_stats *stats)
{
    struct kd_buffer text = { 0 };
    cJSON *scene = kd_scene_to_json(stats->scene, &text) ? NULL : cJSON_Parse((const char *)text.data);
    cJSON *accuracy = cJSON_DetachItemFromObjectCaseSensitive(scene, "accuracy");
    if (!accuracy)
        accuracy = cJSON_CreateObject();
    /* What the scene's words come to takes their place. */
    const struct kd_setting *by = &stats->plan->setting;
    cJSON_ReplaceItemInObjectCaseSensitive(accuracy, "engine", cJSON_CreateString(kd_engine_name(by->engine)));
    cJSON_ReplaceItemInObjectCaseSensitive(accuracy, "precision", cJSON_CreateString(kd_precision_name(by->precision)));
    cJSON_ReplaceItemInObjectCaseSensitive(accuracy, "steps", cJSON_CreateNumber(by->steps)); /* 0: the closed form */
    const struct kd_accuracy_report *report = &stats->frame->accuracy;
    cJSON_AddNumberToObject(accuracy, "undecided", (double)report->undecided);
    cJSON_AddNumberToObject(accuracy, "sampled", report->sampled);
    if (report->sampled) {
        cJSON_AddNumberToObject(accuracy, "crossings", report->crossings);
        cJSON_AddNumberToObject(accuracy, "differ", report->differ);
        cJSON_AddNumberToObject(accuracy, "radius_error_median", report->median);
        cJSON_AddNumberToObject(accuracy, "radius_error_worst", report->worst);
    }
    cJSON_AddItemToObject(root, "accuracy", accuracy);
    cJSON_Delete(scene);
    kd_buffer_finish(&text);
}

static void add_times(cJSON *root, const struct kd_stats *stats)
{
    cJSON *times = cJSON_AddObjectToObject(root, "device_ms");
    for (size_t i = 0; i < stats->frame->n_timings; i++)
        cJSON_AddNumberToObject(times, stats->frame->timings[i].name, stats->frame->timings[i].ms);
    cJSON_AddNumberToObject(root, "render_ms", stats->render_ms);
    cJSON_AddNumberToObject(root, "encode_ms", stats->encode_ms);
    cJSON_AddNumberToObject(root, "estimate_ms", stats->plan->estimate_ms);
}

char *kd_stats_json(const struct kd_stats *stats)
{
    char hash[65] = "";
    if (kd_scene_hash(stats->scene, hash))
        return NULL;
    cJSON *root = cJSON_CreateObject();
    cJSON_AddStringToObject(root, "kerrd", KD_VERSION);
    cJSON_AddStringToObject(root, "device", stats->device);
    cJSON_AddStringToObject(root, "hash", hash);
    cJSON_AddNumberToObject(root, "width", stats->frame->width);
    cJSON_AddNumberToObject(root, "height", stats->frame->height);
    cJSON_AddNumberToObject(root, "rays", (double)stats->plan->rays);
    cJSON_AddNumberToObject(root, "critical_rays", (double)(kd_plan_rays(stats->plan) - stats->plan->rays));
    cJSON_AddNumberToObject(root, "exposure", stats->frame->exposure);
    cJSON_AddNumberToObject(root, "bytes", (double)stats->bytes);
    add_times(root, stats);
    add_accuracy(root, stats);
    cJSON *list = cJSON_AddArrayToObject(root, "approximations");
    for (size_t i = 0; i < stats->plan->n_approximations; i++)
        cJSON_AddItemToArray(list, cJSON_CreateString(stats->plan->approximations[i]));
    char *text = cJSON_PrintUnformatted(root);
    cJSON_Delete(root);
    return text;
}

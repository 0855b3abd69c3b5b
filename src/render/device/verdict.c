#include "render/device/verdict.h"

#include "base/json.h"
#include "base/log.h"
#include "base/replace.h"
#include "render/device/device_internal.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FORMAT 1
#define FILE_MAX 4096

const char *kd_verdict_word(const struct kd_verdict *verdict)
{
    return verdict->result == KD_PASSED ? "passed" : verdict->result == KD_FAILED ? "failed" : "not run";
}

const struct kd_verdict *kd_renderer_verdict(const struct kd_renderer *r) { return &r->verdict; }

/* Identifies the device, driver and kerrd that a verdict is for. */
static void name_of(const struct kd_renderer *r, char *out, size_t size)
{
    const struct kd_vk_info *info = kd_vk_info(r->vk);
    size_t used = 0;
    for (size_t i = 0; i < sizeof info->uuid; i++)
        used += (size_t)snprintf(out + used, size - used, "%02x", info->uuid[i]);
    snprintf(out + used, size - used, " %s, %s %s %u, kerrd " KD_VERSION, info->name, info->driver, info->driver_info,
             info->driver_version);
}

void kd_verdict_save(const struct kd_renderer *r, struct kd_capacity capacity)
{
    const struct kd_verdict *s = &r->verdict;
    char name[1024], *path = kd_vk_cache_file(r->vk, ".selftest.json");
    struct kd_buffer text = { 0 };
    struct kd_json whole = kd_json_begin_lines(&text), *json = &whole;
    name_of(r, name, sizeof name);
    kd_json_object(json, NULL);
    kd_json_number(json, "format", FORMAT);
    kd_json_string(json, "of", name);
    kd_json_number(json, "checks", s->checks);
    kd_json_number(json, "seconds", s->seconds);
    kd_json_object(json, "ns_per_item");
    for (int i = 0; i < KD_FIGURE_COUNT && capacity.measured; i++)
        kd_json_number(json, kd_figures[i].word, capacity.ns[i]);
    kd_json_end(json);
    kd_json_end(json);
    if (path && !kd_json_finish_line(json) && !kd_replace_file(path, text.data, text.size))
        kd_log(KD_LOG_DEBUG, "cannot write %s: %s", path, strerror(errno));
    kd_buffer_finish(&text);
    free(path);
}

/* Reads the text of a file. A file for another device, driver or version is ignored. */
static void understand(struct kd_renderer *r, const char *text, size_t size)
{
    struct kd_capacity *c = &r->capacity;
    char name[1024];
    cJSON *root = cJSON_ParseWithLength(text, size);
    const cJSON *format = cJSON_GetObjectItemCaseSensitive(root, "format"),
                *of = cJSON_GetObjectItemCaseSensitive(root, "of");
    const cJSON *checks = cJSON_GetObjectItemCaseSensitive(root, "checks");
    const cJSON *seconds = cJSON_GetObjectItemCaseSensitive(root, "seconds");
    const cJSON *speed = cJSON_GetObjectItemCaseSensitive(root, "ns_per_item");
    name_of(r, name, sizeof name);
    bool known = cJSON_IsNumber(format) && format->valuedouble == FORMAT && cJSON_IsString(of) &&
                 !strcmp(of->valuestring, name) && cJSON_IsNumber(checks) && checks->valuedouble >= 1 &&
                 checks->valuedouble < 1e6 && cJSON_IsNumber(seconds);
    if (known)
        r->verdict =
            (struct kd_verdict) { KD_PASSED, false, (unsigned)checks->valuedouble, 0, seconds->valuedouble, "" };
    for (int i = 0; i < KD_FIGURE_COUNT && known; i++) {
        const cJSON *ns = cJSON_GetObjectItemCaseSensitive(speed, kd_figures[i].word);
        if (cJSON_IsNumber(ns) && ns->valuedouble > 1e-6 && ns->valuedouble < 1e9)
            c->ns[i] = ns->valuedouble;
        else
            speed = NULL; /* all later figures are ignored too, so that these passes keep their default costs */
    }
    c->measured = known && speed;
    cJSON_Delete(root);
}

void kd_verdict_recall(struct kd_renderer *r)
{
    char text[FILE_MAX], *path = kd_vk_cache_file(r->vk, ".selftest.json");
    FILE *file = path ? fopen(path, "re") : NULL;
    size_t n = file ? fread(text, 1, sizeof text, file) : 0;
    if (file)
        fclose(file);
    free(path);
    if (n)
        understand(r, text, n);
    r->stored = r->capacity;
}

/* True if a figure has changed so much that the file must be written again. */
static bool differs(double a, double b) { return !(a < 1.25 * b && b < 1.25 * a); }

void kd_verdict_keep(struct kd_renderer *r)
{
    struct kd_capacity capacity;
    bool changed = false;
    kd_renderer_capacity(r, &capacity);
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        changed |= differs(capacity.ns[i], r->stored.ns[i]);
    if (r->verdict.result == KD_PASSED && capacity.measured && changed)
        kd_verdict_save(r, capacity);
}

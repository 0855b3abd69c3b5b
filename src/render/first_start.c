#include "render/first_start.h"

#include "base/json.h"
#include "base/log.h"
#include "base/replace.h"
#include "render/internal.h"
#include "render/selftest.h"

#include <cjson/cJSON.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FORMAT 1
#define FILE_MAX 4096

const char *kd_first_start_word(const struct kd_first_start *start)
{
    return start->verdict == KD_PASSED ? "passed" : start->verdict == KD_FAILED ? "failed" : "not run";
}

const struct kd_first_start *kd_renderer_first_start(const struct kd_renderer *r) { return &r->first_start; }

/* Which device, driver and kerrd a verdict is for. */
static void name_of(const struct kd_renderer *r, char *out, size_t size)
{
    const struct kd_vk_info *info = kd_vk_info(r->vk);
    size_t used = 0;
    for (size_t i = 0; i < sizeof info->uuid; i++)
        used += (size_t)snprintf(out + used, size - used, "%02x", info->uuid[i]);
    snprintf(out + used, size - used, " %s, %s %s %u, kerrd " KD_VERSION, info->name, info->driver, info->driver_info,
             info->driver_version);
}

/* The figures of a capacity, by the names that /v1/device has for them. */
static const struct figure { const char *name; size_t at; } figures[] = {
    { "ray_radius", offsetof(struct kd_capacity, ns_per_ray_radius) },
    { "ray_full", offsetof(struct kd_capacity, ns_per_ray_full) },
    { "sample_transfer", offsetof(struct kd_capacity, ns_per_sample_transfer) },
    { "pixel_post", offsetof(struct kd_capacity, ns_per_pixel_post) },
    { "particle", offsetof(struct kd_capacity, ns_per_particle) },
};
enum { FIGURES = sizeof figures / sizeof *figures };

static double *figure(struct kd_capacity *c, int i) { return (double *)((char *)c + figures[i].at); }

static void save(const struct kd_renderer *r, struct kd_capacity capacity)
{
    const struct kd_first_start *s = &r->first_start;
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
    for (int i = 0; i < FIGURES && capacity.measured; i++)
        kd_json_number(json, figures[i].name, *figure(&capacity, i));
    kd_json_end(json);
    kd_json_end(json);
    if (path && !kd_json_finish_line(json) && !kd_replace_file(path, text.data, text.size))
        kd_log(KD_LOG_DEBUG, "cannot write %s: %s", path, strerror(errno));
    kd_buffer_finish(&text);
    free(path);
}

/* What a file says of this very device, driver and version; anything else is as no file. */
static void understand(struct kd_renderer *r, const char *text, size_t size)
{
    struct kd_capacity *c = &r->capacity;
    char name[1024];
    cJSON *root = cJSON_ParseWithLength(text, size);
    const cJSON *format = cJSON_GetObjectItemCaseSensitive(root, "format"), *of = cJSON_GetObjectItemCaseSensitive(root, "of");
    const cJSON *checks = cJSON_GetObjectItemCaseSensitive(root, "checks");
    const cJSON *seconds = cJSON_GetObjectItemCaseSensitive(root, "seconds");
    const cJSON *speed = cJSON_GetObjectItemCaseSensitive(root, "ns_per_item");
    name_of(r, name, sizeof name);
    bool known = cJSON_IsNumber(format) && format->valuedouble == FORMAT && cJSON_IsString(of) && !strcmp(of->valuestring, name) &&
                 cJSON_IsNumber(checks) && checks->valuedouble >= 1 && checks->valuedouble < 1e6 && cJSON_IsNumber(seconds);
    if (known)
        r->first_start = (struct kd_first_start) { KD_PASSED, false, (unsigned)checks->valuedouble, 0, seconds->valuedouble, "" };
    for (int i = 0; i < FIGURES && known; i++) {
        const cJSON *ns = cJSON_GetObjectItemCaseSensitive(speed, figures[i].name);
        if (cJSON_IsNumber(ns) && ns->valuedouble > 1e-6 && ns->valuedouble < 1e9)
            *figure(c, i) = ns->valuedouble;
        else
            speed = NULL; /* and what follows stays a guess */
    }
    c->measured = known && speed;
    cJSON_Delete(root);
}

static bool judge(void *user, const struct kd_selftest_row *row)
{
    struct kd_first_start *s = user;
    s->checks++;
    if (!row->ok && !s->failed++)
        snprintf(s->worst, sizeof s->worst, "%s, by %s: error %.2g, allowed %.2g", row->what, row->by, row->error, row->bound);
    return true;
}

static void restore(struct kd_renderer *r, const struct kd_capacity *capacity)
{
    pthread_mutex_lock(&r->lock);
    r->capacity = *capacity;
    pthread_mutex_unlock(&r->lock);
}

/* What a ray and a pixel cost here, instead of what devices of this type are guessed to cost: the least of some small pictures, since
 * a driver may make a kernel when it first runs, and a busy machine adds to any of them. */
static enum kd_status measure(struct kd_renderer *r, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    struct kd_capacity *c = &r->capacity;
    const struct kd_capacity guess = *c;
    for (int i = 0; i < FIGURES; i++)
        *figure(c, i) = INFINITY;
    r->probing = true;
    for (int k = 0; k < 8 && !status; k++) {
        struct kd_scene scene;
        struct kd_plan plan;
        struct kd_frame frame = { 0 };
        kd_scene_defaults(&scene);
        scene.image.width = 256;
        scene.image.height = 144 + k; /* another lens map */
        scene.camera.r = k < 4 ? INFINITY : 30;
        status = kd_plan_make(&scene, &guess, &plan, error);
        if (!status)
            status = kd_render(r, &scene, &plan, NULL, NULL, &frame, error);
        kd_frame_finish(&frame);
    }
    r->probing = false;
    for (int i = 0; i < FIGURES; i++) /* that of particles, and all without timestamps */
        *figure(c, i) = isfinite(*figure(c, i)) ? *figure(c, i) : *figure((struct kd_capacity *)&guess, i);
    return status;
}

static void tell(const struct kd_renderer *r, enum kd_status status, const struct kd_error *why)
{
    const struct kd_first_start *s = &r->first_start;
    if (status)
        kd_log(KD_LOG_ERROR, "the self-test of %s could not be made: %s", r->name, why->message);
    else if (s->failed)
        kd_log(KD_LOG_ERROR, "%u of %u checks of the self-test FAILED on %s: what it computes may be wrong (%s); `kerrd doctor "
               "--selftest` shows all of them", s->failed, s->checks, r->name, s->worst);
    else
        kd_log(KD_LOG_INFO, "the self-test passed on %s, its first start here: %u checks in %.1f s", r->name, s->checks, s->seconds);
}

enum kd_status kd_first_start(struct kd_renderer *r, struct kd_error *error)
{
    struct kd_first_start *s = &r->first_start;
    if (s->verdict == KD_PASSED)
        return KD_OK;
    struct kd_error why = { 0 };
    const struct kd_capacity before = r->capacity; /* the self-test's pictures are too small to learn from */
    double begun = kd_render_now_ms();
    *s = (struct kd_first_start) { .now = true };
    enum kd_status status = kd_selftest_run(r, &kd_selftest_reference, judge, s, &why);
    s->seconds = 1e-3 * (kd_render_now_ms() - begun);
    restore(r, &before);
    s->verdict = status || !s->checks ? KD_UNTESTED : s->failed ? KD_FAILED : KD_PASSED;
    if (status != KD_EDEVICE)
        tell(r, status, &why);
    if (!status)
        status = measure(r, &why);
    if (status == KD_EDEVICE)
        return kd_error_set(error, status, "%s", why.message);
    if (s->verdict == KD_PASSED)
        save(r, r->capacity);
    return KD_OK;
}

void kd_first_start_recall(struct kd_renderer *r)
{
    char text[FILE_MAX], *path = kd_vk_cache_file(r->vk, ".selftest.json");
    FILE *file = path ? fopen(path, "re") : NULL;
    size_t n = file ? fread(text, 1, sizeof text, file) : 0;
    if (file)
        fclose(file);
    free(path);
    if (n)
        understand(r, text, n);
    r->kept = r->capacity;
}

/* A figure that has changed by less is not worth a write. */
static bool differs(double a, double b) { return !(a < 1.25 * b && b < 1.25 * a); }

void kd_first_start_keep(struct kd_renderer *r)
{
    struct kd_capacity capacity;
    bool changed = false;
    kd_renderer_capacity(r, &capacity);
    for (int i = 0; i < FIGURES; i++)
        changed |= differs(*figure(&capacity, i), *figure(&r->kept, i));
    if (r->first_start.verdict == KD_PASSED && capacity.measured && changed)
        save(r, capacity);
}

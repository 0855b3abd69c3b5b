#include "render/device/device_internal.h"

#include "base/json.h"
#include "render/device/accuracy_store.h"
#include "base/clock.h"
#include "render/device/prepare.h"
#include "base/cores.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Device memory for pictures: three quarters of the heap, or the driver's budget for this process if that is less. */
static uint64_t free_bytes(const struct kd_vk_info *info)
{
    uint64_t share = info->heap_bytes / 4 * 3;
    return info->budget_bytes && info->budget_bytes < share ? info->budget_bytes : share;
}

/* Costs that are used until some were measured: the order of magnitude per item on this type of device. */
static struct kd_capacity guess(const struct kd_vk_info *info, uint64_t memory_bytes)
{
    uint64_t device = free_bytes(info), given = kd_memory_main(memory_bytes);
    bool narrower = memory_bytes && given < device;
    double scale = info->type == KD_VK_CPU ? 1 : info->type == KD_VK_DISCRETE ? 0.005 : 0.05;
    struct kd_capacity c = {
        .max_binding_bytes = info->max_binding_bytes,
        .max_allocation_bytes = info->max_allocation_bytes,
        .max_groups_x = info->max_groups_x,
        .max_groups_y = info->max_groups_y,
        .memory_bytes = narrower ? given : device,
        .memory_by = narrower ? "--memory" : NULL,
        .host_memory = info->type == KD_VK_CPU || info->type == KD_VK_INTEGRATED,
        .float64 = info->float64,
        .cores = kd_cores(),
    };
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        c.ns[i] = kd_figures[i].guess * scale;
    return c;
}

/* Loads the table in which tolerances are looked up: the device's own table if it exists and can be read. */
static void load_accuracy(struct kd_renderer *r)
{
    char *path = kd_accuracy_path(r);
    struct kd_accuracy_table *table = malloc(sizeof *table);
    if (table && !kd_accuracy_load(path, table, NULL))
        r->accuracy = table;
    else
        free(table);
    free(path);
    r->capacity.accuracy = r->accuracy ? r->accuracy : kd_accuracy_built_in();
    r->capacity.accuracy_measured = r->accuracy;
}

/* Path of the Milky Way's file in the folder of the driver's cache. All devices share the file. */
static char *milky_way_file(const struct kd_vk *vk)
{
    char *own = kd_vk_cache_file(vk, ""), *slash = own ? strrchr(own, '/') : NULL, *out = NULL;
    if (slash && asprintf(&out, "%.*s/milky-way", (int)(slash - own), own) < 0)
        out = NULL;
    free(own);
    return out;
}

static enum kd_status open_device(struct kd_renderer *r, struct kd_error *error)
{
    const struct kd_vk_params vk = { .device = r->opening.device,
                                     .cache_dir = r->opening.cache_dir,
                                     .validate = r->opening.validate,
                                     .compiles_only = r->opening.compiles_only,
                                     .deadline_ms = r->opening.deadline_ms };
    enum kd_status status = kd_vk_create(&vk, &r->vk, error);
    if (status)
        return status;
    r->store.vk = r->vk;
    for (size_t i = 0; i < KD_BACKGROUND_RENDERS; i++)
        r->background_renders[i].store.vk = r->vk;
    return KD_OK;
}

/* Closes the device. Everything on the device is lost with it. */
static void close_device(struct kd_renderer *r)
{
    if (!r->vk)
        return;
    kd_kernels_finish(&r->kernels, r->vk);
    kd_store_empty(&r->store);
    kd_prepared_finish(&r->prepared, r->vk);
    for (size_t i = 0; i < KD_BACKGROUND_RENDERS; i++) {
        kd_store_empty(&r->background_renders[i].store);
        kd_prepared_finish(&r->background_renders[i].prepared, r->vk);
    }
    for (size_t i = 0; i < sizeof r->rays / sizeof **r->rays; i++)
        kd_vk_buffer_destroy(r->vk, r->rays[i / 3][i % 3]);
    memset(r->rays, 0, sizeof r->rays);
    kd_vk_destroy(r->vk);
    r->vk = NULL;
}

static bool remember_opening(struct kd_renderer *r, const struct kd_renderer_params *params)
{
    r->opening = (struct kd_opening) { .validate = params->validate,
                                       .compiles_only = params->compiles_only,
                                       .deadline_ms = params->deadline_ms };
    return (!params->device || (r->opening.device = strdup(params->device))) &&
           (!params->cache_dir || (r->opening.cache_dir = strdup(params->cache_dir)));
}

enum kd_status kd_renderer_create(const struct kd_renderer_params *params, struct kd_renderer **out,
                                  struct kd_error *error)
{
    struct kd_renderer *r = calloc(1, sizeof *r);
    struct kd_emit_state *emit = calloc(1, sizeof *emit);
    if (!r || !emit) {
        free(r);
        free(emit);
        return kd_error_set(error, KD_ENOMEM, "out of memory for the renderer");
    }
    r->emit = emit;
    r->passing = params->passing;
    r->lacks = params->lacks;
    r->lacks_user = params->lacks_user;
    pthread_mutex_init(&r->lock, NULL);
    kd_panoramas_init(&r->panoramas, params->assets, params->asset_read, params->asset_read_user);
    kd_grids_init(&r->grids, params->assets, params->asset_read, params->asset_read_user);
    r->panoramas.blank = r->grids.blank = params->compiles_only;
    enum kd_status status = remember_opening(r, params)
                                ? open_device(r, error)
                                : kd_error_set(error, KD_ENOMEM, "out of memory for the renderer");
    if (status) {
        kd_renderer_destroy(r);
        return status;
    }
    kd_panoramas_keep_at(&r->panoramas, milky_way_file(r->vk));
    const struct kd_vk_info *info = kd_vk_info(r->vk);
    r->opened = *info;
    r->files = kd_vk_cache_file(r->vk, "");
    r->capacity = guess(info, params->memory_bytes);
    load_accuracy(r);
    if (!r->capacity.accuracy) {
        kd_renderer_destroy(r);
        return kd_error_set(error, KD_ENOMEM, "out of memory for the accuracy table");
    }
    snprintf(r->device, sizeof r->device, "%s", info->name);
    snprintf(r->driver, sizeof r->driver, "%s%s%s", info->driver, *info->driver_info ? " " : "", info->driver_info);
    snprintf(r->name, sizeof r->name, "%s, %s", r->device, r->driver);
    kd_verdict_recall(r);
    status = params->prove ? params->prove(r, error) : KD_OK;
    if (status) {
        kd_renderer_destroy(r);
        return status;
    }
    kd_renderer_begin_count(r);
    *out = r;
    return KD_OK;
}

void kd_renderer_destroy(struct kd_renderer *renderer)
{
    if (!renderer)
        return;
    if (renderer->vk && !kd_vk_wait(renderer->vk, 0, NULL) && !renderer->passing)
        kd_verdict_keep(renderer);
    close_device(renderer);
    free(renderer->opening.device);
    free(renderer->opening.cache_dir);
    free(renderer->files);
    pthread_mutex_destroy(&renderer->lock);
    free(renderer->accuracy);
    free(renderer->emit);
    kd_panoramas_finish(&renderer->panoramas);
    kd_grids_finish(&renderer->grids);
    free(renderer);
}

/* True if both descriptions are of the same device. A new driver version counts as another device, because pictures
 * and measured values may differ. */
static bool is_same(const struct kd_vk_info *a, const struct kd_vk_info *b)
{
    return !memcmp(a->uuid, b->uuid, sizeof a->uuid) && a->driver_version == b->driver_version &&
           !strcmp(a->name, b->name) && !strcmp(a->driver, b->driver);
}

bool kd_renderer_hangs(const struct kd_renderer *renderer) { return renderer->vk && kd_vk_hangs(renderer->vk); }

enum kd_status kd_renderer_reopen(struct kd_renderer *r, struct kd_error *error)
{
    /* If submitted work hangs, the device cannot be closed, and no second device is opened. */
    if (r->vk)
        kd_vk_wait(r->vk, 0, NULL);
    if (kd_renderer_hangs(r))
        return kd_error_set(error, KD_EDEVICE, "%s hangs: a submission missed its deadline", r->opened.name);
    close_device(r);
    enum kd_status status = open_device(r, error);
    if (status || is_same(kd_vk_info(r->vk), &r->opened))
        return status;
    kd_error_set(error, KD_EDEVICE, "the device %.200s is gone; %.200s has replaced it", r->opened.name,
                 kd_vk_info(r->vk)->name);
    close_device(r);
    return KD_EDEVICE;
}

bool kd_renderer_assets_begin(struct kd_renderer *renderer, const struct kd_scene *scene)
{
    const bool sky = *scene->sky.image && kd_panorama_begin(&renderer->panoramas, scene);
    return kd_grid_begin(&renderer->grids, scene) || sky;
}

void kd_renderer_sky_ahead(struct kd_renderer *renderer, const char *hash)
{
    kd_panorama_ahead(&renderer->panoramas, hash);
}

void kd_renderer_assets_stop(struct kd_renderer *renderer)
{
    kd_panoramas_stop(&renderer->panoramas);
    kd_grids_stop(&renderer->grids);
}

void kd_renderer_capacity(struct kd_renderer *renderer, struct kd_capacity *out)
{
    pthread_mutex_lock(&renderer->lock);
    *out = renderer->capacity;
    kd_memory_watch(&renderer->memory, kd_clock_ms());
    if (renderer->memory.known)
        kd_memory_narrow(out, &renderer->memory.limit, atomic_load(&renderer->held));
    pthread_mutex_unlock(&renderer->lock);
}

const char *kd_renderer_device_name(const struct kd_renderer *renderer) { return renderer->name; }

const char *kd_renderer_device(const struct kd_renderer *renderer) { return renderer->device; }

const char *kd_renderer_driver(const struct kd_renderer *renderer) { return renderer->driver; }

uint64_t kd_renderer_held(const struct kd_renderer *renderer) { return atomic_load(&renderer->held); }

char *kd_renderer_cache_file(const struct kd_renderer *renderer, const char *suffix)
{
    char *path = NULL;
    return renderer->files && asprintf(&path, "%s%s", renderer->files, suffix) >= 0 ? path : NULL;
}

uint32_t kd_renderer_validation_messages(const struct kd_renderer *renderer)
{
    return kd_vk_validation_messages(renderer->vk);
}

enum kd_status kd_renderer_device_json(struct kd_renderer *renderer, struct kd_buffer *out)
{
    const struct kd_vk_info *info = kd_vk_info(renderer->vk);
    struct kd_capacity c;
    char version[32];
    kd_renderer_capacity(renderer, &c);
    snprintf(version, sizeof version, "%u.%u.%u", info->api_version >> 22 & 0x7f, info->api_version >> 12 & 0x3ff,
             info->api_version & 0xfff);

    struct kd_json whole = kd_json_begin_lines(out), *json = &whole;
    kd_json_object(json, NULL);
    kd_json_string(json, "kerrd", KD_VERSION);
    kd_json_string(json, "name", info->name);
    kd_json_string(json, "type", kd_vk_type_name(info->type));
    kd_json_string(json, "driver", info->driver);
    kd_json_string(json, "driver_info", info->driver_info);
    kd_json_string(json, "vulkan", version);
    kd_json_number(json, "index", info->index);
    kd_json_string(json, "choice", kd_vk_choice(renderer->vk));
    kd_json_array(json, "precision");
    for (int p = KD_PRECISION_F32; p <= (info->float64 ? KD_PRECISION_F64 : KD_PRECISION_F32); p++)
        kd_json_string(json, NULL, kd_precision_name((enum kd_precision)p));
    kd_json_end(json);
    kd_json_bool(json, "float64_hardware", info->float64);
    kd_json_bool(json, "timestamps", info->timestamps);
    const struct kd_verdict *tested = &renderer->verdict;
    kd_json_object(json, "selftest");
    kd_json_string(json, "result", kd_verdict_word(tested));
    if (tested->result != KD_UNTESTED) {
        kd_json_number(json, "checks", tested->checks);
        kd_json_number(json, "failed", tested->failed);
        kd_json_number(json, "seconds", tested->seconds);
        kd_json_bool(json, "now", tested->now);
    }
    if (tested->failed)
        kd_json_string(json, "first_failure", tested->worst);
    kd_json_end(json);
    kd_json_object(json, "limits");
    kd_json_number(json, "heap_bytes", (double)info->heap_bytes);
    kd_json_number(json, "memory_bytes", (double)c.memory_bytes);
    kd_json_string(json, "memory_by", c.memory_by ? c.memory_by : "the device");
    kd_json_number(json, "binding_bytes", (double)info->max_binding_bytes);
    kd_json_number(json, "allocation_bytes", (double)info->max_allocation_bytes);
    kd_json_number(json, "workgroups", info->max_groups_x);
    kd_json_number(json, "subgroup_size", info->subgroup_size);
    kd_json_end(json);
    kd_json_object(json, "ns_per_item");
    kd_json_string(json, "basis", c.measured ? "measured" : "guess");
    for (int i = 0; i < KD_FIGURE_COUNT; i++)
        kd_json_number(json, kd_figures[i].word, c.ns[i]);
    kd_json_end(json);
    kd_json_end(json);
    return kd_json_finish(json);
}

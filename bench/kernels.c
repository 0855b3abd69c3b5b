/* Measures kernels one by one: compiles each variant that the presets' pictures need.
 *
 * Without --on: compiles each kernel on the same device, and then dispatches it with no workgroups, because some
 * drivers (lavapipe) compile only then. The processor time of compiling and dispatching is measured, with Mesa's disk
 * cache disabled. With --on DEVICE: creates a pipeline of each kernel for that device, which need not be present (RADV
 * with RADV_FORCE_FAMILY). Standard error has a line "kernel N" for each kernel, followed by the driver's statistics of
 * the kernel. Standard output has one line of JSON. kernels.py runs this program and reads both outputs. */
#include "render/device/device_internal.h"
#include "render/render.h"

#include <argp.h>
#include <cJSON.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST = 512, MOST_SCENES = 64 };
struct variant {
    struct kd_kernel_entry kernel; /* a kernel's cache entry, without its pipeline */
    cJSON *scenes;
};
struct options {
    const char *device, *on, *kernel, *scenes[MOST_SCENES];
    int n, width, height;
};

static struct variant variants[MOST];
static size_t n_variants;

/* Processor time of this process on all threads. Other processes do not affect it. */
static double processor_ms(void)
{
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return 1e3 * (double)t.tv_sec + 1e-6 * (double)t.tv_nsec;
}

static void add(const struct kd_kernel_entry *entry, const char *scene)
{
    size_t i = 0;
    while (i < n_variants && (variants[i].kernel.source != entry->source ||
                              memcmp(variants[i].kernel.constants, entry->constants, sizeof entry->constants)))
        i++;
    if (i == MOST)
        return;
    if (i == n_variants)
        variants[n_variants++] = (struct variant) { *entry, cJSON_CreateArray() };
    cJSON_AddItemToArray(variants[i].scenes, cJSON_CreateString(scene));
}

/* Renders a preset without computing anything, and records the kernels that were used. */
static enum kd_status visit(struct kd_renderer *renderer, const struct options *o, const char *name,
                            struct kd_error *error)
{
    struct kd_scene scene;
    struct kd_plan plan;
    struct kd_frame frame = { 0 };
    struct kd_capacity capacity;
    enum kd_status status;
    const uint64_t before = renderer->kernels.clock;
    KD_TRY(kd_scene_preset(&scene, name, error));
    scene.image.width = o->width;
    scene.image.height = o->height;
    kd_renderer_capacity(renderer, &capacity);
    KD_TRY(kd_plan_make(&scene, &capacity, &plan, error));
    plan.lens.audit = 0;
    KD_TRY(kd_render(renderer, &scene, &plan, NULL, NULL, &frame, error));
    for (size_t i = 0; i < KD_KERNELS_KEPT; i++)
        if (renderer->kernels.entries[i].pipeline && renderer->kernels.entries[i].used > before &&
            (!o->kernel || strstr(renderer->kernels.entries[i].source->name, o->kernel)))
            add(&renderer->kernels.entries[i], name);
done:
    kd_frame_finish(&frame);
    return status;
}

static enum kd_status collect(const struct options *o, cJSON *root, struct kd_error *error)
{
    struct kd_renderer *renderer;
    enum kd_status status = kd_renderer_create(
        &(struct kd_renderer_params) { .device = o->device, .cache_dir = "", .passing = true, .compiles_only = true },
        &renderer, error);
    if (status)
        return status;
    cJSON_AddStringToObject(root, "device", kd_renderer_device_name(renderer));
    for (int i = 0; i < o->n && !status; i++)
        status = visit(renderer, o, o->scenes[i], error);
    kd_renderer_assets_stop(renderer);
    kd_renderer_destroy(renderer);
    return status;
}

static enum kd_status dispatch(struct kd_vk *vk, const struct kd_vk_pipeline_params *params,
                               const struct kd_vk_pipeline *pipeline, struct kd_error *error)
{
    static const uint8_t push[256];
    struct kd_vk_dispatch d = { .pass = "compile", .pipeline = pipeline, .push = push };
    enum kd_status status = KD_OK;
    uint32_t n = 0;
    for (; n < params->n_buffers; n++) {
        KD_TRY(kd_vk_buffer_create(vk, 65536, KD_VK_DEVICE, "nothing", &d.bindings[n].buffer, error));
        d.bindings[n].write = params->kinds[n] == KD_VK_STORAGE;
    }
    KD_TRY(kd_vk_dispatch(vk, &d, error));
    KD_TRY(kd_vk_submit(vk, NULL, error));
    KD_TRY(kd_vk_wait(vk, 0, error));
done:
    while (n)
        kd_vk_buffer_destroy(vk, d.bindings[--n].buffer);
    return status;
}

static enum kd_status make(struct kd_vk *vk, const struct options *o, size_t number, cJSON *all, struct kd_error *error)
{
    const struct kd_kernel_entry *k = &variants[number].kernel;
    struct kd_vk_spec spec[KD_KERNEL_MAX_CONSTANTS];
    struct kd_vk_pipeline_params params = *k->source;
    struct kd_vk_pipeline *pipeline;
    enum kd_status status;
    for (uint32_t i = 0; i < k->n; i++)
        spec[i] = (struct kd_vk_spec) { i, k->constants[i] };
    params.spec = spec;
    params.n_spec = k->n;
    fprintf(stderr, "kernel %zu\n", number);
    const double start = processor_ms();
    KD_TRY(kd_vk_pipeline_create(vk, &params, &pipeline, error));
    const double made = processor_ms();
    if (!o->on)
        status = dispatch(vk, &params, pipeline, error);
    const double end = processor_ms();
    kd_vk_pipeline_destroy(vk, pipeline);
    cJSON *one = cJSON_CreateObject(), *constants = cJSON_AddArrayToObject(one, "constants");
    cJSON_AddStringToObject(one, "name", k->source->name);
    for (uint32_t i = 0; i < k->n; i++)
        cJSON_AddItemToArray(constants, cJSON_CreateNumber(k->constants[i]));
    cJSON_AddItemToObject(one, "scenes", variants[number].scenes);
    cJSON_AddNumberToObject(one, "spirv_bytes", (double)k->source->spirv_bytes);
    cJSON_AddNumberToObject(one, "pipeline_ms", made - start);
    cJSON_AddNumberToObject(one, "dispatch_ms", end - made);
    cJSON_AddItemToArray(all, one);
done:
    return status;
}

static enum kd_status make_all(const struct options *o, cJSON *root, struct kd_error *error)
{
    struct kd_vk *vk;
    /* set before the device is created, because Mesa reads the variable then */
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    enum kd_status status = kd_vk_create(
        &(struct kd_vk_params) {
            .device = o->on ? o->on : o->device, .cache_dir = "", .compiles_only = !o->on, .pipelines_only = o->on },
        &vk, error);
    cJSON *all = cJSON_AddArrayToObject(root, "kernels");
    if (status)
        return status;
    const struct kd_vk_info *info = kd_vk_info(vk);
    cJSON_AddStringToObject(root, "made_on", info->name);
    cJSON_AddStringToObject(root, "driver", info->driver);
    cJSON_AddStringToObject(root, "driver_info", info->driver_info);
    for (size_t i = 0; i < n_variants && !status; i++)
        status = make(vk, o, i, all, error);
    kd_vk_destroy(vk);
    return status;
}

static error_t option(int key, char *text, struct argp_state *state)
{
    struct options *o = state->input;
    switch (key) {
    case 'd': o->device = text; return 0;
    case 'o': o->on = text; return 0;
    case 'k': o->kernel = text; return 0;
    case 'x': o->width = atoi(text); return 0;
    case 'y': o->height = atoi(text); return 0;
    case ARGP_KEY_ARG:
        if (o->n == MOST_SCENES)
            argp_error(state, "too many scenes (limit %d)", MOST_SCENES);
        o->scenes[o->n++] = text;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

int main(int argc, char **argv)
{
    static const struct argp_option table[] = {
        { "device", 'd', "DEVICE", 0, "that renders the presets (auto)", 0 },
        { "on", 'o', "DEVICE", 0, "that makes the kernels, as pipelines alone", 0 },
        { "kernel", 'k', "TEXT", 0, "only kernels whose name has it", 0 },
        { "width", 'x', "N", 0, "pixels (1280)", 0 },
        { "height", 'y', "N", 0, "pixels (720)", 0 },
        { 0 },
    };
    struct options o = { .device = "auto", .width = 1280, .height = 720 };
    struct argp parser = { table, option, "PRESET...", "The kernels of scenes, one by one.", NULL, NULL, NULL };
    argp_parse(&parser, argc, argv, 0, NULL, &o);
    struct kd_error error = { 0 };
    cJSON *root = cJSON_CreateObject();
    enum kd_status status = collect(&o, root, &error);
    if (!status)
        status = make_all(&o, root, &error);
    char *text = cJSON_PrintUnformatted(root);
    if (status)
        fprintf(stderr, "kd_bench_kernels: %s\n", error.message);
    else if (text)
        puts(text);
    cJSON_free(text);
    cJSON_Delete(root);
    return status != KD_OK;
}

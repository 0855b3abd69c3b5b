/* Implements render/render.h without a device, for tests of the code in front of it. Plans and picture formats are
 * the real ones.
 *
 * The scene's time selects the behaviour. t >= 0 takes t milliseconds, in slices of 10, and 30 times as long with
 * several rays a pixel. t = -1: the device is lost; it can be reopened if its name is "mends". -1.5: the device is lost
 * only the first time. -2: out of memory. -3: another failure. The exposure "auto" alternates between 1 stop and -1.
 * Rays on the device cross once, at 10 + |alpha| with the azimuth beta; with 8 steps there is no double precision; with
 * 12 steps each ray takes a millisecond.
 *
 * The picture of a sky of seed 4711 is being decoded until another picture is rendered. Kernels of a sky of seed 4712,
 * and of rays with steps 20, are being compiled until then, but for a minute at most. For a sky of seed 4713, the lack
 * of kernels is found only after its picture has begun. Each compilation is reported as a kilobyte more of kernels; on
 * a device called "miscompiles" each compilation fails. On a device called "compiles", a small picture of a preset
 * takes until five other pictures have been rendered, as if a kernel were compiled. It fails if they are not rendered
 * within a minute. */
#include "base/clock.h"
#include "render/device/accuracy_store.h"
#include "render/device/rest.h"
#include "render/rays/device.h"
#include "render/frame/compilation.h"
#include "render/frame/frame.h"
#include "render/frame/probe.h"

#include <fcntl.h>
#include <math.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

struct kd_renderer {
    char lens_key[65];
    bool measured, slow, held, gated, compiles, miscompiles, bright;
    struct kd_renderer_params params;
    _Atomic bool read; /* true after the picture of the sky of seed 4711 has been decoded */
    bool compiled;     /* true after the kernels of the other skies have been compiled */
};
enum {
    UNREAD = 4711,
    UNCOMPILED = 4712,
    LACKING = 4713,
    AHEAD = 4714,
    STEPS_UNCOMPILED = 20,
    MEANWHILE = 5,
    PATIENCE_MS = 60000
};
static _Atomic unsigned drawn; /* number of pictures rendered, over all renderers */

enum kd_status kd_renderer_create(const struct kd_renderer_params *params, struct kd_renderer **out,
                                  struct kd_error *error)
{
    if (params->device && !strcmp(params->device, "none"))
        return kd_error_set(error, KD_EDEVICE, "there is no device called none");
    *out = calloc(1, sizeof **out);
    if (*out)
        (*out)->params = *params;
    if (*out)
        (*out)->measured = params->device && !strcmp(params->device, "measured");
    if (*out)
        (*out)->slow = params->device && !strcmp(params->device, "slow");
    if (*out)
        (*out)->held = params->device && !strcmp(params->device, "held");
    if (*out)
        (*out)->gated = params->device && !strcmp(params->device, "gated");
    if (*out)
        (*out)->compiles = params->device && !strcmp(params->device, "compiles");
    if (*out)
        (*out)->miscompiles = params->device && !strcmp(params->device, "miscompiles");
    return *out ? KD_OK : KD_ENOMEM;
}

void kd_renderer_destroy(struct kd_renderer *renderer) { free(renderer); }

enum kd_status kd_renderer_reopen(struct kd_renderer *renderer, struct kd_error *error)
{
    return renderer->params.device && !strcmp(renderer->params.device, "mends")
               ? KD_OK
               : kd_error_set(error, KD_EDEVICE, "the device missed its deadline");
}

bool kd_renderer_hangs(const struct kd_renderer *renderer)
{
    return !renderer->params.device || strcmp(renderer->params.device, "mends");
}

bool kd_renderer_assets_begin(struct kd_renderer *renderer, const struct kd_scene *scene)
{
    return scene->sky.seed == UNREAD && !atomic_load(&renderer->read);
}

void kd_renderer_sky_ahead(struct kd_renderer *renderer, const char *hash) { (void)renderer, (void)hash; }

void kd_renderer_assets_stop(struct kd_renderer *renderer) { (void)renderer; }

/* Reports through one FIFO that a thread is planning, and waits for a byte in the other FIFO. */
static void wait_at_gate(void)
{
    char byte = 0;
    const int asks = open(getenv("KERRD_GATE_ASKS"), O_WRONLY), may = open(getenv("KERRD_GATE_MAY"), O_RDONLY);
    if (write(asks, &byte, 1) < 0 || read(may, &byte, 1) < 0)
        abort();
    close(asks);
    close(may);
}

/* Called by every planning thread. A device called "held" blocks the thread. A device called "gated" blocks the thread
 * after it has rendered a picture, until the test releases it. */
void kd_renderer_capacity(struct kd_renderer *renderer, struct kd_capacity *out)
{
    if (renderer->held)
        nanosleep(&(struct timespec) { .tv_sec = 5 }, NULL);
    if (renderer->gated && atomic_load(&drawn))
        wait_at_gate();
    *out = (struct kd_capacity) { .max_binding_bytes = 128u << 20,
                                  .memory_bytes = 1u << 30,
                                  .ns[KD_NS_RAY_RADIUS] = 1000,
                                  .ns[KD_NS_RAY_FULL] = 1000,
                                  .ns[KD_NS_SAMPLE_TRANSFER] = 1,
                                  .ns[KD_NS_RAY_STARS] = 1.5,
                                  .ns[KD_NS_SAMPLE_STARS] = 1,
                                  .ns[KD_NS_PIXEL_POST] = 1,
                                  .float64 = true,
                                  .accuracy = kd_accuracy_built_in() };
}

enum kd_status kd_renderer_device_json(struct kd_renderer *renderer, struct kd_buffer *out)
{
    (void)renderer;
    return kd_buffer_printf(out, "{\"name\":\"fake\"}\n");
}

/* A device called "measured" has an accuracy table. A device called "slow" reports after a delay that it has none. */
enum kd_status kd_renderer_accuracy_json(const struct kd_renderer *renderer, struct kd_buffer *out,
                                         struct kd_error *error)
{
    if (renderer->slow)
        nanosleep(&(struct timespec) { .tv_sec = 5 }, NULL);
    return renderer->measured ? kd_buffer_printf(out, "{\"format\":1}\n")
                              : kd_error_set(error, KD_EIO, "there is no table: `kerrd bench accuracy` makes one");
}

const char *kd_renderer_device_name(const struct kd_renderer *renderer)
{
    (void)renderer;
    return "fake";
}

const char *kd_renderer_device(const struct kd_renderer *renderer)
{
    (void)renderer;
    return "fake";
}

const char *kd_renderer_driver(const struct kd_renderer *renderer)
{
    (void)renderer;
    return "a \"driver\" \\ of no device";
}

/* Each time that the renderer becomes idle adds one byte to the reported size of kernels. */
static _Atomic unsigned rests, compilations;

enum kd_status kd_renderer_rest(struct kd_renderer *renderer, struct kd_error *error)
{
    (void)renderer, (void)error;
    atomic_fetch_add(&rests, 1);
    return KD_OK;
}

void kd_renderer_cached(const struct kd_renderer *renderer, uint64_t out[KD_N_CACHE_KINDS])
{
    (void)renderer;
    for (size_t i = 0; i < KD_N_CACHE_KINDS; i++)
        out[i] = 0;
    out[KD_CACHE_KERNELS] = atomic_load(&rests) + 1024 * atomic_load(&compilations);
}

uint64_t kd_renderer_kept_sum(const struct kd_renderer *renderer)
{
    (void)renderer;
    return atomic_load(&rests);
}

uint64_t kd_renderer_held(const struct kd_renderer *renderer)
{
    (void)renderer;
    return 12345678;
}

/* The folder of caches that the environment names, as for real devices. */
char *kd_renderer_cache_file(const struct kd_renderer *renderer, const char *suffix)
{
    const char *folder = getenv("XDG_CACHE_HOME");
    char *path = NULL;
    (void)renderer;
    return folder && asprintf(&path, "%s/fake%s", folder, suffix) >= 0 ? path : NULL;
}

uint32_t kd_renderer_validation_messages(const struct kd_renderer *renderer)
{
    (void)renderer;
    return 0;
}

static enum kd_status pass_time(double ms, kd_progress_fn progress, void *user, struct kd_error *error)
{
    for (double t = 0; t < ms; t += 10) {
        struct timespec slice = { .tv_nsec = 10 * 1000 * 1000 };
        nanosleep(&slice, NULL);
        if (progress && !progress(user, t / ms))
            return kd_error_set(error, KD_ECANCELLED, "stopped by its caller");
    }
    return KD_OK;
}

struct kd_compilation {
    struct kd_renderer *renderer;
    bool done;
};

bool kd_compilation_helps(const struct kd_renderer *renderer)
{
    (void)renderer;
    return true;
}

static struct kd_compilation *lacked(struct kd_renderer *renderer)
{
    struct kd_compilation *c = renderer->compiled ? NULL : calloc(1, sizeof *c);
    if (c)
        c->renderer = renderer;
    return c;
}

struct kd_compilation *kd_compilation_begin(struct kd_renderer *renderer, const struct kd_scene *scene,
                                            const struct kd_plan *plan)
{
    return scene->sky.seed == UNCOMPILED || (scene->sky.seed == AHEAD && plan->report.probe.on) ? lacked(renderer)
                                                                                                : NULL;
}

struct kd_compilation *kd_compilation_of(struct kd_renderer *renderer, kd_kernels_ask_fn ask, const void *user)
{
    return ask(renderer, user) ? NULL : lacked(renderer);
}

/* Returns KD_OK if a kernel must be compiled. */
enum kd_status kd_rays_device_ask(struct kd_renderer *renderer, const struct kd_rays_params *params, bool told)
{
    (void)renderer, (void)told;
    return params->steps == STEPS_UNCOMPILED ? KD_OK : KD_EABSENT;
}

enum kd_status kd_compilation_run(struct kd_compilation *compilation, kd_progress_fn progress, void *user,
                                  struct kd_error *error)
{
    const unsigned before = atomic_load(&drawn);
    atomic_fetch_add(&compilations, 1);
    if (compilation->renderer->miscompiles)
        return kd_error_set(error, KD_EIO, "the driver could not make a kernel");
    for (int ms = 0; ms < PATIENCE_MS && atomic_load(&drawn) == before; ms += 10)
        if (pass_time(10, progress, user, NULL))
            return KD_OK;
    compilation->done = true;
    return KD_OK;
}

void kd_compilation_end(struct kd_compilation *compilation)
{
    compilation->renderer->compiled |= compilation->done;
    free(compilation);
}

void kd_compilation_drop(struct kd_compilation *compilation) { free(compilation); }

static enum kd_status compile(kd_progress_fn progress, void *user, struct kd_error *error)
{
    const unsigned before = atomic_load(&drawn);
    for (int ms = 0; ms < PATIENCE_MS; ms += 10) {
        if (atomic_load(&drawn) - before >= MEANWHILE)
            return KD_OK;
        enum kd_status status = pass_time(10, progress, user, error);
        if (status)
            return status;
    }
    return kd_error_set(error, KD_EIO, "nothing else was rendered meanwhile");
}

static enum kd_status mishap(double time, struct kd_error *error)
{
    static _Atomic unsigned failed;
    if (time == -1 || (time == -1.5 && !atomic_fetch_add(&failed, 1)))
        return kd_error_set(error, KD_EDEVICE, "the device missed its deadline");
    if (time == -2)
        return kd_error_set(error, KD_ENOMEM, "no memory for the picture");
    return time < 0 && time != -1.5 ? kd_error_set(error, KD_EIO, "something failed") : KD_OK;
}

/* Explains a pixel: light of 1/4, equal for the pixel and for all rays, and no emitters. */
static struct kd_probed_pixel *tell(const struct kd_plan *plan)
{
    const uint32_t side = plan->lens.side;
    struct kd_probed_pixel *told = plan->report.probe.on ? calloc(1, sizeof *told) : NULL;
    if (!told)
        return NULL;
    *told = (struct kd_probed_pixel) {
        .x = plan->report.probe.x, .y = plan->report.probe.y, .rays = side * side, .radiance = { 0.25f, 0.25f, 0.25f }
    };
    told->each = malloc(told->rays * sizeof *told->each);
    for (uint32_t i = 0; told->each && i < told->rays; i++)
        told->each[i] = (struct kd_probed_ray) {
            .steps_a_pixel = side,
            .x = told->x * side + i % side,
            .y = told->y * side + i / side,
            .light = { 0.25f, 0.25f, 0.25f },
        };
    told->rays = told->each ? told->rays : 0;
    /* the path has a start and no further step */
    if (plan->report.probe.steps && (told->steps = calloc(1, sizeof *told->steps))) {
        *told->steps = (struct kd_rays_steps) { .params = { .engine = plan->lens.setting.engine,
                                                            .steps = plan->lens.setting.steps },
                                                .n = 1,
                                                .steps = calloc(1, sizeof *told->steps->steps),
                                                .same = true };
        told->steps->n = told->steps->steps != NULL;
    }
    told->middle = told->each ? told->each[0] : (struct kd_probed_ray) { .steps_a_pixel = side };
    return told;
}

/* Black linear light, and maps of constant brightness: 1 in all image orders together, and 1/2 in image order 1. With
 * three samples a side the maps are black too. */
static enum kd_status add_numbers(const struct kd_scene *scene, const struct kd_plan *plan, struct kd_frame *out,
                                  struct kd_error *error)
{
    enum kd_status status =
        plan->picture.radiance ? kd_frame_add_layer(out, "radiance", 3, KD_LAYER_F32, error) : KD_OK;
    for (size_t i = 0; i < plan->picture.n_layers && !status; i++) {
        char name[KD_LAYER_NAME];
        kd_layer_name(plan->picture.layers[i], name);
        if ((status = kd_frame_add_layer(out, name, 1, KD_LAYER_F32, error)))
            break;
        float *at = out->layers[out->n_layers - 1].data;
        for (size_t k = 0; k < (size_t)plan->picture.width * plan->picture.height; k++)
            at[k] = scene->image.samples == 3 ? 0 : plan->picture.layers[i].order == 1 ? 0.5f : 1;
    }
    return status;
}

/* True if a picture lacks kernels that its plan did not predict. */
static enum kd_status lack(struct kd_renderer *renderer, const struct kd_scene *scene, bool aside,
                           struct kd_error *error)
{
    struct kd_compilation *c = scene->sky.seed == LACKING && renderer->params.lacks ? lacked(renderer) : NULL;
    if (!c || renderer->params.lacks(renderer->params.lacks_user, c, aside))
        return KD_OK;
    return kd_error_set(error, KD_ECANCELLED, "the picture waits for a kernel");
}

static enum kd_status draw(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                           bool aside, kd_progress_fn progress, void *user, struct kd_frame *out,
                           struct kd_error *error)
{
    const double begun = kd_clock_ms();
    enum kd_status status = mishap(scene->top.time, error);
    if (kd_renderer_assets_begin(renderer, scene))
        return kd_error_set(error, KD_EIO, "a picture has the device while its sky is read");
    if (!atomic_exchange(&renderer->read, true) && renderer->params.asset_read)
        renderer->params.asset_read(renderer->params.asset_read_user);
    if (!status)
        status = lack(renderer, scene, aside, error);
    if (!status)
        status = pass_time(scene->top.time * (plan->lens.side > 1 ? 30 : 1), progress, user, error);
    if (!status && renderer->compiles && plan->picture.width == 192 && plan->picture.height == 120)
        status = compile(progress, user, error);
    if (status)
        return status;
    *out = (struct kd_frame) { .width = plan->picture.width,
                               .height = plan->picture.height,
                               .told = tell(plan),
                               .exposure = isinf(scene->style.exposure)
                                               ? kd_plan_exposure(&plan->picture, renderer->bright ? -1 : 1)
                                               : scene->style.exposure };
    if (plan->report.probe.on && (!out->told || !out->told->each ||
                                  (plan->report.probe.steps && (!out->told->steps || !out->told->steps->steps)))) {
        kd_frame_finish(out);
        return kd_error_set(error, KD_ENOMEM, "out of memory for the report on a pixel");
    }
    if (kd_frame_add_layer(out, "rgb", 3, scene->image.bit_depth > 8 ? KD_LAYER_U16 : KD_LAYER_U8, error)) {
        kd_frame_finish(out);
        return KD_ENOMEM;
    }
    size_t size = (size_t)plan->picture.width * plan->picture.height * kd_layer_pixel_bytes(&out->layers[0]);
    renderer->bright = !renderer->bright;
    uint32_t noise = 1;
    for (size_t i = 0; i < size; i++) {
        noise = noise * 1664525 + 1013904223;
        ((unsigned char *)kd_frame_pixels(out))[i] = (unsigned char)(scene->image.samples > 1 ? noise >> 24 : i * 7);
    }
    if (add_numbers(scene, plan, out, error)) {
        kd_frame_finish(out);
        return KD_ENOMEM;
    }
    const double t = scene->top.time; /* the picture is black at time 0 */
    if (plan->light.photometry)
        out->light = (struct kd_light_report) {
            .measured = true,
            .all = { t, t > 0 ? 0.5 * t : NAN, -t, 0, 0, 0 },
            .spots = { t / 4, t > 0 ? 3 : NAN, t > 0 ? 0.25 : NAN, 0, 0, 0 },
        };
    out->lens_reused = !strcmp(renderer->lens_key, plan->lens.key);
    memcpy(renderer->lens_key, plan->lens.key, sizeof renderer->lens_key);
    if (!out->lens_reused)
        out->timings[out->n_timings++] = (struct kd_timing) { "trace", scene->top.time };
    out->timings[out->n_timings++] = (struct kd_timing) { "total", scene->top.time };
    /* the time is measured, because a busy machine wakes the thread late */
    out->timings[out->n_timings++] = (struct kd_timing) { "slept", kd_clock_ms() - begun };
    atomic_fetch_add(&drawn, 1);
    return KD_OK;
}

enum kd_status kd_render(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                         kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error)
{
    return draw(renderer, scene, plan, false, progress, user, out, error);
}

struct aside {
    kd_progress_fn progress;
    const struct kd_preview_hook *preview;
    void *user;
    const struct kd_plan *plan;
};

static bool go_on(void *user, double fraction)
{
    const struct aside *a = user;
    if (!a->progress(a->user, fraction))
        return false;
    uint32_t rows = (uint32_t)(fraction * a->plan->picture.height);
    if (a->preview && rows && a->preview->wanted(a->user)) {
        struct kd_frame frame = { .width = a->plan->picture.width, .height = a->plan->picture.height };
        if (!kd_frame_add_layer(&frame, "rgb", 3, KD_LAYER_U8, NULL)) {
            memset(kd_frame_pixels(&frame), 0, (size_t)3 * frame.width * frame.height);
            memset(kd_frame_pixels(&frame), 200, (size_t)3 * frame.width * rows);
            a->preview->seen(a->user, &frame, rows);
        }
        kd_frame_finish(&frame);
    }
    return true;
}

enum kd_status kd_render_in_background(struct kd_renderer *renderer, const struct kd_scene *scene,
                                       const struct kd_plan *plan, kd_progress_fn progress,
                                       const struct kd_preview_hook *preview, void *user, struct kd_frame *out,
                                       struct kd_error *error)
{
    struct aside aside = { progress, preview, user, plan };
    return draw(renderer, scene, plan, true, go_on, &aside, out, error);
}

/* Ignores the light of the other pictures of a blurred frame. The result is black, like each picture. */
enum kd_status kd_render_mean(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_light_sum *others, bool aside, kd_progress_fn progress,
                              const struct kd_preview_hook *preview, void *user, struct kd_frame *out,
                              struct kd_error *error)
{
    (void)others;
    return aside ? kd_render_in_background(renderer, scene, plan, progress, preview, user, out, error)
                 : kd_render(renderer, scene, plan, progress, user, out, error);
}

enum kd_status kd_rays_device(struct kd_renderer *renderer, const struct kd_rays_params *params,
                              const struct kd_ray_labels *rays, struct kd_ray_crossing *crossings,
                              struct kd_ray_end *ends, kd_progress_fn progress, void *user, struct kd_error *error)
{
    const double *alpha_beta = rays->alpha_beta;
    size_t n = rays->n;
    (void)renderer;
    if (params->steps == 2044) {
        kd_error_field(error, "/accuracy/precision", "no double precision here");
        return error->status = KD_EDEVICE;
    }
    enum kd_status status = pass_time(params->steps == 12 ? (double)n : 0, progress, user, error);
    for (size_t i = 0; i < n && !status; i++) {
        for (uint32_t k = 0; k < params->orders; k++)
            crossings[i * params->orders + k] = (struct kd_ray_crossing) { NAN, NAN, NAN, NAN };
        crossings[i * params->orders] =
            (struct kd_ray_crossing) { 10 + fabs(alpha_beta[2 * i]), alpha_beta[2 * i + 1], 0, NAN };
        ends[i] = (struct kd_ray_end) { KD_RAY_CAPTURED, 1, NAN, NAN, 1e-6 };
    }
    return status;
}

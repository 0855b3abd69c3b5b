#include "render/frame/compilation.h"

#include "base/log.h"
#include "render/device/compiled.h"
#include "render/frame/job.h"
#include "render/frame/normalise.h"
#include "scene/dynamic_bodies.h"

#include <stdlib.h>

struct kd_compilation {
    struct kd_renderer *renderer;
    bool picture; /* true if the kernels are those of a whole picture; the scene is then rendered by its plan */
    struct kd_scene scene;
    struct kd_dynamic_bodies *dynamic; /* the scene's bodies of a playground; a counted reference, because the
                                        * requester may end before the compilation */
    struct kd_plan plan;
    struct kd_kernel_requests wishes;
    kd_progress_fn progress;
    void *user;
    enum kd_status status;
    struct kd_error error;
};

struct kd_compilation *kd_compilation_of(struct kd_renderer *r, kd_kernels_ask_fn ask, const void *user)
{
    struct kd_compilation *c = calloc(1, sizeof *c);
    if (!c || !r->vk) {
        free(c);
        return NULL;
    }
    kd_kernels_note(&r->kernels);
    const enum kd_status status = ask(r, user);
    kd_kernels_noted(&r->kernels, &c->wishes);
    if (status || !c->wishes.n) {
        free(c);
        return NULL;
    }
    c->renderer = r;
    return c;
}

struct picture {
    const struct kd_scene *scene;
    const struct kd_plan *plan;
};

static enum kd_status ask_picture(struct kd_renderer *r, const void *user)
{
    const struct picture *p = user;
    struct kd_error error = { 0 }; /* the error is reported to the render that needs the kernel */
    struct kd_frame_job job = { .r = r, .store = &r->store, .scene = p->scene, .plan = p->plan, .error = &error };
    const enum kd_status status = kd_frame_normalise_ask(r, p->scene, p->plan, &error);
    return status ? status : kd_frame_ask_kernels(&job);
}

struct kd_compilation *kd_compilation_begin(struct kd_renderer *r, const struct kd_scene *scene,
                                            const struct kd_plan *plan)
{
    struct kd_compilation *c = kd_compilation_of(r, ask_picture, &(struct picture) { scene, plan });
    if (!c)
        return NULL;
    c->picture = true;
    c->scene = *scene;
    c->dynamic = (struct kd_dynamic_bodies *)scene->dynamic.at;
    kd_dynamic_bodies_keep(c->dynamic);
    c->plan = *plan;
    c->plan.lens.audit = 0; /* a device that only compiles has no results to audit */
    return c;
}

/* Dispatches each kernel once, without workgroups. Bound buffers are of the right kinds but have no contents. */
static enum kd_status dispatch_each(struct kd_compilation *c, struct kd_renderer *own, struct kd_error *error)
{
    static const uint32_t push[128 / 4]; /* Vulkan guarantees this size of push constants */
    const uint64_t bytes = 16384;        /* every device accepts a uniform buffer of this size */
    struct kd_vk_buffer *any = NULL;
    enum kd_status status;
    KD_TRY(kd_vk_buffer_create(own->vk, bytes, KD_VK_DEVICE, "of nothing", &any, error));
    for (const struct kd_kernel_request *w = c->wishes.at; w < c->wishes.at + c->wishes.n; w++) {
        struct kd_vk_dispatch d = { .pass = "compile", .push = push };
        KD_TRY(kd_kernels_get_of(&own->kernels, own->vk, w->source, w->constants, w->n, &d.pipeline, error));
        for (uint32_t i = 0; i < w->source->n_buffers; i++)
            d.bindings[i] = (struct kd_vk_binding) { .buffer = any };
        KD_TRY(kd_vk_dispatch(own->vk, &d, error));
        KD_TRY(kd_vk_submit(own->vk, NULL, error));
        KD_TRY(kd_vk_wait(own->vk, 0, error));
        if (!c->progress(c->user, 0))
            KD_TRY(kd_error_set(error, KD_ECANCELLED, "the kernels are no longer needed"));
    }
done:
    kd_vk_buffer_destroy(own->vk, any);
    return status;
}

/* Renders the picture, or dispatches its kernels, on a device that computes nothing. Then closes the device: the driver
 * writes its files on a thread of its own, which ends with the device. */
static void *rehearse(void *user)
{
    struct kd_compilation *c = user;
    const struct kd_renderer *r = c->renderer;
    const struct kd_renderer_params params = { .device = r->opening.device,
                                               .cache_dir = "",
                                               .assets = r->panoramas.assets,
                                               .passing = true,
                                               .compiles_only = true,
                                               .deadline_ms = r->opening.deadline_ms };
    struct kd_renderer *own = NULL;
    struct kd_frame frame = { 0 };
    c->status = kd_renderer_create(&params, &own, &c->error);
    if (!c->status)
        c->status = c->picture ? kd_render(own, &c->scene, &c->plan, c->progress, c->user, &frame, &c->error)
                               : dispatch_each(c, own, &c->error);
    kd_frame_finish(&frame);
    if (own && kd_renderer_hangs(own))
        return NULL; /* not closed, because a hanging device can never be closed */
    if (c->status == KD_EDEVICE)
        c->status = KD_EIO; /* not KD_EDEVICE, because the picture's own device may still work */
    if (own)
        kd_renderer_assets_stop(own);
    kd_renderer_destroy(own);
    return NULL;
}

enum kd_status kd_compilation_run(struct kd_compilation *c, kd_progress_fn progress, void *user, struct kd_error *error)
{
    char dir[4096];
    pthread_t thread;
    c->progress = progress;
    c->user = user;
    const bool late = kd_vk_compiling(c->renderer->vk, dir) == KD_VK_COMPILES_LATE &&
                      !kd_compiled_has(c->renderer, &c->wishes),
               beside = late && !pthread_create(&thread, NULL, rehearse, c);
    kd_kernel_requests_make(&c->wishes, c->renderer->vk);
    if (beside)
        pthread_join(thread, NULL);
    else if (late)
        rehearse(c);
    if (late && !c->status)
        kd_compiled_add(c->renderer, &c->wishes);
    if (c->status && c->status != KD_ECANCELLED)
        kd_log(KD_LOG_DEBUG, "kernels could not be compiled on the second device: %s", c->error.message);
    if (c->status == KD_EDEVICE && error)
        *error = c->error;
    return c->status == KD_EDEVICE ? KD_EDEVICE : KD_OK;
}

void kd_compilation_end(struct kd_compilation *c)
{
    kd_kernels_keep(&c->renderer->kernels, c->renderer->vk, &c->wishes);
    kd_compilation_drop(c);
}

void kd_compilation_drop(struct kd_compilation *c)
{
    kd_dynamic_bodies_release(c->dynamic);
    free(c);
}

bool kd_compilation_helps(const struct kd_renderer *r)
{
    char dir[4096];
    const enum kd_vk_compiling how = kd_vk_compiling(r->vk, dir);
    if (how == KD_VK_COMPILES_LATE_KEEPS_NOTHING)
        kd_log(KD_LOG_WARN,
               "%.200s stores no compiled kernels (%.300s is not writable, or MESA_SHADER_CACHE_DISABLE is set): a "
               "picture with new kernels occupies the device for some seconds during their compilation",
               r->driver, *dir ? dir : "its folder");
    return how != KD_VK_COMPILES_LATE_KEEPS_NOTHING;
}

#include "render/device/prepare.h"

#include "render/device/device_internal.h"

#include <stdlib.h>

enum kd_status kd_emitter_buffers_at_least(const struct kd_emitter_buffers_work *work, struct kd_vk_buffer **buffer,
                                           uint64_t bytes, enum kd_vk_memory memory, const char *name,
                                           struct kd_error *error)
{
    return kd_store_at_least(work->vk, buffer, bytes, memory, name, error);
}

enum kd_status kd_emitter_buffers_kernel(const struct kd_emitter_buffers_work *work,
                                         const struct kd_vk_pipeline_params *kernel, const uint32_t *constants,
                                         size_t n, const struct kd_vk_pipeline **out, struct kd_error *error)
{
    return kd_kernels_get_of(&work->renderer->kernels, work->vk, kernel, constants, n, out, error);
}

static enum kd_status work_of(struct kd_renderer *r, struct kd_prepared *prepared, enum kd_emitter_number number,
                              const struct kd_capacity *c, struct kd_emitter_buffers_work *out, struct kd_error *error)
{
    const struct kd_emitter *e = kd_emitters[number];
    const struct kd_pass *pass = kd_pass_find(e->name);
    if (!prepared->own[number])
        prepared->own[number] = calloc(1, e->own->bytes);
    if (!prepared->own[number])
        return kd_error_set(error, KD_ENOMEM, "out of memory for %s", e->title);
    *out = (struct kd_emitter_buffers_work) { r, r->vk, prepared->own[number], pass ? c->ns[pass->figure] : 0 };
    return KD_OK;
}

enum kd_status kd_prepare_asked(struct kd_renderer *r, enum kd_emitter_number number,
                                struct kd_emitter_buffers_work *out, struct kd_error *error)
{
    return work_of(r, &r->prepared, number, &r->capacity, out, error);
}

void kd_prepare_begin(struct kd_renderer *r, const struct kd_scene *scene, const struct kd_plan_light *light)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->own && kd_emitters[i]->own->begin && light->traits[i])
            kd_emitters[i]->own->begin(r, scene);
}

enum kd_status kd_prepare_tell(struct kd_renderer *r, const struct kd_scene *scene, const struct kd_plan_light *light,
                               struct kd_emission *out, char *credit, size_t size, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_emitters[i]->own && kd_emitters[i]->own->tell && light->traits[i])
            KD_TRY(kd_emitters[i]->own->tell(r, scene, out, credit, size, error));
done:
    return status;
}

enum kd_status kd_prepare(struct kd_renderer *r, struct kd_prepared *prepared, const struct kd_scene *scene,
                          const struct kd_plan_light *light, const struct kd_capacity *c, struct kd_error *error)
{
    struct kd_emitter_buffers_work work;
    enum kd_status status = KD_OK;
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        if (!kd_emitters[i]->own || !light->traits[i])
            continue;
        KD_TRY(work_of(r, prepared, i, c, &work, error));
        KD_TRY(kd_emitters[i]->own->prepare(&work, scene, error));
    }
done:
    return status;
}

void kd_prepared_buffers(const struct kd_prepared *prepared, const struct kd_plan_light *light,
                         struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    for (int i = 0; i < KD_OWN_COUNT; i++)
        out[i] = NULL;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (prepared->own[i] && light->traits[i])
            kd_emitters[i]->own->buffers(prepared->own[i], out);
}

void kd_prepared_forget(struct kd_prepared *prepared)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (prepared->own[i])
            kd_emitters[i]->own->forget(prepared->own[i]);
}

void kd_prepared_finish(struct kd_prepared *prepared, struct kd_vk *vk)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++) {
        if (prepared->own[i])
            kd_emitters[i]->own->finish(prepared->own[i], vk);
        free(prepared->own[i]);
        prepared->own[i] = NULL;
    }
}

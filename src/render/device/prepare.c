#include "render/device/prepare.h"

#include "render/device/deposit.h"
#include "render/device/internal.h"
#include "render/device/skies.h"

const struct kd_preparation *const kd_preparations[KD_EMITTER_COUNT] = {
    [KD_EMITTER_particles] = &kd_prepare_particles,
    [KD_EMITTER_sky] = &kd_prepare_sky,
};

enum kd_status kd_prepare(struct kd_renderer *r, struct kd_prepared *prepared, const struct kd_scene *scene, const struct kd_plan *plan,
                          const struct kd_capacity *c, struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_preparations[i] && plan->traits[i])
            KD_TRY(kd_preparations[i]->prepare(r, prepared, scene, c, error));
done:
    return status;
}

void kd_prepared_buffers(const struct kd_prepared *prepared, const struct kd_plan *plan, struct kd_vk_buffer *out[KD_OWN_COUNT])
{
    for (int i = 0; i < KD_OWN_COUNT; i++)
        out[i] = NULL;
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_preparations[i] && plan->traits[i])
            kd_preparations[i]->buffers(prepared, out);
}

void kd_prepared_forget(struct kd_prepared *prepared)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_preparations[i])
            kd_preparations[i]->forget(prepared);
}

void kd_prepared_finish(struct kd_prepared *prepared, struct kd_vk *vk)
{
    for (int i = 0; i < KD_EMITTER_COUNT; i++)
        if (kd_preparations[i])
            kd_preparations[i]->finish(prepared, vk);
}

/* Completes rays through volumes that a driver stopped because of its limit on loops. The march lists these rays.
 * Here they continue in pieces, each in one dispatch. */
#include "render/frame/compilation.h"
#include "render/frame/lens.h"

/* Reads the counters of rays, which are stored at the end of the light's buffer. */
static enum kd_status read_counts(struct kd_frame_job *j, const struct kd_vk_dispatch *base,
                                  uint32_t counts[KD_LOST_WAITING])
{
    struct kd_vk_buffer *light = base->bindings[3].buffer;
    const uint64_t bytes = 4 * KD_LOST_WAITING;
    enum kd_status status;
    KD_TRY(kd_vk_copy(j->r->vk, base->pass, j->store->readback, 0, light, kd_vk_buffer_size(light) - bytes, bytes,
                      j->error));
    KD_TRY(kd_vk_submit(j->r->vk, NULL, j->error));
    KD_TRY(kd_vk_wait(j->r->vk, 0, j->error));
    const uint32_t *words = kd_vk_buffer_map(j->store->readback);
    for (int i = 0; i < KD_LOST_WAITING; i++)
        counts[i] = words[KD_LOST_WAITING - 1 - i];
done:
    return status;
}

static enum kd_status forget(struct kd_frame_job *j, const struct kd_vk_dispatch *base, int word, uint32_t words)
{
    struct kd_vk_buffer *light = base->bindings[3].buffer;
    return kd_vk_fill(j->r->vk, base->pass, light, kd_vk_buffer_size(light) - 4ull * (uint64_t)word, 4ull * words, 0,
                      j->error);
}

/* Continues ray number push->ray of each listed pixel, piece by piece, until all these rays have ended. */
static enum kd_status follow(struct kd_frame_job *j, struct kd_vk_dispatch *d, struct kd_slice *push,
                             const struct kd_critical_lattice *l)
{
    uint32_t counts[KD_LOST_WAITING];
    enum kd_status status;
    push->lost_goes = 0;
    do {
        KD_TRY(kd_frame_light_kernel(j, l, KD_MAKES_PIECES, &d->pipeline));
        KD_TRY(forget(j, d, KD_LOST_WAITING, 1));
        KD_TRY(kd_vk_dispatch(j->r->vk, d, j->error));
        KD_TRY(read_counts(j, d, counts));
        KD_TRY(kd_frame_report(j, 0));
        push->lost_goes = 1;
    } while (counts[KD_LOST_WAITING - 1]);
done:
    return status;
}

struct wanted {
    struct kd_frame_job *job;
    const struct kd_critical_lattice *lattice;
};

static enum kd_status ask(struct kd_renderer *r, const void *user)
{
    const struct wanted *w = user;
    const struct kd_vk_pipeline *later;
    (void)r;
    return kd_frame_light_kernel(w->job, w->lattice, KD_MAKES_PIECES, &later);
}

enum kd_status kd_frame_follow_lost(struct kd_frame_job *j, const struct kd_vk_dispatch *base,
                                    const struct kd_slice *march, const struct kd_critical_lattice *l, uint32_t turns)
{
    struct kd_slice push = *march;
    struct kd_vk_dispatch d = *base;
    uint32_t counts[KD_LOST_WAITING];
    enum kd_status status = KD_OK;
    if (!j->plan->light.march.steps)
        return KD_OK;
    KD_TRY(read_counts(j, base, counts));
    uint32_t listed = counts[KD_LOST_LISTED - 1];
    listed = listed < push.lost_most ? listed : push.lost_most;
    d.push = &push;
    if (listed)
        KD_TRY(kd_frame_await_kernels(j, ask, &(struct wanted) { j, l }));
    for (; push.lost_first < listed; push.lost_first += push.lost_n) {
        const uint32_t left = listed - push.lost_first;
        push.lost_n = left < KD_LOST_AT_ONCE ? left : KD_LOST_AT_ONCE;
        d.groups[0] = kd_frame_groups(push.lost_n);
        d.groups[1] = 1;
        for (push.ray = 0; push.ray < turns; push.ray++)
            KD_TRY(follow(j, &d, &push, l));
    }
    if (listed)
        KD_TRY(forget(j, base, KD_LOST_LISTED, 1));
done:
    return status;
}

enum kd_status kd_frame_forget_lost(struct kd_frame_job *j, struct kd_vk_buffer *light, const char *pass)
{
    const struct kd_vk_dispatch base = { .pass = pass, .bindings = { [3] = { light, 0, 0, true } } };
    return j->plan->light.march.steps ? forget(j, &base, KD_LOST_WAITING, KD_LOST_WAITING)
                                      : forget(j, &base, KD_LOST_GIVEN_UP, 1);
}

/* Chooses the buffers in which a frame is rendered. They are the renderer's own, or those of a background render that
 * no other frame uses meanwhile. */
#include "render/frame/job.h"
#include "render/frame/normalise.h"
#include "render/frame/parts.h"

/* An idle background render whose store has the plan's lens map; NULL if there is none. */
static struct kd_background_render *background_render_with(struct kd_renderer *r, const struct kd_plan *plan)
{
    for (size_t i = 0; i < KD_BACKGROUND_RENDERS; i++)
        if (!r->background_renders[i].busy && kd_store_has(&r->background_renders[i].store, plan))
            return &r->background_renders[i];
    return NULL;
}

static enum kd_status render_here(struct kd_renderer *renderer, const struct kd_scene *scene,
                                  const struct kd_plan *plan, const struct kd_light_sum *others,
                                  kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error)
{
    if (kd_plan_is_parted(&plan->picture))
        return kd_frame_parted(&(struct kd_parted) { renderer, scene, plan, false, progress, user }, out, error);
    struct kd_scene scaled = *scene;
    double scale = 1;
    enum kd_status status = kd_frame_normalise(renderer, &scaled, plan, progress, user, &scale, error);
    if (status)
        return status;
    struct kd_background_render *found =
        kd_store_has(&renderer->store, plan) ? NULL : background_render_with(renderer, plan);
    struct kd_frame_job job = {
        .r = renderer,
        .store = found ? &found->store : &renderer->store,
        .prepared = found ? &found->prepared : &renderer->prepared,
        .scene = &scaled,
        .plan = plan,
        .others = others,
        .progress = progress,
        .user = user,
        .error = error,
    };
    status = kd_frame_run(&job, out);
    if (!status)
        out->density_scale = scale;
    return status;
}

/* Empties the stores of idle background renders, the oldest first, until all stores and `bytes` more fit into half of
 * the memory. */
static void make_room_in_background(struct kd_renderer *r, uint64_t bytes)
{
    struct kd_capacity c;
    kd_renderer_capacity(r, &c);
    for (;;) {
        struct kd_background_render *oldest = NULL;
        uint64_t held = bytes;
        for (size_t i = 0; i < KD_BACKGROUND_RENDERS; i++) {
            struct kd_background_render *a = &r->background_renders[i];
            uint64_t own = kd_store_bytes(&a->store);
            held += own;
            if (!a->busy && own && (!oldest || a->used < oldest->used))
                oldest = a;
        }
        if (held <= c.memory_bytes / 2 || !oldest)
            return;
        kd_store_empty(&oldest->store);
    }
}

/* Limits the memory of idle background renders, except the last one, even if there is room for more. The oldest ones
 * are emptied first. */
static void bound_idle_backgrounds(struct kd_renderer *r)
{
    for (;;) {
        struct kd_background_render *oldest = NULL, *last = NULL;
        uint64_t held = 0;
        for (struct kd_background_render *a = r->background_renders; a < r->background_renders + KD_BACKGROUND_RENDERS;
             a++) {
            const uint64_t own = a->busy ? 0 : kd_store_bytes(&a->store);
            if (!own)
                continue;
            held += own;
            oldest = !oldest || a->used < oldest->used ? a : oldest;
            last = !last || a->used > last->used ? a : last;
        }
        if (oldest == last || held - kd_store_bytes(&last->store) <= KD_IDLE_ASIDES_BYTES)
            return;
        kd_store_empty(&oldest->store);
        kd_prepared_finish(&oldest->prepared, r->vk);
    }
}

static struct kd_background_render *enter_background_render(struct kd_renderer *r, const struct kd_plan *plan)
{
    struct kd_background_render *a = background_render_with(r, plan);
    for (size_t i = 0; i < KD_BACKGROUND_RENDERS && (!a || !kd_store_has(&a->store, plan)); i++)
        if (!r->background_renders[i].busy && (!a || r->background_renders[i].used < a->used))
            a = &r->background_renders[i];
    if (!a)
        return NULL;
    a->busy = true;
    a->used = ++r->backgrounds_used;
    make_room_in_background(r, plan->cost.device_bytes);
    if (!kd_store_has(&a->store, plan))
        kd_store_hand_over(&r->store, &a->store, plan);
    return a;
}

static enum kd_status render_background(struct kd_renderer *renderer, const struct kd_scene *scene,
                                        const struct kd_plan *plan, const struct kd_light_sum *others,
                                        kd_progress_fn progress, const struct kd_preview_hook *preview, void *user,
                                        struct kd_frame *out, struct kd_error *error)
{
    if (kd_plan_is_parted(&plan->picture))
        return kd_frame_parted(&(struct kd_parted) { renderer, scene, plan, true, progress, user }, out, error);
    struct kd_scene scaled = *scene;
    double scale = 1;
    const enum kd_status found = kd_frame_normalise(renderer, &scaled, plan, progress, user, &scale, error);
    if (found)
        return found;
    struct kd_background_render *a = enter_background_render(renderer, plan);
    if (!a)
        return kd_error_set(error, KD_EBUSY, "too many background pictures are being rendered (limit %u)",
                            KD_BACKGROUND_RENDERS);
    struct kd_frame_job job = {
        .r = renderer,
        .store = &a->store,
        .prepared = &a->prepared,
        .background = true,
        .scene = &scaled,
        .plan = plan,
        .others = others,
        .progress = progress,
        .preview = preview,
        .user = user,
        .error = error,
    };
    enum kd_status status = kd_frame_run(&job, out);
    a->busy = false;
    bound_idle_backgrounds(renderer);
    kd_renderer_count(renderer);
    if (!status)
        out->density_scale = scale;
    return status;
}

enum kd_status kd_render(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                         kd_progress_fn progress, void *user, struct kd_frame *out, struct kd_error *error)
{
    return render_here(renderer, scene, plan, NULL, progress, user, out, error);
}

enum kd_status kd_render_in_background(struct kd_renderer *renderer, const struct kd_scene *scene,
                                       const struct kd_plan *plan, kd_progress_fn progress,
                                       const struct kd_preview_hook *preview, void *user, struct kd_frame *out,
                                       struct kd_error *error)
{
    return render_background(renderer, scene, plan, NULL, progress, preview, user, out, error);
}

enum kd_status kd_render_mean(struct kd_renderer *renderer, const struct kd_scene *scene, const struct kd_plan *plan,
                              const struct kd_light_sum *others, bool background, kd_progress_fn progress,
                              const struct kd_preview_hook *preview, void *user, struct kd_frame *out,
                              struct kd_error *error)
{
    return background ? render_background(renderer, scene, plan, others, progress, preview, user, out, error)
                      : render_here(renderer, scene, plan, others, progress, user, out, error);
}

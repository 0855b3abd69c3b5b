/* Plans of pictures that are made of parts: two eyes, a tile, or strips of a picture that does not fit. */
#include "render/plan/parts.h"

#include "render/plan/lens_key.h"
#include "render/plan/tile.h"

#include <string.h>

#define STRIPS_MOST 1024u

/* Adds the resources of a picture that is made after this one. */
static void add(struct kd_plan *plan, const struct kd_plan *next)
{
    for (size_t i = 0; i < next->cost.n_passes; i++) {
        const struct kd_plan_pass *pass = &next->cost.passes[i];
        size_t k = 0;
        while (k < plan->cost.n_passes && strcmp(plan->cost.passes[k].name, pass->name))
            k++;
        if (k == plan->cost.n_passes)
            plan->cost.passes[plan->cost.n_passes++] =
                (struct kd_plan_pass) { pass->name, pass->kernel, 0, 0, pass->figure };
        plan->cost.passes[k].invocations += pass->invocations;
        plan->cost.passes[k].estimate_ms += pass->estimate_ms;
    }
    plan->cost.estimate_ms += next->cost.estimate_ms;
    plan->cost.device_bytes =
        plan->cost.device_bytes > next->cost.device_bytes ? plan->cost.device_bytes : next->cost.device_bytes;
    plan->lens.cacheable = plan->lens.cacheable && next->lens.cacheable;
}

static enum kd_status name_lens(struct kd_plan *plan, const struct kd_scene *scene, struct kd_error *error)
{
    return kd_plan_lens_key(plan, scene) ? kd_error_set(error, KD_ENOMEM, "out of memory while hashing the scene")
                                         : KD_OK;
}

static enum kd_status make_pair(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    const struct kd_scene left = kd_scene_eye(scene, -1), right = kd_scene_eye(scene, 1);
    struct kd_plan plan, next;
    enum kd_status status;
    if (needs->light && needs->no_image)
        KD_TRY(kd_error_field(error, "/camera/stereo",
                              "camera.stereo is \"pair\"; for a measurement of light it must be \"none\", because each "
                              "eye has its own flux"));
    KD_TRY(kd_plan_make_for(&left, needs, capacity, &plan, error));
    KD_TRY(kd_plan_make_for(&right, needs, capacity, &next, error));
    add(&plan, &next);
    plan.cost.host_bytes = 2 * (plan.cost.host_bytes +
                                next.cost.host_bytes); /* memory for each picture alone, and for both side by side */
    plan.picture.eyes = 2;
    kd_plan_say(&plan, scene);
    KD_TRY(name_lens(&plan, scene, error));
    *out = plan;
done:
    return status;
}

/* A tile has no flux and no centroid, because they would include the tile's margin. */
static struct kd_needs of_tile(const struct kd_needs *needs)
{
    struct kd_needs own = *needs;
    own.light = false;
    return own;
}

static enum kd_status make_tile(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    struct kd_window cut;
    const struct kd_scene wide = kd_tile_with_margin(scene, &cut);
    const struct kd_needs own = of_tile(needs);
    const enum kd_status status = kd_plan_one(&wide, &own, capacity, out, error);
    if (!status)
        out->picture.cut = cut;
    return status;
}

/* Sets *rest to the capacity that is left when the whole picture is on the host, both as pixels and as the encoded
 * file. Returns false if nothing is left. */
static bool rest_of(const struct kd_capacity *c, uint64_t host_bytes, struct kd_capacity *rest)
{
    const uint64_t whole = 2 * host_bytes;
    *rest = *c;
    if (!c->host_memory && c->host_bytes)
        rest->host_bytes = c->host_bytes > whole ? c->host_bytes - whole : 0;
    else if (c->host_memory)
        rest->memory_bytes = c->memory_bytes > whole ? c->memory_bytes - whole : 0;
    return (c->host_memory ? rest->memory_bytes : !c->host_bytes || rest->host_bytes) > 0;
}

/* Plans all n strips; the last strip may have fewer rows. */
static enum kd_status plan_strips(const struct kd_scene *scene, const struct kd_needs *needs,
                                  const struct kd_capacity *c, uint32_t n, struct kd_plan *out, struct kd_error *error)
{
    struct kd_plan sum, next;
    struct kd_capacity rest;
    enum kd_status status;
    struct kd_scene strip = kd_tile_strip(scene, n, 0);
    KD_TRY(make_tile(&strip, needs, c, &sum, error));
    const uint64_t host = sum.cost.host_bytes / sum.picture.height * kd_scene_window(scene).height;
    if (!rest_of(c, host, &rest))
        KD_TRY(kd_error_set(error, KD_ETOOBIG, "the whole picture does not fit on the host"));
    KD_TRY(make_tile(&strip, needs, &rest, &sum, error));
    for (uint32_t i = 1; i < kd_tile_strips(scene, n); i++) {
        strip = kd_tile_strip(scene, n, i);
        KD_TRY(make_tile(&strip, needs, &rest, &next, error));
        add(&sum, &next);
        sum.lens.rays += next.lens.rays;
        sum.lens.critical_pixels += next.lens.critical_pixels;
    }
    const struct kd_window window = kd_scene_window(scene);
    sum.picture.strips = n;
    sum.picture.width = window.width;
    sum.picture.height = window.height;
    sum.picture.cut = (struct kd_window) { 0 };
    sum.cost.host_bytes += host;
    sum.lens.cacheable = false;
    sum.lens.audit = 0;
    *out = sum;
done:
    return status;
}

static enum kd_status refuse_strips(struct kd_error *error, const struct kd_error *why)
{
    const struct kd_error whole = *error;
    return kd_error_set(error, KD_ETOOBIG, "%.250s; strips might fit, but %.200s", whole.message, why->message);
}

/* Uses as few strips as fit. Strips are not possible if the scene needs something that no tile can have. `error`
 * already says that the picture is too large. */
static enum kd_status make_strips(const struct kd_scene *scene, const struct kd_needs *needs,
                                  const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    const struct kd_scene strip = kd_tile_strip(scene, 2, 0);
    const struct kd_needs own = of_tile(needs);
    struct kd_error inner = { 0 };
    if (kd_tile_check(&strip, &own, &inner))
        return refuse_strips(error, &inner);
    for (uint32_t n = 2; n <= STRIPS_MOST; n *= 2) {
        const enum kd_status status = plan_strips(scene, needs, capacity, n, out, &inner);
        if (!status)
            return name_lens(out, scene, error);
        if (status != KD_ETOOBIG) {
            *error = inner;
            return status;
        }
    }
    return KD_ETOOBIG;
}

/* True if some number of strips may fit. The check does not consider the list of pixels at the critical curve. It
 * uses the first strip, because no other strip has more rows. */
static enum kd_status check_strips(const struct kd_scene *scene, const struct kd_needs *needs,
                                   const struct kd_capacity *capacity, struct kd_error *error)
{
    struct kd_scene strip = kd_tile_strip(scene, 2, 0);
    const struct kd_needs own = of_tile(needs);
    struct kd_error inner = { 0 };
    if (kd_tile_check(&strip, &own, &inner))
        return refuse_strips(error, &inner);
    for (uint32_t n = 2; n <= STRIPS_MOST; n *= 2) {
        strip = kd_tile_strip(scene, n, 0);
        strip = kd_tile_with_margin(&strip, NULL);
        if (!kd_plan_one_fits(&strip, &own, capacity, &inner))
            return KD_OK;
    }
    return KD_ETOOBIG;
}

enum kd_status kd_plan_make_for(const struct kd_scene *scene, const struct kd_needs *needs,
                                const struct kd_capacity *capacity, struct kd_plan *out, struct kd_error *error)
{
    enum kd_status status = kd_scene_has_tile(scene) ? kd_tile_check(scene, needs, error) : KD_OK;
    if (status)
        return status;
    if (scene->camera.stereo == KD_STEREO_PAIR)
        return make_pair(scene, needs, capacity, out, error);
    status = (kd_scene_has_tile(scene) ? make_tile : kd_plan_one)(scene, needs, capacity, out, error);
    return status == KD_ETOOBIG ? make_strips(scene, needs, capacity, out, error) : status;
}

enum kd_status kd_plan_check(const struct kd_scene *scene, const struct kd_capacity *capacity, struct kd_error *error)
{
    const struct kd_needs needs = kd_needs_of(scene), own = of_tile(&needs);
    const struct kd_scene first = scene->camera.stereo == KD_STEREO_PAIR ? kd_scene_eye(scene, -1) : *scene;
    enum kd_status status = kd_scene_has_tile(scene) ? kd_tile_check(scene, &needs, error) : KD_OK;
    if (status)
        return status;
    const struct kd_scene wide = kd_tile_with_margin(&first, NULL);
    status = kd_scene_has_tile(scene) ? kd_plan_one_fits(&wide, &own, capacity, error)
                                      : kd_plan_one_fits(&first, &needs, capacity, error);
    return status == KD_ETOOBIG ? check_strips(&first, &needs, capacity, error) : status;
}

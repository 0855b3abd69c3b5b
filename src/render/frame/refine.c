/* Refinement: traces more rays, in rounds, where one ray a pixel is not enough.
 *
 * One ray a pixel has an error of up to half of the change across the pixel. Where the picture is linear from pixel to
 * pixel, a ray in the middle of each pixel is exact whatever the slope. So the criterion is the second difference of
 * displayed values. Pixels with a large second difference are refined first. In later rounds the neighbours of pixels
 * that changed are refined, until no pixel changes, in at most KD_PLAN_ROUNDS rounds. A line or rim is thus followed to
 * its end, even if one ray a pixel hit it only in some places.
 *
 * A chosen pixel has a square grid of rays. If the lens map is smooth around the pixel, these rays are interpolated
 * from existing rays. At edges of orders and fates they are traced. The total of traced rays is at most four times
 * the number of pixels. Pixels at the critical curve have more rays already (view/critical_pixels.h). */
#include "render/frame/choose.h"
#include "render/frame/lens.h"

#include <stdlib.h>
#include <string.h>

/* now: the displayed picture; before: the displayed picture before this round */
struct work { uint16_t *now, *before; };

static void finish(struct work *w)
{
    free(w->now);
    free(w->before);
}

static enum kd_status init(struct kd_frame_job *j, struct work *w)
{
    const size_t pixels = (size_t)j->plan->picture.width * j->plan->picture.height;
    *w = (struct work) { malloc(6 * pixels), malloc(6 * pixels) };
    j->kinds = calloc(pixels, 1);
    return w->now && w->before && j->kinds
               ? KD_OK
               : kd_error_set(j->error, KD_ENOMEM, "out of memory for the pixels that need more rays");
}

static void take(struct kd_frame_job *j, const struct kd_critical_pixels *list, uint8_t kind)
{
    for (size_t i = 0; i < list->n; i++)
        j->kinds[list->pixels[i].y * (size_t)j->plan->picture.width + list->pixels[i].x] = kind;
}

/* The pixels of a round, row by row, by the source of their rays. AT_CURVE: at the critical curve, where pixels already
 * have more rays. FOLLOWED: traced rays. BETWEEN: interpolated rays. */
enum { AT_CURVE, FOLLOWED, BETWEEN, WAYS };
static const uint8_t kind_of[WAYS] = { KD_REFINED_AT_CURVE, KD_REFINED_FOLLOWED, KD_REFINED_BETWEEN };
struct ways { struct kd_choice of[WAYS]; };

static void ways_finish(struct ways *w)
{
    for (int i = 0; i < WAYS; i++)
        kd_choice_finish(&w->of[i]);
}

static enum kd_status light(struct kd_frame_job *j, int way, const struct kd_critical_pixels *pixels)
{
    const struct kd_plan *p = j->plan;
    struct kd_frame_list list = {
        .pixels = pixels,
        .lattice = kd_critical_grid(KD_PLAN_ADAPTIVE_SIDE),
        .camera = KD_CAMERA_DENSE,
        .buffers = &j->store->listed,
        .again = true,
        .between = way == BETWEEN,
        .layers = true,
        .pass = kd_passes[KD_PASS_REFINE].name,
    };
    if (way == AT_CURVE) {
        list.lattice = kd_critical_lattice(p->lens.critical_dense);
        list.camera = KD_CAMERA_DENSE_CRITICAL;
    }
    list.most = kd_plan_listed_most(&p->lens, list.lattice.rays);
    return kd_frame_light_list(j, &list, true);
}

/* Divides the chosen pixels by the source of their rays. marks: for each chosen pixel, 1 if interpolation is
 * accurate. */
static enum kd_status part(struct kd_frame_job *j, const struct kd_choice *c, const uint8_t *marks, struct ways *to)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < c->list.n && !status; i++) {
        const struct kd_pixel p = c->list.pixels[i];
        const bool at_curve = j->kinds[p.y * (size_t)j->plan->picture.width + p.x] == KD_REFINED_NOT_AT_CURVE;
        status = kd_choice_add(&to->of[at_curve ? AT_CURVE : marks[i] ? BETWEEN : FOLLOWED], p, c->scores[i], j->error);
    }
    return status;
}

/* Gives the chosen pixels their rays. *left: number of rays that may still be traced. Pixels at the critical curve get
 * at most half of these rays. If there are not enough rays for all chosen pixels, only the pixels with the largest
 * scores get more rays. */
static enum kd_status one_round(struct kd_frame_job *j, const struct kd_choice *c, struct ways *by, uint64_t *left)
{
    uint8_t *marks = malloc(c->list.n);
    enum kd_status status =
        marks ? KD_OK : kd_error_set(j->error, KD_ENOMEM, "out of memory for the pixels that need more rays");
    KD_TRY(status);
    KD_TRY(kd_frame_mark_between(j, &c->list, marks));
    KD_TRY(part(j, c, marks, by));
    if (j->plan->lens.critical_dense)
        kd_choose_largest(&by->of[AT_CURVE], *left / 2 / j->plan->lens.critical_dense);
    *left -= by->of[AT_CURVE].list.n * j->plan->lens.critical_dense;
    kd_choose_largest(&by->of[FOLLOWED], *left / j->plan->lens.adaptive);
    *left -= by->of[FOLLOWED].list.n * j->plan->lens.adaptive;
    for (int way = 0; way < WAYS; way++) {
        KD_TRY(light(j, way, &by->of[way].list));
        take(j, &by->of[way].list, kind_of[way]);
    }
    j->frame->accuracy.refined += by->of[AT_CURVE].list.n + by->of[FOLLOWED].list.n;
    j->frame->accuracy.between += by->of[BETWEEN].list.n;
done:
    free(marks);
    return status;
}

static enum kd_status rounds(struct kd_frame_job *j, struct work *w)
{
    const double off = j->scene->image.pixel_error;
    const struct kd_shown now = { w->now, j->kinds, KD_REFINED_AT_CURVE, j->plan->picture.width,
                                  j->plan->picture.height };
    const uint64_t most = kd_plan_followed_most(&j->plan->lens);
    uint64_t left = most;
    struct ways by = { 0 };
    struct kd_choice choice = { 0 };
    enum kd_status status = KD_OK;
    if (j->plan->lens.critical)
        take(j, &j->lens->pixels, KD_REFINED_NOT_AT_CURVE);
    KD_TRY(kd_frame_bare(j, w->now));
    KD_TRY(kd_choose_bent(&now, off, &choice, j->error));
    for (int round = 0; choice.list.n && round < KD_PLAN_ROUNDS; round++) {
        struct kd_critical_pixels lists[WAYS];
        KD_TRY(one_round(j, &choice, &by, &left));
        for (int way = 0; way < WAYS; way++)
            lists[way] = by.of[way].list;
        kd_choice_finish(&choice);
        memcpy(w->before, w->now, 6ull * now.width * now.height);
        KD_TRY(kd_frame_bare(j, w->now));
        KD_TRY(kd_choose_beside(&now, w->before, lists, WAYS, off, &choice, j->error));
        ways_finish(&by);
    }
done:
    j->frame->accuracy.followed = most - left;
    ways_finish(&by);
    kd_choice_finish(&choice);
    return status;
}

/* For a device that only compiles. Such a device would choose no pixel, so this refines one pixel with each source of
 * rays, to compile the kernels. */
static enum kd_status rehearse(struct kd_frame_job *j)
{
    struct kd_pixel pixel = { 0, 0 };
    const struct kd_critical_pixels one = { &pixel, 1 };
    uint8_t mark;
    enum kd_status status;
    if (j->plan->lens.critical)
        take(j, &j->lens->pixels, KD_REFINED_NOT_AT_CURVE);
    KD_TRY(kd_frame_mark_between(j, &one, &mark));
    for (int way = 0; way < WAYS; way++)
        if ((way != AT_CURVE || j->plan->lens.critical_dense) && (way != BETWEEN || kd_frame_has_between(j)))
            KD_TRY(light(j, way, &one));
done:
    return status;
}

enum kd_status kd_frame_refine(struct kd_frame_job *j)
{
    struct work w;
    enum kd_status status = init(j, &w);
    if (!status)
        status = j->r->opening.compiles_only ? rehearse(j) : rounds(j, &w);
    finish(&w);
    return status;
}

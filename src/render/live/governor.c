#include "render/live/governor.h"

#include "base/hash.h"
#include "scene/dynamic_bodies.h"

#include <math.h>
#include <string.h>

/* These constants were chosen by the simulations of tests/unit/governor.c, with noise of 25 % and one frame in
 * twenty ten times as long. */
/* OVER, FAR_OVER, CLIMB_BELOW: fractions of the budget. CLIMB_BELOW is far enough below OVER that noise does not
 * cause a move down and up again. */
static const double OVER = 1.1, FAR_OVER = 1.5, CLIMB_BELOW = 0.8;
static const double MORE = 1.1; /* factor by which a target must change to count as different, because shares of a
                                 * device fluctuate a little */
static const double LEAST_ROOM = 0.5, LEAST_SHARE = 0.25; /* least budget: LEAST_ROOM as a fraction of the target,
                                                             LEAST_SHARE as a fraction of the fixed part */
static const double COOLDOWN_MS = 1000;                   /* least time on a rung before a climb */
/* time before climbing again to a rung that was too slow; doubled at each failure */
static const double RETRY_MS = 3000;
static const double SETTLE_MS = 50; /* time in which a user reacts to a frame with the next change */
/* HOLD_MS: pause up to which changes belong to one drag; HOLD_MAX_MS: largest value of this pause */
static const double HOLD_MS = 400, HOLD_MAX_MS = 2000;
/* time for which lens maps are assumed not to be cached; doubled at each repetition */
static const double BLIND_MS = 2000;
/* narrowest width, as a fraction of the requested width, whatever kd_governor_least says */
static const double NARROWEST = 0.25;
/* frames of the requested width are tried again when they are estimated to take less than this fraction of
 * max_frame_ms */
static const double PATIENT_AGAIN = 0.6;
enum {
    MOVING_AUDIT = 4, /* in frames that will be refined, one in this many of the sampled rays is audited */
    /* image.critical_factor for a picture that is replaced before the eye can examine it: 4 rays instead of 16 */
    DRAGGED_CRITICAL = 2,
    FEW = 4, /* this many slow frames in a row are a sign of load; fewer may be a spike */
    /* least number of frames for a mean: the middle half of so many frames contains neither of two spikes */
    ENOUGH = 8,
    MISSES = 3, /* number of lens maps that may be missing when the rung changes */
};

/* Resets the measurements of a pace, which stays on its rung. */
static void begin_anew(struct kd_pace *pace)
{
    *pace =
        (struct kd_pace) { .rung = pace->rung, .changed_at = -INFINITY, .failed_at = -INFINITY, .retry_ms = RETRY_MS };
}

void kd_governor_init(struct kd_governor *governor, const struct kd_governor_params *params)
{
    *governor = (struct kd_governor) { .params = *params, .share = 1, .hold_ms = HOLD_MS, .blind_ms = BLIND_MS };
    governor->changed_at = governor->lens_at = governor->blind_until = -INFINITY;
    governor->least = params->bounds.scale;
    governor->patience_ms = INFINITY;
    for (int i = 0; i < 2; i++)
        begin_anew(&governor->paces[i]);
}

/* Costs of frames */

static uint32_t at_most(uint32_t n, uint32_t limit) { return n < limit ? n : limit; }

static const struct kd_frame_cost *latest(const struct kd_pace *pace, uint32_t back)
{
    return &pace->costs[(pace->count - 1 - back) % KD_PACE_FRAMES];
}

static void add(struct kd_frame_cost *sum, const struct kd_frame_cost *cost, double weight)
{
    sum->fixed_ms += weight * cost->fixed_ms;
    sum->rays_ms += weight * cost->rays_ms;
    sum->pixels_ms += weight * cost->pixels_ms;
    sum->total_ms += weight * cost->total_ms;
}

/* Estimates the cost from the cheapest of a few frames: compiling a kernel and load only increase the cost. */
static struct kd_frame_cost cheapest_of_latest(const struct kd_pace *pace, uint32_t n)
{
    const struct kd_frame_cost *least = latest(pace, 0);
    for (uint32_t i = 1; i < n; i++)
        if (latest(pace, i)->total_ms < least->total_ms)
            least = latest(pace, i);
    return *least;
}

/* Mean over the middle half of the window, sorted by total time. So spikes and empty frames do not affect the mean.
 * If two kinds of frames alternate, the mean lies between their costs, whereas a median would be one of the two
 * costs. */
static struct kd_frame_cost mean_of_middle(const struct kd_pace *pace)
{
    const struct kd_frame_cost *sorted[KD_PACE_FRAMES];
    uint32_t n = at_most(pace->count, KD_PACE_FRAMES);
    for (uint32_t i = 0; i < n; i++) {
        uint32_t j = i;
        for (; j > 0 && sorted[j - 1]->total_ms > latest(pace, i)->total_ms; j--)
            sorted[j] = sorted[j - 1];
        sorted[j] = latest(pace, i);
    }
    struct kd_frame_cost mean = { 0 };
    for (uint32_t i = n / 4; i < n - n / 4; i++)
        add(&mean, sorted[i], 1.0 / (n - 2 * (n / 4)));
    return mean;
}

/* The part of a frame's time that may change with the frame's size. */
static double varying(const struct kd_frame_cost *cost) { return cost->total_ms - cost->fixed_ms; }

/* Time for a frame: the session's share of the time between frames. */
static double target(const struct kd_governor *g)
{
    return g->share * fmax(g->params.target_ms, fmin(g->params.target_ms / sqrt(g->share), g->params.sparse_ms));
}

static double room(const struct kd_governor *g, const struct kd_frame_cost *cost)
{
    double all = target(g);
    return fmax(all - cost->fixed_ms, fmax(LEAST_ROOM * all, LEAST_SHARE * cost->fixed_ms));
}

/* Predicts the varying time of a frame on another rung. Time that belongs neither to rays nor to pixels may stay
 * constant, or may grow with the pixels. */
static double predict(const struct kd_frame_cost *cost, const struct kd_rung *from, const struct kd_rung *to,
                      bool rest_stays)
{
    double pixels = to->pixels / from->pixels, rest = varying(cost) - cost->rays_ms - cost->pixels_ms;
    return cost->rays_ms * to->rays / from->rays + cost->pixels_ms * pixels + (rest_stays ? rest : rest * pixels);
}

/* The lowest rung that a pace may take. If only brightness changes, one picture of full size is more useful to
 * viewers than many small ones. */
static uint32_t last_rung(const struct kd_governor *g, const struct kd_pace *pace)
{
    uint32_t last = (uint32_t)g->ladder.n_rungs - 1;
    while (last > 0 && g->rings && pace == &g->paces[0] && g->ladder.rungs[last].quality.scale < 1)
        last--;
    return last;
}

static uint32_t first_that_fits(const struct kd_governor *g, const struct kd_pace *pace,
                                const struct kd_frame_cost *cost, const struct kd_rung *from, uint32_t first)
{
    uint32_t last = last_rung(g, pace), to = at_most(first, last);
    while (to < last && predict(cost, from, &g->ladder.rungs[to], false) > room(g, cost))
        to++;
    return to;
}

/* Moves up and down the ladder */

/* Called when a pace leaves its rung. narrower: true if it leaves because other sessions began; the rung is then
 * remembered. */
static void hold(struct kd_pace *pace, bool narrower)
{
    if (!narrower && pace->rung <= pace->held) {
        pace->held_target = 0; /* frames of the rung are no longer in time */
    } else if (narrower && (pace->widest > pace->held_target || pace->rung < pace->held)) {
        pace->held = pace->rung;
        pace->held_target = pace->widest;
    }
}

/* cost: cost of frames on the rung that is left; NULL: unknown. */
static void move(const struct kd_governor *g, struct kd_pace *pace, const struct kd_frame_cost *cost, uint32_t rung,
                 bool up, double now)
{
    if (cost) {
        pace->other = g->ladder.rungs[pace->rung];
        pace->other_ms = cost->rays_ms;
    }
    const bool narrower = MORE * target(g) < pace->widest; /* the rung was in time before other sessions began */
    if (pace->climbed && !up && !narrower)
        pace->retry_ms *= 2;
    if (!up)
        hold(pace, narrower);
    pace->ceiling = up ? at_most(pace->ceiling, rung) : pace->rung + 1;
    if (!up) {
        pace->failed_at = now;
        pace->failed_target = target(g);
    }
    pace->climbed = up;
    pace->rung = rung;
    pace->count = 0;
    pace->changed_at = now;
    pace->widest = target(g);
}

static bool far_over(const struct kd_governor *g, const struct kd_pace *pace)
{
    for (uint32_t i = 0; i < at_most(pace->count, FEW); i++)
        if (varying(latest(pace, i)) <= FAR_OVER * room(g, latest(pace, i)))
            return false;
    return pace->count > 1;
}

/* True if frames that reuse a lens map may take this rung: tracing the rung's map must not take longer than the
 * limit. */
static bool traceable(const struct kd_governor *g, const struct kd_pace *pace, const struct kd_rung *rung, double limit)
{
    return pace != &g->paces[0] || g->traced_on.rays == 0 || predict(&g->traced, &g->traced_on, rung, true) <= limit;
}

static bool may_climb(const struct kd_governor *g, const struct kd_pace *pace, const struct kd_frame_cost *cost,
                      uint32_t to, bool rest_stays)
{
    const struct kd_rung *rungs = g->ladder.rungs;
    return predict(cost, &rungs[pace->rung], &rungs[to], rest_stays) <= CLIMB_BELOW * room(g, cost) &&
           traceable(g, pace, &rungs[to], CLIMB_BELOW * g->share * g->params.stall_ms);
}

/* Returns a rung on which frames are known to be in time with the present target. If there is none, returns the
 * present rung. */
static uint32_t known_good(const struct kd_governor *g, const struct kd_pace *pace)
{
    bool enough = pace->held_target > 0 && MORE * target(g) >= pace->held_target;
    return enough && pace->held < pace->rung &&
                   traceable(g, pace, &g->ladder.rungs[pace->held], g->share * g->params.stall_ms)
               ? pace->held
               : pace->rung;
}

/* The rung that the pace may not climb to, because frames there were too slow with at least the present target. */
static uint32_t ceiling_of(const struct kd_governor *g, const struct kd_pace *pace, double now)
{
    return now - pace->failed_at < pace->retry_ms && target(g) <= MORE * pace->failed_target ? pace->ceiling : 0;
}

/* Estimates which fraction of the rays' time on this rung does not depend on size. The estimate is a straight line
 * through two measured times: the present one, and one at another size a moment ago. If the smaller size took longer,
 * only the machine's load has changed. */
static void learn(const struct kd_governor *g, struct kd_pace *pace, const struct kd_frame_cost *cost)
{
    const struct kd_rung *here = &g->ladder.rungs[pace->rung], *other = &pace->other;
    if (other->rays > 0 && other->pixels != here->pixels && cost->rays_ms > 0) {
        const double per_ray = (pace->other_ms - cost->rays_ms) / (other->rays - here->rays);
        pace->tried = true;
        if (per_ray > 0)
            pace->stays = fmax(0, 1 - per_ray * here->rays / cost->rays_ms);
    }
    pace->other.rays = 0;
}

/* True if a frame one rung up would be in time, assuming that a given fraction of the rays' time is independent of
 * size. */
static bool may_climb_if(const struct kd_governor *g, const struct kd_pace *pace, const struct kd_frame_cost *cost,
                         double part)
{
    const struct kd_rung *rungs = g->ladder.rungs, *here = &rungs[pace->rung], *to = here - 1;
    const double stays = part * cost->rays_ms;
    struct kd_frame_cost line = *cost;
    line.rays_ms -= stays;
    line.total_ms -= stays;
    return stays > 0 && stays + predict(&line, here, to, false) <= CLIMB_BELOW * room(g, cost) &&
           traceable(g, pace, to, CLIMB_BELOW * g->share * g->params.stall_ms);
}

/* Climbs as far as is safe. If no rung is safe, climbs one rung on a more favourable assumption. If that rung turns out
 * to be too slow, the pace leaves it and does not try it again soon. */
static void climb(const struct kd_governor *g, struct kd_pace *pace, const struct kd_frame_cost *cost, double now)
{
    uint32_t ceiling = ceiling_of(g, pace, now), to = known_good(g, pace);
    while (to > ceiling && may_climb(g, pace, cost, to - 1, false))
        to--;
    if (to == pace->rung && to > ceiling &&
        (may_climb(g, pace, cost, to - 1, true) || may_climb_if(g, pace, cost, pace->stays))) {
        to--;
    } else if (to == pace->rung && to > ceiling && !pace->tried && may_climb_if(g, pace, cost, 1)) {
        pace->tried = true;
        to--;
    }
    if (to < pace->rung)
        move(g, pace, cost, to, true, now);
}

static void spare_a_stall(struct kd_governor *g, double now)
{
    struct kd_pace *pace = &g->paces[0];
    uint32_t last = last_rung(g, pace), to = pace->rung;
    while (to < last && !traceable(g, pace, &g->ladder.rungs[to], g->share * g->params.stall_ms))
        to++;
    if (to > pace->rung)
        move(g, pace, NULL, to, false, now);
}

/* Changes of ladder */

static void change_ladder(struct kd_governor *g, const struct kd_scene *asked)
{
    struct kd_ladder old = g->ladder;
    kd_ladder_make(asked, &g->params.bounds, &g->ladder);
    for (int i = 0; i < 2 && g->ladders; i++) {
        struct kd_pace *pace = &g->paces[i];
        struct kd_frame_cost cost = mean_of_middle(pace);
        pace->rung = pace->count ? first_that_fits(g, pace, &cost, &old.rungs[pace->rung], 0)
                                 : at_most(pace->rung, (uint32_t)g->ladder.n_rungs - 1);
        pace->ceiling = pace->count = 0;
        pace->held_target = 0;
        pace->other.rays = pace->stays = 0;
        pace->tried = false;
        pace->climbed = false;
    }
    g->ladders++;
}

/* Sets whether frames of this pace may be narrower than the requested least width because they were too slow. */
static void give_way(struct kd_governor *g, const struct kd_pace *pace, bool whether)
{
    g->gave_way = whether;
    g->wide_ms = g->stays_of = 0;
    g->slow = pace == &g->paces[1];
    g->params.bounds.scale = whether ? fmin(NARROWEST, g->least) : g->least;
    if (g->ladders)
        change_ladder(g, &g->asked);
}

/* Gives up the requested least width for this pace. The cost of its frames is kept, for comparison with the narrower
 * frames that follow. */
static void give_up_width(struct kd_governor *g, const struct kd_pace *pace, const struct kd_frame_cost *cost)
{
    const struct kd_rung wide = g->ladder.rungs[pace->rung];
    give_way(g, pace, true);
    g->wide_ms = varying(cost);
    g->wide = wide;
}

/* Measures, once, the fraction of the time of narrow frames that does not depend on size. The first narrow frames are
 * used, because the machine's load is then still the same. */
static void compare_with_wide(struct kd_governor *g, const struct kd_frame_cost *cost, const struct kd_rung *here)
{
    if (!(g->wide_ms > 0) || !(varying(cost) > 0) || here->rays >= g->wide.rays)
        return;
    const double more = g->wide.rays / here->rays, dearer = g->wide_ms / varying(cost);
    g->stays = fmin((more - dearer) / (more - 1), 1); /* negative if rays cost more on the rung than assumed */
    g->stays_of = here->rays;
    g->wide_ms = 0;
}

/* Predicts the varying time of frames on a rung of the wide ladder. */
static double predict_wide(const struct kd_governor *g, const struct kd_frame_cost *cost, const struct kd_rung *here,
                           const struct kd_rung *wide)
{
    const double stays = g->stays * g->stays_of, shrinks = 1 - g->stays, now = stays + shrinks * here->rays;
    return g->stays_of > 0 && now > 0 ? varying(cost) * (stays + shrinks * wide->rays) / now
                                      : predict(cost, here, wide, false);
}

/* True if frames of the requested least width would now take well less than the patience; estimated from a narrower
 * frame. */
static bool is_quick_as_asked(const struct kd_governor *g, const struct kd_frame_cost *cost, const struct kd_rung *here)
{
    struct kd_ladder_bounds bounds = g->params.bounds;
    struct kd_ladder ladder;
    bounds.scale = g->least;
    kd_ladder_make(&g->asked, &bounds, &ladder);
    return cost->fixed_ms + predict_wide(g, cost, here, &ladder.rungs[ladder.n_rungs - 1]) <=
           PATIENT_AGAIN * g->share * g->patience_ms;
}

static void decide(struct kd_governor *g, struct kd_pace *pace, double now)
{
    const struct kd_rung *here = &g->ladder.rungs[pace->rung];
    bool far = far_over(g, pace);
    if (!far && pace->count < ENOUGH)
        return;
    struct kd_frame_cost cost = far ? cheapest_of_latest(pace, at_most(pace->count, FEW)) : mean_of_middle(pace);
    learn(g, pace, &cost);
    if (g->gave_way && pace == &g->paces[g->slow])
        compare_with_wide(g, &cost, here);
    if (pace == &g->paces[1]) {
        g->traced = cost;
        g->traced_on = *here;
        spare_a_stall(g, now);
    }
    if (far || varying(&cost) > OVER * room(g, &cost)) {
        if (pace->rung < last_rung(g, pace))
            move(g, pace, &cost, first_that_fits(g, pace, &cost, here, pace->rung + 1), false, now);
        else if (!g->gave_way && g->least > NARROWEST && cost.total_ms > g->share * g->patience_ms)
            give_up_width(g, pace, &cost);
        return;
    }
    if (g->gave_way && pace == &g->paces[g->slow] && is_quick_as_asked(g, &cost, here)) {
        give_way(g, pace, false);
        return;
    }
    if (now - pace->changed_at >= COOLDOWN_MS)
        climb(g, pace, &cost, now);
}

/* Changes of the scene */

void kd_governor_share(struct kd_governor *g, double share)
{
    g->share = share;
    for (int i = 0; i < 2; i++)
        g->paces[i].widest = fmax(g->paces[i].widest, target(g));
}

static bool same_ladder(const struct kd_scene *a, const struct kd_scene *b)
{
    const struct kd_image *i = &a->image, *j = &b->image;
    const struct kd_accuracy *p = &a->accuracy, *q = &b->accuracy;
    return i->width == j->width && i->height == j->height && i->samples == j->samples && p->profile == q->profile &&
           p->tolerance == q->tolerance && p->engine == q->engine && p->precision == q->precision &&
           p->steps == q->steps && p->orders == q->orders && kd_emit_along(a) == kd_emit_along(b);
}

/* Properties of a scene, besides its size, that determine the cost of its frames: its emitters, and the kind of its
 * rays. */
static struct kd_work work_of(const struct kd_scene *scene)
{
    struct kd_work work = kd_emit_work(scene);
    const uint64_t parts[] = { work.kind, (uint64_t)scene->camera.projection, isinf(scene->camera.r) };
    work.kind = kd_hash(KD_HASH_BEGIN, parts, sizeof parts);
    return work;
}

void kd_governor_least(struct kd_governor *g, double scale, double patience_ms)
{
    if (g->least == scale && g->patience_ms == patience_ms)
        return;
    g->least = scale;
    g->patience_ms = patience_ms;
    give_way(g, &g->paces[1], false);
}

/* True if the scenes differ only in their motion, which does not affect a single picture. */
static bool motion_alone(const struct kd_scene *a, const struct kd_scene *b)
{
    struct kd_scene still = *b;
    still.motion = a->motion;
    return !memcmp(a, &still, sizeof still) &&
           memcmp(a, b, sizeof still); /* equal scenes have equal bytes: kd_scene_defaults */
}

void kd_governor_changed(struct kd_governor *g, double now, const struct kd_scene *shown, bool lens)
{
    const struct kd_work work = work_of(shown);
    struct kd_scene still = *shown;
    const struct kd_scene *const asked = &still;
    /* bodies of a playground are counted only in the scene's work, because their memory may be freed after this call */
    kd_scene_show(&still, NULL);
    /* If the scene does not move and only its motion was changed, the picture shown is already right. The scene is
     * rendered once more nevertheless. */
    bool told_again = g->ladders && !lens && g->shown_revision == g->revision && motion_alone(&g->asked, asked) &&
                      !kd_emit_moves(asked);
    const bool same_work = kd_work_alike(&work, &g->work);
    if (g->gave_way && !(same_ladder(&g->asked, asked) && same_work))
        give_way(g, &g->paces[1], false); /* for another kind of scene the requested width is tried again */
    if (!g->ladders || !same_ladder(&g->asked, asked))
        change_ladder(g, asked);
    for (int i = 0; i < 2 && !same_work; i++)
        begin_anew(&g->paces[i]);
    bool rings = kd_emit_only_dims(asked);
    if (g->rings != rings) {
        begin_anew(&g->paces[0]);
        g->rings = rings;
        g->paces[0].rung = at_most(g->paces[0].rung, last_rung(g, &g->paces[0]));
        g->lens_at = -INFINITY; /* the camera does not move, so this change does not count as a drag */
    }
    g->asked = *asked;
    if (!same_work) /* the work at the start of the measurements is kept, so that many small changes are noticed
                     * together */
        g->work = work;
    g->revision++;
    g->changed_at = now;
    if (told_again) {
        g->shown_revision = g->revision;
        g->shown.final = false;
    }
    if (!lens)
        return;
    /* A lens change soon after the hold ended belongs to the same drag, so the hold is lengthened. */
    double gap = now - g->lens_at;
    g->hold_ms = gap >= HOLD_MAX_MS ? HOLD_MS : fmin(fmax(g->hold_ms, 2 * gap), HOLD_MAX_MS);
    g->lens_at = now;
}

/* Takes the rung that fits the expected cost, unless more than `known` frames were measured. */
static void expect(struct kd_governor *g, const struct kd_frame_cost *cost, const struct kd_rung *of, uint32_t known)
{
    struct kd_pace *pace = &g->paces[!cost->lens_reused];
    uint32_t rung = first_that_fits(g, pace, cost, of, 0);
    if (pace->count > known || !isinf(pace->changed_at) || rung == pace->rung)
        return;
    pace->rung = rung;
    pace->count = 0;
}

void kd_governor_expect(struct kd_governor *g, const struct kd_frame_cost *cost)
{
    if (g->ladders)
        expect(g, cost, &g->ladder.rungs[0], 0);
}

/* Decisions */

static struct kd_frame_decision next_step(const struct kd_governor *g, struct kd_frame_decision decision)
{
    size_t i = 0;
    while (i + 1 < g->ladder.n_steps && g->ladder.steps[i].rays <= g->shown_rays)
        i++;
    decision.quality = g->ladder.steps[i].quality;
    decision.rays = g->ladder.steps[i].rays;
    decision.refining = true;
    decision.audit = 1;
    return decision;
}

struct kd_frame_decision kd_governor_decide(const struct kd_governor *g, double now)
{
    const bool moves = now - g->lens_at < g->hold_ms, traced = moves || now < g->blind_until;
    struct kd_frame_decision decision = {
        .traced = traced, .ladder = g->ladders, .rung = g->paces[traced].rung, .revision = g->revision
    };
    decision.quality = g->ladder.rungs[decision.rung].quality;
    decision.quality.bright = traced && decision.rung;
    decision.quality.critical = moves && decision.rung ? DRAGGED_CRITICAL : 0;
    decision.rays = g->ladder.rungs[decision.rung].rays;
    decision.audit = decision.quality.final && g->share >= 1 ? 1 : MOVING_AUDIT;
    if (g->shown_revision != g->revision)
        return decision;
    double since = g->share < 1 ? fmax(g->changed_at, g->shown_at) : g->changed_at,
           left = fmax(g->params.rest_ms - (now - since), SETTLE_MS - (now - g->shown_at));
    if (!g->shown.final && left < 1e-3) /* the sum of rounded waits may end slightly early */
        return next_step(g, decision);
    decision.quality = g->shown;
    decision.wait_ms = g->shown.final ? INFINITY : left;
    return decision;
}

/* Counts lens maps that were traced although they should have been cached. After a change of rung one may be missing.
 * If maps are never cached, for example because they do not fit in memory, each frame traces, even if only time
 * advances. */
static void miss(struct kd_governor *g, double now)
{
    if (++g->missed < MISSES)
        return;
    g->missed = 0;
    g->blind_until = now + g->blind_ms;
    g->blind_ms *= 2;
}

static bool is_sane(const struct kd_frame_cost *c)
{
    return c->fixed_ms >= 0 && c->rays_ms >= 0 && c->pixels_ms >= 0 && c->total_ms >= 0 &&
           isfinite(c->total_ms + c->fixed_ms);
}

void kd_governor_frame(struct kd_governor *g, double now, const struct kd_frame_decision *decision,
                       const struct kd_frame_cost *cost)
{
    if (decision->revision == g->revision) {
        g->shown = decision->quality;
        g->shown_revision = decision->revision;
        g->shown_rays = decision->rays;
        g->shown_at = decision->refining ? g->shown_at : now;
    }
    struct kd_pace *pace = &g->paces[decision->traced];
    if (decision->ladder != g->ladders || !is_sane(cost))
        return;
    if (!cost->lens_reused && (decision->refining || !decision->traced)) {
        const struct kd_rung of = { .rays = decision->rays,
                                    .pixels = (double)decision->quality.width * decision->quality.height };
        expect(g, cost, &of, ENOUGH - 1);
    }
    if (decision->refining || decision->rung != pace->rung)
        return;
    if (!decision->traced) {
        g->missed = cost->lens_reused ? 0 : g->missed;
        if (!cost->lens_reused) {
            miss(g, now);
            return;
        }
    } else if (cost->lens_reused) {
        return;
    }
    pace->costs[pace->count++ % KD_PACE_FRAMES] = *cost;
    decide(g, pace, now);
}

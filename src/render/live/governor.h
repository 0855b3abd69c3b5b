/* The governor of a live session decides what to render next, and at what quality. While the scene changes, frames come
 * in time. When the scene rests, frames reach the requested quality. Pure: no clock, no device, no allocation. Times
 * are milliseconds of any steady clock. One owner at a time.
 *
 *     struct kd_governor governor;
 *     kd_governor_init(&governor, kd_governor_params(.target_ms = 33));
 *     when a session opens, or its scene changes (a PATCH, a step of time):
 *         kd_governor_changed(&governor, now, &asked, lens);
 *     whenever the renderer is free:
 *         struct kd_frame_decision decision = kd_governor_decide(&governor, now);
 *         if (decision.wait_ms > 0) wait for a change for at most that long, and ask again
 *         kd_quality_apply(&decision.quality, &asked, &scene); plan, render and encode `scene`; show it
 *         kd_governor_frame(&governor, now, &decision, &cost);
 *
 * One frame is in flight at a time: ask for the next decision after the last frame was reported by kd_governor_frame,
 * or was given up. A frame that was cancelled or failed is not reported, and is offered again. Cancel a frame with
 * decision.refining as soon as the scene changes. It may take long, and nobody waits for it any more.
 *
 * decision.quality is the quality to report to viewers. While nothing is rendered, it is that of the newest frame
 * shown.
 *
 * The cost of a frame has a fixed part, a part for each ray, and a part for each pixel. Only the parts that depend on
 * size can be reduced. Their time budget is the target minus the fixed part. It is at least half the target, and at
 * least a quarter of the fixed part. Ten million particles thus slow the frames down, but do not shrink the picture as
 * well.
 *
 * While the scene changes, a rung of quality.h's ladder is in force:
 * - Frames that trace their rays cost orders of magnitude more than frames that find their lens map cached. So each
 *   kind has a pace with a rung, a ceiling and an average of its own. The tracing pace is in force while the camera or
 *   the hole has moved recently.
 * - A pace moves down if its cost exceeds the budget by a tenth. It does so at once if four frames in a row, or the
 *   first two on a rung, exceed it by half, judged by the cheapest of them. Otherwise the mean over the middle half of
 *   the last 8 to 32 frames decides, which single spikes do not affect. It moves down as far as needed, on the
 *   assumption that everything except the fixed part shrinks with the picture.
 * - A rung that was left because it was too slow becomes the ceiling: the pace does not climb to it or above it. The
 *   ceiling is lifted after 3 s. That time doubles with each climb that failed. So on a machine that looks faster than
 *   it is, only about log N climbs fail in N hours.
 * - A pace moves up as far as the cost stays below 80 % of the budget, on the assumption that everything except the
 *   fixed part grows with the picture. It moves up by one rung if only the parts known to depend on size grow, or if
 *   the cost of rays follows the line through measurements at two sizes: rays next to the critical curve and the star
 *   search take the same time at any size. It does not move up within a second of the last change of rung.
 * - A pace that has been on one rung only, as in a session that began low, tries the next rung up once. It does so if
 *   that rung would be in time with the whole cost of rays unchanged: one frame at that size shows how the cost
 *   depends on it.
 * - After each change of rung averages start again. Ceilings start again when the scene changes its kind, such as
 *   particles for a smooth disk.
 * - Frames that reuse a lens map take no rung whose map would take longer than stall_ms to trace. That matters when a
 *   drag ends and time goes on.
 *
 * While the lens changes, frames on any rung but the first have an image.critical_factor of at most 2. There are then
 * fewer rays next to the critical curve. The number of these rays is proportional to the picture's width, so with few
 * of them the cost of a frame is nearly proportional to the picture's size. Frames in which only time advances keep all
 * of these rays, even if no lens map is cached and each frame traces. The ring then stands still, and four rays a pixel
 * would show as dots.
 *
 * If other sessions move too, kd_governor_share sets the fraction of the device's time for this one. Its target is then
 * that fraction of the time between frames. The time between frames grows as the inverse square root of the fraction,
 * up to sparse_ms. Frame rate and picture are thus reduced alike until that limit is reached, and after that only the
 * picture. A single session has 33 ms; each of two has 23 ms every 47 ms, each of eight 7.5 ms every 60 ms. The costs
 * compared with the target do not include waiting for other sessions. A ceiling set with a smaller fraction is ignored,
 * and a rung that was left because other sessions began is taken again as soon as they stop.
 *
 * If only the ringdown of a hole changes the picture, nothing moves. Frames then keep the requested size however long
 * they take; only their rays a pixel are reduced. A change of the scene's motion alone does not change the picture. The
 * picture is then rendered once more, as at rest.
 *
 * After rest_ms without a change, one frame is rendered for each step of the ladder upwards, except steps below the
 * quality that is shown. Then nothing is rendered until the next change. On a shared device a frame itself may wait for
 * rest_ms. So rest_ms counts from the time when the frame was shown. If a client waited longer than that for a frame,
 * it still has 50 ms for its next change. A scene whose time advances with each frame does not rest. */
#ifndef KD_RENDER_LIVE_GOVERNOR_H
#define KD_RENDER_LIVE_GOVERNOR_H

#include "render/emit/emitter.h"
#include "render/live/quality.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_governor_params {
    double target_ms; /* limit of a frame's time while the scene changes; above 0 */
    double rest_ms;   /* time without a change after which the picture is refined */
    /* limit of the time for tracing a lens map that later frames will reuse; it is multiplied by the session's share */
    double stall_ms;
    double sparse_ms; /* largest time between frames on a shared device; ignored if below the target */
    struct kd_ladder_bounds bounds;
};
#define KD_GOVERNOR_DEFAULTS \
    .target_ms = 33, .rest_ms = 150, .stall_ms = 500, .sparse_ms = 60, .bounds = KD_LADDER_BOUNDS_DEFAULT,
#define kd_governor_params(...) (&(struct kd_governor_params) { KD_GOVERNOR_DEFAULTS __VA_ARGS__ })

/* The parts of a frame's time. total_ms is compared with the target. It is the longest stage if stages overlap,
 * otherwise the sum of all stages. Part of total_ms may be in none of the other members (waiting and submitting);
 * this part may or may not shrink with the picture. If all other members are 0, this part is all of total_ms. */
struct kd_frame_cost {
    double fixed_ms;  /* independent of the picture's size: particles, audit */
    double rays_ms;   /* passes over rays: trace, transfer */
    double pixels_ms; /* passes over pixels: expose, post, readback, encode */
    double total_ms;
    bool lens_reused; /* same meaning as in kd_frame */
};

struct kd_frame_decision {
    /* quality of the frame to render now; if nothing is to be rendered, quality of the picture shown */
    struct kd_quality quality;
    /* 0: render now. Otherwise the time in which nothing needs to be rendered; INFINITY: the session rests */
    double wait_ms;
    bool refining; /* true if the scene rests and this frame is a step up the ladder */
    /* 1 or 4: one in this many of the sampled rays is audited. The audit runs on one core and takes a third of a
     * small frame */
    uint32_t audit;
    /* true if the tracing pace is in force; this and the remaining members are for kd_governor_frame only */
    bool traced;
    uint32_t ladder, rung, revision;
    double rays;
};

enum { KD_PACE_FRAMES = 32 };

/* Measurements and rung of one kind of frames: those that trace a lens map, or those that reuse one. */
struct kd_pace {
    /* indices of rungs, where 0 is the requested quality; the pace never climbs above `ceiling` */
    uint32_t rung, ceiling;
    uint32_t count; /* frames since the last change of rung */
    struct kd_frame_cost costs[KD_PACE_FRAMES];
    /* changed_at: time of the last change of rung; -INFINITY until the first change for a kind of scene. failed_at:
     * time at which a rung was last found too slow. retry_ms: time after failed_at for which the ceiling is in force */
    double changed_at, failed_at, retry_ms;
    /* widest: largest target since the last change; failed_target: target when failed_at was set */
    double widest, failed_target;
    bool climbed;       /* true if the last change was upwards */
    uint32_t held;      /* a rung that was left because other sessions began */
    double held_target; /* the target at which frames of the rung `held` were in time; 0: there is no such rung */
    /* the rung before the present one; rays 0: that rung is unknown, or was used for an estimate already */
    struct kd_rung other;
    double other_ms; /* time of the rays of a frame on the rung `other` */
    double stays;    /* estimated fraction of the rays' time that does not depend on size */
    bool tried;      /* true if `stays` was measured, so that no trial of another rung is needed */
};

/* All members are private. */
struct kd_governor {
    struct kd_governor_params params;
    double share;
    struct kd_scene asked;
    /* properties of the scene, except its size, that determined the cost of frames when measurements began */
    struct kd_work work;
    struct kd_ladder ladder;
    uint32_t ladders, revision;
    struct kd_pace paces[2]; /* [0]: for frames that reuse their lens map; [1]: for frames that trace it */
    /* changed_at: time of the last change. lens_at: time of the last change of the lens. hold_ms: time after which a
     * change of the lens is no longer recent */
    double changed_at, lens_at, hold_ms;
    struct kd_frame_cost traced; /* latest average cost of frames that trace */
    struct kd_rung traced_on;    /* rung of the frames of `traced`; rays 0: no frame yet */
    /* blind_until: until this time lens maps are assumed not to be cached, even if only time advances. blind_ms:
     * length of the next such period */
    double blind_until, blind_ms;
    uint32_t missed;           /* number of successive frames that traced although the lens was unchanged */
    bool rings;                /* true if only the brightness changes and nothing moves */
    double least, patience_ms; /* arguments of kd_governor_least */
    /* gave_way: true if frames may be narrower than `least`, because a pace was too slow; slow: index of this pace */
    bool gave_way, slow;
    double wide_ms;      /* total minus fixed time of a frame on the rung `wide`; 0: unknown */
    struct kd_rung wide; /* rung of the slow pace before frames became narrower */
    /* stays: fraction of the time of narrow frames that does not depend on their size. stays_of: number of rays of the
     * rung on which this fraction was measured; 0: unknown */
    double stays, stays_of;
    struct kd_quality shown;
    uint32_t shown_revision; /* 0: none */
    double shown_at;         /* time at which the newest frame that was not a step of refinement was shown */
    double shown_rays;
};

void kd_governor_init(struct kd_governor *governor, const struct kd_governor_params *params);

/* Sets the fraction of the device's time for this session: above 0 and at most 1, the initial value. The fraction
 * changes as other sessions stop or begin; set it before kd_governor_expect and before each kd_governor_frame. */
void kd_governor_share(struct kd_governor *governor, double share);

/* Sets the least width of frames while the scene changes, as a fraction of the requested width, 1/4 to 1, in place of
 * bounds.scale. If frames of this width take longer than the target, all other qualities are reduced first. Then the
 * frame rate is reduced, down to one frame every patience_ms (INFINITY: no limit). If the narrowest frames were
 * measured to take longer than patience_ms, frames become narrower after all, down to a quarter. Frames stay narrower
 * until the scene changes its kind, or until wide frames are estimated to be well within patience_ms. Part of a frame's
 * time does not depend on its size. So the estimate is the line through two measurements: the last wide frames, and the
 * first narrow frames right after them. */
void kd_governor_least(struct kd_governor *governor, double scale, double patience_ms);

/* The scene is now *shown, which must be valid; its dynamic bodies must live until the call returns. lens: true if
 * the lens map has changed, that is, if lens_key differs between the plans of the two requested scenes. It is true
 * for a session's first scene. A change of image.* or accuracy.* makes a new ladder, and starts on the rung that old
 * averages suggest. Averages and waits start again if the scene changes its kind, or if the cost of its emitters has
 * changed by more than a factor of two since the averages started. */
void kd_governor_changed(struct kd_governor *governor, double now, const struct kd_scene *shown, bool lens);

/* Sets the expected cost of a frame at the requested quality, for example from its plan. The cost chooses the first
 * rung. Without it, frames start on the top rung or stay on the present one. The cost is ignored once frames of this
 * kind were measured, so this function may be called after each change. A traced frame, such as a step of refinement,
 * has the same effect with better data while few frames of its kind were measured. */
void kd_governor_expect(struct kd_governor *governor, const struct kd_frame_cost *cost);

/* Decides what to do now. Call after kd_governor_changed. */
struct kd_frame_decision kd_governor_decide(const struct kd_governor *governor, double now);

/* Reports that the frame of that decision was shown. */
void kd_governor_frame(struct kd_governor *governor, double now, const struct kd_frame_decision *decision,
                       const struct kd_frame_cost *cost);

#endif

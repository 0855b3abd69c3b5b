/* The governor says what a live session renders next, and how finely: so that frames come in time while the scene
 * changes, and that the picture becomes what was asked when it rests. Pure: no clock, no device, no allocation.
 * Times are milliseconds of any steady clock. One owner at a time.
 *
 *     struct kd_governor governor;
 *     kd_governor_init(&governor, kd_governor_params(.target_ms = 33));
 *     when a session opens, or its scene changes (a PATCH, a step of time):
 *         kd_governor_changed(&governor, now, &asked, lens);
 *     whenever the renderer is free:
 *         struct kd_turn turn = kd_governor_turn(&governor, now);
 *         if (turn.wait_ms > 0) wait for a change, at most so long, and ask again
 *         kd_quality_apply(&turn.quality, &asked, &scene); plan, render and encode `scene`; show it
 *         kd_governor_frame(&governor, now, &turn, &cost);
 *
 * One frame is in flight: ask for the next turn when the last has been reported by kd_governor_frame, or was given
 * up. A frame that was cancelled or failed is not reported, and is offered again. Cancel a frame with turn.refining
 * as soon as the scene changes: it may be long, and nobody waits for it any more.
 *
 * turn.quality is what to report as in force, also while nothing is rendered: then it is that of the newest frame
 * shown.
 *
 * A frame costs something whatever its size, something for each ray, something for each pixel. Only what goes with
 * its size can be mended here: that has what the first leaves of the target, at least half the target, and at least
 * a quarter of the first, so that ten million particles cost frames and not the picture too.
 *
 * While the scene changes, a rung of quality.h's ladder is in force:
 * - Frames that trace their rays and frames that find their lens map cached cost different orders of magnitude, so
 * that each kind
 *   has a rung, a ceiling and an average of its own. As long as the camera or the hole was moved lately the first
 *     kind's hold.
 * - Over that by a tenth: down. At once if four frames in a row, or the first two on a rung, are over it by half, as
 * far as the
 *   cheapest of them takes; else by the mean of the middle half of the last 8 to 32, which single spikes do not
 *     reach. As far as it
 *   takes if all of the cost but what is known not to shrank with the picture.
 * - A rung that was left because it was too slow is the ceiling: it and those above are not climbed to again. It is
 * lifted after 3
 *   s, and whenever a climb was in vain that time doubles: of N hours only log N climbs are lost to a machine that
 *     seems faster
 *   than it is.
 * - Up as far as would take at most 80 % of it if all of the cost but what is known not to grew, or by one rung if
 * only what is
 *   known to grow did, or if rays cost what the line through two sizes says that were measured: rays next to the
 *     critical curve and the search
 *   for stars take their time at any size; not within a second of the last change.
 * - A pace that has been on no rung but one, as a session's that began low, is tried on the next one up once if that
 * is in time should all of what rays
 *   take stay: one frame in that size says what does.
 * - After each change of rung averages start again; so do ceilings when the scene is of another kind, such as
 * particles for a
 *   smooth disk.
 * - Frames that reuse a lens map get none that would take longer than stall_ms to trace: that is seen when a drag
 * ends and time goes
 *   on.
 *
 * Frames of a lens that changes, on any rung but the first, have image.critical_factor 2 at most: the rays next to the
 * critical curve are fewer, and its list is as long as the picture is wide, so that what is left goes nearly with the
 * picture's size. Frames of a scene whose time alone goes on have all of them, also where no lens map is kept and each
 * traces: the ring stands still, and by four rays a pixel it is dotted.
 *
 * Where other sessions move too, kd_governor_share says which part of the device's time this one may count on. Its
 * target then is that part of the time from one frame to the next, which grows by the root of what the part shrinks,
 * to sparse_ms at most: pace and picture give way alike, and from there on the picture alone does. One that is alone
 * has 33 ms; of two each has 23 every 47, and of eight each has 7.5 every 60. The costs that are compared with it
 * leave out the time that frames wait for others. A ceiling that was met with less of the device than there is now
 * does not hold, and a rung that was left because others began is taken again as soon as they stop.
 *
 * Where a hole rings and nothing else goes on, nothing moves: frames keep the size that is asked, however long they
 * take, and give up rays of a pixel alone. A change of motion alone changes no picture: what is shown is rendered
 * once more, as at rest.
 *
 * When nothing changed for rest_ms: the steps of the ladder, one frame each, those that are less than what is shown
 * left out. Then nothing, until the next change. Where the device is shared a frame may wait for rest_ms itself, so
 * that the rest counts from when it was shown; and who has waited for a frame longer than that has 50 ms for the
 * next change. A scene that is stepped in time at each frame does not rest. */
#ifndef KD_RENDER_LIVE_GOVERNOR_H
#define KD_RENDER_LIVE_GOVERNOR_H

#include "render/live/quality.h"

#include <stdbool.h>
#include <stdint.h>

struct kd_governor_params {
    double target_ms; /* of a frame while the scene changes; over 0 */
    double rest_ms;   /* without a change before the picture is refined */
    double stall_ms;  /* once, for the lens map that frames are to reuse; a session that shares has its share of it */
    double sparse_ms; /* from frame to frame, at most, where the device is shared; no matter if below the target */
    struct kd_ladder_bounds bounds;
};
#define KD_GOVERNOR_DEFAULTS \
    .target_ms = 33, .rest_ms = 150, .stall_ms = 500, .sparse_ms = 60, .bounds = KD_LADDER_BOUNDS_DEFAULT,
#define kd_governor_params(...) (&(struct kd_governor_params) { KD_GOVERNOR_DEFAULTS __VA_ARGS__ })

/* Where a frame's time went. total_ms is compared with the target: if stages overlap, the longest; if not, the sum.
 * What the parts leave of it, waiting and submitting, may or may not shrink with the picture; with all parts 0 that
 * is so of everything. */
struct kd_frame_cost {
    double fixed_ms;  /* whatever the picture's size: particles, audit */
    double rays_ms;   /* passes over rays: trace, transfer */
    double pixels_ms; /* over pixels: expose, post, readback, encode */
    double total_ms;
    bool lens_reused; /* as in kd_frame */
};

struct kd_turn {
    struct kd_quality quality; /* in force: of the frame to render now; if there is none, of what is shown */
    double wait_ms; /* 0: render it. Else there is nothing to render for so long; INFINITY: the session rests */
    bool refining;  /* the scene rests, and this is a step upwards */
    uint32_t audit; /* one of so many of the rays that measure the accuracy is enough: 1 or 4. That is done on one core,
                       and takes a third of a small frame */
    bool traced;    /* the rung for frames that trace is in force; what follows is for kd_governor_frame alone */
    uint32_t ladder, rung, revision;
    double rays;
};

enum { KD_PACE_FRAMES = 32 };

/* A pace is what is known of frames of one kind: those that trace a lens map, or those that reuse one. */
struct kd_pace {
    uint32_t rung, ceiling; /* indices: 0 is what was asked; never climb below `ceiling` */
    uint32_t count;         /* frames since the last change of rung */
    struct kd_frame_cost costs[KD_PACE_FRAMES];
    double changed_at, failed_at, retry_ms; /* changed_at: -INFINITY until the first change of a kind of scene */
    double widest, failed_target;           /* the target: at most, since the last change; when it failed */
    bool climbed;                           /* the last change was upwards */
    uint32_t held;                          /* the rung that was left because others began to share; */
    double held_target;                     /* at which it was in time; 0: none */
    struct kd_rung other;                   /* the rung before; no rays: nobody knows, or it was made use of; */
    double other_ms;                        /* what its rays took */
    double stays; /* which part of what rays take is the same at any size, as far as is known */
    bool tried;   /* it need not be tried on another rung to know that */
};

/* All members are private. */
struct kd_governor {
    struct kd_governor_params params;
    double share;
    struct kd_scene asked;
    struct kd_ladder ladder;
    uint32_t ladders, revision;
    struct kd_pace paces[2];             /* frames that reuse their lens map; that trace it */
    double changed_at, lens_at, hold_ms; /* last change; last one of the lens; how long that counts as lately */
    struct kd_frame_cost traced;         /* the newest average of frames that trace, */
    struct kd_rung traced_on;            /* and their rung; no rays: none yet */
    double blind_until, blind_ms;        /* lens maps are not kept, whatever the changes are */
    uint32_t missed;                     /* frames in a row that traced though the lens was the same */
    bool rings;                          /* nothing moves, light alone changes */
    double least, patience_ms;           /* kd_governor_least; */
    bool gave_way, slow;                 /* frames may be narrower than that; index of the pace that took too long, */
    double wide_ms;                      /* what it varied by on its rung, 0: nobody knows any more; */
    struct kd_rung wide;                 /* that rung; */
    double stays, stays_of; /* and the part of what narrow frames take that is the same at any size, on a rung of so
                               many rays; 0: not known yet */
    struct kd_quality shown;
    uint32_t shown_revision; /* 0: none */
    double shown_at;         /* the newest frame that was no step of refinement */
    double shown_rays;
};

void kd_governor_init(struct kd_governor *governor, const struct kd_governor_params *params);

/* The part of the device's time that this session may count on, over 0 and at most 1, which is what it begins with.
 * Others that stop or begin change it: tell it before what is expected and before each frame that is reported. */
void kd_governor_share(struct kd_governor *governor, double share);

/* While the scene changes a frame has at least this part of the asked width, 1/4 to 1, instead of bounds.scale: a
 * smaller target gives up what else there is, and then time, up to patience_ms from frame to frame (INFINITY:
 * however long they take). Where the narrowest frames were measured to take longer than that, frames become narrower
 * all the same, to a quarter, until the scene is of another kind or what they take says that wide ones would be well
 * within it: by the line through what wide ones took when they were given up and the first narrow ones right after,
 * since a part of what a frame takes is the same at any size. */
void kd_governor_least(struct kd_governor *governor, double scale, double patience_ms);

/* The scene is now *asked, valid. lens: its lens map is another, as it is when the plans of both, as asked, differ
 * in lens_key; the first of a session is. A change of image.* or accuracy.* makes a new ladder and starts on the
 * rung that old averages suggest; one of what is drawn begins averages and waits anew. */
void kd_governor_changed(struct kd_governor *governor, double now, const struct kd_scene *asked, bool lens);

/* Says what a frame as asked is believed to cost, by its plan for instance, before any of this kind was measured. It
 * sets the rung to begin with; without it that is the first, or the one in force. Later it is ignored, so that each
 * change may be followed by it. A frame that traced while few of its kind are known, as a step of refinement does,
 * says the same better. */
void kd_governor_expect(struct kd_governor *governor, const struct kd_frame_cost *cost);

/* Says what to do now. To be called after kd_governor_changed. */
struct kd_turn kd_governor_turn(const struct kd_governor *governor, double now);

/* The frame of that turn was shown. */
void kd_governor_frame(struct kd_governor *governor, double now, const struct kd_turn *turn,
                       const struct kd_frame_cost *cost);

#endif

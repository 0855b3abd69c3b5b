/* A scene that keyframes change: what jobs render frame by frame, and what a session goes along second by second.
 * Pure; any thread.
 *
 *     "keyframes": [{"frame": 24, "scene": {patch}, "proper_time": 5, "ease": "in-out", "look_at": "hole"}, ...],
 *     "interpolation": "smooth", "distances": "geometric", "angles": "shorter", "ease": "out", "look_at":
 *       {"theta_deg": 90, "phi_deg": 30}
 *
 * A keyframe's scene is a merge patch of the keyframe before. Between keyframes real numbers are interpolated,
 * everything else keeps the value of the keyframe before. After the last nothing changes. "smooth" is a monotone
 * cubic: at rest at both ends and wherever the direction turns, and never beyond the values given. "catmull-rom"
 * goes through the keyframes without stopping: Hermite's cubic with the slope at a key of the parabola through it
 * and its two neighbours, at either end that of the straight line to the next (E. Catmull & R. Rom 1974, in Computer
 * Aided Geometric Design, 317; P. Barry & R. Goldman 1988, SIGGRAPH Comput. Graph. 22, 199, with the keys' places as
 * knots: for keys at even distances it is the uniform one). It may overshoot the values given.
 *
 * "ease": a part of the way, or all of it, is gone by a clock of its own, t of [0, 1] being t^2 ("in"), 1 - (1 -
 * t)^2 ("out") or 3 t^2 - 2 t^3 ("in-out"): a keyframe's is that of the part that leads to it, the timeline's that
 * of the whole, so that its keyframes are where its own clock is at their places.
 *
 * With "angles": "shorter" numbers of degrees that have a whole turn go the shorter way from key to key: from 350 to
 * 10 through 0.
 *
 * "look_at" turns the camera (scene/aim.h) wherever it is, instead of yaw and pitch: towards "hole", or a place;
 * "free": as they say. A keyframe without it has that of the keyframe before, the first the timeline's. Between two
 * that are not alike the camera turns from the one to the other along a great circle.
 *
 * "proper_time" moves the observer on along its own path (physics/spacetime/worldline.h) from where the scene has it,
 * by so much of its own time since the beginning, in M, or, if it falls, "horizon" or "end": that of the outer horizon,
 * and that of the last place a camera can be. A keyframe without it has that of the keyframe before, the first has
 * 0. It is interpolated as numbers are, but for "catmull-rom" by the monotone cubic; where it takes the observer is
 * exact. With "distances": "geometric" camera.r, camera.field_m and camera.field_uas go by equal ratios instead of
 * equal steps. */
#ifndef KD_SCENE_TIMELINE_H
#define KD_SCENE_TIMELINE_H

#include "scene/aim.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>

#define KD_TIMELINE_KEYS_MAX 1000

/* Words as requests have them, in this order. W(word), one behind the other with C between them: KD_WORD_OF and
 * KD_COMMA make an array of them. */
#define KD_INTERPOLATIONS(W, C) W("linear") C W("smooth") C W("catmull-rom")
enum kd_interpolation { KD_LINEAR, KD_SMOOTH, KD_CATMULL_ROM };
#define KD_EASES(W, C) W("none") C W("in") C W("out") C W("in-out")
enum kd_ease { KD_EASE_NONE, KD_EASE_IN, KD_EASE_OUT, KD_EASE_IN_OUT };

#define KD_DISTANCES(W, C) W("linear") C W("geometric")
#define KD_ANGLES(W, C) W("as-given") C W("shorter")
#define KD_WORD_OF(word) word
#define KD_COMMA ,

/* Where a place to look at may be; its r is from 0 to this, M. */
#define KD_LOOK_AT_FAR 1e12

struct kd_timeline_key {
    double at; /* frame, or seconds */
    double proper_time;
    enum kd_ease ease; /* of the way to it */
    struct kd_aim aim;
    struct kd_scene scene;
};

struct kd_timeline {
    struct kd_timeline_key *keys; /* the first at 0, growing; none: this is no timeline */
    size_t n_keys;
    enum kd_interpolation interpolation;
    enum kd_ease ease; /* of the whole */
    bool geometric, shorter;
};
void kd_timeline_finish(struct kd_timeline *timeline);

/* How the places of keyframes are called, and what they may be. */
struct kd_timeline_form {
    const char *place; /* "frame" */
    double most;
    bool whole;
};

/* The members of a request that are a timeline; NULL: not there. */
struct kd_timeline_items { const cJSON *keyframes, *interpolation, *distances, *angles, *ease, *look_at; };
#define KD_TIMELINE_MEMBERS(items) \
    { "keyframes", &(items).keyframes }, { "interpolation", &(items).interpolation }, \
        { "distances", &(items).distances }, { "angles", &(items).angles }, { "ease", &(items).ease }, \
    { \
        "look_at", &(items).look_at \
    }

/* The name of one that is there and says how keyframes are gone along; NULL: none is. */
const char *kd_timeline_manner(const struct kd_timeline_items *items);

/* Reads them into *out, whose first key is *first, which is valid; each of its keys is valid then. assets: those
 * that scenes may name; NULL: hashes are taken as they are. KD_EINVAL with the pointer into the request. */
enum kd_status kd_timeline_read(const struct kd_timeline_items *items, const struct kd_timeline_form *form,
                                const struct kd_assets *assets, const struct kd_scene *first, struct kd_timeline *out,
                                struct kd_error *error);

/* Where the last keyframe is. */
double kd_timeline_end(const struct kd_timeline *timeline);

/* The scene at a place, 0 or more, valid. KD_EINVAL, with a pointer to the keyframes, where what lies between two of
 * them is not. */
enum kd_status kd_timeline_scene(const struct kd_timeline *timeline, double at, struct kd_scene *out,
                                 struct kd_error *error);

#endif

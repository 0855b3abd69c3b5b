/* Timelines are scenes animated by keyframes. In jobs the place of a keyframe is a frame number, in sessions it is a
 * time in seconds. Pure; any thread.
 *
 *     "keyframes": [{"frame": 24, "scene": {patch}, "proper_time": 5, "ease": "in-out", "look_at": "hole"}, ...],
 *     "interpolation": "smooth", "distances": "geometric", "angles": "shorter", "ease": "out",
 *     "look_at": {"theta_deg": 90, "phi_deg": 30}
 *
 * A keyframe's scene is a merge patch on the scene of the keyframe before. Real numbers are interpolated between
 * keyframes; all other values stay as in the previous keyframe. After the last keyframe nothing changes.
 *
 * "smooth" is a monotone cubic: it is at rest at both ends and at turning points, and never exceeds the given
 * values. "catmull-rom" is a cubic Hermite spline. It passes through the keyframes without stopping, and may exceed
 * the given values. The slope at a key is that of the parabola through the key and its two neighbours. The slope at
 * either end is that of the straight line to the neighbour (E. Catmull & R. Rom 1974, in Computer Aided Geometric
 * Design, 317; P. Barry & R. Goldman 1988, SIGGRAPH Comput. Graph. 22, 199, with the keys' places as knots). For
 * evenly spaced keys it is the uniform Catmull-Rom spline.
 *
 * "ease" replaces the fraction t of [0, 1] by t^2 ("in"), 1 - (1 - t)^2 ("out") or 3 t^2 - 2 t^3 ("in-out"). The
 * "ease" of a keyframe applies to the interval that ends at this keyframe. The "ease" of the timeline applies to the
 * whole timeline at once.
 *
 * With "angles": "shorter", an angle whose field covers a full turn takes the shorter way from key to key: from 350
 * to 10 through 0.
 *
 * "look_at" aims the camera (scene/aim.h) at "hole" or at a place, and overrides yaw and pitch. With "free" yaw and
 * pitch decide. A keyframe without "look_at" inherits that of the keyframe before; the first keyframe inherits that
 * of the timeline. Between two different aims the camera turns along a great circle.
 *
 * "proper_time" moves the observer along its own path (physics/spacetime/worldline.h), from its place in the scene.
 * Its value is the proper time since the beginning, in M. For a falling observer it may also be "horizon" or "end":
 * the proper time at which the observer reaches the outer horizon, or the last place that a camera can have. A
 * keyframe without "proper_time" inherits that of the keyframe before; the first has 0. It is interpolated like
 * other numbers, but with "catmull-rom" by the monotone cubic; the resulting place is exact.
 *
 * With "distances": "geometric", camera.r, camera.field_m and camera.field_uas are interpolated logarithmically. */
#ifndef KD_SCENE_TIMELINE_H
#define KD_SCENE_TIMELINE_H

#include "scene/aim.h"
#include "scene/asset.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>

#define KD_TIMELINE_KEYS_MAX 1000

/* Words of requests, in the order of the enumerators: each word is W(word), and C stands between two words. With
 * KD_WORD_OF as W and KD_COMMA as C the list becomes an array. */
#define KD_INTERPOLATIONS(W, C) W("linear") C W("smooth") C W("catmull-rom")
enum kd_interpolation { KD_LINEAR, KD_SMOOTH, KD_CATMULL_ROM };
#define KD_EASES(W, C) W("none") C W("in") C W("out") C W("in-out")
enum kd_ease { KD_EASE_NONE, KD_EASE_IN, KD_EASE_OUT, KD_EASE_IN_OUT };

#define KD_DISTANCES(W, C) W("linear") C W("geometric")
#define KD_ANGLES(W, C) W("as-given") C W("shorter")
#define KD_WORD_OF(word) word
#define KD_COMMA ,

/* Maximum r, in M, of a place at which the camera can look. */
#define KD_LOOK_AT_FAR 1e12

struct kd_timeline_key {
    double at; /* place of the key: a frame number, or a time in seconds */
    double proper_time;
    enum kd_ease ease; /* ease of the interval that ends at this key */
    struct kd_aim aim;
    struct kd_scene scene;
};

struct kd_timeline {
    /* keys in ascending order of `at`, the first with `at` = 0; if n_keys is 0, there is no timeline */
    struct kd_timeline_key *keys;
    size_t n_keys;
    enum kd_interpolation interpolation;
    enum kd_ease ease; /* ease of the whole timeline */
    bool geometric, shorter;
};
void kd_timeline_finish(struct kd_timeline *timeline);

/* How a request gives the place of a keyframe, and the range of places. */
struct kd_timeline_form {
    const char *place; /* name of the member with the place, such as "frame" */
    double most;
    bool whole;
};

/* The members of a request that form a timeline. A missing member is NULL. */
struct kd_timeline_items { const cJSON *keyframes, *interpolation, *distances, *angles, *ease, *look_at; };
/* The rows of these members, for a struct of type `type` whose member `items` holds them. */
#define KD_TIMELINE_ROW_(type, items, member) \
    { .name = #member, \
      .kind = KD_KIND_JSON, \
      .offset = offsetof(type, items) + offsetof(struct kd_timeline_items, member) }
#define KD_TIMELINE_ROWS(type, items) \
    KD_TIMELINE_ROW_(type, items, keyframes), KD_TIMELINE_ROW_(type, items, interpolation), \
        KD_TIMELINE_ROW_(type, items, distances), KD_TIMELINE_ROW_(type, items, angles), \
        KD_TIMELINE_ROW_(type, items, ease), KD_TIMELINE_ROW_(type, items, look_at)

/* Returns the name of the first of these members in the request, except "keyframes". Returns NULL if there is none. */
const char *kd_timeline_manner(const struct kd_timeline_items *items);

/* Reads a timeline. *first is the scene of the first key, and must be valid. On success, every key of *out is valid.
 * assets: provider in which names and hashes are looked up; NULL: hashes are not looked up. Returns KD_EINVAL with a
 * pointer into the request. Free *out with kd_timeline_finish. */
enum kd_status kd_timeline_read(const struct kd_timeline_items *items, const struct kd_timeline_form *form,
                                const struct kd_assets *assets, const struct kd_scene *first, struct kd_timeline *out,
                                struct kd_error *error);

/* Returns the place of the last keyframe: a frame number or seconds. */
double kd_timeline_end(const struct kd_timeline *timeline);

/* Makes the scene at a place (0 or more), and validates it. If the interpolated scene is not valid, returns
 * KD_EINVAL with a pointer to the keyframes. */
enum kd_status kd_timeline_scene(const struct kd_timeline *timeline, double at, struct kd_scene *out,
                                 struct kd_error *error);

#endif

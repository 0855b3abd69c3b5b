/* A scene that keyframes change: what jobs render frame by frame, and what a session goes along second by second. Pure; any thread.
 *
 *     "keyframes": [{"frame": 24, "scene": {patch}, "proper_time": 5}, ...], "interpolation": "smooth", "distances": "geometric"
 *
 * A keyframe's scene is a merge patch of the keyframe before. Between keyframes real numbers are interpolated, everything else keeps the value
 * of the keyframe before. After the last nothing changes. "smooth" is a monotone cubic: at rest at both ends and wherever the direction turns,
 * and never beyond the values given.
 *
 * "proper_time" moves the observer on along its own path (physics/worldline.h) from where the scene has it, by so much of its own time since
 * the beginning, in M, or, if it falls, "horizon" or "end": that of the outer horizon, and that of the last place a camera can be. A keyframe
 * without it has that of the keyframe before, the first has 0. It is interpolated as numbers are; where it takes the observer is exact.
 * With "distances": "geometric" camera.r and camera.field_m go by equal ratios instead of equal steps. */
#ifndef KD_SCENE_TIMELINE_H
#define KD_SCENE_TIMELINE_H

#include "scene/asset.h"
#include "scene/scene.h"

#include <cjson/cJSON.h>

#define KD_TIMELINE_KEYS_MAX 1000

struct kd_timeline_key {
    double at; /* frame, or seconds */
    double proper_time;
    struct kd_scene scene;
};

struct kd_timeline {
    struct kd_timeline_key *keys; /* the first at 0, growing; none: this is no timeline */
    size_t n_keys;
    bool smooth, geometric;
};
void kd_timeline_finish(struct kd_timeline *timeline);

/* How the places of keyframes are called, and what they may be. */
struct kd_timeline_form {
    const char *place; /* "frame" */
    double most;
    bool whole;
};

/* The members of a request that are a timeline; NULL: not there. */
struct kd_timeline_items {
    const cJSON *keyframes, *interpolation, *distances;
};

/* Reads them into *out, whose first key is *first, which is valid; each of its keys is valid then. assets: those that scenes may name; NULL: hashes
 * are taken as they are. KD_EINVAL with the pointer into the request. */
enum kd_status kd_timeline_read(const struct kd_timeline_items *items, const struct kd_timeline_form *form, const struct kd_assets *assets,
                                const struct kd_scene *first, struct kd_timeline *out, struct kd_error *error);

/* Where the last keyframe is. */
double kd_timeline_end(const struct kd_timeline *timeline);

/* The scene at a place, 0 or more, valid. KD_EINVAL, with a pointer to the keyframes, where what lies between two of them is not. */
enum kd_status kd_timeline_scene(const struct kd_timeline *timeline, double at, struct kd_scene *out, struct kd_error *error);

#endif

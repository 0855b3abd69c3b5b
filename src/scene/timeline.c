#include "scene/timeline.h"

#include "physics/spacetime/worldline.h"
#include "scene/sky_scale.h"
#include "scene/table.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void kd_timeline_finish(struct kd_timeline *timeline)
{
    free(timeline->keys);
    *timeline = (struct kd_timeline) { 0 };
}

double kd_timeline_end(const struct kd_timeline *t) { return t->n_keys ? t->keys[t->n_keys - 1].at : 0; }

static bool continuous(const struct kd_row *field) { return field->kind == KD_KIND_REAL; }

/* A number that all keys have: a field, or the proper time if `field` is NULL. */
struct column {
    const struct kd_timeline *timeline;
    const struct kd_row *field;
    size_t index;
    size_t from; /* the key at which t is 0; whole turns of an angle at other keys are counted from this key */
    bool ratios; /* true if the logarithm of the member is interpolated */
    bool turns;  /* true if the member is an angle that takes the shorter way from key to key */
    enum kd_interpolation by;
};

static double given(const struct column *c, size_t key)
{
    const struct kd_timeline_key *k = &c->timeline->keys[key];
    return c->field ? kd_field_get(&k->scene, c->field, c->index) : k->proper_time;
}

/* The value at a key. To compute a slope, values at most two keys away from the interval are needed. */
static double value_at(const struct column *c, size_t key)
{
    double value = given(c, c->turns ? c->from : key);
    for (size_t i = c->from; c->turns && i < key; i++)
        value += remainder(given(c, i + 1) - given(c, i), 360);
    for (size_t i = c->from; c->turns && i > key; i--)
        value -= remainder(given(c, i) - given(c, i - 1), 360);
    return c->ratios ? log(value) : value;
}

static double apart(const struct column *c, size_t key)
{
    return c->timeline->keys[key + 1].at - c->timeline->keys[key].at;
}

/* Slope of the straight line from a key to the next one. NAN if there is no next key, or if one of the two values is
 * a word. */
static double secant(const struct column *c, size_t key)
{
    if (key + 1 >= c->timeline->n_keys)
        return NAN;
    double rise = value_at(c, key + 1) - value_at(c, key); /* NAN also for inf - inf */
    return isfinite(rise) ? rise / apart(c, key) : NAN;
}

/* Monotone slope at a key: the weighted harmonic mean of the secants, or 0 at a turning point (Fritsch & Butland,
 * SIAM J. Sci. Stat. Comput. 5 (1984) 300, with the weights of Brodlie, as in SLATEC's PCHIM). At both ends of the
 * timeline the slope is 0. */
static double monotone_slope(const struct column *c, size_t key, double before, double after)
{
    if (!(before * after > 0))
        return 0;
    double h0 = apart(c, key - 1), h1 = apart(c, key), w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / before + w1 / after);
}

/* Slope, at a key, of the parabola through this key and its two neighbours. If the key has only one neighbour, the
 * slope of the straight line to it. */
static double parabola_slope(const struct column *c, size_t key, double before, double after)
{
    if (isnan(before) || isnan(after))
        return isnan(before) ? after : before;
    double h0 = apart(c, key - 1), h1 = apart(c, key);
    return (h1 * before + h0 * after) / (h0 + h1);
}

static double slope(const struct column *c, size_t key)
{
    double before = key ? secant(c, key - 1) : NAN, after = secant(c, key);
    return (c->by == KD_CATMULL_ROM ? parabola_slope : monotone_slope)(c, key, before, after);
}

static double cubic(const struct column *c, size_t key, double t, double from, double to)
{
    double h = apart(c, key), m0 = h * slope(c, key), m1 = h * slope(c, key + 1);
    /* Hermite's cubic */
    return from + t * (m0 + t * (3 * (to - from) - 2 * m0 - m1 + t * (m0 + m1 - 2 * (to - from))));
}

static double between(const struct column *c, size_t key, double t)
{
    double from = value_at(c, key), to = value_at(c, key + 1);
    if (!isfinite(from) || !isfinite(to) || (from == to && c->by != KD_CATMULL_ROM))
        return c->ratios ? exp(from) : from;
    double value = c->by == KD_LINEAR ? from + t * (to - from) : cubic(c, key, t, from, to);
    if (c->by != KD_CATMULL_ROM)
        /* clamped, because the monotone cubic lies between the two values, but rounding may exceed them */
        value = fmax(fmin(from, to), fmin(fmax(from, to), value));
    if (c->turns && !(value >= c->field->least && value <= c->field->most))
        value = remainder(value, 360);
    return c->ratios ? exp(value) : value;
}

static bool is_distance(const struct kd_row *field)
{
    return !strcmp(field->object, "camera") &&
           (!strcmp(field->name, "r") || !strcmp(field->name, "field_m") || !strcmp(field->name, "field_uas"));
}

static bool is_turn(const struct kd_row *field)
{
    return !strcmp(field->unit, "degrees") && field->most - field->least >= 360;
}

/* True if a field keeps its value between two keys. With the Catmull-Rom cubic, a field may change even if both keys
 * have the same value. */
static bool stays(const struct kd_timeline *timeline, size_t key, const struct kd_row *field, size_t index)
{
    const struct kd_scene *from = &timeline->keys[key].scene, *to = &timeline->keys[key + 1].scene;
    return timeline->interpolation != KD_CATMULL_ROM &&
           kd_field_get(from, field, index) == kd_field_get(to, field, index);
}

/* Interpolates a section. If only one of the two keyframes has a certain list element, that element has all defaults
 * in the other keyframe. */
static void section_between(const struct kd_timeline *timeline, size_t key, double t, const struct kd_section *section,
                            struct kd_scene *out)
{
    size_t size = kd_section_size(&timeline->keys[key].scene, section),
           next = kd_section_size(&timeline->keys[key + 1].scene, section);
    if (next > size)
        kd_section_resize(out, section, size = next);
    for (size_t index = 0; index < size; index++)
        for (size_t i = section->first; i < section->first + section->count; i++) {
            const struct kd_row *field = &kd_fields[i];
            const struct column column = { timeline,
                                           field,
                                           index,
                                           key,
                                           timeline->geometric && is_distance(field),
                                           timeline->shorter && is_turn(field),
                                           timeline->interpolation };
            if (continuous(field) && !stays(timeline, key, field, index))
                kd_field_put(out, field, index, between(&column, key, t));
        }
}

static enum kd_status go_on(struct kd_scene *scene, double proper_time, struct kd_error *error)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    if (proper_time == 0)
        return KD_OK;
    if (!kd_worldline_is_known(&motion, &at))
        return kd_error_field(error, "",
                              "proper_time is %.9g M; it must be 0 unless the observer stays at a finite camera.r, "
                              "orbits there in the equatorial plane, or falls from there at constant latitude",
                              proper_time);
    kd_scene_go_on(scene, proper_time);
    return KD_OK;
}

static double eased(enum kd_ease ease, double t)
{
    switch (ease) {
    case KD_EASE_IN: return t * t;
    case KD_EASE_OUT: return t * (2 - t);
    case KD_EASE_IN_OUT: return t * t * (3 - 2 * t);
    default: return t;
    }
}

static bool same_aim(const struct kd_aim *a, const struct kd_aim *b)
{
    return a->kind == b->kind &&
           (a->kind != KD_AIM_PLACE || (a->r == b->r && a->theta_deg == b->theta_deg && a->phi_deg == b->phi_deg));
}

/* Turns the camera as the keyframes require. to: the next keyframe, or NULL. */
static enum kd_status aim(struct kd_scene *scene, const struct kd_timeline_key *from, const struct kd_timeline_key *to,
                          double t, struct kd_error *error)
{
    double look[3], then[3];
    const bool turns = to && !same_aim(&from->aim, &to->aim);
    enum kd_status status = KD_OK;
    if (from->aim.kind == KD_AIM_FREE && !turns)
        return KD_OK;
    KD_TRY(kd_aim_look(&from->aim, scene, look, error));
    if (turns) {
        KD_TRY(kd_aim_look(&to->aim, scene, then, error));
        kd_aim_between(look, then, t, look);
    }
    kd_aim_turn(scene, look);
done:
    return status;
}

/* The last key at or before a place, found by bisection, because a list of scenes has a key for each scene. */
static size_t key_before(const struct kd_timeline *timeline, double at)
{
    size_t key = 0, end = timeline->n_keys;
    while (end - key > 1) {
        const size_t middle = key + (end - key) / 2;
        *(timeline->keys[middle].at <= at ? &key : &end) = middle;
    }
    return key;
}

enum kd_status kd_timeline_scene(const struct kd_timeline *timeline, double at, struct kd_scene *out,
                                 struct kd_error *error)
{
    struct kd_error inner = { 0 };
    const double end = kd_timeline_end(timeline);
    if (at < end && timeline->ease != KD_EASE_NONE)
        at = end * eased(timeline->ease, at / end);
    const size_t key = key_before(timeline, at);
    const struct kd_timeline_key *from = &timeline->keys[key], *to = NULL;
    const struct column clock = { .timeline = timeline,
                                  .from = key,
                                  .by = timeline->interpolation == KD_LINEAR ? KD_LINEAR : KD_SMOOTH };
    double proper_time = from->proper_time, t = 0;
    *out = from->scene;
    if (from->at < at && key + 1 < timeline->n_keys) {
        to = from + 1;
        t = eased(to->ease, (at - from->at) / (to->at - from->at));
        for (size_t i = 0; i < KD_SECTION_COUNT; i++)
            section_between(timeline, key, t, &kd_sections[i], out);
        if (isinf(to->scene.camera.field_uas)) /* the two keys use different units, so the width in M is interpolated */
            out->camera.field_uas = INFINITY;
        kd_scene_settle(out, NULL);
        proper_time = between(&clock, key, t);
    } else if (proper_time == 0 && from->aim.kind == KD_AIM_FREE) {
        return KD_OK;
    }
    if (!kd_scene_validate(out, &inner) && !go_on(out, proper_time, &inner) && !aim(out, from, to, t, &inner))
        return KD_OK;
    kd_error_field(error, "/keyframes", "%.400s", inner.message);
    return KD_EINVAL;
}

/* This reads a timeline from a request. */
#include "scene/members.h"
#include "scene/number.h"
#include "scene/timeline.h"
#include "scene/tree.h"

#include "physics/infall.h"
#include "physics/kerr.h"
#include "physics/worldline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct reader {
    const struct kd_timeline_form *form;
    const struct kd_assets *assets;
    struct kd_timeline *out;
    struct kd_error *error;
};

static struct kd_timeline_key *last(const struct reader *r) { return &r->out->keys[r->out->n_keys - 1]; }

/* A place after that of the key before, if there is one. */
static enum kd_status read_place(struct reader *r, const cJSON *item, const char *pointer, bool first, double *out)
{
    unsigned frame = 0;
    char allowed[80];
    if (!first && last(r)->at >= r->form->most)
        return kd_error_field(r->error, pointer, "%s follows a keyframe at %.9g, the last place that there may be", pointer + 1, r->form->most);
    if (r->form->whole) {
        enum kd_status status = kd_member_whole(item, pointer, first ? 0 : (unsigned)last(r)->at + 1, (unsigned)r->form->most, &frame, r->error);
        *out = frame;
        return status;
    }
    *out = cJSON_IsNumber(item) ? item->valuedouble : NAN;
    if (*out <= r->form->most && (first ? *out >= 0 : *out > last(r)->at))
        return KD_OK;
    snprintf(allowed, sizeof allowed, "a number %s %.9g to %.9g", first ? "from" : "above", first ? 0 : last(r)->at, r->form->most);
    return kd_member_refuse(item, pointer, allowed, r->error);
}

/* "horizon" and "end" of one that falls; what it falls from is where the keyframe has it. */
static double proper_time_to(const struct kd_scene *scene, const char *word)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    if (motion.observer != KD_OBSERVER_INFALL || !kd_worldline_is_known(&motion, &at))
        return NAN;
    double r = !strcmp(word, "horizon") ? kd_kerr_horizon(at.spin) : !strcmp(word, "end") ? kd_infall_last(at.spin) : NAN;
    return r <= at.r ? kd_infall_proper_time(&motion, &at, r) : NAN;
}

static enum kd_status read_proper_time(struct reader *r, const cJSON *item, const char *pointer)
{
    struct kd_timeline_key *key = last(r);
    const struct kd_vantage at = kd_scene_vantage(&key->scene);
    const struct kd_observer_motion motion = kd_scene_observer(&key->scene);
    double value = cJSON_IsNumber(item) ? item->valuedouble : cJSON_IsString(item) ? proper_time_to(&key->scene, item->valuestring) : NAN;
    if (!(value >= 0 && value <= 1e12))
        return kd_member_refuse(item, pointer, "0 to 1000000000000 M, or \"horizon\" or \"end\" of an observer that falls from further out without leaving its "
                                "latitude", r->error);
    if (value > 0 && !kd_worldline_is_known(&motion, &at))
        return kd_member_refuse(item, pointer, "0 unless camera.observer stays, goes round in the equatorial plane or falls without leaving its latitude, from a "
                                "finite camera.r", r->error);
    if (value > 0 && key->scene.motion.proper_time_rate > 0)
        return kd_error_field(r->error, pointer, "%s is given with motion.proper_time_rate, allowed is one of them", pointer + 1);
    key->proper_time = value;
    return KD_OK;
}

static enum kd_status read_scene(struct reader *r, const cJSON *item, const char *pointer)
{
    struct kd_scene *scene = &last(r)->scene;
    enum kd_status status = kd_scene_from_tree(scene, item, true, r->error);
    if (!status && r->assets)
        status = kd_scene_resolve(scene, r->assets, r->error);
    if (!status)
        status = kd_scene_validate(scene, r->error);
    return kd_member_inside(status, pointer, r->error);
}

static enum kd_status read_key(struct reader *r, const cJSON *item, size_t index)
{
    const cJSON *place = NULL, *scene = NULL, *proper_time = NULL;
    char pointer[40], at[60];
    double where = 0;
    enum kd_status status;
    snprintf(pointer, sizeof pointer, "/keyframes/%zu", index);
    if (!cJSON_IsObject(item)) {
        snprintf(at, sizeof at, "an object with %s and scene", r->form->place);
        return kd_member_refuse(item, pointer, at, r->error);
    }
    const struct kd_member members[] = { { r->form->place, &place }, { "scene", &scene }, { "proper_time", &proper_time } };
    KD_TRY(kd_members_read(item, pointer, members, sizeof members / sizeof *members, r->error));
    if (!place || !(scene || proper_time))
        KD_TRY(kd_error_field(r->error, pointer, "a keyframe has a %s and a scene or a proper_time, here %s is missing", r->form->place, place ? "scene" : r->form->place));
    snprintf(at, sizeof at, "%s/%s", pointer, r->form->place);
    KD_TRY(read_place(r, place, at, index == 0, &where));
    if (where > 0) { /* one at 0 takes the place of the first itself */
        r->out->keys[r->out->n_keys] = *last(r);
        r->out->keys[r->out->n_keys++].at = where;
    }
    snprintf(at, sizeof at, "%s/scene", pointer);
    if (scene)
        KD_TRY(read_scene(r, scene, at));
    snprintf(at, sizeof at, "%s/proper_time", pointer);
    if (proper_time)
        KD_TRY(read_proper_time(r, proper_time, at));
done:
    return status;
}

/* One of two words, the second true; false without one. */
static enum kd_status read_word(struct reader *r, const cJSON *item, const char *pointer, const char *no, const char *yes, bool *out)
{
    char allowed[60];
    const char *word = cJSON_IsString(item) ? item->valuestring : item ? "" : no;
    *out = !strcmp(word, yes);
    snprintf(allowed, sizeof allowed, "\"%s\" or \"%s\"", no, yes);
    return *out || !strcmp(word, no) ? KD_OK : kd_member_refuse(item, pointer, allowed, r->error);
}

enum kd_status kd_timeline_read(const struct kd_timeline_items *items, const struct kd_timeline_form *form, const struct kd_assets *assets,
                                const struct kd_scene *first, struct kd_timeline *out, struct kd_error *error)
{
    struct kd_timeline timeline = { 0 };
    struct reader r = { form, assets, &timeline, error };
    size_t n = cJSON_IsArray(items->keyframes) ? (size_t)cJSON_GetArraySize(items->keyframes) : 0, i = 0;
    enum kd_status status;
    KD_TRY(read_word(&r, items->interpolation, "/interpolation", "linear", "smooth", &timeline.smooth));
    KD_TRY(read_word(&r, items->distances, "/distances", "linear", "geometric", &timeline.geometric));
    if (items->keyframes && !cJSON_IsArray(items->keyframes))
        KD_TRY(kd_member_refuse(items->keyframes, "/keyframes", "an array of keyframes", error));
    if (items->keyframes && (!n || n > KD_TIMELINE_KEYS_MAX))
        KD_TRY(kd_error_field(error, "/keyframes", "there are %zu keyframes, allowed are 1 to %d", n, KD_TIMELINE_KEYS_MAX));
    timeline.keys = calloc(n + 1, sizeof *timeline.keys);
    if (!timeline.keys)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %zu scenes", n + 1));
    timeline.n_keys = 1;
    timeline.keys[0].scene = *first;
    for (const cJSON *item = items->keyframes ? items->keyframes->child : NULL; item; item = item->next)
        KD_TRY(read_key(&r, item, i++));
done:
    if (status)
        kd_timeline_finish(&timeline);
    else
        *out = timeline;
    return status;
}

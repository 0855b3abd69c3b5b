/* Reads a timeline from a request. */
#include "document/document.h"
#include "document/members.h"
#include "document/number.h"
#include "scene/timeline.h"
#include "scene/tree.h"

#include "physics/spacetime/infall.h"
#include "physics/spacetime/kerr.h"
#include "physics/spacetime/worldline.h"

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

/* Reads the place of a keyframe. It must be greater than the place of the previous key. */
static enum kd_status read_place(struct reader *r, const cJSON *item, const char *pointer, bool first, double *out)
{
    unsigned frame = 0;
    char allowed[80];
    if (!first && last(r)->at >= r->form->most)
        return kd_error_field(r->error, pointer,
                              "%s cannot be used, because the keyframe before it is at %.9g, the latest place",
                              pointer + 1, r->form->most);
    if (r->form->whole) {
        enum kd_status status = kd_member_whole(item, pointer, first ? 0 : (unsigned)last(r)->at + 1,
                                                (unsigned)r->form->most, &frame, r->error);
        *out = frame;
        return status;
    }
    *out = cJSON_IsNumber(item) ? item->valuedouble : NAN;
    if (*out <= r->form->most && (first ? *out >= 0 : *out > last(r)->at))
        return KD_OK;
    snprintf(allowed, sizeof allowed, "a number %s %.9g to %.9g", first ? "from" : "above", first ? 0 : last(r)->at,
             r->form->most);
    return kd_member_refuse(item, pointer, allowed, r->error);
}

/* The proper time that the word "horizon" or "end" stands for, for a falling observer. The parameters of the fall
 * are those of the keyframe. */
static double proper_time_to(const struct kd_scene *scene, const char *word)
{
    const struct kd_vantage at = kd_scene_vantage(scene);
    const struct kd_observer_motion motion = kd_scene_observer(scene);
    if (motion.observer != KD_OBSERVER_INFALL || !kd_worldline_is_known(&motion, &at))
        return NAN;
    double r = !strcmp(word, "horizon") ? at.hole.outer : !strcmp(word, "end") ? kd_infall_last(&at.hole) : NAN;
    return r <= at.r ? kd_infall_proper_time(&motion, &at, r) : NAN;
}

static enum kd_status read_proper_time(struct reader *r, const cJSON *item, const char *pointer)
{
    struct kd_timeline_key *key = last(r);
    const struct kd_vantage at = kd_scene_vantage(&key->scene);
    const struct kd_observer_motion motion = kd_scene_observer(&key->scene);
    double value = cJSON_IsNumber(item)   ? item->valuedouble
                   : cJSON_IsString(item) ? proper_time_to(&key->scene, item->valuestring)
                                          : NAN;
    if (!(value >= 0 && value <= 1e12))
        return kd_member_refuse(item, pointer,
                                "0 to 1000000000000 M, or \"horizon\" or \"end\" for an observer that falls from "
                                "further out at constant latitude",
                                r->error);
    if (value > 0 && !kd_worldline_is_known(&motion, &at))
        return kd_member_refuse(item, pointer,
                                "0 unless the observer stays at a finite camera.r, orbits there in the equatorial "
                                "plane, or falls from there at constant latitude",
                                r->error);
    if (value > 0 && key->scene.motion.proper_time_rate > 0)
        return kd_error_field(r->error, pointer, "%s cannot be used with motion.proper_time_rate", pointer + 1);
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

static const char *const interpolations[] = { KD_INTERPOLATIONS(KD_WORD_OF, KD_COMMA) },
                         *const eases[] = { KD_EASES(KD_WORD_OF, KD_COMMA) },
                         *const distances[] = { KD_DISTANCES(KD_WORD_OF, KD_COMMA) },
                         *const angles[] = { KD_ANGLES(KD_WORD_OF, KD_COMMA) };
#define READ_WORD(r, item, pointer, words, out) \
    kd_member_word(item, pointer, words, sizeof words / sizeof *words, out, (r)->error)

static enum kd_status read_look_at(struct reader *r, const cJSON *item, const char *pointer, struct kd_aim *out)
{
    static const struct kd_row rows[] = {
        { .name = "r", .offset = offsetof(struct kd_aim, r), .initial = INFINITY, .most = KD_LOOK_AT_FAR, .unit = "M" },
        { .name = "theta_deg",
          .offset = offsetof(struct kd_aim, theta_deg),
          .initial = 90,
          .most = 180,
          .unit = "degrees" },
        { .name = "phi_deg",
          .offset = offsetof(struct kd_aim, phi_deg),
          .least = -360,
          .most = 360,
          .unit = "degrees" },
    };
    static const struct kd_document place = { .rows = rows, .n = sizeof rows / sizeof *rows };
    const char *word = cJSON_IsString(item) ? item->valuestring : "";
    *out = (struct kd_aim) { .kind = !strcmp(word, "hole")  ? KD_AIM_HOLE
                                     : cJSON_IsObject(item) ? KD_AIM_PLACE
                                                            : KD_AIM_FREE };
    if (out->kind == KD_AIM_HOLE || !strcmp(word, "free"))
        return KD_OK;
    if (out->kind == KD_AIM_FREE)
        return kd_member_refuse(
            item, pointer, "\"hole\", \"free\" or an object with theta_deg, phi_deg and r; without r it is a direction",
            r->error);
    kd_document_defaults(&place, out);
    return kd_document_read(&place, out, item, pointer, NULL, r->error);
}

static enum kd_status read_key(struct reader *r, const cJSON *item, size_t index)
{
    struct key_items { const cJSON *place, *scene, *proper_time, *ease, *look_at; } key;
    char pointer[40], at[60];
    unsigned word = 0;
    double where = 0;
    enum kd_status status;
    snprintf(pointer, sizeof pointer, "/keyframes/%zu", index);
    if (!cJSON_IsObject(item)) {
        snprintf(at, sizeof at, "an object with %s and scene", r->form->place);
        return kd_member_refuse(item, pointer, at, r->error);
    }
#define ITEM(called, member) \
    { \
        .name = called, .kind = KD_KIND_JSON, .offset = offsetof(struct key_items, member) \
    }
    const struct kd_row rows[] = { ITEM(r->form->place, place), ITEM("scene", scene), ITEM("proper_time", proper_time),
                                   ITEM("ease", ease), ITEM("look_at", look_at) };
#undef ITEM
    const struct kd_document document = { .rows = rows, .n = sizeof rows / sizeof *rows };
    kd_document_defaults(&document, &key);
    KD_TRY(kd_document_read(&document, &key, item, pointer, NULL, r->error));
    if (!key.place || !(key.scene || key.proper_time || key.look_at))
        KD_TRY(kd_error_field(r->error, pointer,
                              "a keyframe must have a %s, and a scene, a proper_time or a look_at; %s is missing",
                              r->form->place, key.place ? "scene" : r->form->place));
    snprintf(at, sizeof at, "%s/%s", pointer, r->form->place);
    KD_TRY(read_place(r, key.place, at, index == 0, &where));
    if (where > 0) { /* otherwise the keyframe is at place 0 and replaces the first key */
        r->out->keys[r->out->n_keys] = *last(r);
        r->out->keys[r->out->n_keys++].at = where;
    }
    snprintf(at, sizeof at, "%s/scene", pointer);
    if (key.scene)
        KD_TRY(read_scene(r, key.scene, at));
    snprintf(at, sizeof at, "%s/proper_time", pointer);
    if (key.proper_time)
        KD_TRY(read_proper_time(r, key.proper_time, at));
    snprintf(at, sizeof at, "%s/ease", pointer);
    KD_TRY(READ_WORD(r, key.ease, at, eases, &word));
    last(r)->ease = (enum kd_ease)word;
    snprintf(at, sizeof at, "%s/look_at", pointer);
    if (key.look_at)
        KD_TRY(read_look_at(r, key.look_at, at, &last(r)->aim));
done:
    return status;
}

const char *kd_timeline_manner(const struct kd_timeline_items *t)
{
    return t->interpolation ? "interpolation"
           : t->distances   ? "distances"
           : t->angles      ? "angles"
           : t->ease        ? "ease"
           : t->look_at     ? "look_at"
                            : NULL;
}

enum kd_status kd_timeline_read(const struct kd_timeline_items *items, const struct kd_timeline_form *form,
                                const struct kd_assets *assets, const struct kd_scene *first, struct kd_timeline *out,
                                struct kd_error *error)
{
    struct kd_timeline timeline = { 0 };
    struct reader r = { form, assets, &timeline, error };
    size_t n = cJSON_IsArray(items->keyframes) ? (size_t)cJSON_GetArraySize(items->keyframes) : 0, i = 0;
    enum kd_status status;
    unsigned interpolation = 0, ease = 0, geometric = 0, shorter = 0;
    KD_TRY(READ_WORD(&r, items->interpolation, "/interpolation", interpolations, &interpolation));
    KD_TRY(READ_WORD(&r, items->distances, "/distances", distances, &geometric));
    KD_TRY(READ_WORD(&r, items->angles, "/angles", angles, &shorter));
    KD_TRY(READ_WORD(&r, items->ease, "/ease", eases, &ease));
    timeline.interpolation = (enum kd_interpolation)interpolation;
    timeline.ease = (enum kd_ease)ease;
    timeline.geometric = geometric;
    timeline.shorter = shorter;
    if (items->keyframes && !cJSON_IsArray(items->keyframes))
        KD_TRY(kd_member_refuse(items->keyframes, "/keyframes", "an array of keyframes", error));
    if (items->keyframes && (!n || n > KD_TIMELINE_KEYS_MAX))
        KD_TRY(kd_error_field(error, "/keyframes", "there are %zu keyframes; there must be 1 to %d", n,
                              KD_TIMELINE_KEYS_MAX));
    timeline.keys = calloc(n + 1, sizeof *timeline.keys);
    if (!timeline.keys)
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for %zu scenes", n + 1));
    timeline.n_keys = 1;
    timeline.keys[0].scene = *first;
    if (items->look_at)
        KD_TRY(read_look_at(&r, items->look_at, "/look_at", &timeline.keys[0].aim));
    for (const cJSON *item = items->keyframes ? items->keyframes->child : NULL; item; item = item->next)
        KD_TRY(read_key(&r, item, i++));
done:
    if (status)
        kd_timeline_finish(&timeline);
    else
        *out = timeline;
    return status;
}

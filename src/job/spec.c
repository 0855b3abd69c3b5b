#include "job/spec.h"

#include "playground/json.h"
#include "playground/show.h"
#include "render/frame/blur.h"
#include "document/document.h"
#include "document/members.h"
#include "scene/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define VALUES_MAX 400000 /* limit of the number of JSON values in a request; a scene has some 40 fields */

enum { ONE, EACH };
static const char *const exposures[] = { [ONE] = "one", [EACH] = "each" };

static const struct kd_timeline_form by_frame = { "frame", KD_JOB_FRAMES_MAX - 1, true };

struct reader {
    struct kd_job_spec *spec;
    struct kd_scene base;
    const struct kd_job_base *asked;
    const struct kd_assets *assets;
    const cJSON *scene, *scenes, *frames, *axes, *output, *playground, *every, *exposure, *blur;
    struct kd_timeline_items timeline;
    struct kd_error *error;
};

#define ITEM(called, member) { .name = called, .kind = KD_KIND_JSON, .offset = offsetof(struct reader, member) }
static const struct kd_row request_rows[] = {
    ITEM("scene", scene),      ITEM("scenes", scenes),
    ITEM("frames", frames),    ITEM("axes", axes),
    ITEM("output", output),    ITEM("playground", playground),
    ITEM("every", every),      ITEM("exposure", exposure),
    ITEM("motion_blur", blur), KD_TIMELINE_ROWS(struct reader, timeline),
};
#undef ITEM
static const struct kd_document request = { .rows = request_rows, .n = sizeof request_rows / sizeof *request_rows };

static enum kd_status read_scene(struct reader *r, const cJSON *item, const char *pointer, struct kd_scene *scene)
{
    enum kd_status status = item ? kd_scene_from_tree(scene, item, false, r->error) : KD_OK;
    if (!status && r->assets)
        status = kd_scene_resolve(scene, r->assets, r->error);
    if (!status && r->asked->change && (status = r->asked->change(r->asked->user, scene, r->error)))
        return status;
    if (!status)
        status = kd_scene_validate(scene, r->error);
    return kd_member_inside(status, pointer, r->error);
}

static enum kd_status read_list(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    struct kd_timeline *all = &spec->timeline;
    int n = cJSON_IsArray(r->scenes) ? cJSON_GetArraySize(r->scenes) : 0;
    char pointer[40];
    if (!n || n > KD_JOB_FRAMES_MAX)
        return cJSON_IsArray(r->scenes)
                   ? kd_error_field(r->error, "/scenes", "there are %d scenes; there must be 1 to %d", n,
                                    KD_JOB_FRAMES_MAX)
                   : kd_member_refuse(r->scenes, "/scenes", "an array of scenes", r->error);
    if (r->scene || r->timeline.keyframes || r->frames || kd_timeline_manner(&r->timeline) || r->axes)
        return kd_error_field(r->error, "/scenes",
                              "scenes cannot be used with scene, axes, keyframes, frames, interpolation, distances, "
                              "angles, ease or look_at");
    all->keys = calloc((size_t)n, sizeof *all->keys);
    enum kd_status status = all->keys ? KD_OK : kd_error_set(r->error, KD_ENOMEM, "out of memory for %d scenes", n);
    spec->listed = true;
    for (const cJSON *item = r->scenes->child; item && !status; item = item->next) {
        struct kd_timeline_key *key = &all->keys[all->n_keys];
        snprintf(pointer, sizeof pointer, "/scenes/%zu", all->n_keys);
        key->at = (double)all->n_keys++;
        key->scene = r->base;
        status = read_scene(r, item, pointer, &key->scene);
    }
    spec->frames = (unsigned)n;
    return status;
}

static enum kd_status refuse_without_keyframes(const struct reader *r)
{
    const char *name = r->frames ? "frames" : kd_timeline_manner(&r->timeline);
    char pointer[40];
    snprintf(pointer, sizeof pointer, "/%s", name);
    return kd_error_field(r->error, pointer,
                          "%s cannot be used without keyframes, because the job is one picture: give keyframes, as in "
                          "\"keyframes\": [{\"frame\": 24, \"scene\": {\"time\": 100}}]",
                          name);
}

static enum kd_status read_sequence(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    struct kd_scene first = r->base;
    const struct kd_timeline_items *t = &r->timeline;
    if (!r->scene)
        return kd_error_field(r->error, "/scene", "scene is missing; a job must have scene or scenes");
    enum kd_status status;
    KD_TRY(read_scene(r, r->scene, "/scene", &first));
    KD_TRY(kd_timeline_read(t, &by_frame, r->assets, &first, &spec->timeline, r->error));
    if (!t->keyframes && (r->frames || kd_timeline_manner(t)))
        KD_TRY(refuse_without_keyframes(r));
    spec->frames = (unsigned)kd_timeline_end(&spec->timeline) + 1;
    if (r->frames)
        KD_TRY(kd_member_whole(r->frames, "/frames", spec->frames, KD_JOB_FRAMES_MAX, &spec->frames, r->error));
done:
    return status;
}

/* Parses a request for a scene with axes. */
static enum kd_status read_sweep(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    struct kd_scene base = r->base;
    enum kd_status status;
    if (r->timeline.keyframes || r->frames || kd_timeline_manner(&r->timeline))
        return kd_error_field(
            r->error, "/axes",
            "axes cannot be used with keyframes, frames, interpolation, distances, angles, ease or look_at");
    KD_TRY(read_scene(r, r->scene, "/scene", &base));
    KD_TRY(kd_sweep_read(r->axes, &base, r->assets, &spec->sweep, r->error));
    spec->frames = spec->sweep->scenes;
    if (spec->series->swept)
        KD_TRY(kd_cube_check(spec->sweep, r->error));
done:
    return status;
}

/* Checks, for each keyframe, that its scene can show the playground. */
static enum kd_status look_through(struct reader *r, const struct kd_playground *p)
{
    const struct kd_timeline *timeline = &r->spec->timeline;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < timeline->n_keys && !status; i++)
        status = kd_member_inside(kd_playground_may_show(p, &timeline->keys[i].scene, r->error),
                                  timeline->n_keys > 1 && i ? "/keyframes" : "/scene", r->error);
    return status;
}

static enum kd_status read_every(struct reader *r)
{
    if (!r->every)
        return kd_error_field(
            r->error, "/every",
            "every is missing; it must be the time in M from one frame of the playground to the next");
    const double every = cJSON_IsNumber(r->every) ? r->every->valuedouble : 0;
    if (!(every > 0) || every > KD_PLAYGROUND_TIME)
        return kd_member_refuse(r->every, "/every", "a number above 0, the time in M from one frame to the next",
                                r->error);
    r->spec->every = every;
    return KD_OK;
}

static const char *named(const struct kd_job_base *base) { return base->preset && *base->preset ? base->preset : NULL; }

/* Parses a request for a film of a playground. Its frames form a sequence. */
static enum kd_status read_film(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    struct kd_playground *p = NULL;
    struct kd_scene first;
    enum kd_status status;
    if (r->scenes || r->axes)
        return kd_error_field(
            r->error, "/playground",
            "playground cannot be used with scenes or axes; it may be used with scene, keyframes and frames");
    if (!cJSON_IsObject(r->playground))
        return kd_member_refuse(r->playground, "/playground", "an object: a document of a playground, or a snapshot",
                                r->error);
    KD_TRY(read_every(r));
    KD_TRY(kd_member_inside(kd_playground_read_tree(r->playground, &p, r->error), "/playground", r->error));
    if (!r->asked->scene && !named(r->asked))
        KD_TRY(kd_playground_usual_scene(kd_playground_preset_in(r->playground), p, &r->base, r->error));
    first = r->base;
    KD_TRY(read_scene(r, r->scene, "/scene", &first));
    KD_TRY(kd_timeline_read(&r->timeline, &by_frame, r->assets, &first, &spec->timeline, r->error));
    spec->frames = (unsigned)kd_timeline_end(&spec->timeline) + 1;
    if (!r->frames && !r->timeline.keyframes)
        KD_TRY(kd_error_field(r->error, "/frames",
                              "frames is missing; it must be the number of pictures of the playground, unless the last "
                              "keyframe is at the last picture"));
    if (r->frames)
        KD_TRY(kd_member_whole(r->frames, "/frames", spec->frames, KD_JOB_FRAMES_MAX, &spec->frames, r->error));
    KD_TRY(look_through(r, p));
    KD_TRY(kd_playground_show(p, &spec->first, r->error));
done:
    kd_playground_destroy(p);
    return status;
}

enum kd_status kd_job_spec_playground(const char *text, size_t length, struct kd_playground **out,
                                      struct kd_error *error)
{
    cJSON *root = NULL;
    enum kd_status status;
    KD_TRY(kd_tree_parse(text, length, KD_JOB_FILM_MAX, VALUES_MAX, &root, error));
    KD_TRY(kd_playground_read_tree(cJSON_GetObjectItemCaseSensitive(root, "playground"), out, error));
done:
    kd_tree_free(root);
    return status;
}

static enum kd_status read_output(struct reader *r)
{
    char known[200];
    if (r->output)
        r->spec->series = cJSON_IsString(r->output) ? kd_series_named(r->output->valuestring) : NULL;
    if (r->spec->series && r->spec->series->swept && !r->axes)
        return kd_error_field(r->error, "/output",
                              "output is \"%s\", which needs axes, as in \"axes\": {\"spacetime.spin\": [0, 0.5, 0.9]}",
                              r->spec->series->name);
    if (r->spec->series)
        return KD_OK;
    for (size_t i = 0, n = 0; i < kd_n_series && n < sizeof known; i++)
        n += (size_t)snprintf(known + n, sizeof known - n, "%s\"%s\"", i ? " or " : "", kd_series_all[i]->name);
    return kd_member_refuse(r->output, "/output", known, r->error);
}

static bool makes_pictures(const struct kd_job_spec *spec) { return spec->series->frame->carries & KD_CARRIES_PICTURE; }

/* Parses "exposure". A common exposure is refused in two cases: the frames of a film of a playground are not known
 * in advance, and the scenes of a sweep are independent of each other. */
static enum kd_status read_exposure(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    const bool pictures = makes_pictures(spec);
    unsigned word = !spec->listed && !spec->sweep && !r->playground && spec->frames > 1 && pictures ? ONE : EACH;
    enum kd_status status =
        kd_member_word(r->exposure, "/exposure", exposures, sizeof exposures / sizeof *exposures, &word, r->error);
    if (status)
        return status;
    if (r->exposure && !pictures)
        return kd_error_field(r->error, "/exposure",
                              "exposure cannot be used with \"output\": \"%s\", because only pictures have an exposure",
                              spec->series->name);
    if (word == ONE && (spec->sweep || r->playground))
        return kd_error_field(r->error, "/exposure",
                              "exposure is \"one\"; with %s it must be \"each\"; a number in style.exposure gives all "
                              "frames the same exposure",
                              spec->sweep ? "axes" : "a playground");
    spec->one_exposure = word == ONE;
    return KD_OK;
}

/* Returns the words for the part of the request that excludes motion blur; NULL if motion blur is possible. */
static const char *unblurred(const struct reader *r)
{
    return r->playground              ? "a playground, whose bodies move from frame to frame"
           : r->spec->sweep           ? "axes, because nothing moves between the scenes of a sweep"
           : r->spec->listed          ? "scenes, because nothing moves between listed scenes"
           : !r->timeline.keyframes   ? "a scene without keyframes, in which nothing moves"
           : !makes_pictures(r->spec) ? "an output of numbers, because only light can be averaged"
                                      : NULL;
}

static enum kd_status read_blur(struct reader *r)
{
    struct asked {
        uint32_t samples;
        double shutter;
    } blur;
    static const struct kd_row rows[] = {
        { .name = "samples",
          .kind = KD_KIND_INT,
          .offset = offsetof(struct asked, samples),
          .least = 1,
          .most = KD_BLUR_SAMPLES },
        { .name = "shutter",
          .kind = KD_KIND_REAL,
          .offset = offsetof(struct asked, shutter),
          .initial = 0.5,
          .most = 1,
          .open = KD_OPEN_BELOW,
          .allowed = "a number above 0, at most 1: the open time of the shutter as a fraction of a frame's time" },
    };
    static const struct kd_document document = { .rows = rows, .n = sizeof rows / sizeof *rows };
    const struct kd_job_base *asked = r->asked;
    struct kd_job_spec *spec = r->spec;
    enum kd_status status = KD_OK;
    kd_document_defaults(&document, &blur);
    if (!r->blur && !asked->samples)
        return asked->shutter > 0 ? kd_error_field(r->error, "/motion_blur",
                                                   "samples is missing, but shutter needs it; samples is the number "
                                                   "of pictures averaged for each frame")
                                  : KD_OK;
    if (unblurred(r))
        return kd_error_field(r->error, "/motion_blur",
                              "motion_blur cannot be used with %s; it needs keyframes and an output of pictures",
                              unblurred(r));
    if (r->blur && !cJSON_IsObject(r->blur))
        return kd_member_refuse(r->blur, "/motion_blur",
                                "an object with samples and shutter, as in {\"samples\": 16, \"shutter\": 0.5}",
                                r->error);
    if (r->blur)
        KD_TRY(kd_document_read(&document, &blur, r->blur, "/motion_blur", NULL, r->error));
    if (!blur.samples && !asked->samples)
        KD_TRY(kd_error_field(
            r->error, "/motion_blur/samples",
            "samples is missing; it must be the number of pictures whose mean is a frame's light, 1 to %d",
            KD_BLUR_SAMPLES));
    spec->blur.samples = asked->samples ? asked->samples : blur.samples;
    spec->blur.shutter = asked->shutter > 0 ? asked->shutter : blur.shutter;
done:
    return status;
}

enum kd_status kd_job_spec_parse(const char *text, size_t length, const struct kd_job_base *base,
                                 const struct kd_assets *assets, struct kd_job_spec *out, struct kd_error *error)
{
    struct kd_job_spec spec = { .series = kd_series_all[0], .exposure = NAN };
    struct reader r = { .spec = &spec, .asked = base, .assets = assets, .error = error };
    cJSON *root = NULL;
    kd_scene_defaults(&r.base);
    if (base->scene)
        r.base = *base->scene;
    enum kd_status status;
    if (named(base))
        KD_TRY(kd_member_inside(kd_scene_preset(&r.base, base->preset, error), "/preset", error));
    KD_TRY(kd_tree_parse(text, length, KD_JOB_FILM_MAX, VALUES_MAX, &root, error));
    if (!cJSON_IsObject(root))
        KD_TRY(kd_member_refuse(root, "", "an object", error));
    KD_TRY(kd_document_read(&request, &r, root, "", NULL, error));
    KD_TRY(read_output(&r));
    if (r.every && !r.playground)
        KD_TRY(kd_error_field(
            error, "/every",
            "every cannot be used without a playground; give one, as in \"playground\": {\"preset\": \"disruption\"}"));
    if (!r.playground && length > KD_JOB_BODY_MAX)
        KD_TRY(
            kd_error_set(error, KD_ETOOBIG, "a job without a playground must have at most %u bytes", KD_JOB_BODY_MAX));
    KD_TRY(r.playground ? read_film(&r) : r.scenes ? read_list(&r) : r.axes ? read_sweep(&r) : read_sequence(&r));
    KD_TRY(read_exposure(&r));
    KD_TRY(read_blur(&r));
done:
    kd_tree_free(root);
    if (status)
        kd_job_spec_finish(&spec);
    else
        *out = spec;
    return status;
}

void kd_job_spec_finish(struct kd_job_spec *spec)
{
    kd_timeline_finish(&spec->timeline);
    kd_dynamic_bodies_release(spec->first);
    kd_sweep_free(spec->sweep);
    *spec = (struct kd_job_spec) { 0 };
}

static enum kd_status scene_at(const struct kd_job_spec *spec, double at, struct kd_scene *out, struct kd_error *error)
{
    struct kd_error inner = { 0 };
    if (kd_timeline_scene(&spec->timeline, at, out, &inner))
        return kd_error_field(error, inner.pointer, "frame %.9g, between two keyframes, is not a valid scene: %.380s",
                              at, inner.message);
    if (isinf(out->style.exposure) && !isnan(spec->exposure))
        out->style.exposure = spec->exposure;
    return KD_OK;
}

enum kd_status kd_job_spec_scene(const struct kd_job_spec *spec, unsigned frame, struct kd_scene *out,
                                 struct kd_error *error)
{
    return spec->sweep ? kd_sweep_scene(spec->sweep, frame, out, error) : scene_at(spec, frame, out, error);
}

enum kd_status kd_job_spec_sample(const struct kd_job_spec *spec, unsigned frame, unsigned sample, struct kd_scene *out,
                                  struct kd_error *error)
{
    return scene_at(spec, frame + spec->blur.shutter * sample / spec->blur.samples, out, error);
}

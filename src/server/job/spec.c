#include "server/job/spec.h"

#include "scene/text.h"
#include "scene/tree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VALUES_MAX 400000 /* some 40 fields a scene */
#define KEYFRAMES_MAX 1000 /* between which every frame is interpolated */

struct reader {
    struct kd_job_spec *spec;
    struct kd_scene base;
    const struct kd_assets *assets;
    const cJSON *scene, *scenes, *keyframes, *frames, *interpolation, *output;
    struct kd_error *error;
};

static enum kd_status not_a(struct reader *r, const cJSON *item, const char *pointer, const char *allowed)
{
    char given[KD_VALUE_SIZE];
    struct kd_value value = kd_tree_value(item);
    kd_value_describe(&value, given);
    return kd_error_field(r->error, pointer, "%s is %s, allowed is %s", *pointer ? pointer + 1 : "the document", given, allowed);
}

/* A member that is known, and may be given once. */
struct member {
    const char *name;
    const cJSON **to;
};
static enum kd_status read_members(struct reader *r, const cJSON *object, const char *pointer, const struct member *members, size_t n)
{
    for (const cJSON *item = object->child; item; item = item->next) {
        char at[sizeof r->error->pointer], name[60], known[120] = "";
        size_t i = 0;
        snprintf(at, sizeof at, "%s", pointer);
        kd_text_pointer(at, sizeof at, item->string);
        kd_text_clip(name, sizeof name, item->string);
        while (i < n && strcmp(members[i].name, item->string))
            i++;
        if (i < n && *members[i].to)
            return kd_error_field(r->error, at, "%s is given twice", name);
        if (i < n) {
            *members[i].to = item;
            continue;
        }
        for (i = 0; i < n; i++)
            snprintf(known + strlen(known), sizeof known - strlen(known), "%s%s", i ? ", " : "", members[i].name);
        return kd_error_field(r->error, at, "there is no field %s here; known are %s", name, known);
    }
    return KD_OK;
}

static enum kd_status whole(struct reader *r, const cJSON *item, const char *pointer, unsigned least, unsigned most, unsigned *out)
{
    char allowed[60];
    double value = cJSON_IsNumber(item) ? item->valuedouble : -1;
    snprintf(allowed, sizeof allowed, "a whole number from %u to %u", least, most);
    if (!(value >= least && value <= most) || value != floor(value))
        return not_a(r, item, pointer, allowed);
    *out = (unsigned)value;
    return KD_OK;
}

/* Turns an error about a scene into one about the request. */
static enum kd_status inside(struct reader *r, enum kd_status status, const char *pointer)
{
    char joined[2 * sizeof r->error->pointer];
    if (!status || !r->error)
        return status;
    snprintf(joined, sizeof joined, "%s%s", pointer, r->error->pointer);
    snprintf(r->error->pointer, sizeof r->error->pointer, "%.*s", (int)sizeof r->error->pointer - 1, joined);
    return status;
}

static enum kd_status read_scene(struct reader *r, const cJSON *item, const char *pointer, bool patch, struct kd_scene *scene)
{
    enum kd_status status = kd_scene_from_tree(scene, item, patch, r->error);
    if (!status && r->assets)
        status = kd_scene_resolve(scene, r->assets, r->error);
    if (!status)
        status = kd_scene_validate(scene, r->error);
    return inside(r, status, pointer);
}

static enum kd_status allocate(struct reader *r, size_t n)
{
    r->spec->keys = calloc(n, sizeof *r->spec->keys);
    return r->spec->keys ? KD_OK : kd_error_set(r->error, KD_ENOMEM, "out of memory for %zu scenes", n);
}

static enum kd_status read_list(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    int n = cJSON_IsArray(r->scenes) ? cJSON_GetArraySize(r->scenes) : 0;
    char pointer[40];
    if (!n || n > KD_JOB_FRAMES_MAX)
        return cJSON_IsArray(r->scenes)
                   ? kd_error_field(r->error, "/scenes", "there are %d scenes, allowed are 1 to %d", n, KD_JOB_FRAMES_MAX)
                   : not_a(r, r->scenes, "/scenes", "an array of scenes");
    if (r->scene || r->keyframes || r->frames || r->interpolation)
        return kd_error_field(r->error, "/scenes", "scenes stands alone: scene, keyframes, frames and interpolation do not go with it");
    enum kd_status status = allocate(r, (size_t)n);
    spec->listed = true;
    for (const cJSON *item = r->scenes->child; item && !status; item = item->next) {
        struct kd_job_key *key = &spec->keys[spec->n_keys];
        snprintf(pointer, sizeof pointer, "/scenes/%zu", spec->n_keys);
        key->frame = (unsigned)spec->n_keys++;
        key->scene = r->base;
        status = read_scene(r, item, pointer, false, &key->scene);
    }
    spec->frames = (unsigned)n;
    return status;
}

static enum kd_status read_keyframe(struct reader *r, const cJSON *item, size_t index)
{
    struct kd_job_spec *spec = r->spec;
    const cJSON *frame = NULL, *scene = NULL;
    char pointer[40], at[60];
    unsigned number = 0;
    snprintf(pointer, sizeof pointer, "/keyframes/%zu", index);
    if (!cJSON_IsObject(item))
        return not_a(r, item, pointer, "an object with frame and scene");
    enum kd_status status = read_members(r, item, pointer, (struct member[]) { { "frame", &frame }, { "scene", &scene } }, 2);
    if (status)
        return status;
    if (!frame || !scene)
        return kd_error_field(r->error, pointer, "a keyframe has a frame and a scene, here %s is missing", frame ? "scene" : "frame");
    snprintf(at, sizeof at, "%s/frame", pointer);
    status = whole(r, frame, at, index ? spec->keys[spec->n_keys - 1].frame + 1 : 0, KD_JOB_FRAMES_MAX - 1, &number);
    if (status)
        return status;
    if (number) { /* one that says frame 0 takes the place of the scene itself */
        spec->keys[spec->n_keys] = (struct kd_job_key) { number, spec->keys[spec->n_keys - 1].scene };
        spec->n_keys++;
    }
    snprintf(at, sizeof at, "%s/scene", pointer);
    return read_scene(r, scene, at, true, &spec->keys[spec->n_keys - 1].scene);
}

static enum kd_status read_interpolation(struct reader *r)
{
    if (!r->interpolation)
        return KD_OK;
    const char *word = cJSON_IsString(r->interpolation) ? r->interpolation->valuestring : "";
    r->spec->smooth = !strcmp(word, "smooth");
    return r->spec->smooth || !strcmp(word, "linear") ? KD_OK
                                                      : not_a(r, r->interpolation, "/interpolation", "\"linear\" or \"smooth\"");
}

static enum kd_status read_sequence(struct reader *r)
{
    struct kd_job_spec *spec = r->spec;
    size_t n = cJSON_IsArray(r->keyframes) ? (size_t)cJSON_GetArraySize(r->keyframes) : 0, i = 0;
    if (!r->scene)
        return kd_error_field(r->error, "/scene", "scene is missing: a job has a scene, or scenes");
    enum kd_status status = read_interpolation(r);
    if (status)
        return status;
    if (!r->keyframes && (r->frames || r->interpolation))
        return kd_error_field(r->error, r->frames ? "/frames" : "/interpolation",
                              "without keyframes a job is one picture: leave %s out, or say what changes, as in "
                              "\"keyframes\": [{\"frame\": 24, \"scene\": {\"time\": 100}}]", r->frames ? "frames" : "interpolation");
    if (r->keyframes && !cJSON_IsArray(r->keyframes))
        return not_a(r, r->keyframes, "/keyframes", "an array of keyframes");
    if (r->keyframes && (!n || n > KEYFRAMES_MAX))
        return kd_error_field(r->error, "/keyframes", "there are %zu keyframes, allowed are 1 to %d", n, KEYFRAMES_MAX);
    if ((status = allocate(r, n + 1)))
        return status;
    spec->n_keys = 1;
    spec->keys[0].scene = r->base;
    status = read_scene(r, r->scene, "/scene", false, &spec->keys[0].scene);
    for (const cJSON *item = r->keyframes ? r->keyframes->child : NULL; item && !status; item = item->next)
        status = read_keyframe(r, item, i++);
    spec->frames = spec->keys[spec->n_keys - 1].frame + 1;
    return status || !r->frames ? status : whole(r, r->frames, "/frames", spec->frames, KD_JOB_FRAMES_MAX, &spec->frames);
}

static enum kd_status read_output(struct reader *r)
{
    char known[200];
    if (r->output)
        r->spec->series = cJSON_IsString(r->output) ? kd_series_named(r->output->valuestring) : NULL;
    if (r->spec->series)
        return KD_OK;
    for (size_t i = 0, n = 0; i < kd_n_series && n < sizeof known; i++)
        n += (size_t)snprintf(known + n, sizeof known - n, "%s\"%s\"", i ? " or " : "", kd_series_all[i]->name);
    return not_a(r, r->output, "/output", known);
}

enum kd_status kd_job_spec_parse(const char *text, size_t length, const char *preset, const struct kd_assets *assets, struct kd_job_spec *out,
                                 struct kd_error *error)
{
    struct kd_job_spec spec = { .series = kd_series_all[0] };
    struct reader r = { .spec = &spec, .assets = assets, .error = error };
    const struct member members[] = { { "scene", &r.scene }, { "scenes", &r.scenes }, { "keyframes", &r.keyframes },
                                      { "frames", &r.frames }, { "interpolation", &r.interpolation },
                                      { "output", &r.output } };
    cJSON *root = NULL;
    kd_scene_defaults(&r.base);
    enum kd_status status;
    if (*preset)
        KD_TRY(inside(&r, kd_scene_preset(&r.base, preset, error), "/preset"));
    KD_TRY(kd_tree_parse(text, length, KD_JOB_BODY_MAX, VALUES_MAX, &root, error));
    if (!cJSON_IsObject(root))
        KD_TRY(not_a(&r, root, "", "an object"));
    KD_TRY(read_members(&r, root, "", members, sizeof members / sizeof *members));
    KD_TRY(read_output(&r));
    KD_TRY(r.scenes ? read_list(&r) : read_sequence(&r));
done:
    cJSON_Delete(root);
    if (status)
        kd_job_spec_finish(&spec);
    else
        *out = spec;
    return status;
}

void kd_job_spec_finish(struct kd_job_spec *spec)
{
    free(spec->keys);
    *spec = (struct kd_job_spec) { 0 };
}

static bool continuous(const struct kd_field *field) { return field->kind == KD_FIELD_REAL || field->kind == KD_FIELD_WORD; }

static double value_at(const struct kd_job_spec *spec, size_t key, const struct kd_field *field, size_t index)
{
    return kd_field_get(&spec->keys[key].scene, field, index);
}

/* Gives the slope of the straight line from a key to the next; NAN where there is none: a word, or no next. */
static double secant(const struct kd_job_spec *spec, size_t key, const struct kd_field *field, size_t index)
{
    if (key + 1 >= spec->n_keys)
        return NAN;
    double rise = value_at(spec, key + 1, field, index) - value_at(spec, key, field, index); /* inf - inf is NAN too */
    return isfinite(rise) ? rise / (spec->keys[key + 1].frame - spec->keys[key].frame) : NAN;
}

/* The slope at a key that keeps the curve between its neighbours: the weighted harmonic mean of the secants, 0 at a turning point
 * (Fritsch & Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300, with the weights of Brodlie that SLATEC's PCHIM takes). At rest at both
 * ends. */
static double slope(const struct kd_job_spec *spec, size_t key, const struct kd_field *field, size_t index)
{
    double before = key ? secant(spec, key - 1, field, index) : NAN, after = secant(spec, key, field, index);
    if (!(before * after > 0))
        return 0;
    double h0 = spec->keys[key].frame - spec->keys[key - 1].frame, h1 = spec->keys[key + 1].frame - spec->keys[key].frame;
    double w0 = 2 * h1 + h0, w1 = h1 + 2 * h0;
    return (w0 + w1) / (w0 / before + w1 / after);
}

static double between(const struct kd_job_spec *spec, size_t key, double t, const struct kd_field *field, size_t index)
{
    double from = value_at(spec, key, field, index), to = value_at(spec, key + 1, field, index);
    if (!isfinite(from) || !isfinite(to) || from == to)
        return from;
    if (!spec->smooth)
        return from + t * (to - from);
    double h = spec->keys[key + 1].frame - spec->keys[key].frame, m0 = h * slope(spec, key, field, index), m1 = h * slope(spec, key + 1, field, index);
    double value = from + t * (m0 + t * (3 * (to - from) - 2 * m0 - m1 + t * (m0 + m1 - 2 * (to - from)))); /* cubic Hermite */
    return fmax(fmin(from, to), fmin(fmax(from, to), value)); /* it is between them; its rounding need not be */
}

/* An element that only one of two keyframes has is at its defaults in the other. */
static void section_between(const struct kd_job_spec *spec, size_t key, double t, const struct kd_section *section, struct kd_scene *out)
{
    size_t size = kd_section_size(&spec->keys[key].scene, section), next = kd_section_size(&spec->keys[key + 1].scene, section);
    if (next > size)
        kd_section_resize(out, section, size = next);
    for (size_t index = 0; index < size; index++)
        for (size_t i = section->first; i < section->first + section->count; i++)
            if (continuous(&kd_fields[i]))
                kd_field_put(out, &kd_fields[i], index, between(spec, key, t, &kd_fields[i], index));
}

enum kd_status kd_job_spec_scene(const struct kd_job_spec *spec, unsigned frame, struct kd_scene *out, struct kd_error *error)
{
    size_t key = 0;
    while (key + 1 < spec->n_keys && spec->keys[key + 1].frame <= frame)
        key++;
    *out = spec->keys[key].scene;
    if (spec->keys[key].frame == frame || key + 1 == spec->n_keys)
        return KD_OK;
    double t = (double)(frame - spec->keys[key].frame) / (spec->keys[key + 1].frame - spec->keys[key].frame);
    for (size_t i = 0; i < KD_SECTION_COUNT; i++)
        section_between(spec, key, t, &kd_sections[i], out);
    struct kd_error inner = { 0 };
    if (!kd_scene_validate(out, &inner))
        return KD_OK;
    kd_error_field(error, "/keyframes", "between keyframes, frame %u is no valid scene: %.380s", frame, inner.message);
    return KD_EINVAL;
}

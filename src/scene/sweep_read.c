/* Reads the axes of a sweep, from a request or a command line. */
#include "document/members.h"
#include "document/number.h"
#include "scene/sweep.h"
#include "scene/table.h"
#include "document/text.h"
#include "document/tree.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HITS 1e-9 /* a range reaches its end if the last value differs from it by less than this fraction of a step */
#define EVEN 1e-12

struct reader {
    struct kd_sweep *sweep;
    const struct kd_assets *assets;
    struct kd_error *error;
    /* field of the axis that is being read, which is always the last axis of the sweep so far */
    const struct kd_row *field;
    size_t index; /* index of the list element to which the field belongs */
    char pointer[100];
};

static struct kd_sweep_axis *last(const struct reader *r) { return &r->sweep->axes[r->sweep->n_axes - 1]; }

static enum kd_status no_memory(const struct reader *r)
{
    return kd_error_set(r->error, KD_ENOMEM, "out of memory for the axes of a sweep");
}

static enum kd_status too_many(const struct reader *r, double n)
{
    return kd_error_field(r->error, r->pointer, "the axes make %.6g scenes; they must make at most %d", n,
                          KD_SWEEP_MOST);
}

static enum kd_status begin(struct reader *r, const char *path)
{
    struct kd_sweep *s = r->sweep;
    char name[60];
    snprintf(r->pointer, sizeof r->pointer, "/axes");
    kd_text_pointer(r->pointer, sizeof r->pointer, path);
    kd_text_clip(name, sizeof name, path);
    if (s->n_axes == KD_SWEEP_AXES)
        return kd_error_field(r->error, r->pointer, "%s is one axis too many; there must be at most %d", name,
                              KD_SWEEP_AXES);
    for (size_t i = 0; i < s->n_axes; i++)
        if (kd_scene_same_path(s->axes[i].path, path))
            return kd_error_field(r->error, r->pointer, "%s is given twice", name);
    struct kd_error inner = { 0 };
    if (kd_field_at(path, &r->field, &r->index, &inner))
        return kd_error_field(r->error, r->pointer, "%.400s", inner.message);
    struct kd_sweep_axis axis = { .path = strdup(path), .unit = r->field->unit };
    if (!axis.path)
        return no_memory(r);
    s->axes[s->n_axes++] = axis;
    return KD_OK;
}

/* Text of a value in the form in which the scene stores it: an asset's name is replaced by its hash. */
static const char *resolved(const struct reader *r, const struct kd_scene *scene, const char *text)
{
    return r->field->kind == KD_KIND_ASSET ? kd_field_asset(scene, r->field, r->index) : text;
}

/* Appends a value to the axis. at: JSON pointer of the value. */
static enum kd_status add(struct reader *r, const char *text, const char *at)
{
    struct kd_sweep_axis *axis = last(r);
    struct kd_scene scene = r->sweep->base;
    struct kd_error inner = { 0 };
    enum kd_status status = kd_scene_set(&scene, axis->path, text, &inner);
    if (!status && r->assets)
        status = kd_scene_resolve(&scene, r->assets, &inner);
    if (status == KD_EINVAL)
        return kd_error_field(r->error, at, "%.440s", inner.message);
    if (axis->n >= KD_SWEEP_MOST)
        return too_many(r, (double)axis->n + 1);
    if (!(axis->n & (axis->n - 1))) { /* the array is full and is doubled */
        struct kd_sweep_value *more = realloc(axis->values, (axis->n ? 2 * axis->n : 1) * sizeof *more);
        if (!more)
            return no_memory(r);
        axis->values = more;
    }
    const struct kd_value value = kd_value_typed(text);
    char *copy = strdup(resolved(r, &scene, text));
    if (status || !copy) {
        free(copy);
        return no_memory(r);
    }
    const bool numeric = value.kind == KD_VALUE_NUMBER && r->field->kind != KD_KIND_ASSET;
    axis->values[axis->n++] = (struct kd_sweep_value) {
        .text = copy,
        .number = numeric ? value.number : NAN,
        .matter = kd_scene_same_path(axis->path, "volume.grid") ? scene.matter : (struct kd_scene_matter) { 0 },
    };
    return KD_OK;
}

static enum kd_status add_number(struct reader *r, double value, const char *at)
{
    char text[KD_NUMBER_SIZE];
    kd_number_format(text, value == 0 ? 0 : value);
    return add(r, text, at);
}

/* A parsed range. by: ':' if the range has a step, '/' if it has a count, or 0 if the text is not a range. */
struct range {
    double from, to, step;
    char by;
};

static struct range range_of(const char *text)
{
    struct range out = { .by = 0 };
    double *const to[] = { &out.from, &out.to, &out.step };
    const char *at = text;
    for (int i = 0; i < 3; i++) {
        size_t n = kd_number_span_typed(at, strlen(at));
        char by = at[n];
        *to[i] = n ? kd_number_parse(at) : NAN;
        if (!n || (i == 0 && by != ':') || (i == 1 && by != ':' && by != '/') || (i == 2 && by))
            return (struct range) { .by = 0 };
        out.by = i == 1 ? by : out.by;
        at += n + 1;
    }
    return out;
}

static enum kd_status add_range(struct reader *r, const char *text)
{
    struct range range = range_of(text);
    char shown[60];
    kd_text_clip(shown, sizeof shown, text);
    const bool count = range.by == '/' && range.step >= 2 && range.step == floor(range.step);
    double steps = count ? range.step - 1 : range.by == ':' ? (range.to - range.from) / range.step : NAN;
    if (count)
        range.step = (range.to - range.from) / steps;
    if (!(steps >= 0) || !isfinite(steps) || !isfinite(range.step) || range.step == 0)
        return kd_error_field(
            r->error, r->pointer,
            "%s is \"%s\"; it must be a list of values, or a range whose steps lead from start to stop: "
            "\"10:80:15\" (start:stop:step) or \"10:80/15\" (start:stop/count)",
            last(r)->path, shown);
    if (steps > KD_SWEEP_MOST)
        return too_many(r, steps + 1);
    size_t n = (size_t)(steps + HITS) + 1;
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n && !status; i++) {
        char rounded[KD_NUMBER_SIZE];
        snprintf(rounded, sizeof rounded, "%.15g", range.from + (double)i * range.step);
        bool hits = fabs((double)i - steps) < HITS;
        status = add_number(r, hits ? range.to : i ? kd_number_parse(rounded) : range.from, r->pointer);
    }
    return status;
}

static int by_text(const void *a, const void *b) { return strcmp(*(char *const *)a, *(char *const *)b); }

static enum kd_status refuse_twins(struct reader *r)
{
    const struct kd_sweep_axis *axis = last(r);
    char **texts = malloc(axis->n * sizeof *texts);
    const char *twin = NULL;
    char shown[60];
    for (size_t i = 0; i < axis->n && texts; i++)
        texts[i] = axis->values[i].text;
    if (texts)
        qsort(texts, axis->n, sizeof *texts, by_text);
    for (size_t i = 1; i < axis->n && texts; i++)
        twin = strcmp(texts[i], texts[i - 1]) ? twin : texts[i];
    if (twin)
        kd_text_clip(shown, sizeof shown, twin);
    enum kd_status status = !texts ? no_memory(r)
                            : twin ? kd_error_field(r->error, r->pointer, "%s holds %s twice", axis->path, shown)
                                   : KD_OK;
    free(texts);
    return status;
}

/* Completes the axis: checks its values, and determines whether they are numbers and evenly spaced. */
static enum kd_status end(struct reader *r)
{
    struct kd_sweep *s = r->sweep;
    struct kd_sweep_axis *axis = last(r);
    if (!axis->n)
        return kd_error_field(r->error, r->pointer, "%s is an empty list; it must have at least one value", axis->path);
    double all = (double)(s->scenes ? s->scenes : 1) * (double)axis->n;
    if (all > KD_SWEEP_MOST)
        return too_many(r, all);
    s->scenes = (unsigned)all;
    axis->numeric = true;
    for (size_t i = 0; i < axis->n; i++)
        axis->numeric = axis->numeric && !isnan(axis->values[i].number);
    const struct kd_sweep_value *v = axis->values;
    double most = axis->numeric ? fmax(fabs(v[0].number), fabs(v[axis->n - 1].number)) : 0;
    double step = axis->n > 1 ? (v[axis->n - 1].number - v[0].number) / (double)(axis->n - 1) : 0;
    axis->even = axis->numeric && (axis->n == 1 || step != 0);
    for (size_t i = 0; i < axis->n; i++)
        axis->even = axis->even && fabs(v[i].number - v[0].number - (double)i * step) <= EVEN * most;
    return refuse_twins(r);
}

static struct kd_sweep *create(const struct kd_scene *base)
{
    struct kd_sweep *sweep = calloc(1, sizeof *sweep);
    if (sweep)
        sweep->base = *base;
    return sweep;
}

static enum kd_status finish(struct reader *r, enum kd_status status, struct kd_sweep **out)
{
    if (status)
        kd_sweep_free(r->sweep);
    else
        *out = r->sweep;
    return status;
}

/* Joins the words of an array, which is a value of image.layers, to "a,b". */
static enum kd_status join(struct reader *r, const cJSON *words, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (const cJSON *word = words->child; word && !status; word = word->next)
        status = kd_buffer_printf(out, "%s%s", word == words->child ? "" : ",",
                                  cJSON_IsString(word) ? word->valuestring : "?");
    return status ? no_memory(r) : KD_OK;
}

static enum kd_status add_words(struct reader *r, const cJSON *item, const char *at)
{
    struct kd_buffer words = { 0 };
    enum kd_status status;
    KD_TRY(join(r, item, &words));
    KD_TRY(add(r, words.data ? (const char *)words.data : "", at));
done:
    kd_buffer_finish(&words);
    return status;
}

static enum kd_status add_item(struct reader *r, const cJSON *item, const char *at)
{
    if (cJSON_IsNumber(item))
        return add_number(r, item->valuedouble, at);
    if (cJSON_IsBool(item))
        return add(r, cJSON_IsTrue(item) ? "true" : "false", at);
    if (cJSON_IsArray(item) && r->field->kind == KD_KIND_SERIES)
        return add_words(r, item, at);
    if (cJSON_IsString(item) &&
        (r->field->kind == KD_KIND_ASSET || kd_value_typed(item->valuestring).kind == KD_VALUE_STRING))
        return add(r, item->valuestring, at);
    return kd_member_refuse(item, at, "a value of its field: a number, a word, true or false", r->error);
}

static enum kd_status read_axis(struct reader *r, const cJSON *axis)
{
    char at[sizeof r->pointer + 24];
    size_t i = 0;
    enum kd_status status;
    KD_TRY(begin(r, axis->string));
    if (cJSON_IsString(axis))
        KD_TRY(add_range(r, axis->valuestring));
    else if (!cJSON_IsArray(axis))
        KD_TRY(kd_member_refuse(axis, r->pointer, "a list of values, or a range as in \"10:80:15\"", r->error));
    for (const cJSON *item = cJSON_IsArray(axis) ? axis->child : NULL; item; item = item->next) {
        snprintf(at, sizeof at, "%s/%zu", r->pointer, i++);
        KD_TRY(add_item(r, item, at));
    }
    KD_TRY(end(r));
done:
    return status;
}

enum kd_status kd_sweep_read(const cJSON *axes, const struct kd_scene *base, const struct kd_assets *assets,
                             struct kd_sweep **out, struct kd_error *error)
{
    struct reader r = { .sweep = create(base), .assets = assets, .error = error, .pointer = "/axes" };
    enum kd_status status;
    if (!r.sweep)
        KD_TRY(no_memory(&r));
    if (!cJSON_IsObject(axes) || !axes->child)
        KD_TRY(kd_member_refuse(
            axes, "/axes",
            "an object of one or more fields, each with its values, as in {\"spacetime.spin\": [0, 0.5]}", error));
    for (const cJSON *axis = axes->child; axis; axis = axis->next)
        KD_TRY(read_axis(&r, axis));
done:
    return finish(&r, status, out);
}

/* Adds the values of a text "a,b", one after the other. */
static enum kd_status add_typed(struct reader *r, char *values)
{
    enum kd_status status = KD_OK;
    for (char *value = values, *comma; value && !status; value = comma) {
        comma = strchr(value, ',');
        if (comma)
            *comma++ = 0;
        const struct kd_value typed = kd_value_typed(value);
        status = typed.kind == KD_VALUE_NUMBER && r->field->kind != KD_KIND_ASSET
                     ? add_number(r, typed.number, r->pointer)
                     : add(r, value, r->pointer);
    }
    return status;
}

/* Reads a text FIELD=VALUES. The text is modified. */
static enum kd_status read_typed(struct reader *r, char *text)
{
    char *values = strchr(text, '=');
    enum kd_status status;
    if (!values || values == text)
        KD_TRY(kd_error_set(r->error, KD_EINVAL,
                            "an axis is \"%.60s\"; it must be FIELD=VALUE,VALUE,... or FIELD=START:STOP:STEP", text));
    *values++ = 0;
    KD_TRY(begin(r, text));
    if (range_of(values).by)
        KD_TRY(add_range(r, values));
    else
        KD_TRY(add_typed(r, values));
    KD_TRY(end(r));
done:
    return status;
}

enum kd_status kd_sweep_typed(const char *const *axes, size_t n, const struct kd_scene *base,
                              const struct kd_assets *assets, struct kd_sweep **out, struct kd_error *error)
{
    struct reader r = { .sweep = create(base), .assets = assets, .error = error, .pointer = "/axes" };
    enum kd_status status = r.sweep ? KD_OK : no_memory(&r);
    for (size_t i = 0; i < n && !status; i++) {
        char *text = strdup(axes[i]);
        status = text ? read_typed(&r, text) : no_memory(&r);
        free(text);
    }
    return finish(&r, status, out);
}

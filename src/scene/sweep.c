#include "scene/sweep.h"

#include "scene/style.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void kd_sweep_free(struct kd_sweep *sweep)
{
    if (!sweep)
        return;
    for (size_t i = 0; i < sweep->n_axes; i++) {
        struct kd_sweep_axis *axis = &sweep->axes[i];
        for (size_t k = 0; k < axis->n; k++)
            free(axis->values[k].text);
        free(axis->values);
        free(axis->path);
    }
    free(sweep);
}

const struct kd_sweep_value *kd_sweep_at(const struct kd_sweep *sweep, unsigned scene, size_t axis)
{
    size_t left = scene;
    for (size_t i = sweep->n_axes; i-- > axis + 1;)
        left /= sweep->axes[i].n;
    return &sweep->axes[axis].values[left % sweep->axes[axis].n];
}

static enum kd_status set(const struct kd_sweep *sweep, unsigned scene, bool style, struct kd_scene *out,
                          struct kd_error *error)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < sweep->n_axes && !status; i++)
        if (kd_scene_same_path(sweep->axes[i].path, "style.name") == style)
            status = kd_scene_set(out, sweep->axes[i].path, kd_sweep_at(sweep, scene, i)->text, error);
    return status;
}

/* Writes the values of a scene for messages, such as "spacetime.spin 0.9 and disk.inner 2". */
static void tell(const struct kd_sweep *sweep, unsigned scene, char *out, size_t size)
{
    for (size_t i = 0, n = 0; i < sweep->n_axes && n < size; i++)
        n += (size_t)snprintf(out + n, size - n, "%s%s %.40s",
                              !i                      ? ""
                              : i + 1 < sweep->n_axes ? ", "
                                                      : " and ",
                              sweep->axes[i].path, kd_sweep_at(sweep, scene, i)->text);
}

enum kd_status kd_sweep_scene(const struct kd_sweep *sweep, unsigned scene, struct kd_scene *out,
                              struct kd_error *error)
{
    struct kd_error inner = { 0 };
    char with[160];
    enum kd_status status;
    *out = sweep->base;
    KD_TRY(set(sweep, scene, true, out, &inner));
    KD_TRY(set(sweep, scene, false, out, &inner));
    for (size_t i = 0; i < sweep->n_axes; i++)
        if (kd_sweep_at(sweep, scene, i)->matter.nodes)
            out->matter = kd_sweep_at(sweep, scene, i)->matter;
    KD_TRY(kd_scene_validate(out, &inner));
done:
    if (!status)
        return KD_OK;
    tell(sweep, scene, with, sizeof with);
    kd_error_field(error, "/axes", "with %s: %.300s", with, inner.message);
    return error ? (error->status = status) : status;
}

enum kd_status kd_sweep_value_json(const struct kd_sweep_value *value, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    if (!isnan(value->number))
        kd_json_number(&json, NULL, value->number);
    else if (!strcmp(value->text, "true") || !strcmp(value->text, "false"))
        kd_json_bool(&json, NULL, *value->text == 't');
    else
        kd_json_string(&json, NULL, value->text);
    return kd_json_finish(&json);
}

void kd_sweep_axes_json(const struct kd_sweep *sweep, struct kd_json *json, const char *name)
{
    struct kd_buffer text = { 0 };
    kd_json_object(json, name);
    for (size_t i = 0; i < sweep->n_axes; i++) {
        const struct kd_sweep_axis *axis = &sweep->axes[i];
        kd_json_array(json, axis->path);
        for (size_t k = 0; k < axis->n && !json->status; k++) {
            text.size = 0;
            if (!(json->status = kd_sweep_value_json(&axis->values[k], &text)))
                kd_json_raw(json, NULL, (const char *)text.data, text.size);
        }
        kd_json_end(json);
    }
    kd_json_end(json);
    kd_buffer_finish(&text);
}

void kd_sweep_name(const struct kd_sweep *sweep, unsigned scene, char out[KD_SWEEP_NAME])
{
    size_t n = (size_t)snprintf(out, KD_SWEEP_NAME, "%06u", scene);
    for (size_t i = 0; i < sweep->n_axes; i++) {
        const char *dot = strrchr(sweep->axes[i].path, '.');
        char part[KD_SWEEP_NAME];
        int length = snprintf(part, sizeof part, " %s=%.24s", dot ? dot + 1 : sweep->axes[i].path,
                              kd_sweep_at(sweep, scene, i)->text);
        if (n + (size_t)length >= KD_SWEEP_NAME)
            break;
        for (const char *c = part; *c; c++)
            out[n++] = isalnum((unsigned char)*c) || strchr(" ._=+-", *c) ? *c : '_';
        out[n] = 0;
    }
}

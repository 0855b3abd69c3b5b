#include "scene/control.h"

#include <string.h>

#define SPAN(of, low, high) { .path = of, .kind = KD_CONTROL_SPAN, .a = low, .b = high },
#define FIRST(of, value) { .path = of, .kind = KD_CONTROL_FIRST, .a = value },
#define SWITCH(of) { .path = of, .kind = KD_CONTROL_SWITCH },
#define WITH(of, other, value) { .path = of, .kind = KD_CONTROL_WITH, .a = value, .text = other },
#define VARIES(of, ways) { .path = of, .kind = KD_CONTROL_VARIES, .text = ways },
#define BUTTON(of, value, title) { .path = of, .kind = KD_CONTROL_BUTTON, .a = value, .text = title },
const struct kd_control kd_controls[] = { KD_SCENE_CONTROLS(SPAN, FIRST, SWITCH, WITH, VARIES, BUTTON) { .path = "" } };
const size_t kd_control_count = sizeof kd_controls / sizeof *kd_controls - 1;

static bool is_of(const struct kd_control *control, const struct kd_row *field)
{
    size_t n = strlen(field->object);
    if (!n)
        return !strcmp(control->path, field->name);
    return !strncmp(control->path, field->object, n) && control->path[n] == '.' &&
           !strcmp(control->path + n + 1, field->name);
}

static const struct kd_control *from(size_t i, const struct kd_row *field, enum kd_control_kind kind)
{
    while (i < kd_control_count && (kd_controls[i].kind != kind || !is_of(&kd_controls[i], field)))
        i++;
    return i < kd_control_count ? &kd_controls[i] : NULL;
}

const struct kd_control *kd_control_find(const struct kd_row *field, enum kd_control_kind kind)
{
    return from(0, field, kind);
}

const struct kd_control *kd_control_next(const struct kd_row *field, const struct kd_control *found)
{
    return from((size_t)(found - kd_controls) + 1, field, found->kind);
}

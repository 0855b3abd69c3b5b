#include "scene/style.h"

#include <math.h>

#define ROW(section, name, ...) { #section, #name, { __VA_ARGS__ } },
const struct kd_style_row kd_style_rows[] = { KD_SCENE_STYLES(ROW) { NULL, NULL, { 0 } } };
const size_t kd_style_row_count = sizeof kd_style_rows / sizeof *kd_style_rows - 1;

const struct kd_row *kd_style_field(void) { return kd_field_find("style", "name"); }

void kd_style_apply(struct kd_scene *scene, const uint64_t *given)
{
    const int style = (int)kd_field_get(scene, kd_style_field(), 0) - 1;
    for (size_t i = 0; i < kd_style_row_count && style >= 0; i++) {
        const struct kd_row *field = kd_field_find(kd_style_rows[i].section, kd_style_rows[i].name);
        if (!isnan(kd_style_rows[i].values[style]) && (!given || !kd_field_is_given(given, field)))
            kd_field_put(scene, field, 0, kd_style_rows[i].values[style]);
    }
}

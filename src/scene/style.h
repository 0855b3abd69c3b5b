/* Styles are what style.name sets, by the table KD_SCENE_STYLES of scene/fields.h. A style is a preset of fields: a
 * document that names one sets these fields to the style's values, but for those that the same document sets itself;
 * the canonical form shows each of them, and nothing else reads the name. Constant data and pure functions, any
 * thread. */
#ifndef KD_SCENE_STYLE_H
#define KD_SCENE_STYLE_H

#include "scene/table.h"

struct kd_style_row {
    const char *section, *name; /* of a field that styles set, in a section that is no list */
    double values[KD_STYLES];   /* as kd_field_put takes them; NAN: the style leaves it alone */
};
extern const struct kd_style_row kd_style_rows[];
extern const size_t kd_style_row_count;

/* The row of style.name; NULL in a table of fields that has none. */
const struct kd_field *kd_style_field(void);
/* Sets what the scene's style.name stands for. given: fields to be left alone, by their place in kd_fields; NULL:
 * none. */
void kd_style_apply(struct kd_scene *scene, const bool *given);

#endif

/* Styles are presets of some fields, from the table KD_SCENE_STYLES in scene/fields.h. style.name selects a style.
 * If a document names a style, these fields get the style's values, except for fields that the document sets itself.
 * The canonical form contains the resulting values; apart from them, the style's name has no effect. Constant data
 * and pure functions, any thread. */
#ifndef KD_SCENE_STYLE_H
#define KD_SCENE_STYLE_H

#include "scene/table.h"

struct kd_style_row {
    const char *section, *name; /* section and name of the field; the section must not be a list */
    /* values as for kd_field_put, one for each style; NAN: the style leaves the field unchanged */
    double values[KD_STYLES];
};
extern const struct kd_style_row kd_style_rows[];
extern const size_t kd_style_row_count;

/* The row of the field style.name; NULL if there is no such row. */
const struct kd_row *kd_style_field(void);
/* Applies the scene's style. given: the fields that stay unchanged, in the form of kd_document_read; NULL: none. */
void kd_style_apply(struct kd_scene *scene, const uint64_t *given);

#endif

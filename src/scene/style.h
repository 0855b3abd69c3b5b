/* Styles: presets of fields, selected by style.name, from the table KD_SCENE_STYLES of scene/fields.h. If a document
 * names a style, these fields get the style's values, except for fields that the document sets itself. The canonical
 * form contains the resulting fields; the style's name has no other effect. Constant data and pure functions, any
 * thread. */
#ifndef KD_SCENE_STYLE_H
#define KD_SCENE_STYLE_H

#include "scene/table.h"

struct kd_style_row {
    const char *section, *name; /* section and name of the field; the section is not a list */
    /* values in the form that kd_field_put accepts; NAN: the style leaves the field unchanged */
    double values[KD_STYLES];
};
extern const struct kd_style_row kd_style_rows[];
extern const size_t kd_style_row_count;

/* The row of the field style.name; NULL if the table of fields has none. */
const struct kd_row *kd_style_field(void);
/* Applies the scene's style. given: fields to leave unchanged, as kd_document_read writes them; NULL: none. */
void kd_style_apply(struct kd_scene *scene, const uint64_t *given);

#endif

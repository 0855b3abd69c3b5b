/* Data for the page's control of a field that are not in the field's row. They come from the table KD_SCENE_CONTROLS
 * in scene/fields.h. The JSON Schema has them as x-span, x-first, x-switch, x-with, x-varies and x-button. Constant
 * data and pure functions, any thread. */
#ifndef KD_SCENE_CONTROL_H
#define KD_SCENE_CONTROL_H

#include "scene/table.h"

struct kd_control {
    const char *path; /* path of the field; for a field of a list without an index, as in "spots.r" */
    enum kd_control_kind {
        /* the slider goes from a to b only, because the whole range of the field is much wider than is useful */
        KD_CONTROL_SPAN,
        /* a is the number that the control shows first when the user switches from the word to a number */
        KD_CONTROL_FIRST,
        /* While this field has its minimum or its first word, all other fields of its section or list element have
         * no effect. */
        KD_CONTROL_SWITCH,
        /* The field has an effect only while the field `text` of the same section has the value a. If there are
         * several such entries for the field, one of their values is enough. */
        KD_CONTROL_WITH,
        /* the field has an effect only if the picture varies in at least one of the ways "a|b" in `text`
         * (docs/live.md) */
        KD_CONTROL_VARIES,
        /* a button with the label `text` sets the field to a, or resets it; in a list it acts on the first element */
        KD_CONTROL_BUTTON,
    } kind;
    double a, b; /* values as for kd_field_put */
    const char *text;
};
extern const struct kd_control kd_controls[];
extern const size_t kd_control_count;

/* kd_control_find returns the entry of this kind for a field, or NULL if there is none. A field has at most one
 * entry of each kind, except that it may have several of KD_CONTROL_WITH, all with the same `text`. kd_control_next
 * returns the next such entry after `found`. */
const struct kd_control *kd_control_find(const struct kd_row *field, enum kd_control_kind kind);
const struct kd_control *kd_control_next(const struct kd_row *field, const struct kd_control *found);

#endif

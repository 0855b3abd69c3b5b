/* Data for the page's control of a field, in addition to the field's row. They are in the table KD_SCENE_CONTROLS of
 * scene/fields.h. In the JSON Schema they are x-span, x-first, x-switch, x-with, x-varies and x-button. Constant
 * data and pure functions, any thread. */
#ifndef KD_SCENE_CONTROL_H
#define KD_SCENE_CONTROL_H

#include "scene/table.h"

struct kd_control {
    const char *path; /* path of the field; without an index if it belongs to a list: "spots.r" */
    enum kd_control_kind {
        KD_CONTROL_SPAN,  /* the slider goes from a to b, because the field's range is much wider than is useful */
        KD_CONTROL_FIRST, /* a is the number that the control shows when the user switches from the word to a number */
        /* While the field has its least value or its first word, the other fields of its section, or of its list
         * element, have no effect. */
        KD_CONTROL_SWITCH,
        /* The field has an effect only while the field `text` of its section has the value a. If the field has
         * several such rows, one of their values suffices. */
        KD_CONTROL_WITH,
        /* the field has an effect only if the picture varies in one of the ways "a|b" in `text` (docs/live.md) */
        KD_CONTROL_VARIES,
        /* a button labelled `text` sets the field to a, or resets the field; for a list the button acts on the first
         * element */
        KD_CONTROL_BUTTON,
    } kind;
    double a, b; /* values in the form that kd_field_put accepts */
    const char *text;
};
extern const struct kd_control kd_controls[];
extern const size_t kd_control_count;

/* kd_control_find returns a field's entry of this kind; NULL if there is none. A field has at most one entry of each
 * kind, except that it may have several of KD_CONTROL_WITH, all with the same `text`. kd_control_next returns the
 * entry after `found`. */
const struct kd_control *kd_control_find(const struct kd_row *field, enum kd_control_kind kind);
const struct kd_control *kd_control_next(const struct kd_row *field, const struct kd_control *found);

#endif

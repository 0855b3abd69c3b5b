/* Extra data for the page's control of a field, beyond its row: the table KD_SCENE_CONTROLS of scene/fields.h. The
 * JSON Schema has it as x-span, x-first, x-switch, x-with, x-varies and x-button. Constant data and pure functions,
 * any thread. */
#ifndef KD_SCENE_CONTROL_H
#define KD_SCENE_CONTROL_H

#include "scene/table.h"

struct kd_control {
    const char *path; /* of the field; without index for a field of a list: "spots.r" */
    enum kd_control_kind {
        KD_CONTROL_SPAN,  /* the slider spans a to b, because the field's range is much wider than useful */
        KD_CONTROL_FIRST, /* a is the number shown first when the user switches from the word to a number */
        /* At its least value or first word, the other fields of its section (or list element) have no effect. */
        KD_CONTROL_SWITCH,
        /* Has an effect only if the field `text` of its section has the value a, or that of another such row. */
        KD_CONTROL_WITH,
        KD_CONTROL_VARIES, /* has an effect only if the picture varies in one of the ways "a|b" of `text` (docs/live.md)
                            */
        KD_CONTROL_BUTTON, /* a button called `text` sets it to a, and resets it; in a list, for the first element */
    } kind;
    double a, b; /* values in the form that kd_field_put takes */
    const char *text;
};
extern const struct kd_control kd_controls[];
extern const size_t kd_control_count;

/* Finds a field's entry of this kind, NULL if none. A field has at most one of each kind, except several
 * KD_CONTROL_WITH with the same `text`; kd_control_next gives the entry after `found`. */
const struct kd_control *kd_control_find(const struct kd_field *field, enum kd_control_kind kind);
const struct kd_control *kd_control_next(const struct kd_field *field, const struct kd_control *found);

#endif

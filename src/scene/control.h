/* Controls say what a page that has one for each field cannot tell from the rows: they are the table
 * KD_SCENE_CONTROLS of scene/fields.h. The schema carries it as x-span, x-first, x-switch, x-with, x-varies and
 * x-button. Constant data and pure functions, any thread. */
#ifndef KD_SCENE_CONTROL_H
#define KD_SCENE_CONTROL_H

#include "scene/table.h"

struct kd_control {
    const char *path; /* of the field; of one in a list without a number: "spots.r" */
    enum kd_control_kind {
        KD_CONTROL_SPAN,   /* a slider spans a to b, where the range is much wider than anybody sweeps */
        KD_CONTROL_FIRST,  /* a is the number that stands there once a word is given up */
        KD_CONTROL_SWITCH, /* with its least value, or its first word, the others of its section, or of an element, mean
                              nothing */
        KD_CONTROL_WITH,   /* it means something only where the field `text` of its section has the value a, or that of
                              another such row */
        KD_CONTROL_VARIES, /* and it only where the picture varies in one of the ways "a|b" of `text` (docs/live.md) */
        KD_CONTROL_BUTTON, /* a button called `text` gives it the value a, and takes it back; of a list that of the
                              first element */
    } kind;
    double a, b; /* as kd_field_put takes them */
    const char *text;
};
extern const struct kd_control kd_controls[];
extern const size_t kd_control_count;

/* Finds what a field has of a kind; NULL: nothing. Of one kind a field has one, of KD_CONTROL_WITH several for one
 * and the same `text`: `next` finds what stands behind one that was found. */
const struct kd_control *kd_control_find(const struct kd_field *field, enum kd_control_kind kind);
const struct kd_control *kd_control_next(const struct kd_field *field, const struct kd_control *found);

#endif

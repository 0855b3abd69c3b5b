/* Metadata of a picture in its file, for all formats: what is needed to render it again, and how it was made. Any
 * thread. */
#ifndef KD_RENDER_OUTPUT_NOTES_H
#define KD_RENDER_OUTPUT_NOTES_H

#include "base/json.h"
#include "render/output/clock.h"
#include "render/output/flux.h"
#include "render/output/format.h"

/* One line: "rays=921600 engine=mino-rkn6 precision=f32 steps=8 undecided=0 sampled=768 crossings=927 differ=0
 * median=1.6e-07 worst=2.0e-05"; the last four items are left out if nothing was sampled. */
#define KD_ACCURACY_TEXT 384
void kd_accuracy_text(const struct kd_accuracy_report *report, const struct kd_plan_lens *lens,
                      char out[KD_ACCURACY_TEXT]);
/* Writes the accuracy of kd_accuracy_text as members of a JSON object, without rays, engine, precision and steps.
 * median, worst: names for the two errors of radii. */
void kd_accuracy_members(struct kd_json *json, const struct kd_accuracy_report *report, const char *median,
                         const char *worst);

/* Gets, by index, an approximation that is known only after the picture is rendered, such as rays that were given
 * up. report NULL: lists all approximations of this kind. Returns false if there are fewer. */
bool kd_measured_approximation(const struct kd_accuracy_report *report, size_t index, struct kd_approximation *out);
/* Gets, by index, an approximation of a picture: first those of its plan, then those of kd_measured_approximation. */
bool kd_picture_approximation(const struct kd_plan_report *plan, const struct kd_accuracy_report *report, size_t index,
                              struct kd_approximation *out);

/* "samples=16 shutter=0.5": the light is the mean of 16 pictures at equal time steps within half of a frame's time
 * (render/frame/blur.h). */
#define KD_BLUR_TEXT 48

struct kd_notes {
    struct kd_buffer scene; /* canonical JSON */
    char hash[65];
    struct kd_buffer approximations; /* one approximation a line */
    char accuracy[KD_ACCURACY_TEXT];
    char clock[KD_CLOCK_TEXT]; /* kd_fall_clock as text; "" unless the observer falls */
    char flux[KD_FLUX_TEXT];   /* flux as text; "" unless the picture is at a radio frequency */
    char blur[KD_BLUR_TEXT];   /* motion blur as text; "" unless the picture is a mean */
};
/* Collects the metadata of a picture. The only error is KD_ENOMEM. Call kd_notes_finish in any case. */
enum kd_status kd_notes_of(const struct kd_picture *picture, struct kd_notes *out, struct kd_error *error);
void kd_notes_finish(struct kd_notes *notes);

/* The notes of a picture as named texts, for formats that store such texts. Empty texts are left out. The texts
 * belong to `notes` and `picture`. Returns their number. */
enum { KD_NOTES = 11 };
struct kd_note {
    /* name: "kerrd:scene" and other names of kerrd's own, or "Software" and "Copyright", which other programs read */
    const char *name, *text;
};
size_t kd_notes_list(const struct kd_picture *picture, const struct kd_notes *notes, struct kd_note out[KD_NOTES]);

/* Parses the scene in a file's notes; *out is unchanged on error. */
enum kd_status kd_notes_scene(const char *text, size_t length, struct kd_scene *out, struct kd_error *error);

#endif

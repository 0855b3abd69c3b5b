#include "render/output/notes.h"

#include "scene/dynamic_bodies.h"
#include "scene/sha256.h"

#include <stdio.h>
#include <string.h>

/* a member that no scene has, so that a document with this member is not taken for a scene */
#define PLAYGROUND "playground"

void kd_accuracy_text(const struct kd_accuracy_report *report, const struct kd_plan_lens *lens,
                      char out[KD_ACCURACY_TEXT])
{
    int n = snprintf(
        out, KD_ACCURACY_TEXT, "rays=%llu engine=%s precision=%s steps=%u critical_rays=%llu undecided=%llu sampled=%u",
        (unsigned long long)lens->rays, kd_engine_name(lens->setting.engine),
        kd_precision_name(lens->setting.precision), lens->setting.steps,
        (unsigned long long)(kd_plan_rays(lens) - lens->rays), (unsigned long long)report->undecided, report->sampled);
    if (report->interpolated)
        n += snprintf(out + n, KD_ACCURACY_TEXT - (size_t)n, " interpolated=%llu",
                      (unsigned long long)report->interpolated);
    if (report->sampled)
        n += snprintf(out + n, KD_ACCURACY_TEXT - (size_t)n, " crossings=%u differ=%u median=%.1e worst=%.1e",
                      report->crossings, report->differ, report->median, report->worst);
    if (report->pixel_sampled)
        n += snprintf(
            out + n, KD_ACCURACY_TEXT - (size_t)n,
            " followed=%llu refined=%llu between=%llu pixel_sampled=%u pixel_error=%.1e pixel_error_worst=%.1e",
            (unsigned long long)report->followed, (unsigned long long)report->refined,
            (unsigned long long)report->between, report->pixel_sampled, report->pixel_error, report->pixel_error_worst);
    if (report->lost)
        n += snprintf(out + n, KD_ACCURACY_TEXT - (size_t)n, " lost=%llu", (unsigned long long)report->lost);
    if (report->volume_sampled)
        snprintf(out + n, KD_ACCURACY_TEXT - (size_t)n, " volume_sampled=%u volume_error=%.1e volume_error_worst=%.1e",
                 report->volume_sampled, report->volume_error, report->volume_error_worst);
}

void kd_accuracy_members(struct kd_json *json, const struct kd_accuracy_report *report, const char *median,
                         const char *worst)
{
    kd_json_number(json, "undecided", (double)report->undecided);
    kd_json_number(json, "lost", (double)report->lost);
    if (report->interpolated) {
        kd_json_number(json, "traced", (double)report->traced);
        kd_json_number(json, "interpolated", (double)report->interpolated);
    }
    kd_json_number(json, "sampled", report->sampled);
    if (report->sampled) {
        kd_json_number(json, "crossings", report->crossings);
        kd_json_number(json, "differ", report->differ);
        kd_json_number(json, median, report->median);
        kd_json_number(json, worst, report->worst);
    }
    if (report->pixel_sampled) {
        kd_json_number(json, "followed", (double)report->followed);
        kd_json_number(json, "refined", (double)report->refined);
        kd_json_number(json, "between", (double)report->between);
        kd_json_number(json, "pixel_sampled", report->pixel_sampled);
        kd_json_number(json, "pixel_error", report->pixel_error);
        kd_json_number(json, "pixel_error_worst", report->pixel_error_worst);
    }
    if (report->volume_sampled) {
        kd_json_number(json, "volume_sampled", report->volume_sampled);
        kd_json_number(json, "volume_error", report->volume_error);
        kd_json_number(json, "volume_error_worst", report->volume_error_worst);
    }
}

static uint64_t undecided(const struct kd_accuracy_report *report) { return report->undecided; }
static uint64_t differ(const struct kd_accuracy_report *report) { return report->differ; }
static uint64_t lost(const struct kd_accuracy_report *report) { return report->lost; }

static const struct {
    struct kd_approximation sentence;
    uint64_t (*count)(const struct kd_accuracy_report *report);
} measured[] = {
    { { "rays.undecided", "rays: some rays of this picture were given up; their pixels are magenta; the accuracy "
                          "report counts them as \"undecided\"" },
      undecided },
    { { "rays.differ", "rays: a sample of this picture's rays was traced again in 64 bits, and some of them have "
                       "another fate or number of crossings; the accuracy report counts them as \"differ\"" },
      differ },
    { { "light.lost", "light: some pixels of this picture have no finite light, or a ray that was given up in a "
                      "volume; they are magenta; the accuracy report counts them as \"lost\"" },
      lost },
};

bool kd_measured_approximation(const struct kd_accuracy_report *report, size_t index, struct kd_approximation *out)
{
    for (size_t i = 0; i < sizeof measured / sizeof *measured; i++)
        if ((!report || measured[i].count(report)) && !index--) {
            *out = measured[i].sentence;
            return true;
        }
    return false;
}

bool kd_picture_approximation(const struct kd_plan_report *plan, const struct kd_accuracy_report *report, size_t index,
                              struct kd_approximation *out)
{
    if (index >= plan->n_approximations)
        return kd_measured_approximation(report, index - plan->n_approximations, out);
    *out = plan->approximations[index];
    return true;
}

/* Joins the approximations, one sentence a line, for readers of the file's properties. */
static enum kd_status join_approximations(const struct kd_picture *picture, struct kd_buffer *out)
{
    enum kd_status status = kd_buffer_append(out, "", 0); /* makes `out` a string even without approximations */
    struct kd_approximation one;
    for (size_t i = 0; !status && kd_picture_approximation(&picture->plan->report, &picture->frame->accuracy, i, &one);
         i++)
        status = kd_buffer_printf(out, "%s%s", i ? "\n" : "", one.text);
    return status;
}

/* Writes the canonical scene, and its hash. For a picture of a playground the document also identifies the state that
 * is shown, and cannot be read back as a scene. */
static enum kd_status put_scene(const struct kd_picture *picture, struct kd_notes *notes)
{
    const struct kd_dynamic_bodies *dynamic = picture->scene->dynamic.at;
    struct kd_buffer *out = &notes->scene;
    enum kd_status status = kd_scene_to_json(picture->scene, out);
    if (status)
        return status;
    if (picture->hash && *picture->hash)
        snprintf(notes->hash, sizeof notes->hash, "%s", picture->hash);
    else
        kd_sha256(out->data, out->size, notes->hash);
    if (!dynamic)
        return KD_OK;
    out->size--; /* removes the last brace */
    return kd_buffer_printf(out, ",\"" PLAYGROUND "\":{\"t\":%.17g,\"bodies\":%zu,\"debris\":%u,\"snapshot\":\"%s\"}}",
                            dynamic->time, dynamic->n, dynamic->debris.pieces, dynamic->snapshot);
}

enum kd_status kd_notes_of(const struct kd_picture *picture, struct kd_notes *out, struct kd_error *error)
{
    *out = (struct kd_notes) { 0 };
    kd_accuracy_text(&picture->frame->accuracy, &picture->plan->lens, out->accuracy);
    kd_fall_clock_text(picture->scene, out->clock);
    kd_flux_text(picture->scene, picture->frame, out->flux);
    if (picture->plan->picture.blur.samples)
        snprintf(out->blur, sizeof out->blur, "samples=%u shutter=%.9g", picture->plan->picture.blur.samples,
                 picture->plan->picture.blur.shutter);
    enum kd_status status;
    KD_TRY(put_scene(picture, out));
    KD_TRY(join_approximations(picture, &out->approximations));
done:
    return status
               ? kd_error_set(error, status, "cannot describe the scene inside its picture: %s", kd_status_name(status))
               : KD_OK;
}

void kd_notes_finish(struct kd_notes *notes)
{
    kd_buffer_finish(&notes->scene);
    kd_buffer_finish(&notes->approximations);
}

size_t kd_notes_list(const struct kd_picture *picture, const struct kd_notes *notes, struct kd_note out[KD_NOTES])
{
    const struct kd_note all[] = {
        { "kerrd:scene", (const char *)notes->scene.data },
        { "kerrd:hash", notes->hash },
        { "kerrd:version", KD_VERSION },
        { "kerrd:approximations", (const char *)notes->approximations.data },
        { "kerrd:accuracy", notes->accuracy },
        { "kerrd:device", picture->device },
        { "Software", "kerrd " KD_VERSION },
    };
    const struct kd_note some[] = {
        { "Copyright", picture->frame->credit },
        { "kerrd:clock", notes->clock },
        { "kerrd:flux", notes->flux },
        { "kerrd:motion_blur", notes->blur },
    };
    _Static_assert(sizeof all / sizeof *all + sizeof some / sizeof *some == KD_NOTES, "KD_NOTES counts the notes");
    size_t n = sizeof all / sizeof *all;
    memcpy(out, all, sizeof all);
    for (size_t i = 0; i < sizeof some / sizeof *some; i++)
        if (*some[i].text)
            out[n++] = some[i];
    return n;
}

enum kd_status kd_notes_scene(const char *text, size_t length, struct kd_scene *out, struct kd_error *error)
{
    if (length && memmem(text, length, ",\"" PLAYGROUND "\":{", sizeof PLAYGROUND + 4))
        return kd_error_set(error, KD_EINVAL,
                            "the picture shows a playground, which is not part of its scene: render it from the "
                            "playground's snapshot with kerrd playground SNAPSHOT.json --picture FILE");
    struct kd_scene scene;   /* *out must not change if the document is refused */
    kd_scene_smooth(&scene); /* sets fields that the document lacks because it was written before they existed */
    enum kd_status status = kd_scene_from_json(&scene, text, length, error);
    if (!status)
        *out = scene;
    return status;
}

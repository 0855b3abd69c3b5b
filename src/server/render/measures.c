#include "server/render/measures.h"

#include <stdio.h>
#include <string.h>

#define NAME(name) name,
static const char *const also[] = { KD_MEASURED_ALSO(NAME) };
enum { N_ALSO = sizeof also / sizeof *also, OTHER = KD_MEASURED_PASSES - 1 };

static const char *name_of(size_t i) { return i < KD_PASS_COUNT ? kd_passes[i].name : also[i - KD_PASS_COUNT]; }

/* Index of a pass in the table. Unknown names get the index of "other". */
static size_t place_of(const char *name)
{
    size_t i = 0;
    while (i < OTHER && strcmp(name_of(i), name))
        i++;
    return i;
}

void kd_render_measures_frame(struct kd_render_measures *measures, const struct kd_frame *frame)
{
    for (size_t i = 0; i < frame->n_timings; i++)
        kd_histogram_add(&measures->passes[place_of(frame->timings[i].name)], frame->timings[i].ms);
}

void kd_render_measures_encoded(struct kd_render_measures *measures, double ms)
{
    kd_histogram_add(&measures->passes[place_of("encode")], ms);
}

void kd_render_measures_waited(struct kd_render_measures *measures, enum kd_class class, double ms)
{
    kd_histogram_add(&measures->waits[class], ms);
}

static enum kd_status write_all(struct kd_buffer *out, const char *name, const char *label,
                                const struct kd_histogram *all, size_t n, const char *(*word)(size_t i))
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < n && !status; i++) {
        char labels[80];
        snprintf(labels, sizeof labels, "%s=\"%s\"", label, word(i));
        if (!kd_histogram_is_empty(&all[i]))
            status = kd_histogram_write(&all[i], out, name, labels);
    }
    return status;
}

static const char *class_name(size_t i)
{
    static const char *const words[] = {
        [KD_CLASS_PIXEL] = "pixel", [KD_CLASS_LIVE] = "live", [KD_CLASS_PICTURE] = "picture",
        [KD_CLASS_RAYS] = "rays",   [KD_CLASS_JOB] = "job",   [KD_CLASS_REFINEMENT] = "refinement",
        [KD_CLASS_IDLE] = "idle",
    };
    _Static_assert(sizeof words / sizeof *words == KD_N_CLASSES, "a word for each class");
    return words[i];
}

enum kd_status kd_render_measures_write(const struct kd_render_measures *measures, struct kd_buffer *out)
{
    static const char passes[] = "kerrd_pass_seconds", waits[] = "kerrd_queue_wait_seconds";
    enum kd_status status;
    KD_TRY(kd_histogram_head(
        out, passes,
        "Time of each pass of a rendered picture, as in Server-Timing; encode: the encoding of the file."));
    KD_TRY(write_all(out, passes, "pass", measures->passes, KD_MEASURED_PASSES, name_of));
    KD_TRY(kd_histogram_head(out, waits,
                             "Time that work waited for the device, before its start and between its slices; work "
                             "other than pictures and rays also waits until its client has device time left."));
    KD_TRY(write_all(out, waits, "class", measures->waits, KD_N_CLASSES, class_name));
done:
    return status;
}

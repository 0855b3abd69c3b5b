/* The table of formats with an additional format for tests. "fake" is a line of text with kd_encode's arguments,
 * followed by the scene. The format requires the light of a frame, but not its picture. It counts the files that it
 * writes. */
#include "fake_formats.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int fake_memories;

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    unsigned *count = *memory;
    if (!count) {
        *memory = count = calloc(1, sizeof *count);
        fake_memories++;
    }
    if (!count)
        return kd_error_set(error, KD_ENOMEM, "no memory for a count");
    enum kd_status status =
        kd_buffer_printf(out, "FAKE %ux%u effort=%d number=%u file=%u flux=%g\n", picture->frame->width,
                         picture->frame->height, effort, picture->number, ++*count, picture->frame->light.all.flux);
    return status ? status : kd_scene_to_json(picture->scene, out);
}

static void forget(void *memory)
{
    fake_memories--;
    free(memory);
}

static enum kd_status scene(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    const char *end = memchr(data, '\n', size);
    if (!end)
        return kd_error_set(error, KD_EINVAL, "a fake without a second line");
    return kd_scene_from_json(out, end + 1, size - (size_t)(end + 1 - (const char *)data), error);
}

const struct kd_format fake_format = {
    .name = "fake",
    .media_type = "application/x-fake",
    .magic = "FAKE",
    .carries = KD_CARRIES_LIGHT,
    .encode = encode,
    .forget = forget,
    .scene = scene,
};

const struct kd_format *const kd_formats[] = { &kd_format_png, &fake_format };
const size_t kd_n_formats = 2;

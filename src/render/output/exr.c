/* Writes a frame's layers as an OpenEXR file: kd_format_exr. "rgb" becomes the channels R, G and B. Any other word
 * is a channel of the EXR layer "kerrd", such as kerrd.g, because OpenImageIO ignores case in names and takes a
 * plain g for green. All are 32-bit numbers. Attributes hold the same metadata as the text of a PNG, and units. */
#include "render/output/format.h"

#include "image/exr.h"
#include "render/output/notes.h"
#include "render/output/numbers.h"

#include <stdio.h>
#include <string.h>

static size_t channels_of(const struct kd_numbers *numbers, struct kd_exr_channel *out)
{
    size_t n = 0;
    for (size_t i = 0; i < numbers->n; i++) {
        const struct kd_layer *layer = numbers->at[i].layer;
        for (uint32_t c = 0; c < layer->channels; c++) {
            out[n] = (struct kd_exr_channel) { .data = (const float *)layer->data + c, .step = layer->channels };
            if (layer->channels > 1)
                snprintf(out[n++].name, sizeof out->name, "%c", "RGB"[c]);
            else
                snprintf(out[n++].name, sizeof out->name, "kerrd.%s", numbers->at[i].name);
        }
    }
    return n;
}

/* Writes units as text: "g= r_1=M" */
static enum kd_status units_of(const struct kd_numbers *numbers, struct kd_buffer *out)
{
    enum kd_status status = KD_OK;
    for (size_t i = 0; i < numbers->n && !status; i++)
        status = kd_buffer_printf(out, "%s%s=%s", i ? " " : "", numbers->at[i].name, numbers->at[i].unit);
    return status;
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    struct kd_exr_channel channels[KD_WORDS_MOST + 2];
    struct kd_buffer units = { 0 };
    struct kd_numbers numbers;
    struct kd_notes notes = { 0 };
    enum kd_status status;
    (void)effort, (void)memory;
    KD_TRY(kd_numbers_of(picture, &numbers, error));
    KD_TRY(kd_notes_of(picture, &notes, error));
    if ((status = units_of(&numbers, &units)))
        goto done;
    struct kd_exr_text texts[9] = {
        { "kerrd:scene", (const char *)notes.scene.data },
        { "kerrd:hash", notes.hash },
        { "kerrd:version", KD_VERSION },
        { "kerrd:approximations", (const char *)notes.approximations.data },
        { "kerrd:accuracy", notes.accuracy },
        { "kerrd:device", picture->device },
        { "kerrd:units", (const char *)units.data },
    };
    size_t n_texts = 7;
    if (*picture->frame->credit)
        texts[n_texts++] = (struct kd_exr_text) { "owner", picture->frame->credit };
    if (*notes.clock)
        texts[n_texts++] = (struct kd_exr_text) { "kerrd:clock", notes.clock };
    if (*notes.flux)
        texts[n_texts++] = (struct kd_exr_text) { "kerrd:flux", notes.flux };
    const struct kd_exr image = {
        .width = picture->frame->width,
        .height = picture->frame->height,
        .channels = channels,
        .n_channels = channels_of(&numbers, channels),
        .texts = texts,
        .n_texts = n_texts,
    };
    status = kd_exr_encode(&image, out, error);
done:
    kd_buffer_finish(&units);
    kd_notes_finish(&notes);
    return status;
}

static enum kd_status scene_in(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    struct kd_buffer text = { 0 };
    enum kd_status status = kd_exr_find_text(data, size, "kerrd:scene", &text, error);
    if (!status)
        status = kd_notes_scene((const char *)text.data, text.size, out, error);
    kd_buffer_finish(&text);
    return status;
}

const struct kd_format kd_format_exr = {
    .name = "exr",
    .media_type = "image/x-exr",
    .magic = "\x76\x2f\x31\x01",
    .carries = KD_CARRIES_LAYERS,
    .encode = encode,
    .scene = scene_in,
};

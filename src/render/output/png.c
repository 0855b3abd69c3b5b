#include "render/output/png.h"

#include "image/png.h"
#include "image/png_live.h"
#include "render/output/xmp.h"

#include <string.h>

enum kd_status kd_png_of_picture(const struct kd_picture *picture, int compression, struct kd_buffer *out,
                                 struct kd_error *error)
{
    const struct kd_frame *frame = picture->frame;
    struct kd_notes notes;
    struct kd_note list[KD_NOTES];
    struct kd_png_text text[KD_NOTES + 1];
    struct kd_buffer xmp = { 0 };
    enum kd_status status;
    KD_TRY(kd_notes_of(picture, &notes, error));
    size_t n = kd_notes_list(picture, &notes, list);
    for (size_t i = 0; i < n; i++)
        text[i] = (struct kd_png_text) { list[i].name, list[i].text };
    if (kd_xmp_put(picture, NULL, 0, &xmp))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the notes of a picture"));
    if (xmp.size)
        text[n++] = (struct kd_png_text) { "XML:com.adobe.xmp", (const char *)xmp.data };
    const struct kd_png_params params = {
        .width = frame->width,
        .height = frame->height,
        .bit_depth = kd_frame_bit_depth(frame),
        .compression = compression,
        .pixels = kd_frame_pixels(frame),
        .text = text,
        .n_text = n,
    };
    KD_TRY(kd_png_encode(&params, out, error));
done:
    kd_notes_finish(&notes);
    kd_buffer_finish(&xmp);
    return status;
}

static enum kd_status encode_live(const struct kd_frame *frame, void **memory, struct kd_buffer *out,
                                  struct kd_error *error)
{
    struct kd_png_live *live = *memory;
    if (kd_frame_bit_depth(frame) != 8)
        return kd_error_set(error, KD_EINVAL, "a live frame has %d bits a channel; it must have 8",
                            kd_frame_bit_depth(frame));
    enum kd_status status = live ? KD_OK : kd_png_live_create(kd_deflate_fastest(), &live, error);
    if (status)
        return status;
    *memory = live;
    return kd_png_live_encode(live, frame->width, frame->height, kd_frame_pixels(frame), out, error);
}

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    if (effort == KD_EFFORT_LIVE)
        return encode_live(picture->frame, memory, out, error);
    /* For a waiting client, saving 10 ms matters more than saving 20 % of the bytes. For a stored file, time does not
     * matter. */
    return kd_png_of_picture(picture, effort == KD_EFFORT_QUICK ? 1 : 5, out, error);
}

static void forget(void *memory) { kd_png_live_destroy(memory); }

static enum kd_status scene_in(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    struct kd_png picture;
    enum kd_status status = kd_png_decode(data, size, &picture, error);
    if (status)
        return status;
    const char *text = kd_png_text_find(&picture, "kerrd:scene");
    if (text) {
        status = kd_notes_scene(text, strlen(text), out, error);
    } else {
        status = kd_error_set(error, KD_EINVAL,
                              "the picture contains no scene: it was not made by kerrd, or its text was removed");
    }
    kd_png_finish(&picture);
    return status;
}

const struct kd_format kd_format_png = {
    .name = "png",
    .media_type = KD_PNG_TYPE,
    .magic = "\x89PNG",
    .end = "IEND\xae\x42\x60\x82",
    .carries = KD_CARRIES_PICTURE,
    .live = true,
    .encode = encode,
    .forget = forget,
    .scene = scene_in,
};

/* JPEG frames of live views. Such frames are not kept and carry no scene, so JPEG is not in the table of formats. */
#include "image/jpeg.h"
#include "render/output/format.h"

static enum kd_status encode(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                             struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_frame *frame = picture->frame;
    (void)effort, (void)memory;
    if (kd_frame_bit_depth(frame) != 8)
        return kd_error_set(error, KD_EINVAL, "a live frame has %d bits a channel; it must have 8",
                            kd_frame_bit_depth(frame));
    return kd_jpeg_encode(frame->width, frame->height, kd_frame_pixels(frame), picture->lossy, out, error);
}

const struct kd_format kd_format_jpeg = {
    .name = "jpg",
    .media_type = "image/jpeg",
    .magic = "\xff\xd8\xff",
    .carries = KD_CARRIES_PICTURE,
    .live = true,
    .encode = encode,
};

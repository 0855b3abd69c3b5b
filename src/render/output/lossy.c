/* Pictures for web pages: JPEG and WebP. Live views use JPEG too. The scene is in their XMP. */
#include "image/jpeg.h"
#include "image/webp.h"
#include "render/output/xmp.h"

/* Functions of a format's library. */
struct codec {
    enum kd_status (*encode)(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                             struct kd_buffer *out, struct kd_error *error);
    enum kd_status (*add_xmp)(const struct kd_buffer *file, const void *xmp, size_t size, struct kd_buffer *out,
                              struct kd_error *error);
};

static enum kd_status encode(const struct codec *codec, const struct kd_picture *picture, enum kd_effort effort,
                             struct kd_buffer *out, struct kd_error *error)
{
    const struct kd_frame *frame = picture->frame;
    const unsigned quality = picture->lossy ? picture->lossy : KD_QUALITY;
    if (kd_frame_bit_depth(frame) != 8)
        return kd_error_set(error, KD_EINVAL, "the frame has %d bits a channel; it must have 8",
                            kd_frame_bit_depth(frame));
    if (effort == KD_EFFORT_LIVE)
        return codec->encode(frame->width, frame->height, kd_frame_pixels(frame), quality, out, error);
    struct kd_notes notes;
    struct kd_note list[KD_NOTES];
    struct kd_buffer bare = { 0 }, xmp = { 0 };
    enum kd_status status;
    KD_TRY(kd_notes_of(picture, &notes, error));
    KD_TRY(codec->encode(frame->width, frame->height, kd_frame_pixels(frame), quality, &bare, error));
    if (kd_xmp_put(picture, list, kd_notes_list(picture, &notes, list), &xmp))
        KD_TRY(kd_error_set(error, KD_ENOMEM, "out of memory for the notes of a picture"));
    KD_TRY(codec->add_xmp(&bare, xmp.data, xmp.size, out, error));
done:
    kd_notes_finish(&notes);
    kd_buffer_finish(&bare);
    kd_buffer_finish(&xmp);
    return status;
}

static enum kd_status encode_jpg(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                                 struct kd_buffer *out, struct kd_error *error)
{
    static const struct codec codec = { kd_jpeg_encode, kd_jpeg_add_xmp };
    (void)memory;
    return encode(&codec, picture, effort, out, error);
}

static enum kd_status encode_webp(const struct kd_picture *picture, enum kd_effort effort, void **memory,
                                  struct kd_buffer *out, struct kd_error *error)
{
    static const struct codec codec = { kd_webp_encode, kd_webp_add_xmp };
    (void)memory;
    return encode(&codec, picture, effort, out, error);
}

/* Refuses what a format cannot hold before the picture is rendered. */
static enum kd_status check(const struct kd_scene *scene, const char *format, uint32_t side_max, struct kd_error *error)
{
    const struct kd_window window = kd_scene_window(scene);
    const uint32_t width = window.width * (scene->camera.stereo == KD_STEREO_PAIR ? 2 : 1);
    if (scene->image.bit_depth != 8)
        return kd_error_field(error, "/image/bit_depth",
                              "image.bit_depth is %d; for a file of the format %s it must be 8; png takes 16",
                              scene->image.bit_depth, format);
    if (width > side_max || window.height > side_max)
        return kd_error_field(
            error, width > side_max ? "/image/width" : "/image/height",
            "the picture has %u x %u pixels; for a file of the format %s each side must be at most %u", width,
            window.height, format, side_max);
    return KD_OK;
}

static enum kd_status draws_jpg(struct kd_scene *scene, struct kd_error *error)
{
    return check(scene, "jpg", KD_JPEG_SIDE_MAX, error);
}

static enum kd_status draws_webp(struct kd_scene *scene, struct kd_error *error)
{
    return check(scene, "webp", KD_WEBP_SIDE_MAX, error);
}

static enum kd_status jpg_scene(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    size_t length = 0;
    const void *xmp = kd_jpeg_xmp(data, size, &length);
    return kd_xmp_scene(xmp ? xmp : "", length, out, error);
}

static enum kd_status webp_scene(const void *data, size_t size, struct kd_scene *out, struct kd_error *error)
{
    struct kd_buffer xmp = { 0 };
    enum kd_status status = kd_webp_xmp(data, size, &xmp, error);
    if (!status)
        status = kd_xmp_scene(xmp.data, xmp.size, out, error);
    kd_buffer_finish(&xmp);
    return status;
}

const struct kd_format kd_format_jpg = {
    .name = "jpg",
    .media_type = KD_JPEG_TYPE,
    .magic = "\xff\xd8\xff",
    .end = "\xff\xd9",
    .carries = KD_CARRIES_PICTURE,
    .live = true,
    .lossy = true,
    .draws = draws_jpg,
    .encode = encode_jpg,
    .scene = jpg_scene,
};

const struct kd_format kd_format_webp = {
    .name = "webp",
    .media_type = "image/webp",
    .magic = "RIFF",
    .carries = KD_CARRIES_PICTURE,
    .lossy = true,
    .draws = draws_webp,
    .bytes = kd_webp_bytes,
    .encode = encode_webp,
    .scene = webp_scene,
};

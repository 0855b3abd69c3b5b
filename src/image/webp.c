#include "image/webp.h"

#include <stdbool.h>

#include <webp/encode.h>
#include <webp/mux.h>

enum {
    METHOD = 4,       /* compression method, from 0 (fastest) to 6 (smallest) */
    LARGE = 16 << 20, /* number of pixels from which on libwebp is told to save memory at the cost of time */
};

uint64_t kd_webp_bytes(uint32_t width, uint32_t height)
{
    const uint64_t pixels = (uint64_t)width * height;
    return (pixels > LARGE ? 5 : 32) * pixels + (1 << 20);
}

static int put(const uint8_t *data, size_t size, const WebPPicture *picture)
{
    return !kd_buffer_append(picture->custom_ptr, data, size);
}

static enum kd_status fault(int code)
{
    switch (code) {
    case VP8_ENC_ERROR_PARTITION0_OVERFLOW:
    case VP8_ENC_ERROR_PARTITION_OVERFLOW:
    case VP8_ENC_ERROR_FILE_TOO_BIG: return KD_ETOOBIG;
    /* kd_webp_encode has checked everything else, so any other code means a lack of memory */
    default: return KD_ENOMEM;
    }
}

static enum kd_status encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                             struct kd_buffer *out)
{
    WebPConfig config;
    WebPPicture picture;
    if (!WebPConfigPreset(&config, WEBP_PRESET_PHOTO, (float)quality) || !WebPPictureInit(&picture))
        return KD_EINTERNAL;
    config.method = METHOD;
    config.low_memory = (uint64_t)width * height > LARGE;
    picture.width = (int)width;
    picture.height = (int)height;
    picture.writer = put;
    picture.custom_ptr = out;
    enum kd_status status = KD_OK;
    if (!WebPPictureImportRGB(&picture, pixels, (int)(3 * width)) || !WebPEncode(&config, &picture))
        status = fault(picture.error_code);
    WebPPictureFree(&picture);
    return status;
}

enum kd_status kd_webp_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error)
{
    if (quality < 1 || quality > 100)
        return kd_error_set(error, KD_EINVAL, "the quality of a WebP is %u; it must be 1 to 100", quality);
    if (width < 1 || width > KD_WEBP_SIDE_MAX || height < 1 || height > KD_WEBP_SIDE_MAX)
        return kd_error_set(error, KD_EINVAL, "a WebP has %u x %u pixels; each side must be 1 to %d", width, height,
                            KD_WEBP_SIDE_MAX);
    const size_t before = out->size;
    const enum kd_status status = encode(width, height, pixels, quality, out);
    if (status)
        out->size = before;
    if (status == KD_ETOOBIG)
        return kd_error_set(error, status,
                            "a picture of %u x %u pixels has more detail than a WebP of quality %u can hold; use a "
                            "lower quality, jpg or png",
                            width, height, quality);
    return !status ? KD_OK
           : status == KD_EINTERNAL
               ? kd_error_set(error, status, "the version of libwebp differs from the one that kerrd was built with")
               : kd_error_set(error, status, "out of memory for a WebP of %u x %u pixels", width, height);
}

enum kd_status kd_webp_add_xmp(const struct kd_buffer *file, const void *xmp, size_t size, struct kd_buffer *out,
                               struct kd_error *error)
{
    const WebPData image = { file->data, file->size }, packet = { xmp, size };
    WebPData whole = { 0 };
    WebPMux *mux = WebPMuxNew();
    const bool made = mux && WebPMuxSetImage(mux, &image, 0) == WEBP_MUX_OK &&
                      WebPMuxSetChunk(mux, "XMP ", &packet, 0) == WEBP_MUX_OK &&
                      WebPMuxAssemble(mux, &whole) == WEBP_MUX_OK;
    const enum kd_status status = made ? kd_buffer_append(out, whole.bytes, whole.size) : KD_ENOMEM;
    WebPDataClear(&whole);
    WebPMuxDelete(mux);
    return status ? kd_error_set(error, status, "out of memory for the metadata of a WebP") : KD_OK;
}

enum kd_status kd_webp_xmp(const void *data, size_t size, struct kd_buffer *out, struct kd_error *error)
{
    const WebPData file = { data, size };
    WebPData packet = { 0 };
    WebPMux *mux = WebPMuxCreate(&file, 0);
    enum kd_status status = KD_EINVAL;
    if (mux && WebPMuxGetChunk(mux, "XMP ", &packet) == WEBP_MUX_OK)
        status = kd_buffer_append(out, packet.bytes, packet.size);
    else
        kd_error_set(error, KD_EINVAL,
                     mux ? "the WebP contains no scene, because it has no XMP" : "the file is not a WebP");
    WebPMuxDelete(mux);
    return status == KD_ENOMEM ? kd_error_set(error, status, "out of memory for the XMP of a WebP") : status;
}

#include "image/jpeg.h"

#include <setjmp.h>
#include <stdio.h> /* jpeglib.h does not include what it needs */
#include <stdlib.h>

#include <jpeglib.h>

struct trouble {
    struct jpeg_error_mgr manager; /* first: libjpeg's pointer is ours */
    jmp_buf back;
    char text[JMSG_LENGTH_MAX];
};

static void give_up(j_common_ptr info)
{
    struct trouble *trouble = (struct trouble *)info->err;
    trouble->manager.format_message(info, trouble->text);
    longjmp(trouble->back, 1);
}

static void say_nothing(j_common_ptr info) { (void)info; }

static void choose(struct jpeg_compress_struct *info, unsigned quality)
{
    jpeg_set_defaults(info); /* 4:2:0 */
    jpeg_set_quality(info, (int)quality, TRUE);
    info->dct_method = JDCT_ISLOW;
    info->optimize_coding = quality < KD_JPEG_THRIFTY;
    if (quality >= KD_JPEG_FULL_COLOUR)
        info->comp_info[0].h_samp_factor = info->comp_info[0].v_samp_factor = 1;
}

/* *file: malloc'd by libjpeg, to be freed whatever the result. */
static enum kd_status compress(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality, unsigned char **file, unsigned long *size,
                               struct kd_error *error)
{
    struct trouble trouble;
    struct jpeg_compress_struct info;
    info.err = jpeg_std_error(&trouble.manager);
    trouble.manager.error_exit = give_up;
    trouble.manager.output_message = say_nothing;
    if (setjmp(trouble.back)) {
        jpeg_destroy_compress(&info);
        return kd_error_set(error, KD_ENOMEM, "a JPEG of %u x %u pixels could not be made: %s", width, height, trouble.text);
    }
    jpeg_create_compress(&info);
    jpeg_mem_dest(&info, file, size);
    info.image_width = width;
    info.image_height = height;
    info.input_components = 3;
    info.in_color_space = JCS_RGB;
    choose(&info, quality);
    jpeg_start_compress(&info, TRUE);
    while (info.next_scanline < height) {
        JSAMPROW row = (JSAMPROW)(uintptr_t)(pixels + (size_t)3 * width * info.next_scanline);
        jpeg_write_scanlines(&info, &row, 1);
    }
    jpeg_finish_compress(&info);
    jpeg_destroy_compress(&info);
    return KD_OK;
}

enum kd_status kd_jpeg_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality, struct kd_buffer *out, struct kd_error *error)
{
    unsigned char *file = NULL;
    unsigned long size = 0;
    if (quality < 1 || quality > 100)
        return kd_error_set(error, KD_EINVAL, "a JPEG of quality %u: allowed are 1 to 100", quality);
    if (width < 1 || width > JPEG_MAX_DIMENSION || height < 1 || height > JPEG_MAX_DIMENSION)
        return kd_error_set(error, KD_EINVAL, "a JPEG of %u x %u pixels: each side is 1 to %ld", width, height, JPEG_MAX_DIMENSION);
    enum kd_status status = compress(width, height, pixels, quality, &file, &size, error);
    if (!status && kd_buffer_append(out, file, size))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for a JPEG of %u x %u pixels", width, height);
    free(file);
    return status;
}

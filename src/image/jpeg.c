#include "image/jpeg.h"

#include <setjmp.h>
#include <stdio.h> /* jpeglib.h does not include what it needs */
#include <stdlib.h>

#include <jpeglib.h>

enum { PIECE = 16 << 10 };

/* One compression: libjpeg's state with what it calls back. */
struct work {
    struct jpeg_compress_struct info; /* first: libjpeg's pointer is ours */
    struct jpeg_error_mgr errors;
    struct jpeg_destination_mgr destination;
    struct kd_buffer *out;
    jmp_buf back;
    char text[JMSG_LENGTH_MAX];
    JOCTET piece[PIECE];
};

static void give_up(j_common_ptr info)
{
    struct work *work = (struct work *)info;
    work->errors.format_message(info, work->text);
    longjmp(work->back, 1);
}

static void say_nothing(j_common_ptr info) { (void)info; }

static void begin_piece(j_compress_ptr info)
{
    struct work *work = (struct work *)info;
    work->destination.next_output_byte = work->piece;
    work->destination.free_in_buffer = PIECE;
}

static void append(struct work *work, size_t size)
{
    if (!kd_buffer_append(work->out, work->piece, size))
        return;
    snprintf(work->text, sizeof work->text, "out of memory for its bytes");
    longjmp(work->back, 1);
}

static boolean put_piece(j_compress_ptr info) /* libjpeg wants all of it gone, whatever it says is free */
{
    append((struct work *)info, PIECE);
    begin_piece(info);
    return TRUE;
}

static void put_last_piece(j_compress_ptr info)
{
    struct work *work = (struct work *)info;
    append(work, PIECE - work->destination.free_in_buffer);
}

static void choose(struct jpeg_compress_struct *info, unsigned quality)
{
    jpeg_set_defaults(info); /* 4:2:0 */
    jpeg_set_quality(info, (int)quality, TRUE);
    info->dct_method = JDCT_ISLOW;
    info->optimize_coding = quality < KD_JPEG_THRIFTY;
    if (quality >= KD_JPEG_FULL_COLOUR)
        info->comp_info[0].h_samp_factor = info->comp_info[0].v_samp_factor = 1;
}

static void compress(struct work *work, const uint8_t *pixels, unsigned quality)
{
    struct jpeg_compress_struct *info = &work->info;
    info->dest = &work->destination;
    info->input_components = 3;
    info->in_color_space = JCS_RGB;
    choose(info, quality);
    jpeg_start_compress(info, TRUE);
    while (info->next_scanline < info->image_height) {
        JSAMPROW row = (JSAMPROW)(uintptr_t)(pixels + (size_t)3 * info->image_width * info->next_scanline);
        jpeg_write_scanlines(info, &row, 1);
    }
    jpeg_finish_compress(info);
}

enum kd_status kd_jpeg_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error)
{
    if (quality < 1 || quality > 100)
        return kd_error_set(error, KD_EINVAL, "a JPEG of quality %u: allowed are 1 to 100", quality);
    if (width < 1 || width > JPEG_MAX_DIMENSION || height < 1 || height > JPEG_MAX_DIMENSION)
        return kd_error_set(error, KD_EINVAL, "a JPEG of %u x %u pixels: each side is 1 to %ld", width, height,
                            JPEG_MAX_DIMENSION);
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return kd_error_set(error, KD_ENOMEM, "out of memory for a JPEG of %u x %u pixels", width, height);
    const size_t before = out->size;
    volatile enum kd_status status = KD_OK;
    work->out = out;
    work->info.err = jpeg_std_error(&work->errors);
    work->errors.error_exit = give_up;
    work->errors.output_message = say_nothing;
    work->destination = (struct jpeg_destination_mgr) { .init_destination = begin_piece,
                                                        .empty_output_buffer = put_piece,
                                                        .term_destination = put_last_piece };
    if (!setjmp(work->back)) {
        jpeg_create_compress(&work->info);
        work->info.image_width = width;
        work->info.image_height = height;
        compress(work, pixels, quality);
    } else {
        out->size = before;
        status =
            kd_error_set(error, KD_ENOMEM, "a JPEG of %u x %u pixels could not be made: %s", width, height, work->text);
    }
    jpeg_destroy_compress(&work->info);
    free(work);
    return status;
}

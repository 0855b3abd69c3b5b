#include "image/jpeg.h"

#include "image/strips.h"

#include <setjmp.h>
#include <stdio.h> /* jpeglib.h needs this header but does not include it */
#include <stdlib.h>
#include <string.h>

#include <jpeglib.h>

enum {
    PIECE = 16 << 10,
    STRIP = 256 << 10,      /* minimum number of pixels in a strip */
    INTERVAL_MOST = 0xffff, /* maximum number of MCUs between two restart markers (ITU-T T.81, B.2.4.4) */
    SOF0 = 0xc0,
    RST0 = 0xd0,
    SOI = 0xd8,
    EOI = 0xd9,
    SOS = 0xda,
    APP0 = 0xe0,
    APP1 = 0xe1,
};

/* name of the namespace; a NUL separates it from the packet */
static const char xmp_name[] = "http://ns.adobe.com/xap/1.0/";

/* State of one compression, for libjpeg and for its callbacks. */
struct work {
    /* must be the first member, so that libjpeg's pointer can be cast to struct work */
    struct jpeg_compress_struct info;
    struct jpeg_error_mgr errors;
    struct jpeg_destination_mgr destination;
    struct kd_buffer *out;
    jmp_buf back;
    JOCTET piece[PIECE];
};

static void give_up(j_common_ptr info)
{
    struct work *work = (struct work *)info;
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
    if (kd_buffer_append(work->out, work->piece, size))
        longjmp(work->back, 1);
}

/* libjpeg requires that the whole buffer is emptied, whatever free space it reports */
static boolean put_piece(j_compress_ptr info)
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

/* strip_rows: number of MCU rows between two restart markers; 0: no markers. */
static void compress(struct work *work, const uint8_t *pixels, unsigned quality, unsigned strip_rows)
{
    struct jpeg_compress_struct *info = &work->info;
    info->dest = &work->destination;
    info->input_components = 3;
    info->in_color_space = JCS_RGB;
    choose(info, quality);
    info->restart_in_rows = (int)strip_rows;
    jpeg_start_compress(info, TRUE);
    while (info->next_scanline < info->image_height) {
        JSAMPROW row = (JSAMPROW)(uintptr_t)(pixels + (size_t)3 * info->image_width * info->next_scanline);
        jpeg_write_scanlines(info, &row, 1);
    }
    jpeg_finish_compress(info);
}

/* A picture divided into strips. */
struct picture {
    uint32_t width, height, rows; /* rows: number of pixel rows in a strip; the last strip may have fewer */
    const uint8_t *pixels;
    unsigned quality, strip_rows; /* strip_rows: number of MCU rows in a strip; 0: there is only one strip */
    size_t n;
    struct kd_buffer *out;
};

/* Makes a JPEG of a single strip. */
static enum kd_status encode_strip(void *user, size_t strip, struct kd_buffer *out)
{
    const struct picture *p = user;
    const size_t first = strip * p->rows, rest = p->height - first;
    struct work *work = calloc(1, sizeof *work);
    if (!work)
        return KD_ENOMEM;
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
        work->info.image_width = p->width;
        work->info.image_height = (JDIMENSION)(rest < p->rows ? rest : p->rows);
        compress(work, p->pixels + 3 * first * p->width, p->quality, p->strip_rows);
    } else {
        status = KD_ENOMEM; /* out of memory is the only possible failure of compress() */
    }
    jpeg_destroy_compress(&work->info);
    free(work);
    return status;
}

/* Returns the offset of the scan's data. While it looks for them, it sets the height in the frame header to that of
 * all strips together. Before the scan, libjpeg writes segments; each has a marker, a length of two bytes that
 * counts itself, and data (T.81, B.1.1.4). */
static size_t scan_of(const struct kd_buffer *jpeg, uint32_t height)
{
    for (size_t at = 2;; at += 2 + (size_t)(jpeg->data[at + 2] << 8 | jpeg->data[at + 3])) {
        uint8_t *segment = jpeg->data + at;
        if (segment[1] == SOF0) {
            segment[5] = (uint8_t)(height >> 8);
            segment[6] = (uint8_t)height;
        } else if (segment[1] == SOS) {
            return at + 2 + (size_t)(segment[2] << 8 | segment[3]);
        }
    }
}

/* Appends the file of a strip. The file of the first strip is copied with its header. From all others only the scans
 * are copied, each after a restart marker. This works because all strips have the same tables, and a decoder resets
 * its state at such a marker, as an encoder of the whole picture does (T.81, F.1.1.5.1). */
static enum kd_status join_strip(void *user, size_t strip, const struct kd_buffer *bytes)
{
    const struct picture *p = user;
    const uint8_t restart[2] = { 0xff, (uint8_t)(RST0 + (strip + 7) % 8) }, end[2] = { 0xff, EOI };
    const size_t scan = scan_of(bytes, p->height), first = strip ? scan : 0;
    enum kd_status status = KD_OK;
    if (strip)
        status = kd_buffer_append(p->out, restart, sizeof restart);
    if (!status)
        status = kd_buffer_append(p->out, bytes->data + first, bytes->size - sizeof end - first);
    if (!status && strip + 1 == p->n)
        status = kd_buffer_append(p->out, end, sizeof end);
    return status;
}

/* Divides a picture into strips. Optimised Huffman tables are made for a whole picture, which then is a single
 * strip. */
static void cut(struct picture *p)
{
    const uint32_t side = p->quality < KD_JPEG_FULL_COLOUR ? 16 : 8, across = (p->width + side - 1) / side;
    const uint32_t rows = (STRIP + p->width * side - 1) / (p->width * side);
    p->n = 1;
    p->rows = p->height;
    if (p->quality < KD_JPEG_THRIFTY || rows * across > INTERVAL_MOST || rows * side >= p->height)
        return;
    p->strip_rows = rows;
    p->rows = rows * side;
    p->n = (p->height + p->rows - 1) / p->rows;
}

enum kd_status kd_jpeg_encode(uint32_t width, uint32_t height, const uint8_t *pixels, unsigned quality,
                              struct kd_buffer *out, struct kd_error *error)
{
    if (quality < 1 || quality > 100)
        return kd_error_set(error, KD_EINVAL, "the quality of a JPEG is %u; it must be 1 to 100", quality);
    if (width < 1 || width > KD_JPEG_SIDE_MAX || height < 1 || height > KD_JPEG_SIDE_MAX)
        return kd_error_set(error, KD_EINVAL, "a JPEG has %u x %u pixels; each side must be 1 to %d", width, height,
                            KD_JPEG_SIDE_MAX);
    struct picture picture = { .width = width, .height = height, .pixels = pixels, .quality = quality, .out = out };
    const size_t before = out->size;
    cut(&picture);
    const enum kd_status status =
        kd_strips_encode(&(struct kd_strips) { picture.n, encode_strip, join_strip, &picture });
    if (status) {
        out->size = before;
        kd_error_set(error, status, "out of memory for a JPEG of %u x %u pixels", width, height);
    }
    return status;
}

enum kd_status kd_jpeg_add_xmp(const struct kd_buffer *file, const void *xmp, size_t size, struct kd_buffer *out,
                               struct kd_error *error)
{
    if (size > KD_JPEG_XMP_MAX)
        return kd_error_set(
            error, KD_ETOOBIG,
            "the scene and its notes take %zu bytes; in a JPEG they must take at most %d; a webp or png "
            "holds more",
            size, KD_JPEG_XMP_MAX);
    const size_t length = 2 + sizeof xmp_name + size, before = out->size;
    const uint8_t *data = file->data, head[4] = { 0xff, APP1, (uint8_t)(length >> 8), (uint8_t)length };
    /* inserted after the JFIF segment, which libjpeg writes first because readers expect it there */
    const size_t first = 2 + (data[3] == APP0 ? 2 + (size_t)(data[4] << 8 | data[5]) : 0);
    enum kd_status status;
    KD_TRY(kd_buffer_append(out, data, first));
    KD_TRY(kd_buffer_append(out, head, sizeof head));
    KD_TRY(kd_buffer_append(out, xmp_name, sizeof xmp_name));
    KD_TRY(kd_buffer_append(out, xmp, size));
    KD_TRY(kd_buffer_append(out, data + first, file->size - first));
done:
    if (status) {
        out->size = before;
        kd_error_set(error, status, "out of memory for the metadata of a JPEG");
    }
    return status;
}

const void *kd_jpeg_xmp(const void *data, size_t size, size_t *length)
{
    const uint8_t *bytes = data;
    if (size < 4 || bytes[0] != 0xff || bytes[1] != SOI)
        return NULL;
    for (size_t at = 2; at + 4 <= size && bytes[at] == 0xff && bytes[at + 1] != SOS;) {
        /* this length includes its own two bytes */
        const size_t segment = (size_t)(bytes[at + 2] << 8 | bytes[at + 3]);
        if (segment < 2 || segment > size - at - 2)
            return NULL;
        if (bytes[at + 1] == APP1 && segment >= 2 + sizeof xmp_name &&
            !memcmp(bytes + at + 4, xmp_name, sizeof xmp_name)) {
            *length = segment - 2 - sizeof xmp_name;
            return bytes + at + 4 + sizeof xmp_name;
        }
        at += 2 + segment;
    }
    return NULL;
}

#include "image/png.h"

#include "base/utf8.h"
#include "image/png_strips.h"

#include <png.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define MAX_SIDE 32768u
#define MAX_TEXT (1u << 20)
#define MAX_CHUNKS 100 /* maximum number of text chunks; even a compressed chunk of 1 KiB may unpack to MAX_TEXT */

/* libpng leaves a failing call by longjmp. This struct holds all variables that such a call changes, and it lies in
 * the stack frame of the function that cleans up. A jump therefore cannot clobber a variable in a register, and
 * cannot skip a free. */
struct job {
    png_structp png;
    png_infop info;
    bool no_memory;
    char message[160];
    struct kd_buffer *sink;   /* for encoding */
    const uint8_t *source;    /* for decoding */
    size_t left, size, texts; /* texts: number of text chunks in the file */
    struct kd_png *picture;
};

static void on_error(png_structp png, png_const_charp message)
{
    struct job *job = png_get_error_ptr(png);
    snprintf(job->message, sizeof job->message, "%s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message; /* ignored, because a malformed ancillary chunk has no effect on the picture */
}

static png_voidp job_malloc(png_structp png, png_alloc_size_t size)
{
    struct job *job = png_get_mem_ptr(png);
    void *memory = malloc(size);
    if (!memory)
        job->no_memory = true;
    return memory;
}

static void job_free(png_structp png, png_voidp memory)
{
    (void)png;
    free(memory);
}

/* Encoding. */

static void sink_write(png_structp png, png_bytep data, size_t size)
{
    struct job *job = png_get_io_ptr(png);
    if (kd_buffer_append(job->sink, data, size)) {
        job->no_memory = true;
        png_error(png, "out of memory");
    }
}

static void sink_flush(png_structp png) { (void)png; }

static bool key_ok(const char *key)
{
    size_t length = strlen(key);
    if (length < 1 || length > 79 || key[0] == ' ' || key[length - 1] == ' ' || strstr(key, "  "))
        return false;
    for (size_t i = 0; i < length; i++)
        if (key[i] < ' ' || key[i] > '~') /* PNG permits Latin-1, but only ASCII is read in the same way everywhere */
            return false;
    return true;
}

static enum kd_status check_params(const struct kd_png_params *params, struct kd_error *error)
{
    if (params->width < 1 || params->width > MAX_SIDE || params->height < 1 || params->height > MAX_SIDE)
        return kd_error_set(error, KD_EINVAL, "a PNG has %u x %u pixels; each side must be 1 to %u", params->width,
                            params->height, MAX_SIDE);
    if (params->bit_depth != 8 && params->bit_depth != 16)
        return kd_error_set(error, KD_EINVAL, "a PNG has %d bits a channel; it must have 8 or 16", params->bit_depth);
    if (params->compression < 0 || params->compression > 8)
        return kd_error_set(error, KD_EINVAL, "the PNG compression level is %d; it must be 0 to 8",
                            params->compression);
    size_t total = 0;
    for (size_t i = 0; i < params->n_text; i++) {
        const struct kd_png_text *text = &params->text[i];
        if (!key_ok(text->key))
            return kd_error_set(error, KD_EINVAL,
                                "a PNG text key is \"%.80s\"; it must be 1 to 79 printable ASCII characters",
                                text->key);
        if (!kd_utf8_valid(text->value))
            return kd_error_set(error, KD_EINVAL, "PNG text \"%s\" is not UTF-8", text->key);
        total += strlen(text->key) + strlen(text->value);
    }
    /* PNG could hold more text, but kerrd could not read it again */
    if (total > MAX_TEXT || params->n_text >= MAX_CHUNKS)
        return kd_error_set(error, KD_EINVAL,
                            "a PNG has %zu bytes of text in %zu chunks; it must have at most %u bytes in %d chunks",
                            total, params->n_text, MAX_TEXT, MAX_CHUNKS - 1);
    return KD_OK;
}

static void put_text(struct job *job, const struct kd_png_text *text)
{
    png_text chunk = {
        .key = (png_charp)text->key, /* libpng copies key and text */
        .text = (png_charp)text->value,
        .compression = kd_utf8_ascii(text->value) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE,
        .text_length = strlen(text->value),
    };
    png_set_text(job->png, job->info, &chunk, 1);
}

/* Writes everything before the pixels. */
static bool encode_head(struct job *job, const struct kd_png_params *params)
{
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    png_set_write_fn(job->png, job, sink_write, sink_flush);
    png_set_user_limits(job->png, MAX_SIDE, MAX_SIDE);
    png_set_IHDR(job->png, job->info, params->width, params->height, params->bit_depth, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(job->png, job->info, PNG_sRGB_INTENT_PERCEPTUAL);
    for (size_t i = 0; i < params->n_text; i++)
        put_text(job, &params->text[i]);
    png_write_info(job->png, job->info);
    return true;
}

static enum kd_status encode_pixels(const struct kd_png_params *params, struct kd_buffer *out, struct kd_error *error)
{
    struct kd_png_strips *strips;
    enum kd_status status = kd_png_strips_create(KD_DEFLATE_LIBDEFLATE, &strips, error);
    if (status)
        return status;
    status = kd_png_strips_append(strips, params, out, error);
    if (!status && (status = kd_png_chunk(out, "IEND", NULL, 0)))
        kd_error_set(error, status, "out of memory for the end of a PNG");
    kd_png_strips_destroy(strips);
    return status;
}

enum kd_status kd_png_encode(const struct kd_png_params *params, struct kd_buffer *out, struct kd_error *error)
{
    enum kd_status status = check_params(params, error);
    if (status)
        return status;
    size_t start = out->size;
    struct job job = { .sink = out };
    job.png = png_create_write_struct_2(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning, &job, job_malloc, job_free);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    if (!job.info)
        status = kd_error_set(error, KD_ENOMEM, "out of memory for a PNG encoder");
    else if (!encode_head(&job, params) || job.no_memory)
        status = job.no_memory ? kd_error_set(error, KD_ENOMEM, "out of memory for a PNG of %u x %u pixels",
                                              params->width, params->height)
                               : kd_error_set(error, KD_EINVAL, "cannot encode the PNG: %s", job.message);
    png_destroy_write_struct(&job.png, &job.info);
    if (!status)
        status = encode_pixels(params, out, error);
    if (status)
        out->size = start;
    return status;
}

/* Decoding. */

static void source_read(png_structp png, png_bytep data, size_t size)
{
    struct job *job = png_get_io_ptr(png);
    if (size > job->left)
        png_error(png, "the file ends too early");
    memcpy(data, job->source, size);
    job->source += size;
    job->left -= size;
}

/* Copies all texts into one block: first the array, then its strings. Latin-1 chunks become UTF-8. libpng skips some
 * text chunks with only a warning: chunks that are too long, unpack to too much, are damaged, or follow too many
 * others. (The exact set differs between 1.6.39 and 1.6.48.) A skipped chunk may have held the scene, so a missing
 * text is an error. */
static enum kd_status take_text(struct job *job)
{
    png_textp text = NULL;
    int n = 0;
    png_get_text(job->png, job->info, &text, &n);
    if ((size_t)n != job->texts)
        return KD_EINVAL;
    size_t total = 0;
    for (int i = 0; i < n; i++) {
        bool utf8 = text[i].compression >= PNG_ITXT_COMPRESSION_NONE;
        total += kd_latin1_size(text[i].key) + (utf8 ? strlen(text[i].text) + 1 : kd_latin1_size(text[i].text));
        if (total > MAX_TEXT + 2u * MAX_CHUNKS || (utf8 && !kd_utf8_valid(text[i].text)))
            return KD_EINVAL;
    }
    if (!n)
        return KD_OK;
    struct kd_png_text *list = malloc((size_t)n * sizeof *list + total);
    if (!list)
        return KD_ENOMEM;
    char *end = (char *)(list + n);
    for (int i = 0; i < n; i++) {
        list[i].key = end;
        end = kd_latin1_copy(end, text[i].key);
        list[i].value = end;
        if (text[i].compression >= PNG_ITXT_COMPRESSION_NONE)
            end = stpcpy(end, text[i].text) + 1;
        else
            end = kd_latin1_copy(end, text[i].text);
    }
    job->picture->text = list;
    job->picture->n_text = (size_t)n;
    return KD_OK;
}

/* Deflate expands data at most by a factor 1032. A header that promises more pixels than the file can hold is
 * therefore refused before memory is allocated. */
static void check_promise(struct job *job, uint32_t height)
{
    uint64_t packed = (uint64_t)png_get_rowbytes(job->png, job->info) * height;
    if (packed / 1032 > job->size)
        png_error(job->png, "the file is too short for its width and height");
}

/* Makes libpng return RGB of 8 or 16 bits for every type of file. Alpha is dropped, not blended. */
static int set_transforms(struct job *job)
{
    png_set_expand(job->png);
    png_set_strip_alpha(job->png);
    png_set_gray_to_rgb(job->png);
    if (__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__)
        png_set_swap(job->png);
    int passes = png_set_interlace_handling(job->png);
    png_read_update_info(job->png, job->info);
    return passes;
}

static void read_pixels(struct job *job)
{
    struct kd_png *picture = job->picture;
    check_promise(job, picture->height);
    int passes = set_transforms(job);
    picture->bit_depth = png_get_bit_depth(job->png, job->info);
    size_t stride = (size_t)picture->width * 3 * ((size_t)picture->bit_depth / 8);
    if (png_get_rowbytes(job->png, job->info) != stride)
        png_error(job->png, "its rows cannot be read as RGB");
    picture->pixels = malloc(stride * picture->height);
    if (!picture->pixels) {
        job->no_memory = true;
        png_error(job->png, "out of memory");
    }
    /* cleared, because the passes of an interlaced file read the previous contents before they write */
    memset(picture->pixels, 0, stride * picture->height);
    for (int pass = 0; pass < passes; pass++)
        for (uint32_t y = 0; y < picture->height; y++)
            png_read_row(job->png, (png_bytep)picture->pixels + y * stride, NULL);
}

static void read_info(struct job *job)
{
    png_set_read_fn(job->png, job, source_read);
    png_set_user_limits(job->png, MAX_SIDE, MAX_SIDE);
    png_set_chunk_malloc_max(job->png, MAX_TEXT + 128); /* room for MAX_TEXT and the key */
    /* one more than needed: libpng accepts two chunks fewer than this limit */
    png_set_chunk_cache_max(job->png, MAX_CHUNKS + 1);
    /* damaged text counts as damage of the file */
    png_set_crc_action(job->png, PNG_CRC_ERROR_QUIT, PNG_CRC_ERROR_QUIT);
    png_read_info(job->png, job->info);
}

static bool decode(struct job *job)
{
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    read_info(job);
    job->picture->width = png_get_image_width(job->png, job->info);
    job->picture->height = png_get_image_height(job->png, job->info);
    read_pixels(job);
    png_read_end(job->png, job->info);
    return true;
}

static uint32_t big_endian(const uint8_t *p)
{
    return (uint32_t)p[0] << 24 | (uint32_t)p[1] << 16 | (uint32_t)p[2] << 8 | p[3];
}

/* Checks a file before libpng reads it. There are two reasons: the error message can then name the fault, and libpng
 * 1.6 trusts the length in a text chunk's header, so that it allocates up to 2 GiB before it checks whether so many
 * bytes follow. */
static enum kd_status check_header(const uint8_t *data, size_t size, size_t *texts, size_t *end, struct kd_error *error)
{
    static const uint8_t signature[8] = { 0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n' };
    if (size < sizeof signature || memcmp(data, signature, sizeof signature))
        return kd_error_set(error, KD_EINVAL, "not a PNG file");
    if (size < 33)
        return kd_error_set(error, KD_EINVAL, "the PNG file ends inside its header");
    uint32_t width = big_endian(data + 16), height = big_endian(data + 20);
    if (memcmp(data + 12, "IHDR", 4) == 0 && (width < 1 || width > MAX_SIDE || height < 1 || height > MAX_SIDE))
        return kd_error_set(error, KD_EINVAL, "a PNG has %u x %u pixels; each side must be 1 to %u", width, height,
                            MAX_SIDE);
    for (size_t at = 8; at < size;) {
        size_t room = size - at;
        if (room < 12 || big_endian(data + at) > room - 12)
            return kd_error_set(error, KD_EINVAL, "damaged PNG file: the chunk at byte %zu ends past the file", at);
        if (memcmp(data + at + 4, "IEND", 4) == 0) {
            *end = at + 12 + big_endian(data + at);
            break;
        }
        *texts += memcmp(data + at + 4, "tEXt", 4) == 0 || memcmp(data + at + 4, "zTXt", 4) == 0 ||
                  memcmp(data + at + 4, "iTXt", 4) == 0;
        at += 12 + (size_t)big_endian(data + at);
    }
    return KD_OK;
}

enum kd_status kd_png_decode(const void *data, size_t size, struct kd_png *out, struct kd_error *error)
{
    *out = (struct kd_png) { 0 };
    struct job job = { .source = data, .left = size, .size = size, .picture = out };
    size_t end = 0;
    enum kd_status status = check_header(data, size, &job.texts, &end, error);
    if (status)
        return status;
    job.png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning, &job, job_malloc, job_free);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    bool done = job.info && decode(&job);
    if (!job.info || job.no_memory) /* libpng itself would drop a text for which there is no memory, and continue */
        status = kd_error_set(error, KD_ENOMEM, "out of memory for a PNG of %u x %u pixels", out->width, out->height);
    else if (!done)
        status = kd_error_set(error, KD_EINVAL, "damaged PNG file: %s", job.message);
    else if ((status = take_text(&job)) == KD_EINVAL)
        kd_error_set(error, status,
                     "the text of the PNG file is damaged, not UTF-8, over %u bytes or in over %d pieces", MAX_TEXT,
                     MAX_CHUNKS - 1);
    else if (status)
        kd_error_set(error, status, "out of memory for the text of a PNG file");
    png_destroy_read_struct(&job.png, &job.info, NULL);
    if (status)
        kd_png_finish(out);
    return status;
}

static bool look(struct job *job, struct kd_png_about *out)
{
    if (setjmp(png_jmpbuf(job->png)))
        return false;
    read_info(job);
    out->width = png_get_image_width(job->png, job->info);
    out->height = png_get_image_height(job->png, job->info);
    out->bit_depth = png_get_bit_depth(job->png, job->info);
    out->channels = png_get_channels(job->png, job->info);
    check_promise(job, out->height);
    return true;
}

enum kd_status kd_png_look(const void *data, size_t size, struct kd_png_about *out, struct kd_error *error)
{
    struct job job = { .source = data, .left = size, .size = size };
    size_t end = 0;
    enum kd_status status = check_header(data, size, &job.texts, &end, error);
    *out = (struct kd_png_about) { 0 };
    if (!status && !end)
        status = kd_error_set(error, KD_EINVAL, "damaged PNG file: its end is missing");
    if (!status && end < size)
        status = kd_error_set(error, KD_EINVAL, "damaged PNG file: %zu bytes follow its end", size - end);
    if (status)
        return status;
    job.png = png_create_read_struct_2(PNG_LIBPNG_VER_STRING, &job, on_error, on_warning, &job, job_malloc, job_free);
    job.info = job.png ? png_create_info_struct(job.png) : NULL;
    bool done = job.info && look(&job, out);
    if (!job.info || job.no_memory)
        status = kd_error_set(error, KD_ENOMEM, "out of memory for the header of a PNG");
    else if (!done)
        status = kd_error_set(error, KD_EINVAL, "damaged PNG file: %s", job.message);
    png_destroy_read_struct(&job.png, &job.info, NULL);
    return status;
}

const char *kd_png_text_find(const struct kd_png *png, const char *key)
{
    for (size_t i = 0; i < png->n_text; i++)
        if (strcmp(png->text[i].key, key) == 0)
            return png->text[i].value;
    return NULL;
}

void kd_png_finish(struct kd_png *png)
{
    free(png->pixels);
    free(png->text);
    *png = (struct kd_png) { 0 };
}

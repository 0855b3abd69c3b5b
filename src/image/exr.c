#include "image/exr.h"

#include <openexr.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { MOST_CHANNELS = 64 };

/* Output or input of OpenEXR's core, with the last error message of the core. */
struct file {
    struct kd_buffer *out;
    size_t from; /* size of the buffer before the file begins */
    const uint8_t *data;
    size_t size;
    bool no_memory;
    char message[160];
};

static int64_t write_at(exr_const_context_t context, void *user, const void *data, uint64_t size, uint64_t offset,
                        exr_stream_error_func_ptr_t fail)
{
    struct file *f = user;
    size_t end = f->from + offset + size;
    while (f->out->size < end) { /* if bytes were skipped, they are written as zeros */
        static const uint8_t zeros[4096];
        size_t more = end - f->out->size;
        if (kd_buffer_append(f->out, zeros, more < sizeof zeros ? more : sizeof zeros)) {
            f->no_memory = true;
            fail(context, EXR_ERR_OUT_OF_MEMORY, "out of memory");
            return -1;
        }
    }
    memcpy(f->out->data + f->from + offset, data, size);
    return (int64_t)size;
}

static int64_t read_at(exr_const_context_t context, void *user, void *to, uint64_t size, uint64_t offset,
                       exr_stream_error_func_ptr_t fail)
{
    const struct file *f = user;
    (void)context, (void)fail;
    if (offset >= f->size)
        return 0;
    size = size < f->size - offset ? size : f->size - offset;
    memcpy(to, f->data + offset, size);
    return (int64_t)size;
}

static int64_t size_of(exr_const_context_t context, void *user)
{
    (void)context;
    return (int64_t)((const struct file *)user)->size;
}

static void keep_message(exr_const_context_t context, exr_result_t code, const char *message)
{
    void *user = NULL;
    (void)code;
    if (context && !exr_get_user_data(context, &user) && user && message)
        snprintf(((struct file *)user)->message, sizeof((struct file *)user)->message, "%s", message);
}

static enum kd_status failed(const struct file *f, exr_result_t code, struct kd_error *error)
{
    return f->no_memory || code == EXR_ERR_OUT_OF_MEMORY
               ? kd_error_set(error, KD_ENOMEM, "out of memory for an EXR file")
               : kd_error_set(error, KD_EINVAL, "EXR: %s",
                              *f->message ? f->message : exr_get_default_error_message(code));
}

#define TRY(call) \
    do { \
        if ((code = (call)) != EXR_ERR_SUCCESS) \
            goto done; \
    } while (0)

static exr_result_t put_header(exr_context_t context, const struct kd_exr *image)
{
    exr_result_t code;
    int part;
    TRY(exr_add_part(context, "kerrd", EXR_STORAGE_SCANLINE, &part));
    TRY(exr_initialize_required_attr_simple(context, part, (int32_t)image->width, (int32_t)image->height,
                                            EXR_COMPRESSION_ZIP));
    for (size_t i = 0; i < image->n_channels; i++)
        TRY(exr_add_channel(context, part, image->channels[i].name, EXR_PIXEL_FLOAT, EXR_PERCEPTUALLY_LINEAR, 1, 1));
    for (size_t i = 0; i < image->n_texts; i++)
        TRY(exr_attr_set_string(context, part, image->texts[i].name, image->texts[i].value));
    TRY(exr_write_header(context));
done:
    return code;
}

/* Matches channels by name, because the core has its own order of channels. */
static exr_result_t connect(exr_encode_pipeline_t *encoder, const struct kd_exr *image, uint32_t y)
{
    for (int c = 0; c < encoder->channel_count; c++) {
        exr_coding_channel_info_t *to = &encoder->channels[c];
        size_t i = 0;
        while (i < image->n_channels && strcmp(image->channels[i].name, to->channel_name))
            i++;
        if (i == image->n_channels)
            return EXR_ERR_INVALID_ARGUMENT;
        const struct kd_exr_channel *from = &image->channels[i];
        to->user_bytes_per_element = 4;
        to->user_data_type = EXR_PIXEL_FLOAT;
        to->user_pixel_stride = (int32_t)(4 * from->step);
        to->user_line_stride = (int32_t)(4 * from->step * image->width);
        to->encode_from_ptr = (const uint8_t *)(from->data + from->step * image->width * y);
    }
    return EXR_ERR_SUCCESS;
}

static exr_result_t put_rows(exr_context_t context, const struct kd_exr *image)
{
    exr_encode_pipeline_t encoder = EXR_ENCODE_PIPELINE_INITIALIZER;
    exr_chunk_info_t chunk;
    exr_result_t code;
    int32_t rows;
    TRY(exr_get_scanlines_per_chunk(context, 0, &rows));
    for (uint32_t y = 0; y < image->height; y += (uint32_t)rows) {
        TRY(exr_write_scanline_chunk_info(context, 0, (int)y, &chunk));
        TRY(y ? exr_encoding_update(context, 0, &chunk, &encoder)
              : exr_encoding_initialize(context, 0, &chunk, &encoder));
        TRY(connect(&encoder, image, y));
        if (!y)
            TRY(exr_encoding_choose_default_routines(context, 0, &encoder));
        TRY(exr_encoding_run(context, 0, &encoder));
    }
done:
    exr_encoding_destroy(context, &encoder);
    return code;
}

enum kd_status kd_exr_encode(const struct kd_exr *image, struct kd_buffer *out, struct kd_error *error)
{
    struct file file = { .out = out, .from = out->size };
    exr_context_initializer_t with = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context = NULL;
    with.user_data = &file;
    with.write_fn = write_at;
    with.error_handler_fn = keep_message;
    if (image->n_channels > MOST_CHANNELS)
        return kd_error_set(error, KD_EINVAL, "EXR: there are %zu channels; there must be at most %d",
                            image->n_channels, MOST_CHANNELS);
    exr_result_t code, closed = EXR_ERR_SUCCESS;
    TRY(exr_start_write(&context, "memory", EXR_WRITE_FILE_DIRECTLY, &with));
    TRY(put_header(context, image));
    TRY(put_rows(context, image));
done:
    if (context)
        closed = exr_finish(&context);
    code = code ? code : closed;
    return code ? failed(&file, code, error) : KD_OK;
}

enum kd_status kd_exr_find_text(const void *data, size_t size, const char *name, struct kd_buffer *out,
                                struct kd_error *error)
{
    struct file file = { .data = data, .size = size };
    exr_context_initializer_t with = EXR_DEFAULT_CONTEXT_INITIALIZER;
    exr_context_t context = NULL;
    const char *text = NULL;
    int32_t length = 0;
    enum kd_status status = KD_OK;
    with.user_data = &file;
    with.read_fn = read_at;
    with.size_fn = size_of;
    with.error_handler_fn = keep_message;
    exr_result_t code;
    TRY(exr_start_read(&context, "memory", &with));
    TRY(exr_attr_get_string(context, 0, name, &length, &text));
    if (kd_buffer_append(out, text, (size_t)length))
        status = kd_error_set(error, KD_ENOMEM, "out of memory for a text of an EXR file");
done:
    if (code)
        status = failed(&file, code, error);
    if (context)
        exr_finish(&context);
    return status;
}

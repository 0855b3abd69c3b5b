/* Writes the files of frames into a ZIP, and contains the functions that all gathered formats share. */
#include "render/output/gather.h"

#include "image/zip.h"

#include <stdio.h>
#include <stdlib.h>

enum kd_status kd_gather_open(const struct kd_gather_format *format, const struct kd_gather_source *source,
                              struct kd_gather *out, struct kd_error *error)
{
    *out = (struct kd_gather) { .format = format };
    return format->open(source, &out->state, error);
}

enum kd_status kd_gather_next(struct kd_gather *gather, struct kd_buffer *out, bool *over, struct kd_error *error)
{
    return gather->format->next(gather->state, out, over, error);
}

void kd_gather_close(struct kd_gather *gather)
{
    if (gather->state)
        gather->format->close(gather->state);
    gather->state = NULL;
}

struct files {
    const struct kd_gather_source *source;
    struct kd_zip *zip;     /* NULL: nothing is written yet */
    struct kd_buffer bytes; /* output of the ZIP so far */
    unsigned next;
    uint64_t at, size; /* at: position in the current file; size: its size. at == size: there is no current file */
    uint8_t piece[KD_GATHER_PIECE];
};

static enum kd_status failed(enum kd_status status, unsigned frame, struct kd_error *error)
{
    return status == KD_EIO ? kd_error_set(error, KD_EIO, "the file of frame %u cannot be read", frame)
                            : kd_error_set(error, status, "out of memory for a ZIP file");
}

static void name_of(const struct files *f, unsigned frame, char out[KD_SWEEP_NAME + 16])
{
    char name[KD_SWEEP_NAME];
    if (f->source->sweep)
        kd_sweep_name(f->source->sweep, frame, name);
    else
        snprintf(name, sizeof name, "%06u", frame);
    snprintf(out, KD_SWEEP_NAME + 16, "%s.%s", name, f->source->frame->name);
}

static enum kd_status put_index(struct files *f)
{
    const struct kd_sweep *sweep = f->source->sweep;
    struct kd_buffer text = { 0 }, scene = { 0 };
    char name[KD_SWEEP_NAME + 16];
    enum kd_status status;
    KD_TRY(kd_scene_to_json(&sweep->base, &scene));
    struct kd_json json = kd_json_begin_lines(&text);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "version", KD_VERSION);
    kd_json_raw(&json, "scene", (const char *)scene.data, scene.size);
    kd_sweep_axes_json(sweep, &json, "axes");
    kd_json_array(&json, "files");
    for (unsigned i = 0; i < f->source->n; i++) {
        name_of(f, i, name);
        kd_json_string(&json, NULL, name);
    }
    kd_json_end(&json);
    kd_json_end(&json);
    KD_TRY(kd_json_finish_line(&json));
    KD_TRY(kd_zip_add(f->zip, "index.json", text.data, text.size));
done:
    kd_buffer_finish(&text);
    kd_buffer_finish(&scene);
    return status;
}

static enum kd_status open_files(const struct kd_gather_source *source, void **state, struct kd_error *error)
{
    struct files *f = calloc(1, sizeof *f);
    *state = f;
    if (!f)
        return failed(KD_ENOMEM, 0, error);
    f->source = source;
    return KD_OK;
}

/* Begins a ZIP without compression: the frames' files are compressed already, or incompressible. */
static enum kd_status begin(struct files *f)
{
    enum kd_status status = kd_zip_create(&f->bytes, false, &f->zip);
    return status || !f->source->sweep ? status : put_index(f);
}

static enum kd_status advance(struct files *f, bool *over)
{
    char name[KD_SWEEP_NAME + 16];
    if (!f->zip)
        return begin(f);
    if (f->at == f->size && f->next == f->source->n) {
        *over = true;
        return kd_zip_close(f->zip);
    }
    if (f->at == f->size) {
        if (!f->source->size(f->source->user, f->next, &f->size))
            return KD_EIO;
        name_of(f, f->next++, name);
        f->at = 0;
        return kd_zip_begin(f->zip, name, f->size);
    }
    if (f->source->counted) {
        *f->source->counted += f->size;
        f->at = f->size;
        return kd_zip_pass_over(f->zip);
    }
    size_t n = f->size - f->at < sizeof f->piece ? (size_t)(f->size - f->at) : sizeof f->piece;
    if (!f->source->read(f->source->user, f->next - 1, f->at, f->piece, n))
        return KD_EIO;
    f->at += n;
    return kd_zip_append(f->zip, f->piece, n);
}

static enum kd_status next_file(void *state, struct kd_buffer *out, bool *over, struct kd_error *error)
{
    struct files *f = state;
    enum kd_status status = advance(f, over);
    if (!status)
        status = kd_buffer_append(out, f->bytes.data, f->bytes.size);
    f->bytes.size = 0;
    return status ? failed(status, f->next ? f->next - 1 : 0, error) : KD_OK;
}

static void close_files(void *state)
{
    struct files *f = state;
    kd_zip_destroy(f->zip);
    kd_buffer_finish(&f->bytes);
    free(f);
}

const struct kd_gather_format kd_gather_zip = {
    .name = "zip",
    .media_type = "application/zip",
    .counts = true,
    .open = open_files,
    .next = next_file,
    .close = close_files,
};

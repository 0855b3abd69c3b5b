/* This answers GET /v1/jobs/{id}/result: a frame as a file, all of them as ZIP, or as they come; a table of their rows. */
#include "server/job/formats.h"
#include "server/job/routes.h"
#include "server/http/reply.h"
#include "server/job/jobs.h"

#include <archive.h>
#include <archive_entry.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#define PREVIEW_TYPE "image/png" /* of a frame under way, whatever it will be */
#define PART_BYTES 65536

/* A stream of the frames from watcher.next on. */
struct frames {
    struct kd_job_watcher watcher; /* first */
    const char *suffix;            /* of a frame */
    struct archive *zip;           /* NULL: each frame after 16 bytes of its own */
    struct archive_entry *entry;
    int fd; /* of the frame under way, -1: none */
    uint64_t left;
    struct kd_buffer out; /* made and not yet taken, from `at` on */
    size_t at;
    bool over;
};

static la_ssize_t keep(struct archive *zip, void *cls, const void *data, size_t size)
{
    struct frames *f = cls;
    if (!kd_buffer_append(&f->out, data, size))
        return (la_ssize_t)size;
    archive_set_error(zip, ENOMEM, "out of memory");
    return -1;
}

/* Stored: PNG is deflated already. */
static bool open_zip(struct frames *f)
{
    f->zip = archive_write_new();
    f->entry = archive_entry_new();
    return f->zip && f->entry && archive_write_set_format_zip(f->zip) == ARCHIVE_OK &&
           archive_write_zip_set_compression_store(f->zip) == ARCHIVE_OK && archive_write_set_bytes_per_block(f->zip, 0) == ARCHIVE_OK &&
           archive_write_open(f->zip, f, NULL, keep, NULL) == ARCHIVE_OK;
}

static void put_le32(unsigned char *out, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        out[i] = (unsigned char)(value >> 8 * i & 255);
}

/* What comes before the bytes of a frame. */
static bool head(struct frames *f)
{
    unsigned char numbers[16] = { 0 };
    char name[20];
    if (!f->zip) {
        put_le32(numbers, (uint32_t)f->left);
        put_le32(numbers + 4, f->watcher.next);
        return !kd_buffer_append(&f->out, numbers, sizeof numbers);
    }
    snprintf(name, sizeof name, "%06u.%.8s", f->watcher.next, f->suffix);
    archive_entry_clear(f->entry);
    archive_entry_set_pathname(f->entry, name);
    archive_entry_set_size(f->entry, (la_int64_t)f->left);
    archive_entry_set_filetype(f->entry, AE_IFREG);
    archive_entry_set_perm(f->entry, 0644);
    archive_entry_set_mtime(f->entry, time(NULL), 0);
    return archive_write_header(f->zip, f->entry) == ARCHIVE_OK;
}

static bool body(struct frames *f)
{
    char part[PART_BYTES];
    ssize_t n = read(f->fd, part, sizeof part);
    if (n <= 0 || (uint64_t)n > f->left)
        return false; /* shorter or longer than it was */
    f->left -= (uint64_t)n;
    if (!f->left) {
        close(f->fd);
        f->fd = -1;
        f->watcher.next++;
    }
    return f->zip ? archive_write_data(f->zip, part, (size_t)n) == n : !kd_buffer_append(&f->out, part, (size_t)n);
}

/* More bytes, or f->over, or *wait for resumption. False: it cannot go on. */
static bool advance(struct frames *f, bool *wait)
{
    if (f->fd >= 0)
        return body(f);
    switch (kd_job_await(&f->watcher)) {
    case KD_JOB_NEWS:
        f->fd = kd_job_frame(f->watcher.job, f->watcher.next, &f->left);
        return f->fd >= 0 && f->left <= UINT32_MAX && head(f);
    case KD_JOB_LATER: *wait = true; return true;
    case KD_JOB_LATE: return true; /* it has no deadline */
    case KD_JOB_OVER: break;
    }
    struct kd_job_status status;
    kd_job_status(f->watcher.job, &status);
    f->over = true;
    if (f->watcher.next < status.frames)
        return false; /* a reader must not take this for the end */
    return !f->zip || archive_write_close(f->zip) == ARCHIVE_OK;
}

static ssize_t produce(void *cls, uint64_t position, char *to, size_t size)
{
    struct frames *f = cls;
    bool wait = false;
    (void)position;
    if (f->at == f->out.size)
        f->out.size = f->at = 0;
    while (!f->out.size && !f->over && !wait)
        if (!advance(f, &wait))
            return MHD_CONTENT_READER_END_WITH_ERROR;
    size_t left = f->out.size - f->at, n = left < size ? left : size;
    if (!n)
        return f->over ? MHD_CONTENT_READER_END_OF_STREAM : 0;
    memcpy(to, f->out.data + f->at, n);
    f->at += n;
    return (ssize_t)n;
}

static void release(void *cls)
{
    struct frames *f = cls;
    archive_write_free(f->zip);
    archive_entry_free(f->entry);
    if (f->fd >= 0)
        close(f->fd);
    kd_buffer_finish(&f->out);
    kd_job_unwatch(&f->watcher);
    free(f);
}

/* Takes the reference over. */
static enum MHD_Result send_frames(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                   const struct kd_job_format *in, unsigned from)
{
    const char *type = in->media_type;
    const bool zip = in == &kd_job_as_zip;
    if (zip)
        kd_reply_file(request, KD_ATTACHMENT, "kerrd-%s.zip", kd_job_id(job));
    struct frames *f = request->head ? NULL : calloc(1, sizeof *f);
    if (!f) {
        kd_job_release(job);
        return request->head ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(type))
                             : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    f->fd = -1;
    f->suffix = status->series->frame->name;
    f->watcher = (struct kd_job_watcher) { .job = job, .mhd = request->mhd, .by_frame = true, .next = from, .deadline_ms = INFINITY };
    kd_job_watch(&f->watcher);
    if (!zip || open_zip(f))
        return kd_job_stream(request, type, produce, f, release);
    release(f);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
}

static enum MHD_Result not_ready(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status)
{
    char detail[600];
    if (status->state == KD_JOB_FAILED)
        snprintf(detail, sizeof detail, "the job has failed with %u of %u frames: %.400s", status->finished, status->frames, status->error);
    else
        snprintf(detail, sizeof detail, "%u of %u frames are finished", status->finished, status->frames);
    kd_job_release(job);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_READY, .detail = detail });
}

static enum MHD_Result send_frame(struct kd_request *request, struct kd_job *job, unsigned frame, const struct kd_job_status *status)
{
    uint64_t size;
    int fd = kd_job_frame(job, frame, &size);
    if (fd < 0)
        return not_ready(request, job, status);
    kd_job_release(job);
    kd_reply_file(request, KD_INLINE, "%06u.%s", frame, status->series->frame->name);
    struct MHD_Response *response = MHD_create_response_from_fd64(size, fd);
    if (!response) {
        close(fd);
        return kd_reply_no_memory(request);
    }
    MHD_add_response_header(response, "Content-Type", status->series->frame->media_type);
    request->reply_bytes = size;
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result bad(struct kd_request *request, struct kd_job *job, const char *detail)
{
    kd_job_release(job);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS, .detail = detail });
}

/* Answers with a job's preview; a viewer asks for it again and again. */
enum MHD_Result kd_handle_job_preview(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_job_status status;
    struct kd_job_sight sight;
    struct kd_buffer png = { 0 };
    char number[24], rows[32], detail[160];
    if (!kd_reply_only(request, (const char *const[]) { NULL }, &refused))
        return refused;
    struct kd_job *job = kd_job_of(request, &refused);
    if (!job)
        return refused;
    kd_job_status(job, &status);
    if (!(status.series->frame->carries & KD_CARRIES_PICTURE)) {
        snprintf(detail, sizeof detail, "the frames of this job are %s: there is nothing to look at", status.series->each);
        return bad(request, job, detail);
    }
    if (!kd_job_glimpse(job, &png, &sight))
        return not_ready(request, job, &status);
    if (sight.finished)
        return send_frame(request, job, sight.frame, &status);
    kd_job_release(job);
    snprintf(number, sizeof number, "%u", sight.frame);
    snprintf(rows, sizeof rows, "%u/%u", sight.rows, sight.height);
    struct MHD_Response *response = kd_reply_take(&png, PREVIEW_TYPE);
    if (response) {
        MHD_add_response_header(response, "Kerrd-Frame", number);
        MHD_add_response_header(response, "Kerrd-Rows", rows);
    }
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static bool read_row(struct kd_job *job, unsigned frame, void *out, size_t row)
{
    uint64_t size;
    int fd = kd_job_frame(job, frame, &size);
    bool whole = fd >= 0 && size == row && read(fd, out, row) == (ssize_t)row;
    if (fd >= 0)
        close(fd);
    return whole;
}

/* Answers of a job that is done. */
static enum MHD_Result send_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const struct kd_table_format *table)
{
    const size_t row = status->series->row_bytes;
    char *rows = malloc(status->frames * row);
    struct kd_buffer text = { 0 };
    bool there = rows;
    for (unsigned i = 0; i < status->frames && there; i++)
        there = read_row(job, i, rows + i * row, row);
    kd_job_release(job);
    enum kd_status made = !rows ? KD_ENOMEM : there ? table->write(rows, status->frames, &text) : KD_EIO;
    free(rows);
    if (table->file)
        kd_reply_file(request, KD_ATTACHMENT, "%s", table->file);
    return kd_reply_json(request, made, &text, table->media_type);
}

static const char *type_of(size_t i, const void *tables) { return ((const struct kd_table_format *)tables)[i].media_type; }

/* What Accept would rather have, the first if it does not care; NULL: none. */
static const struct kd_table_format *accepted(struct kd_request *request, const struct kd_series *series)
{
    size_t best = kd_reply_accepted(request, series->n_tables, type_of, series->tables);
    return best < series->n_tables ? &series->tables[best] : NULL;
}

/* "application/json, text/csv", or "json or csv" */
static const char *list_tables(const struct kd_series *series, bool types, char *out, size_t size)
{
    for (size_t i = 0, n = 0; i < series->n_tables && n < size; i++)
        n += (size_t)snprintf(out + n, size - n, "%s%s", !i ? "" : types ? ", " : " or ",
                              types ? series->tables[i].media_type : series->tables[i].name);
    return out;
}

static enum MHD_Result not_acceptable(struct kd_request *request, struct kd_job *job, const struct kd_series *series)
{
    char offered[160], detail[240];
    kd_job_release(job);
    list_tables(series, true, offered, sizeof offered);
    snprintf(detail, sizeof detail, "%ss are offered as %s", series->noun, offered);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE, .offered = offered, .detail = detail });
}

/* The table of a job whose frames are rows. */
static enum MHD_Result table_of(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status, const char *format)
{
    const struct kd_series *series = status->series;
    const struct kd_table_format *table = format ? kd_series_table(series, format) : accepted(request, series);
    char names[80], detail[240];
    if (!format && !table)
        return not_acceptable(request, job, series);
    if (!table) {
        snprintf(detail, sizeof detail, "format is %s: the frames of this job are %s", list_tables(series, false, names, sizeof names),
                 series->each);
        return bad(request, job, detail);
    }
    if (kd_target_value(&request->target, "frame")) {
        snprintf(detail, sizeof detail, "frame goes with pictures; a %s comes whole", series->noun);
        return bad(request, job, detail);
    }
    return status->state == KD_JOB_DONE ? send_table(request, job, status, table) : not_ready(request, job, status);
}

/* The frames of a job that are files: one of them, or all in something that holds them. */
static enum MHD_Result files_of(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status, const char *format)
{
    const char *one = status->series->frame->name;
    uint64_t frame;
    char detail[160];
    if (!format)
        format = status->frames > 1 ? kd_job_as_zip.name : one;
    if (!kd_target_whole(&request->target, "frame", 0, status->frames ? status->frames - 1 : 0, &frame))
        return bad(request, job, "frame is the number of a frame of this job, from 0 on");
    if (!strcmp(format, one))
        return send_frame(request, job, (unsigned)frame, status);
    if (!strcmp(format, kd_job_as_stream.name))
        return send_frames(request, job, status, &kd_job_as_stream, (unsigned)frame);
    if (strcmp(format, kd_job_as_zip.name) || kd_target_value(&request->target, "frame")) {
        snprintf(detail, sizeof detail, "format is %s or %s, both with frame=NUMBER if wanted, or %s", one, kd_job_as_stream.name,
                 kd_job_as_zip.name);
        return bad(request, job, detail);
    }
    return status->state == KD_JOB_DONE ? send_frames(request, job, status, &kd_job_as_zip, 0) : not_ready(request, job, status);
}

enum MHD_Result kd_handle_job_result(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_job_status status;
    if (!kd_reply_only(request, (const char *const[]) { "format", "frame", NULL }, &refused))
        return refused;
    struct kd_job *job = kd_job_of(request, &refused);
    if (!job)
        return refused;
    kd_job_status(job, &status);
    const char *format = kd_target_value(&request->target, "format");
    return (status.series->row_bytes ? table_of : files_of)(request, job, &status, format);
}

/* GET /v1/jobs/{id}/result: a frame as PNG, all of them as ZIP, or as they come; a light curve as JSON or CSV. */
#include "render/output/curve.h"
#include "server/job/routes.h"
#include "server/http/negotiate.h"
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

#define PNG_TYPE "image/png"
#define STREAM_TYPE "application/x-kerrd-frames"
#define JSON_TYPE "application/json"
#define CSV_TYPE "text/csv"
#define CURVE_OFFERED JSON_TYPE ", " CSV_TYPE
#define PART_BYTES 65536

/* A stream of the frames from watcher.next on. */
struct frames {
    struct kd_job_watcher watcher; /* first */
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
    snprintf(name, sizeof name, "%06u.png", f->watcher.next);
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
static enum MHD_Result send_frames(struct kd_request *request, struct kd_job *job, bool zip, unsigned from)
{
    const char *type = zip ? "application/zip" : STREAM_TYPE;
    if (zip)
        kd_reply_file(request, KD_ATTACHMENT, "kerrd-%s.zip", kd_job_id(job));
    struct frames *f = request->head ? NULL : calloc(1, sizeof *f);
    if (!f) {
        kd_job_release(job);
        return request->head ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(type))
                             : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    f->fd = -1;
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

static enum MHD_Result send_png(struct kd_request *request, struct kd_job *job, unsigned frame, const struct kd_job_status *status)
{
    uint64_t size;
    int fd = kd_job_frame(job, frame, &size);
    if (fd < 0)
        return not_ready(request, job, status);
    kd_job_release(job);
    kd_reply_file(request, KD_INLINE, "%06u.png", frame);
    struct MHD_Response *response = MHD_create_response_from_fd64(size, fd);
    if (!response) {
        close(fd);
        return kd_reply_no_memory(request);
    }
    MHD_add_response_header(response, "Content-Type", PNG_TYPE);
    request->reply_bytes = size;
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result bad(struct kd_request *request, struct kd_job *job, const char *detail)
{
    kd_job_release(job);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS, .detail = detail });
}

/* As a viewer asks again and again. */
enum MHD_Result kd_handle_job_preview(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_job_status status;
    struct kd_job_sight sight;
    struct kd_buffer png = { 0 };
    char number[24], rows[32];
    if (!kd_reply_only(request, (const char *const[]) { NULL }, &refused))
        return refused;
    struct kd_job *job = kd_job_of(request, &refused);
    if (!job)
        return refused;
    kd_job_status(job, &status);
    if (status.curve)
        return bad(request, job, "the frames of this job are the rows of a light curve: there is nothing to look at");
    if (!kd_job_glimpse(job, &png, &sight))
        return not_ready(request, job, &status);
    if (sight.finished)
        return send_png(request, job, sight.frame, &status);
    kd_job_release(job);
    snprintf(number, sizeof number, "%u", sight.frame);
    snprintf(rows, sizeof rows, "%u/%u", sight.rows, sight.height);
    struct MHD_Response *response = kd_reply_take(&png, PNG_TYPE);
    if (response) {
        MHD_add_response_header(response, "Kerrd-Frame", number);
        MHD_add_response_header(response, "Kerrd-Rows", rows);
    }
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static bool read_row(struct kd_job *job, unsigned frame, struct kd_curve_row *out)
{
    uint64_t size;
    int fd = kd_job_frame(job, frame, &size);
    bool whole = fd >= 0 && size == sizeof *out && read(fd, out, sizeof *out) == (ssize_t)sizeof *out;
    if (fd >= 0)
        close(fd);
    return whole;
}

/* Of a job that is done. */
static enum MHD_Result send_curve(struct kd_request *request, struct kd_job *job, unsigned n, bool csv)
{
    struct kd_curve_row *rows = malloc(n * sizeof *rows);
    struct kd_buffer text = { 0 };
    bool there = rows;
    for (unsigned i = 0; i < n && there; i++)
        there = read_row(job, i, &rows[i]);
    kd_job_release(job);
    enum kd_status status = !rows ? KD_ENOMEM : there ? kd_curve_text(rows, n, csv, &text) : KD_EIO;
    free(rows);
    if (csv)
        kd_reply_file(request, KD_ATTACHMENT, "light-curve.csv");
    return kd_reply_json(request, status, &text, csv ? CSV_TYPE : JSON_TYPE);
}

/* What Accept would rather have, JSON if it does not care; NULL: neither. */
static const char *curve_format(struct kd_request *request)
{
    struct kd_buffer accept = kd_reply_header_list(request, "Accept");
    int json = kd_accept_weight((const char *)accept.data, JSON_TYPE), csv = kd_accept_weight((const char *)accept.data, CSV_TYPE);
    kd_buffer_finish(&accept);
    return csv > json ? "csv" : json ? "json" : NULL;
}

static enum MHD_Result curve(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status, const char *format)
{
    if (!format && !(format = curve_format(request))) {
        kd_job_release(job);
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                                                .offered = CURVE_OFFERED,
                                                                .detail = "light curves are offered as " CURVE_OFFERED });
    }
    bool csv = !strcmp(format, "csv");
    if (!csv && strcmp(format, "json"))
        return bad(request, job, "format is json or csv: the frames of this job are the rows of a light curve");
    if (kd_target_value(&request->target, "frame"))
        return bad(request, job, "frame goes with pictures; a light curve comes whole");
    return status->state == KD_JOB_DONE ? send_curve(request, job, status->frames, csv) : not_ready(request, job, status);
}

enum MHD_Result kd_handle_job_result(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_job_status status;
    uint64_t frame;
    if (!kd_reply_only(request, (const char *const[]) { "format", "frame", NULL }, &refused))
        return refused;
    struct kd_job *job = kd_job_of(request, &refused);
    if (!job)
        return refused;
    kd_job_status(job, &status);
    const char *format = kd_target_value(&request->target, "format");
    if (status.curve)
        return curve(request, job, &status, format);
    if (!format)
        format = status.frames > 1 ? "zip" : "png";
    if (!kd_target_whole(&request->target, "frame", 0, status.frames ? status.frames - 1 : 0, &frame))
        return bad(request, job, "frame is the number of a frame of this job, from 0 on");
    if (!strcmp(format, "png"))
        return send_png(request, job, (unsigned)frame, &status);
    if (!strcmp(format, "stream"))
        return send_frames(request, job, false, (unsigned)frame);
    if (strcmp(format, "zip") || kd_target_value(&request->target, "frame"))
        return bad(request, job, "format is png or stream, both with frame=NUMBER if wanted, or zip");
    return status.state == KD_JOB_DONE ? send_frames(request, job, true, 0) : not_ready(request, job, &status);
}

/* GET /v1/jobs/{id}/result: sends a frame as a file, or all frames as a stream. archive.c sends archives, and
 * job_table.c sends tables. */
#include "server/job/formats.h"
#include "server/job/routes.h"
#include "server/job/job_table.h"
#include "server/job/archive.h"
#include "server/http/reply.h"
#include "server/http/representation.h"
#include "server/job/jobs.h"
#include "server/render/task.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PART_BYTES 65536

/* A stream of frames, which starts at the frame watcher.next. Each frame is preceded by a header of 16 bytes. */
struct frames {
    struct kd_job_watcher watcher; /* must be first: callbacks cast its address to this struct */
    int fd;                        /* the file of the present frame; -1: none is open */
    uint64_t left;
    struct kd_buffer out; /* bytes that were generated; those before `at` are sent */
    size_t at;
    bool over;
};

static void put_le32(unsigned char *out, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        out[i] = (unsigned char)(value >> 8 * i & 255);
}

/* Writes the header of a frame. */
static bool head(struct frames *f)
{
    unsigned char numbers[16] = { 0 };
    put_le32(numbers, (uint32_t)f->left);
    put_le32(numbers + 4, f->watcher.next);
    return !kd_buffer_append(&f->out, numbers, sizeof numbers);
}

static bool body(struct frames *f)
{
    char part[PART_BYTES];
    ssize_t n = read(f->fd, part, sizeof part);
    if (n <= 0 || (uint64_t)n > f->left)
        return false; /* fails, because the size of the file has changed since the header was sent */
    f->left -= (uint64_t)n;
    if (!f->left) {
        close(f->fd);
        f->fd = -1;
        f->watcher.next++;
    }
    return !kd_buffer_append(&f->out, part, (size_t)n);
}

static bool open_next(struct frames *f)
{
    struct kd_job_file file;
    if (!kd_job_frame(f->watcher.job, f->watcher.next, &file))
        return false;
    f->fd = file.fd;
    f->left = file.size;
    return true;
}

/* Produces more bytes. Sets f->over at the end of the stream, and *wait if the answer must be suspended. Returns
 * false on failure. */
static bool advance(struct frames *f, bool *wait)
{
    if (f->fd >= 0)
        return body(f);
    switch (kd_job_await(&f->watcher)) {
    case KD_JOB_NEWS: return open_next(f) && f->left <= UINT32_MAX && head(f);
    case KD_JOB_LATER: *wait = true; return true;
    case KD_JOB_LATE: return true; /* cannot happen, because a stream has no deadline */
    case KD_JOB_OVER: break;
    }
    struct kd_job_status status;
    kd_job_status(f->watcher.job, &status);
    f->over = true;
    /* if frames are missing, this must look like a failure to the client, not like a normal end */
    return f->watcher.next >= status.frames;
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
    return kd_job_hand_over(&f->out, &f->at, to, size, f->over ? MHD_CONTENT_READER_END_OF_STREAM : 0);
}

static void release(void *cls)
{
    struct frames *f = cls;
    if (f->fd >= 0)
        close(f->fd);
    kd_buffer_finish(&f->out);
    kd_job_unwatch(&f->watcher);
    free(f);
}

/* Sends the stream of frames, and takes over the reference to the job. */
static enum MHD_Result send_frames(struct kd_request *request, struct kd_job *job, unsigned from)
{
    const char *type = kd_job_as_stream.media_type;
    struct frames *f = request->head ? NULL : calloc(1, sizeof *f);
    if (!f) {
        kd_job_release(job);
        return request->head
                   ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(type))
                   : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    f->fd = -1;
    f->watcher = (struct kd_job_watcher) {
        .job = job, .mhd = request->mhd, .by_frame = true, .next = from, .deadline_ms = INFINITY
    };
    kd_job_watch(&f->watcher);
    return kd_job_stream(request, type, produce, f, release);
}

enum MHD_Result kd_job_not_ready(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status)
{
    char detail[600];
    if (status->state == KD_JOB_FAILED)
        snprintf(detail, sizeof detail, "the job failed after %u of %u frames: %.400s", status->finished,
                 status->frames, status->error);
    else
        snprintf(detail, sizeof detail, "%u of %u frames are finished", status->finished, status->frames);
    kd_job_release(job);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_READY, .detail = detail });
}

static enum MHD_Result send_frame(struct kd_request *request, struct kd_job *job, unsigned frame,
                                  const struct kd_job_status *status)
{
    struct kd_job_file file;
    if (!kd_job_frame(job, frame, &file))
        return kd_job_not_ready(request, job, status);
    kd_job_release(job);
    kd_reply_file(request, KD_INLINE, "%06u.%s", frame, status->series->frame->name);
    snprintf(request->etag, sizeof request->etag, "\"%s\"", file.mark);
    return kd_reply_representation(request, &(struct kd_representation) { .type = status->series->frame->media_type,
                                                                          .etag = request->etag,
                                                                          .size = file.size,
                                                                          .fd = file.fd });
}

enum MHD_Result kd_job_bad(struct kd_request *request, struct kd_job *job, const char *detail)
{
    kd_job_release(job);
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS, .detail = detail });
}

/* Sends the preview of a job. Clients poll this route. */
enum MHD_Result kd_handle_job_preview(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_job_status status;
    struct kd_job_sight sight;
    struct kd_buffer png = { 0 };
    char number[24], rows[32], detail[160];
    struct kd_job *job = kd_job_of(request, &refused);
    if (!job)
        return refused;
    kd_job_status(job, &status);
    if (!(status.series->frame->carries & KD_CARRIES_PICTURE)) {
        snprintf(detail, sizeof detail, "the frames of this job are %s and have no picture", status.series->each);
        return kd_job_bad(request, job, detail);
    }
    if (!kd_job_glimpse(job, &png, &sight))
        return kd_job_not_ready(request, job, &status);
    if (sight.finished)
        return send_frame(request, job, sight.frame, &status);
    kd_job_release(job);
    snprintf(number, sizeof number, "%u", sight.frame);
    snprintf(rows, sizeof rows, "%u/%u", sight.rows, sight.height);
    struct MHD_Response *response = kd_reply_take(&png, KD_PNG_TYPE);
    if (response) {
        MHD_add_response_header(response, "Kerrd-Frame", number);
        MHD_add_response_header(response, "Kerrd-Rows", rows);
    }
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static const struct kd_gather_format *whole_named(const struct kd_series *series, const char *name)
{
    for (size_t i = 0; series->wholes[i]; i++)
        if (!strcmp(series->wholes[i]->name, name))
            return series->wholes[i];
    return NULL;
}

/* Refuses the format with a message such as "format must be fits, npz or zip for all frames; or fits or stream,
 * optionally with frame=NUMBER". */
static enum MHD_Result unknown_format(struct kd_request *request, struct kd_job *job, const struct kd_series *series)
{
    char detail[200] = "format must be ";
    for (size_t i = 0; series->wholes[i]; i++)
        snprintf(detail + strlen(detail), sizeof detail - strlen(detail), "%s%s",
                 !i                      ? ""
                 : series->wholes[i + 1] ? ", "
                                         : " or ",
                 series->wholes[i]->name);
    snprintf(detail + strlen(detail), sizeof detail - strlen(detail),
             " for all frames; or %s or %s, optionally with frame=NUMBER", series->frame->name, kd_job_as_stream.name);
    return kd_job_bad(request, job, detail);
}

/* Sends one frame, a stream of frames, or all frames in an archive. */
static enum MHD_Result files_of(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                const char *format)
{
    const struct kd_series *series = status->series;
    const bool one_of_them = kd_target_value(&request->target, "frame");
    uint64_t frame, rate;
    if (!format)
        format = status->frames > 1 || status->sweep ? series->wholes[0]->name : series->frame->name;
    const struct kd_gather_format *whole = one_of_them ? NULL : whole_named(series, format);
    if (!kd_target_whole(&request->target, "frame", 0, status->frames ? status->frames - 1 : 0, &frame))
        return kd_job_bad(request, job, "frame must be the number of a frame of this job, counted from 0");
    if (!kd_target_whole(&request->target, "rate", KD_FILM_RATE, KD_FILM_RATE_MAX, &rate) || !rate ||
        (kd_target_value(&request->target, "rate") && !(whole && whole->waits)))
        return kd_job_bad(request, job,
                          "rate must be a whole number of frames a second from 1 to 120, with format=mp4 or webm");
    if (whole && status->state != KD_JOB_DONE)
        return kd_job_not_ready(request, job, status);
    if (whole)
        return kd_job_send_whole(request, job, status, whole, (unsigned)rate);
    if (!strcmp(format, series->frame->name))
        return send_frame(request, job, (unsigned)frame, status);
    return strcmp(format, kd_job_as_stream.name) ? unknown_format(request, job, series)
                                                 : send_frames(request, job, (unsigned)frame);
}

enum MHD_Result kd_handle_job_result(struct kd_request *request)
{
    enum MHD_Result refused;
    struct kd_job_status status;
    if (request->task)
        return request->task->kind->answer(request);
    struct kd_job *job = kd_job_of(request, &refused);
    if (!job)
        return refused;
    kd_job_status(job, &status);
    const char *format = kd_target_value(&request->target, "format");
    return (status.series->row_bytes ? kd_job_send_table : files_of)(request, job, &status, format);
}

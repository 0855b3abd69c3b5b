#include "server/job/job_table.h"

#include "base/clock.h"
#include "server/http/reply.h"
#include "server/job/routes.h"
#include "server/render/task.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

struct table {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_job *job;  /* a counted reference */
    struct kd_job_status status;
    const struct kd_table_format *format;
    char *rows;
    unsigned there; /* number of rows that were read so far */
    struct kd_buffer text;
};

static void finish(struct kd_task *task)
{
    struct table *t = (struct table *)task;
    kd_job_release(t->job);
    kd_buffer_finish(&t->text);
    free(t->rows);
}

static bool read_row(struct kd_job *job, unsigned frame, void *out, size_t row)
{
    struct kd_job_file file;
    if (!kd_job_frame(job, frame, &file))
        return false;
    const bool whole = file.size == row && read(file.fd, out, row) == (ssize_t)row;
    close(file.fd);
    return whole;
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    struct table *t = (struct table *)task;
    const size_t row = t->status.series->row_bytes;
    struct kd_error error = { 0 };
    enum kd_status status = KD_OK;
    while (t->there < t->status.frames) {
        if (!read_row(t->job, t->there, t->rows + t->there * row, row))
            KD_TRY(kd_error_set(&error, KD_EIO, "the file of frame %u cannot be read", t->there));
        t->there++;
        if (kd_clock_ms() > until_ms)
            return KD_SLICE_MORE;
    }
    if (t->format->write(t->rows, t->status.frames, t->status.sweep, &t->text))
        KD_TRY(kd_error_set(&error, KD_ENOMEM, "out of memory for a table of %u rows", t->status.frames));
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

static enum MHD_Result answer(struct kd_request *request)
{
    struct table *t = (struct table *)request->task;
    struct kd_job_status status;
    if (t->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    kd_job_status(t->job, &status);
    if (t->task.status && status.deleted)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = "the job has been deleted" });
    if (t->task.status)
        return kd_reply_error(request, &t->task.error);
    if (t->format->file)
        kd_reply_file(request, KD_ATTACHMENT, "%s", t->format->file);
    return kd_reply_json(request, KD_OK, &t->text, t->format->media_type);
}

/* Starts the task for a finished job, and takes over the reference to the job. */
static enum MHD_Result write_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                   const struct kd_table_format *format)
{
    static const struct kd_task_kind kind = { "tables", sizeof(struct table), work, finish, .answer = answer };
    enum MHD_Result refused;
    struct table *t = kd_task_begin(request, request->server->scheduler, &kind, &refused);
    if (!t) {
        kd_job_release(job);
        return refused;
    }
    t->job = job;
    t->status = *status;
    t->format = format;
    if (!(t->rows = malloc(status->frames * status->series->row_bytes)))
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    return kd_task_submit(&t->task);
}

static const char *type_of(size_t i, const void *tables)
{
    return ((const struct kd_table_format *)tables)[i].media_type;
}

/* The format that the Accept header prefers; the first format if there is no preference; NULL if none is acceptable. */
static const struct kd_table_format *accepted(struct kd_request *request, const struct kd_series *series)
{
    size_t best = kd_reply_accepted(request, series->n_tables, type_of, series->tables);
    return best < series->n_tables ? &series->tables[best] : NULL;
}

/* Lists media types, as in "application/json, text/csv", or names, as in "json or csv". */
static const char *list_tables(const struct kd_series *series, bool types, char *out, size_t size)
{
    for (size_t i = 0, n = 0; i < series->n_tables && n < size; i++)
        n += (size_t)snprintf(out + n, size - n, "%s%s",
                              !i      ? ""
                              : types ? ", "
                                      : " or ",
                              types ? series->tables[i].media_type : series->tables[i].name);
    return out;
}

static enum MHD_Result not_acceptable(struct kd_request *request, struct kd_job *job, const struct kd_series *series)
{
    char offered[160], detail[240];
    kd_job_release(job);
    list_tables(series, true, offered, sizeof offered);
    snprintf(detail, sizeof detail, "%ss are available as %s", series->noun, offered);
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE, .offered = offered, .detail = detail });
}

enum MHD_Result kd_job_send_table(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const char *format)
{
    const struct kd_series *series = status->series;
    const struct kd_table_format *table = format ? kd_series_table(series, format) : accepted(request, series);
    char names[80], detail[240];
    if (!format && !table)
        return not_acceptable(request, job, series);
    if (!table) {
        snprintf(detail, sizeof detail, "format must be %s, because the frames of this job are %s",
                 list_tables(series, false, names, sizeof names), series->each);
        return kd_job_bad(request, job, detail);
    }
    if (kd_target_value(&request->target, "frame")) {
        snprintf(detail, sizeof detail, "frame cannot be used with a %s; it belongs to pictures", series->noun);
        return kd_job_bad(request, job, detail);
    }
    return status->state == KD_JOB_DONE ? write_table(request, job, status, table)
                                        : kd_job_not_ready(request, job, status);
}

#include "server/job/archive.h"

#include "base/clock.h"
#include "base/log.h"
#include "server/http/reply.h"
#include "server/http/representation.h"
#include "server/job/films.h"
#include "server/job/routes.h"
#include "server/render/task.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Maximum number of cubes and films that are made at the same time: CUBES for all clients together, CUBES_OF_ONE for
 * one client. Before it is sent, workers prepare a large part of each in memory, which counts towards the budget of
 * answers. A cube needs some 400 bytes per scene. */
enum { CUBES = 8, CUBES_OF_ONE = 3 };

struct kd_job_whole {
    struct kd_job *job; /* a counted reference */
    struct kd_server *server;
    char client[KD_CLIENT];
    struct kd_job_whole *next; /* next cube in the server's list of cubes that are being downloaded */
    size_t held;               /* bytes that this archive has reserved in the budget of answers */
    struct kd_gather_source source;
    struct kd_gather gather;
    struct kd_buffer out; /* bytes that were generated; those before `at` are sent */
    size_t at;
    uint64_t given; /* number of bytes that were sent, or skipped because the client requested a later position */
    bool over;
    int fd; /* the file that was read last; -1: none */
    unsigned frame;
    uint64_t size;
};

static void enter(struct kd_job_whole *w, size_t held)
{
    w->held = held;
    w->next = w->server->cubes;
    w->server->cubes = w;
}

static void leave(const struct kd_job_whole *w)
{
    struct kd_job_whole **link = &w->server->cubes;
    while (*link && *link != w)
        link = &(*link)->next;
    if (!*link)
        return;
    *link = w->next;
    kd_bytes_give(w->server->replies, w->client, w->held);
}

/* True if the client may start another cube, whose bytes are then reserved. */
static bool admit(struct kd_request *request, size_t held, enum MHD_Result *refused)
{
    unsigned all = 0, own = 0;
    for (const struct kd_job_whole *w = request->server->cubes; w; w = w->next) {
        all++;
        own += !strcmp(w->client, request->client);
    }
    bool quota = own >= CUBES_OF_ONE;
    if (all < CUBES && !quota && !kd_bytes_take(request->server->replies, request->client, held, held, &quota))
        return true;
    const struct kd_problem problem = {
        .type = quota ? KD_PROBLEM_QUOTA : KD_PROBLEM_QUEUE_FULL,
        .retry_after = 2,
        .detail = quota ? "you are downloading too many cubes and films at once (limit for one client)"
                        : "too many cubes and films are being downloaded"
    };
    *refused = kd_reply_problem(request, &problem);
    return false;
}

static bool open_frame(struct kd_job_whole *w, unsigned frame)
{
    if (w->fd >= 0 && w->frame == frame)
        return true;
    if (w->fd >= 0)
        close(w->fd);
    w->frame = frame;
    struct kd_job_file file;
    const bool there = kd_job_frame(w->job, frame, &file);
    w->fd = there ? file.fd : -1;
    w->size = there ? file.size : 0;
    return there;
}

static bool size_of(void *user, unsigned frame, uint64_t *out)
{
    struct kd_job_whole *w = user;
    bool there = open_frame(w, frame);
    *out = there ? w->size : 0;
    return there;
}

static bool read_frame(void *user, unsigned frame, uint64_t at, void *to, size_t size)
{
    struct kd_job_whole *w = user;
    char *out = to;
    ssize_t n = 1;
    if (!open_frame(w, frame))
        return false;
    for (; size && n > 0; size -= (size_t)n, at += (uint64_t)n, out += n)
        n = pread(w->fd, out, size, (off_t)at);
    return n > 0;
}

static void release(void *cls)
{
    struct kd_job_whole *w = cls;
    leave(w);
    kd_gather_close(&w->gather);
    if (w->fd >= 0)
        close(w->fd);
    kd_buffer_finish(&w->out);
    kd_job_release(w->job);
    free(w);
}

/* Generates more bytes in w->out. Call this only when all earlier bytes of w->out are sent. */
static bool go_on(struct kd_job_whole *w)
{
    struct kd_error error = { 0 };
    w->out.size = w->at = 0;
    if (w->over || !kd_gather_next(&w->gather, &w->out, &w->over, &error))
        return true;
    kd_log(KD_LOG_ERROR, "job %.4s...: %s", kd_job_id(w->job), error.message);
    return false;
}

/* Callback for libmicrohttpd. Returns 0 if no bytes are available yet; the library then calls it again after serving
 * other connections. */
static ssize_t produce(void *cls, uint64_t position, char *to, size_t size)
{
    struct kd_job_whole *w = cls;
    (void)position;
    if (w->at == w->out.size && !go_on(w))
        return MHD_CONTENT_READER_END_WITH_ERROR;
    return kd_job_hand_over(&w->out, &w->at, to, size, w->over ? MHD_CONTENT_READER_END_OF_STREAM : 0);
}

/* Like produce, for an answer that begins at a later position. The bytes before that position are generated too and
 * then skipped, because the directory of a ZIP file contains the checksums of all files. */
static ssize_t produce_from(void *cls, uint64_t position, char *to, size_t size)
{
    struct kd_job_whole *w = cls;
    if (w->at == w->out.size && (w->over || !go_on(w)))
        return MHD_CONTENT_READER_END_WITH_ERROR;
    const uint64_t left = w->out.size - w->at, before = position - w->given;
    const size_t dropped = (size_t)(before < left ? before : left);
    w->at += dropped;
    const ssize_t n = kd_job_hand_over(&w->out, &w->at, to, size, 0);
    w->given += dropped + (uint64_t)n;
    return n;
}

/* Task that makes the preparations before the first byte of an archive. */
struct looked {
    struct kd_task task;        /* must be first: callbacks cast its address to this struct */
    struct kd_job_whole *whole; /* NULL after the answer has taken it over */
    const struct kd_gather_format *format;
    uint64_t length; /* length of the archive in bytes, if it is known in advance */
    struct kd_job_film_writer writer;
    struct kd_job_file film; /* the film's file; fd is -1 until it is opened */
};

static void finish(struct kd_task *task)
{
    struct looked *l = (struct looked *)task;
    if (l->whole)
        release(l->whole);
    if (l->film.fd >= 0)
        close(l->film.fd);
}

#define LATER_MS 10.0  /* time in ms between two polls while ffmpeg runs */
#define OTHERS_MS 50.0 /* time in ms between two polls while another request encodes the film */

static enum kd_slice_result park(struct kd_task *task, double ms)
{
    task->scheduled.due_ms = kd_clock_ms() + ms;
    return KD_SLICE_PARK;
}

/* Reads files of the cube until its first bytes can be generated. */
static enum kd_slice_result look(struct kd_task *task, double until_ms)
{
    struct kd_job_whole *w = ((struct looked *)task)->whole;
    struct kd_error error = { 0 };
    enum kd_status status;
    do {
        KD_TRY(kd_gather_next(&w->gather, &w->out, &w->over, &error));
        if (w->out.size || w->over)
            return KD_SLICE_LAST;
    } while (kd_clock_ms() < until_ms);
    return KD_SLICE_MORE;
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

/* Computes the length of an archive from the sizes of the frames, without reading the frames. */
static enum kd_slice_result count(struct kd_task *task, double until_ms)
{
    struct looked *l = (struct looked *)task;
    struct kd_job_whole *w = l->whole;
    struct kd_error error = { 0 };
    enum kd_status status;
    if (!w->gather.state) {
        w->source.counted = &l->length;
        KD_TRY(kd_gather_open(l->format, &w->source, &w->gather, &error));
    }
    while (!w->over && kd_clock_ms() < until_ms) {
        w->out.size = 0;
        KD_TRY(kd_gather_next(&w->gather, &w->out, &w->over, &error));
        l->length += w->out.size;
    }
    if (!w->over)
        return KD_SLICE_MORE;
    w->out.size = 0;
    w->over = false;
    w->source.counted = NULL;
    kd_gather_close(&w->gather);
    KD_TRY(kd_gather_open(l->format, &w->source, &w->gather, &error));
    return KD_SLICE_LAST;
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

static bool open_film(struct looked *l)
{
    return kd_job_film_open(l->whole->job, l->format->name, l->whole->source.rate, &l->film);
}

/* If the film is cached, opens it. Otherwise encodes it, or waits for the request that is encoding it. */
static enum kd_slice_result encode(struct kd_task *task, double until_ms)
{
    struct looked *l = (struct looked *)task;
    struct kd_job_whole *w = l->whole;
    struct kd_error error = { 0 };
    enum kd_status status;
    if (atomic_load(&w->server->phase) >= KD_REFUSING)
        KD_TRY(kd_error_set(&error, KD_ECANCELLED, "the server is stopping; request the film again when it is back"));
    if (!l->writer.claimed && open_film(l))
        return KD_SLICE_LAST;
    if (!l->writer.claimed && !kd_job_film_claim(&l->writer, w->job, l->format->name, w->source.rate))
        return park(task, OTHERS_MS);
    while (!w->over && kd_clock_ms() < until_ms) {
        w->out.size = 0;
        KD_TRY(kd_gather_next(&w->gather, &w->out, &w->over, &error));
        if (!w->out.size && !w->over)
            return park(task, LATER_MS);
        KD_TRY(kd_job_film_append(&l->writer, w->out.data, w->out.size, &error));
    }
    if (!w->over)
        return KD_SLICE_MORE;
    KD_TRY(kd_job_film_keep(&l->writer, &error));
    if (!open_film(l))
        KD_TRY(kd_error_set(&error, KD_EIO, "the film cannot be read"));
    return KD_SLICE_LAST;
done:
    kd_task_fail(task, status, &error);
    return KD_SLICE_LAST;
}

/* Runs on a worker, because ending the film may wait for the disk. */
static void end_film(struct kd_task *task)
{
    struct looked *l = (struct looked *)task;
    if (l->writer.job)
        kd_job_film_end(&l->writer);
}

static void name_it(struct kd_request *request, const struct kd_job *job, const struct kd_gather_format *format)
{
    kd_reply_file(request, KD_ATTACHMENT, "kerrd-%s.%s", kd_job_id(job), format->name);
}

static enum MHD_Result stream(struct kd_request *request, struct kd_job_whole *w, const struct kd_gather_format *format)
{
    name_it(request, w->job, format);
    return kd_job_stream(request, format->media_type, produce, w, release);
}

/* Sends an archive. Its ETag contains the version and the time at which the job ended. The same frames give the same
 * archive; if frames are rendered again, the job ends at another time. */
static enum MHD_Result send_archive(struct kd_request *request, struct looked *l, const struct kd_job_status *status)
{
    struct kd_job_whole *w = l->whole;
    l->whole = NULL;
    name_it(request, w->job, l->format);
    snprintf(request->etag, sizeof request->etag, "\"%s-%.0f-%" PRIu64 "-%s\"", kd_job_id(w->job), 1e3 * status->ended,
             l->length, KD_VERSION);
    return kd_reply_representation(request, &(struct kd_representation) { .type = l->format->media_type,
                                                                          .etag = request->etag,
                                                                          .size = l->length,
                                                                          .fd = -1,
                                                                          .read = produce_from,
                                                                          .release = release,
                                                                          .cls = w });
}

/* Sends a film, and takes over its file. */
static enum MHD_Result send_film(struct kd_request *request, const struct kd_job *job,
                                 const struct kd_gather_format *format, const struct kd_job_file *file)
{
    name_it(request, job, format);
    snprintf(request->etag, sizeof request->etag, "\"%s\"", file->mark);
    return kd_reply_representation(
        request,
        &(struct kd_representation) {
            .type = format->media_type, .etag = request->etag, .hashed = true, .size = file->size, .fd = file->fd });
}

static enum MHD_Result answer(struct kd_request *request)
{
    struct looked *l = (struct looked *)request->task;
    struct kd_job_whole *w = l->whole;
    struct kd_job_status status;
    if (l->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    kd_job_status(w->job, &status);
    if (l->task.status && status.deleted)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = "the job has been deleted" });
    if (l->task.status) {
        kd_log(KD_LOG_ERROR, "job %.4s...: %s", kd_job_id(w->job), l->task.error.message);
        return kd_reply_error(request, &l->task.error);
    }
    if (l->format->counts)
        return send_archive(request, l, &status);
    if (l->format->waits) {
        const struct kd_job_file film = l->film;
        l->film.fd = -1;
        return send_film(request, w->job, l->format, &film);
    }
    l->whole = NULL;
    return stream(request, w, l->format);
}

/* Starts the task that prepares an archive, and takes over *w. */
static enum MHD_Result look_through(struct kd_request *request, struct kd_job_whole *w,
                                    const struct kd_gather_format *format)
{
    static const struct kd_task_kind cubes = { "cubes", sizeof(struct looked), look, finish, .answer = answer },
                                     archives = { "archives", sizeof(struct looked), count, finish, .answer = answer },
                                     films = { "films", sizeof(struct looked), encode, finish, end_film, answer };
    enum MHD_Result refused;
    const struct kd_task_kind *kind = format->counts ? &archives : format->waits ? &films : &cubes;
    struct looked *l = kd_task_begin(request, request->server->scheduler, kind, &refused);
    if (!l) {
        release(w);
        return refused;
    }
    l->whole = w;
    l->format = format;
    l->film.fd = -1;
    return kd_task_submit(&l->task);
}

enum MHD_Result kd_job_send_whole(struct kd_request *request, struct kd_job *job, const struct kd_job_status *status,
                                  const struct kd_gather_format *format, unsigned rate)
{
    struct kd_error error = { 0 };
    enum MHD_Result refused;
    struct kd_gather_source source = { .sweep = status->sweep,
                                       .frame = status->series->frame,
                                       .n = status->frames,
                                       .rate = rate,
                                       .size = size_of,
                                       .read = read_frame };
    /* For HEAD, workers compute the length if the format permits it (`counts`). Otherwise the length is left out. */
    const bool head = request->head && !format->counts;
    struct kd_job_file film;
    if (format->waits && kd_job_film_open(job, format->name, rate, &film)) {
        const enum MHD_Result result = send_film(request, job, format, &film);
        kd_job_release(job);
        return result;
    }
    const size_t held = format->holds && !head ? format->holds(&source) : 0;
    if (held && !admit(request, held, &refused)) {
        kd_job_release(job);
        return refused;
    }
    struct kd_job_whole *w = head ? NULL : calloc(1, sizeof *w);
    if (!w) {
        if (held)
            kd_bytes_give(request->server->replies, request->client, held);
        name_it(request, job, format);
        kd_job_release(job);
        return head
                   ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(format->media_type))
                   : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    source.user = w;
    *w = (struct kd_job_whole) { .job = job, .server = request->server, .fd = -1, .source = source };
    memcpy(w->client, request->client, sizeof w->client);
    if (held)
        enter(w, held);
    if (format->counts || !kd_gather_open(format, &w->source, &w->gather, &error))
        return format->holds || format->counts ? look_through(request, w, format) : stream(request, w, format);
    release(w);
    return kd_reply_error(request, &error);
}

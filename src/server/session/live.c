/* Sends the frames of a session, one per request or as a stream. */
#include "base/clock.h"
#include "server/http/negotiate.h"
#include "server/http/query.h"
#include "server/http/reply.h"
#include "server/session/sessions.h"

#include <math.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#define HEARTBEAT_MS 15000.0 /* interval in ms of the comments that serve as heartbeats in an event stream */
/* maximum number of unsent bytes in the kernel; with more, newer frames would be delayed */
#define UNSENT_BYTES (64 << 10)

static enum MHD_Result ended(struct kd_request *request)
{
    return kd_reply_problem(request,
                            &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND, .detail = "the session has ended" });
}

#define NO_SENTENCES UINT64_MAX

static void describe(struct MHD_Response *response, const struct kd_live_frame *frame, uint64_t known)
{
    char number[24];
    snprintf(number, sizeof number, "%llu", (unsigned long long)frame->number);
    MHD_add_response_header(response, "Kerrd-Frame", number);
    snprintf(number, sizeof number, "%u", frame->revision);
    MHD_add_response_header(response, "Kerrd-Revision", number);
    snprintf(number, sizeof number, "%.15g", frame->time);
    MHD_add_response_header(response, "Kerrd-Time", number);
    snprintf(number, sizeof number, "%.15g", frame->azimuth_deg);
    MHD_add_response_header(response, "Kerrd-Azimuth", number);
    MHD_add_response_header(response, "Kerrd-Accuracy", frame->accuracy);
    if (*frame->clock)
        MHD_add_response_header(response, "Kerrd-Clock", frame->clock);
    if (*frame->flux)
        MHD_add_response_header(response, "Kerrd-Flux", frame->flux);
    snprintf(number, sizeof number, "%u", frame->sentences);
    MHD_add_response_header(response, "Kerrd-Sentences", number);
    if (frame->approximations.size && known != frame->sentences)
        MHD_add_response_header(response, "Kerrd-Approximations", (const char *)frame->approximations.data);
}

/* Adds the headers that describe this encoding of the frame. */
static void describe_file(struct MHD_Response *response, const struct kd_live_frame *frame,
                          const struct kd_live_file *file)
{
    char text[sizeof frame->timing + 40];
    snprintf(text, sizeof text, file->lossy ? "%s final=%d lossy=%u" : "%s final=%d", frame->quality,
             frame->final && (!file->lossy || frame->last), file->lossy);
    MHD_add_response_header(response, "Kerrd-Quality", text);
    snprintf(text, sizeof text, "%s, encode;dur=%.3f", frame->timing, file->encode_ms);
    MHD_add_response_header(response, "Server-Timing", text);
    MHD_add_response_header(response, "Content-Type", file->format->media_type);
}

/* Adds the headers that describe the request: the revision that it has made, and the time for which it has waited in
 * the server. With this time the client can compute the delay of the network. */
static void tell_request(struct MHD_Response *response, const struct kd_viewer *viewer)
{
    char number[24];
    if (!response)
        return;
    snprintf(number, sizeof number, "%.1f", kd_clock_ms() - viewer->begun_ms);
    MHD_add_response_header(response, "Kerrd-Waited", number);
    snprintf(number, sizeof number, "%u", viewer->patched);
    if (viewer->patched)
        MHD_add_response_header(response, "Kerrd-Patched", number);
}

static void release_frame(void *cls) { kd_live_frame_release(cls); }

static enum MHD_Result send_frame(struct kd_request *request, const struct kd_viewer *viewer,
                                  struct kd_live_frame *frame)
{
    const struct kd_live_file *file = viewer->file;
    struct MHD_Response *response = MHD_create_response_from_buffer_with_free_callback_cls(
        file->bytes.size, file->bytes.data, release_frame, frame);
    if (!response) {
        kd_live_frame_release(frame);
        return kd_reply_no_memory(request);
    }
    describe(response, frame, viewer->sentences);
    describe_file(response, frame, file);
    tell_request(response, viewer);
    request->reply_bytes = file->bytes.size;
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

/* Sends the answer, or suspends the request again. */
static enum MHD_Result look(struct kd_request *request)
{
    struct kd_error error = { 0 };
    struct kd_live_frame *frame = NULL;
    enum kd_viewer_news what = kd_viewer_next(request->viewer, &frame, &error);
    if (what == KD_VIEWER_LATER)
        return MHD_YES;
    const struct kd_viewer viewer = *request->viewer;
    kd_live_abandon(request);
    struct MHD_Response *nothing;
    switch (what) {
    case KD_VIEWER_FRAME: return send_frame(request, &viewer, frame);
    case KD_VIEWER_OVER: return error.status ? kd_reply_error(request, &error) : ended(request);
    case KD_VIEWER_LATE:
        nothing = kd_reply_static("", 0, kd_format_live()->media_type);
        tell_request(nothing, &viewer);
        return kd_reply_send(request, MHD_HTTP_NO_CONTENT, nothing);
    default: return MHD_NO;
    }
}

static enum MHD_Result bad_number(struct kd_request *request, const char *detail)
{
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS, .detail = detail });
}

enum MHD_Result kd_live_newest(struct kd_request *request, kd_session_find_fn *find, bool kinds)
{
    uint64_t after, wait, lossy = 0, last = 0, sentences;
    enum MHD_Result refused;
    const bool patches = kinds && !strcmp(request->method, "PATCH");
    if (request->viewer)
        return look(request);
    if (kinds && kd_target_value(&request->target, "lossy") &&
        (!kd_target_whole(&request->target, "lossy", 0, KD_QUALITY_MAX, &lossy) || !lossy))
        return bad_number(request, "lossy must be a whole number from 1 to 100, the quality of frames before the last; "
                                   "without it those frames are exact");
    if (kinds && kd_target_value(&request->target, "last") &&
        (!kd_target_whole(&request->target, "last", 0, KD_QUALITY_MAX, &last) || !last))
        return bad_number(request, "last must be a whole number from 1 to 100, the quality of the last frame; without "
                                   "it that frame is exact");
    if (!kd_target_whole(&request->target, "sentences", NO_SENTENCES, KD_SENTENCES_MAX, &sentences))
        return bad_number(request, "sentences must be the Kerrd-Sentences of your last frame; a frame with the same "
                                   "approximations is sent without them");
    if (!kd_target_whole(&request->target, "after", 0, UINT64_MAX, &after))
        return bad_number(request, "after must be the number of a frame, the Kerrd-Frame of your last one");
    if (!kd_target_whole(&request->target, "wait_ms", KD_WAIT_MS, KD_WAIT_MS_MAX, &wait))
        return bad_number(request, "wait_ms must be a whole number of milliseconds, 0 to 60000");
    struct kd_session *session = find(request, &refused);
    if (!session)
        return refused;
    struct kd_session_state state = { 0 };
    if (patches && !kd_session_change(request, session, &state, &refused)) {
        kd_session_release(session);
        return refused;
    }
    struct kd_viewer *viewer = request->connection ? calloc(1, sizeof *viewer) : NULL;
    if (!viewer) {
        kd_session_release(session);
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    const double now = kd_clock_ms();
    *viewer = (struct kd_viewer) { .session = session,
                                   .mhd = request->mhd,
                                   .socket = kd_connection_socket(request->connection),
                                   .seen = after,
                                   .begun_ms = now,
                                   .deadline_ms = now + (double)wait,
                                   .late = !wait,
                                   .lossy = (unsigned)lossy,
                                   .last_lossy = (unsigned)last,
                                   .sentences = sentences,
                                   .patched = state.revision };
    request->viewer = viewer;
    kd_viewer_attach(viewer);
    return look(request);
}

void kd_live_abandon(struct kd_request *request)
{
    if (!request->viewer)
        return;
    kd_viewer_detach(request->viewer);
    free(request->viewer);
    request->viewer = NULL;
}

/* A stream of frames. For each frame it contains some bytes before the picture, the picture, and some bytes after
 * it. */
struct stream {
    struct kd_viewer viewer; /* must be first: callbacks cast its address to this struct */
    enum { MULTIPART, BINARY, EVENTS } form;
    struct kd_live_frame *frame; /* the frame that is being sent to the client */
    char before[64], next[96];
    struct part {
        const char *data;
        size_t size;
    } parts[3];
    size_t part, at;
};

static void set_part(struct stream *s, size_t i, const void *data, size_t size)
{
    s->parts[i] = (struct part) { data, size };
}

static void put_le32(char *out, uint32_t value)
{
    for (int i = 0; i < 4; i++)
        out[i] = (char)(value >> 8 * i & 255);
}

static void frame_parts(struct stream *s, struct kd_live_frame *frame)
{
    s->frame = frame;
    s->part = s->at = 0;
    memset(s->parts, 0, sizeof s->parts);
    switch (s->form) {
    case MULTIPART:
        set_part(s, 1, s->viewer.file->bytes.data, s->viewer.file->bytes.size);
        set_part(s, 2, s->next, strlen(s->next));
        return;
    case BINARY:
        put_le32(s->before, (uint32_t)s->viewer.file->bytes.size);
        put_le32(s->before + 4, (uint32_t)frame->number);
        put_le32(s->before + 8, frame->revision);
        put_le32(s->before + 12, 0);
        set_part(s, 0, s->before, 16);
        set_part(s, 1, s->viewer.file->bytes.data, s->viewer.file->bytes.size);
        return;
    case EVENTS:
        set_part(s, 0, s->before,
                 (size_t)snprintf(s->before, sizeof s->before,
                                  "event: frame\nid: %llu\ndata: ", (unsigned long long)frame->number));
        set_part(s, 1, frame->event.data, frame->event.size);
        set_part(s, 2, "\n\n", 2);
        return;
    }
}

/* Copies bytes of the present frame that are not sent yet. Returns 0 when all of the frame is sent. */
static size_t take(struct stream *s, char *to, size_t size)
{
    size_t n = 0;
    while (s->part < 3 && n < size) {
        struct part *p = &s->parts[s->part];
        size_t left = p->size - s->at, now = left < size - n ? left : size - n;
        if (now)
            memcpy(to + n, p->data + s->at, now);
        n += now;
        s->at += now;
        if (s->at == p->size) {
            s->part++;
            s->at = 0;
        }
    }
    return n;
}

static ssize_t produce(void *cls, uint64_t position, char *to, size_t size)
{
    struct stream *s = cls;
    (void)position;
    size_t n = take(s, to, size);
    if (n)
        return (ssize_t)n;
    kd_live_frame_release(s->frame);
    s->frame = NULL;
    struct kd_live_frame *frame;
    switch (kd_viewer_next(&s->viewer, &frame, NULL)) {
    case KD_VIEWER_FRAME: frame_parts(s, frame); return (ssize_t)take(s, to, size);
    case KD_VIEWER_OVER: return MHD_CONTENT_READER_END_OF_STREAM;
    case KD_VIEWER_GONE: return MHD_CONTENT_READER_END_WITH_ERROR;
    case KD_VIEWER_LATE: /* sends a heartbeat, which also detects clients that have vanished */
        s->viewer.deadline_ms = kd_clock_ms() + HEARTBEAT_MS;
        memcpy(to, ":\n\n", 3);
        return 3;
    case KD_VIEWER_LATER: break;
    }
    return 0;
}

static void release_stream(void *cls)
{
    struct stream *s = cls;
    kd_live_frame_release(s->frame);
    kd_viewer_detach(&s->viewer);
    free(s);
}

static enum MHD_Result start_stream(struct kd_request *request, struct stream *s, const char *type)
{
    int socket = kd_connection_socket(request->connection), unsent = UNSENT_BYTES;
    struct MHD_Response *response =
        MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 64 << 10, produce, s, release_stream);
    if (!response) {
        release_stream(s);
        return kd_reply_no_memory(request);
    }
    setsockopt(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof unsent);
    MHD_add_response_header(response, "Content-Type", type);
    MHD_add_response_header(response, "X-Accel-Buffering", "no"); /* tells proxies not to buffer the stream */
    enum MHD_Result result = kd_reply_send(request, MHD_HTTP_OK, response);
    /* A stream has no deadline. If a client stops reading, libmicrohttpd's timeout ends the connection. */
    kd_connections_stage(request->server->connections, request->connection, KD_STAGE_WORK, 0);
    return result;
}

/* The number in the header Last-Event-ID, which an EventSource sends when it reconnects. Returns 0 if this session
 * has no frame with that number. */
static uint64_t last_event(struct kd_request *request, struct kd_session *session)
{
    const char *id = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Last-Event-ID");
    struct kd_session_state state;
    uint64_t number = 0;
    if (!id || !kd_target_number(id, UINT64_MAX, &number))
        return 0;
    kd_session_state(session, &state);
    return number <= state.frame ? number : 0;
}

static enum MHD_Result open_stream(struct kd_request *request, kd_session_find_fn *find, int form, const char *type)
{
    enum MHD_Result refused;
    struct kd_session *session = find(request, &refused);
    if (!session)
        return refused;
    struct stream *s = request->connection ? calloc(1, sizeof *s) : NULL;
    if (!s || request->head) {
        kd_session_release(session);
        free(s);
        return request->head
                   ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(type))
                   : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    s->form = form;
    s->viewer = (struct kd_viewer) { .session = session,
                                     .mhd = request->mhd,
                                     .socket = kd_connection_socket(request->connection),
                                     .any = form == EVENTS,
                                     .seen = form == EVENTS ? last_event(request, session) : 0,
                                     .deadline_ms = form == EVENTS ? kd_clock_ms() + HEARTBEAT_MS : INFINITY };
    s->part = form == MULTIPART ? 0 : 3;
    /* Browsers show a part of a multipart answer only when the header of the next part arrives. Each frame is
     * therefore followed at once by the header of the next one, and the first header is sent before all frames. */
    snprintf(s->next, sizeof s->next, "\r\n--kerrd\r\nContent-Type: %s\r\n\r\n", kd_format_live()->media_type);
    if (form == MULTIPART)
        set_part(s, 0, s->next + 2, strlen(s->next + 2));
    kd_viewer_attach(&s->viewer);
    return start_stream(request, s, type);
}

enum MHD_Result kd_live_frames(struct kd_request *request, kd_session_find_fn *find)
{
    struct kd_buffer accept = kd_reply_header_list(request, "Accept");
    bool binary = accept.data && strstr((const char *)accept.data, KD_FRAMES_TYPE);
    kd_buffer_finish(&accept);
    return binary ? open_stream(request, find, BINARY, KD_FRAMES_TYPE)
                  : open_stream(request, find, MULTIPART, "multipart/x-mixed-replace; boundary=kerrd");
}

enum MHD_Result kd_handle_session_frame(struct kd_request *request)
{
    return kd_live_newest(request, kd_session_of, false);
}
enum MHD_Result kd_handle_session_picture(struct kd_request *request)
{
    return kd_live_newest(request, kd_session_of, true);
}
enum MHD_Result kd_handle_session_frames(struct kd_request *request) { return kd_live_frames(request, kd_session_of); }
enum MHD_Result kd_handle_session_events(struct kd_request *request)
{
    return open_stream(request, kd_session_of, EVENTS, KD_EVENTS_TYPE);
}

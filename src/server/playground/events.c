/* The event stream of a playground session. It contains each new tick, and each event once, with the event's number. */
#include "base/clock.h"
#include "base/json.h"
#include "server/http/reply.h"
#include "server/playground/routes.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>

#define HEARTBEAT_MS 15000.
/* limit of unsent bytes in the kernel, because bytes that wait there delay later ticks */
#define UNSENT_BYTES (64 << 10)

struct stream {
    struct kd_playground_session_watcher watcher; /* must be first: callbacks cast its address to this struct */
    struct kd_buffer text;                        /* text that is being sent */
    size_t at;                                    /* the bytes of the text before this position are already sent */
    bool over;
};

static size_t take(struct stream *s, char *to, size_t size)
{
    const size_t left = s->text.size - s->at, n = left < size ? left : size;
    if (n)
        memcpy(to, s->text.data + s->at, n);
    s->at += n;
    return n;
}

static enum kd_status add_tick(struct stream *s, struct kd_playground_session_tick *tick)
{
    enum kd_status status = kd_buffer_printf(&s->text, "event: tick\ndata: %.*s\n\n", (int)tick->event.size,
                                             (const char *)tick->event.data);
    kd_playground_session_tick_release(tick);
    return status;
}

/* Appends an event. If earlier events were lost, a note that says so precedes it. before: number of the event that
 * was sent last. */
static enum kd_status add_event(struct stream *s, uint64_t before, const struct kd_playground_event *event)
{
    const uint64_t now = s->watcher.event, lost = event->number ? now - 1 : now;
    enum kd_status status = KD_OK;
    if (lost > before)
        KD_TRY(kd_buffer_printf(&s->text, "event: lost\nid: %llu\ndata: {\"from\":%llu,\"to\":%llu}\n\n",
                                (unsigned long long)lost, (unsigned long long)before + 1, (unsigned long long)lost));
    if (!event->number)
        return status;
    KD_TRY(kd_buffer_printf(&s->text, "event: happened\nid: %llu\ndata: ", (unsigned long long)event->number));
    struct kd_json json = kd_json_begin(&s->text);
    kd_playground_event_json(event, &json, NULL);
    KD_TRY(kd_json_finish(&json));
    KD_TRY(kd_buffer_printf(&s->text, "\n\n"));
done:
    return status;
}

/* Writes the next part of the stream into s->text. Returns false if there is no such part yet, or if the stream has
 * ended; in the second case *end is set. */
static bool fetch(struct stream *s, ssize_t *end)
{
    struct kd_playground_session_tick *tick = NULL;
    struct kd_playground_event event;
    const char *why = "";
    const uint64_t before = s->watcher.event;
    enum kd_status status = KD_OK;
    s->text.size = s->at = 0;
    switch (kd_playground_session_await(&s->watcher, &tick, &event, &why)) {
    case KD_PLAY_TICK: status = add_tick(s, tick); break;
    case KD_PLAY_EVENT: status = add_event(s, before, &event); break;
    case KD_PLAY_OVER:
        s->over = true;
        status = kd_buffer_printf(&s->text, "event: end\ndata: {\"why\":\"%s\"}\n\n", why);
        break;
    case KD_PLAY_LATE: /* sends a heartbeat, which also detects clients that have vanished */
        s->watcher.deadline_ms = kd_clock_ms() + HEARTBEAT_MS;
        status = kd_buffer_printf(&s->text, ":\n\n");
        break;
    case KD_PLAY_GONE: status = KD_ECANCELLED; break;
    case KD_PLAY_LATER: return false;
    }
    if (status)
        *end = MHD_CONTENT_READER_END_WITH_ERROR;
    return !status;
}

static ssize_t produce(void *cls, uint64_t position, char *to, size_t size)
{
    struct stream *s = cls;
    ssize_t end = 0;
    (void)position;
    if (s->at < s->text.size)
        return (ssize_t)take(s, to, size);
    if (s->over)
        return MHD_CONTENT_READER_END_OF_STREAM;
    return fetch(s, &end) ? (ssize_t)take(s, to, size) : end;
}

static void release(void *cls)
{
    struct stream *s = cls;
    kd_buffer_finish(&s->text);
    kd_playground_session_unwatch(&s->watcher);
    free(s);
}

/* Reads from the request the number of the last event that the client has. Returns false if it is malformed. */
static bool begins_at(struct kd_request *request, uint64_t *number)
{
    const char *id = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Last-Event-ID");
    *number = 0;
    if (id && kd_target_number(id, UINT64_MAX, number))
        return true;
    return kd_target_whole(&request->target, "since", 0, UINT64_MAX, number);
}

enum MHD_Result kd_handle_play_events(struct kd_request *request)
{
    uint64_t since;
    enum MHD_Result refused;
    if (!begins_at(request, &since))
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS,
                                                                .detail = "since must be the number of an event" });
    struct kd_playground_session *play = kd_playground_session_of(request, &refused);
    if (!play)
        return refused;
    struct stream *s = request->connection && !request->head ? calloc(1, sizeof *s) : NULL;
    if (!s) {
        kd_playground_session_release(play);
        return request->head
                   ? kd_reply_send(request, MHD_HTTP_OK, kd_reply_empty(KD_EVENTS_TYPE))
                   : kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    const int socket = kd_connection_socket(request->connection), unsent = UNSENT_BYTES;
    s->watcher = (struct kd_playground_session_watcher) { .play = play,
                                                          .mhd = request->mhd,
                                                          .socket = socket,
                                                          .stream = true,
                                                          .event = since,
                                                          .deadline_ms = kd_clock_ms() + HEARTBEAT_MS };
    kd_playground_session_watch(&s->watcher, NULL);
    struct MHD_Response *response = MHD_create_response_from_callback(MHD_SIZE_UNKNOWN, 64 << 10, produce, s, release);
    if (!response) {
        release(s);
        return kd_reply_no_memory(request);
    }
    setsockopt(socket, IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent, sizeof unsent);
    MHD_add_response_header(response, "Content-Type", KD_EVENTS_TYPE);
    MHD_add_response_header(response, "X-Accel-Buffering", "no"); /* tells proxies not to buffer the stream */
    const enum MHD_Result result = kd_reply_send(request, MHD_HTTP_OK, response);
    /* a stream has no deadline */
    kd_connections_stage(request->server->connections, request->connection, KD_STAGE_WORK, 0);
    return result;
}

/* Sends the bodies and the debris of a playground session in packed form. If the client already has the newest tick,
 * the answer waits for the next tick. */
#include "base/clock.h"
#include "image/npy.h"
#include "server/http/negotiate.h"
#include "server/http/query.h"
#include "server/http/reply.h"
#include "server/playground/routes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* A request that waits for a tick. The request owns it. */
struct wait {
    struct kd_playground_session_watcher watcher; /* must be first: callbacks cast its address to this struct */
    bool npy;
};

void kd_playground_session_abandon(struct kd_request *request)
{
    if (!request->watcher)
        return;
    kd_playground_session_unwatch(request->watcher);
    free(request->watcher);
    request->watcher = NULL;
}

static void put_words(uint8_t *to, const uint32_t *words, size_t n)
{
    for (size_t i = 0; i < 4 * n; i++)
        to[i] = (uint8_t)(words[i / 4] >> 8 * (i % 4));
}

static enum kd_status add_head(const struct kd_playground_session_tick *tick, size_t n, uint32_t stride, size_t all,
                               struct kd_buffer *out)
{
    uint64_t t;
    uint8_t bytes[4 * KD_PLAY_HEAD_WORDS];
    memcpy(&t, &tick->t, sizeof t);
    put_words(bytes,
              (const uint32_t[KD_PLAY_HEAD_WORDS]) { (uint32_t)n, stride, (uint32_t)tick->generation, (uint32_t)all,
                                                     (uint32_t)t, (uint32_t)(t >> 32) },
              KD_PLAY_HEAD_WORDS);
    return kd_buffer_append(out, bytes, sizeof bytes);
}

static enum kd_status add_npy_head(const char *const *names, size_t n_names, const char *whole, size_t n,
                                   struct kd_buffer *out)
{
    struct kd_npy array = { .n_fields = n_names, .shape = { n }, .n_dimensions = 1 };
    for (size_t i = 0; i < n_names; i++) {
        snprintf(array.fields[i].name, sizeof array.fields[i].name, "%s", names[i]);
        array.fields[i].type = strcmp(names[i], whole) ? KD_NPY_F4 : KD_NPY_U4;
    }
    return kd_npy_write_header(&array, out);
}

static enum kd_status pack_bodies(const struct kd_playground_session_tick *tick, bool npy, struct kd_buffer *out)
{
    static const char *const names[KD_PLAY_BODY_WORDS] = { "id", "x",  "y",    "z",      "vx",
                                                           "vy", "vz", "mass", "radius", "temperature_k" };
    enum kd_status status = npy ? add_npy_head(names, KD_PLAY_BODY_WORDS, "id", tick->n_bodies, out)
                                : add_head(tick, tick->n_bodies, KD_PLAY_BODY_WORDS, tick->n_bodies, out);
    return status ? status : kd_buffer_append(out, tick->bodies.data, tick->bodies.size);
}

/* Packs the debris. If the tick has more pieces than the client has requested, evenly spaced pieces of the list are
 * packed. */
static enum kd_status pack_debris(const struct kd_playground_session_tick *tick, uint32_t most, bool npy,
                                  struct kd_buffer *out)
{
    static const char *const names[KD_PLAY_DEBRIS_WORDS] = { "x", "y", "z", "stage_and_source" };
    const size_t every = tick->n_debris > most ? (tick->n_debris + most - 1) / most : 1,
                 n = (tick->n_debris + every - 1) / every;
    const size_t row = 4 * KD_PLAY_DEBRIS_WORDS;
    enum kd_status status;
    KD_TRY(npy ? add_npy_head(names, KD_PLAY_DEBRIS_WORDS, "stage_and_source", n, out)
               : add_head(tick, n, KD_PLAY_DEBRIS_WORDS, tick->all_debris, out));
    if (every == 1)
        KD_TRY(kd_buffer_append(out, tick->debris.data, tick->debris.size));
    for (size_t i = 0; every > 1 && i < n; i++)
        KD_TRY(kd_buffer_append(out, tick->debris.data + i * every * row, row));
done:
    return status;
}

static enum MHD_Result send_tick(struct kd_request *request, const struct wait *wait,
                                 struct kd_playground_session_tick *tick)
{
    struct kd_buffer out = { 0 };
    char number[24];
    const uint32_t debris = wait->watcher.debris;
    const enum kd_status status =
        debris ? pack_debris(tick, debris, wait->npy, &out) : pack_bodies(tick, wait->npy, &out);
    if (status) {
        kd_playground_session_tick_release(tick);
        kd_buffer_finish(&out);
        return kd_reply_no_memory(request);
    }
    request->reply_bytes = out.size;
    struct MHD_Response *response = kd_reply_take(&out, wait->npy ? KD_NPY_TYPE : KD_BYTES_TYPE);
    if (response) {
        snprintf(number, sizeof number, "%llu", (unsigned long long)tick->generation);
        MHD_add_response_header(response, "Kerrd-Generation", number);
        snprintf(number, sizeof number, "%.17g", tick->t);
        MHD_add_response_header(response, "Kerrd-Time", number);
    }
    kd_playground_session_tick_release(tick);
    return kd_reply_send(request, MHD_HTTP_OK, response);
}

static enum MHD_Result look(struct kd_request *request)
{
    const struct wait wait = *(const struct wait *)request->watcher;
    struct kd_playground_session_tick *tick = NULL;
    struct kd_playground_event event;
    const char *why;
    const enum kd_playground_session_news what = kd_playground_session_await(request->watcher, &tick, &event, &why);
    if (what == KD_PLAY_LATER)
        return MHD_YES;
    kd_playground_session_abandon(request);
    switch (what) {
    case KD_PLAY_TICK: return send_tick(request, &wait, tick);
    case KD_PLAY_OVER: return kd_playground_session_ended(request);
    case KD_PLAY_LATE: return kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_BYTES_TYPE));
    default: return MHD_NO;
    }
}

static enum MHD_Result bad_number(struct kd_request *request, const char *detail)
{
    return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_PARAMETERS, .detail = detail });
}

static enum MHD_Result begin(struct kd_request *request, bool debris)
{
    static const char *const types[] = { KD_BYTES_TYPE, KD_NPY_TYPE };
    uint64_t after, wait_ms, most = 0;
    enum MHD_Result refused;
    if (!kd_target_whole(&request->target, "after", 0, UINT64_MAX, &after))
        return bad_number(request, "after must be a whole number, the value of Kerrd-Generation in the last answer");
    if (!kd_target_whole(&request->target, "wait_ms", KD_WAIT_MS, KD_WAIT_MS_MAX, &wait_ms))
        return bad_number(request, "wait_ms must be a whole number of milliseconds, 0 to 60000");
    if (debris &&
        (!kd_target_whole(&request->target, "at_most", KD_PLAY_DEBRIS, KD_PLAYGROUND_DEBRIS_MAX, &most) || !most))
        return bad_number(request, "at_most must be a whole number of pieces, 1 to 1000000");
    const size_t type = kd_reply_accepted(request, 2, kd_accept_string, types);
    if (type == 2)
        return kd_reply_problem(
            request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_ACCEPTABLE,
                                            .offered = KD_BYTES_TYPE ", " KD_NPY_TYPE,
                                            .detail = "positions are available only as the listed media types" });
    struct kd_playground_session *play = kd_playground_session_of(request, &refused);
    if (!play)
        return refused;
    struct wait *wait = request->connection ? calloc(1, sizeof *wait) : NULL;
    if (!wait) {
        kd_playground_session_release(play);
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_NO_MEMORY, .retry_after = 5 });
    }
    wait->npy = type == 1;
    wait->watcher = (struct kd_playground_session_watcher) { .play = play,
                                                             .mhd = request->mhd,
                                                             .socket = kd_connection_socket(request->connection),
                                                             .debris = (uint32_t)most,
                                                             .deadline_ms = kd_clock_ms() + (double)wait_ms };
    request->watcher = &wait->watcher;
    kd_playground_session_watch(request->watcher, kd_target_value(&request->target, "after") ? &after : NULL);
    return look(request);
}

enum MHD_Result kd_handle_play_bodies(struct kd_request *request)
{
    return request->watcher ? look(request) : begin(request, false);
}
enum MHD_Result kd_handle_play_debris(struct kd_request *request)
{
    return request->watcher ? look(request) : begin(request, true);
}

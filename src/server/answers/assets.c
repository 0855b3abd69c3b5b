/* Handlers of /v1/assets: upload, counts, download, delete. */
#include "base/clock.h"
#include "base/json.h"
#include "server/asset/store.h"
#include "server/http/negotiate.h"
#include "server/http/reply.h"
#include "server/http/representation.h"
#include "server/http/request.h"
#include "server/render/queue.h"
#include "server/render/task.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *type_of(const struct kd_asset_about *about)
{
    return about->observation == KD_OBSERVATION_UVFITS ? KD_UVFITS_TYPE
           : about->observation == KD_OBSERVATION_CSV  ? KD_CSV_TYPE
           : about->grid.nodes[0]                      ? KD_NPZ_TYPE
                                                       : KD_PNG_TYPE;
}

static const char *end_of(const struct kd_asset_about *about)
{
    return about->observation == KD_OBSERVATION_UVFITS ? "uvfits"
           : about->observation == KD_OBSERVATION_CSV  ? "csv"
           : about->grid.nodes[0]                      ? "npz"
                                                       : "png";
}

static void write_observation(struct kd_json *json, const struct kd_asset_about *about)
{
    kd_json_number(json, "visibilities", about->visibilities);
    kd_json_number(json, "stations", about->stations);
}

static void write_grid(struct kd_json *json, const struct kd_asset_about *about)
{
    kd_json_array(json, "nodes");
    for (int i = 0; i < 3; i++)
        kd_json_number(json, NULL, about->grid.nodes[i]);
    kd_json_end(json);
    if (about->grid.frames > 1) {
        kd_json_number(json, "frames", about->grid.frames);
        kd_json_array(json, "times");
        for (int i = 0; i < 2; i++)
            kd_json_number(json, NULL, about->grid.time[i]);
        kd_json_end(json);
    }
    kd_json_number(json, "spin", about->grid.spin);
#define MORE(x, name, ...) kd_json_number(json, #name, about->grid.name);
    KD_HOLE_MORE(MORE, )
#undef MORE
}

static void write_picture(struct kd_json *json, const struct kd_asset_about *about)
{
    kd_json_number(json, "width", about->width);
    kd_json_number(json, "height", about->height);
    kd_json_number(json, "bit_depth", about->bit_depth);
    kd_json_number(json, "channels", about->channels);
}

/* Writes {"sha256", "type", "bytes", "created"}. A picture also has "width", "height", "bit_depth" and "channels". A
 * grid also has "nodes" and the parameters of its hole, and a grid with several frames has "frames" and "times". An
 * observation also has "visibilities" and "stations". The client that uploads the asset also gets the asset's token. */
static enum kd_status to_json(const struct kd_asset_about *about, bool token, struct kd_buffer *out)
{
    struct kd_json json = kd_json_begin(out);
    kd_json_object(&json, NULL);
    kd_json_string(&json, "sha256", about->hash);
    if (token)
        kd_json_string(&json, "token", about->token);
    kd_json_string(&json, "type", type_of(about));
    (about->observation ? write_observation : about->grid.nodes[0] ? write_grid : write_picture)(&json, about);
    kd_json_number(&json, "bytes", (double)about->size);
    kd_json_number(&json, "created", about->created);
    kd_json_end(&json);
    return kd_json_finish_line(&json);
}

/* State of an upload. A worker hashes and writes the asset. */
struct putting {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_asset_put put;
};

/* Sends the answer. This runs on the HTTP thread, so it must not wait for the disk. */
static void finish(struct kd_task *task)
{
    struct putting *p = (struct putting *)task;
    const struct kd_server *server = task->request->server;
    kd_asset_put_finish(&p->put);
    /* the answer could not be sent, so the client does not know about the new asset */
    if (p->put.created && task->request->status != MHD_HTTP_CREATED)
        kd_asset_store_remove_later(server->assets, p->put.asset, server->scheduler);
    if (p->put.asset)
        kd_asset_release(server->assets, p->put.asset);
}

static enum kd_slice_result work(struct kd_task *task, double until_ms)
{
    enum { AGAIN_MS = 10 };
    struct putting *p = (struct putting *)task;
    const struct kd_buffer *body = &task->request->body;
    enum kd_asset_progress how = KD_ASSET_MORE;
    struct kd_error error = { 0 };
    enum kd_status status = KD_OK;
    if (!p->put.own)
        status =
            kd_asset_put_begin(&p->put, task->request->server->assets, body->data ? body->data : (const uint8_t *)"",
                               body->size, task->request->client, &error);
    if (!status)
        status = kd_asset_put_go_on(&p->put, until_ms, &how, &error);
    kd_task_fail(task, status, &error);
    task->scheduled.due_ms = kd_clock_ms() + AGAIN_MS;
    return status || how == KD_ASSET_OVER ? KD_SLICE_LAST : how == KD_ASSET_WAIT ? KD_SLICE_PARK : KD_SLICE_MORE;
}

static enum MHD_Result refuse(struct kd_request *request, const struct putting *p)
{
    struct kd_problem problem = kd_problem_from(&p->task.error);
    if (p->task.status == KD_EINVAL)
        problem.type = KD_PROBLEM_INVALID_ASSET;
    if (p->put.quota)
        problem.type = KD_PROBLEM_QUOTA;
    if (p->put.full)
        problem.type = KD_PROBLEM_ASSETS_FULL;
    return kd_reply_problem(request, &problem);
}

static enum MHD_Result deliver(struct kd_request *request)
{
    const struct putting *p = (const struct putting *)request->task;
    struct kd_buffer json = { 0 };
    if (p->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (p->task.status)
        return refuse(request, p);
    const struct kd_asset_about *about = kd_asset_about(p->put.asset);
    if (p->put.created && kd_asset_is_panorama(about->width, about->height))
        kd_render_queue_sky_ahead(request->server->renders, about->hash, about->width, about->height);
    enum kd_status status = to_json(about, p->put.created, &json);
    if (status || !p->put.created)
        return kd_reply_json(request, status, &json, KD_JSON_TYPE);
    struct MHD_Response *response = kd_reply_take(&json, KD_JSON_TYPE);
    kd_reply_location(request, response, about->hash);
    return kd_reply_send(request, MHD_HTTP_CREATED, response);
}

static const struct kd_task_kind KIND = { "assets", sizeof(struct putting), work, finish };

/* True if Content-Type contradicts the first bytes of the body; `text` then gets the message. A body of an unknown
 * type is refused later, when it is parsed. */
static bool wrong_type(const struct kd_request *request, char text[200])
{
    static const struct {
        const char *begin, *type, *name;
    } kinds[] = { { "\x89PNG", KD_PNG_TYPE, "a PNG" },
                  { "PK", KD_NPZ_TYPE, "a ZIP, as an NPZ is" },
                  { "SIMPLE  =", KD_UVFITS_TYPE, "a FITS file" },
                  { "#SRC:", KD_CSV_TYPE, "the EHT's CSV" } };
    const struct kd_buffer *body = &request->body;
    const char *said = NULL, *is = NULL, *begin = NULL;
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const bool same = kd_media_type_is(request->header.content_type, kinds[i].type);
        said = same ? kinds[i].type : said;
        begin = same ? kinds[i].begin : begin;
        if (!same && body->size >= strlen(kinds[i].begin) &&
            !memcmp(body->data, kinds[i].begin, strlen(kinds[i].begin)))
            is = kinds[i].name;
    }
    const bool observed = said && (!strcmp(said, KD_UVFITS_TYPE) || !strcmp(said, KD_CSV_TYPE)),
               begins = begin && body->size >= strlen(begin) && !memcmp(body->data, begin, strlen(begin));
    if (!is && observed && !begins) {
        snprintf(text, 200, "the asset is %s by its Content-Type; it must begin with \"%s\"", said, begin);
        return true;
    }
    if (said && is)
        snprintf(text, 200, "the asset is %s by its Content-Type, but its bytes are those of %s", said, is);
    return said && is;
}

static enum MHD_Result put(struct kd_request *request)
{
    enum MHD_Result refused;
    if (request->task)
        return deliver(request);
    char fault[200];
    if (wrong_type(request, fault))
        return kd_reply_problem(request, &(struct kd_problem) { .type = KD_PROBLEM_INVALID_ASSET, .detail = fault });
    struct putting *p = kd_task_begin(request, request->server->scheduler, &KIND, &refused);
    return p ? kd_task_submit(&p->task) : refused;
}

/* Writes the hash of the operator's photograph of the sky, or null if there is none. Also writes null if a client
 * uploaded the same file before the server started, and has deleted it since. */
static void write_sky(struct kd_json *json, const struct kd_server *server)
{
    const char *hash = server->sky ? kd_asset_about(server->sky)->hash : NULL;
    struct kd_asset *sky = hash ? kd_asset_store_find(server->assets, hash) : NULL;
    if (sky)
        kd_json_string(json, "sky", hash);
    else
        kd_json_null(json, "sky");
    if (sky)
        kd_asset_release(server->assets, sky);
}

/* Answers with the number and the size of all assets, and with the limits. The answer contains no hash of a client's
 * asset, because anybody who knows the hash may download the asset. */
enum MHD_Result kd_handle_assets(struct kd_request *request)
{
    if (!strcmp(request->method, "PUT"))
        return put(request);
    const struct kd_asset_limits *limits = kd_asset_store_limits(request->server->assets);
    struct kd_buffer text = { 0 };
    unsigned assets;
    uint64_t bytes;
    kd_asset_store_count(request->server->assets, &assets, &bytes);
    struct kd_json json = kd_json_begin(&text);
    kd_json_object(&json, NULL);
    kd_json_number(&json, "assets", assets);
    kd_json_number(&json, "bytes", (double)bytes);
    kd_json_object(&json, "limits");
    kd_json_number(&json, "assets", limits->most);
    kd_json_number(&json, "bytes", (double)limits->bytes);
    kd_json_number(&json, "asset_bytes", (double)KD_ASSET_BYTES);
    kd_json_number(&json, "asset_pixels", (double)KD_ASSET_PIXELS);
    kd_json_end(&json);
    write_sky(&json, request->server);
    kd_json_array(&json, "types");
    kd_json_string(&json, NULL, KD_PNG_TYPE);
    kd_json_string(&json, NULL, KD_NPZ_TYPE);
    kd_json_string(&json, NULL, KD_UVFITS_TYPE);
    kd_json_string(&json, NULL, KD_CSV_TYPE);
    kd_json_end(&json);
    kd_json_end(&json);
    return kd_reply_json(request, kd_json_finish_line(&json), &text, KD_JSON_TYPE);
}

/* State of an answer that is sent from memory. It holds a reference to the asset. */
struct sending {
    struct kd_asset_store *store;
    struct kd_asset *asset;
};

static ssize_t read_bytes(void *cls, uint64_t position, char *to, size_t size)
{
    const struct sending *s = cls;
    memcpy(to, kd_asset_about(s->asset)->data + position, size);
    return (ssize_t)size;
}

static void release(void *cls)
{
    struct sending *s = cls;
    kd_asset_release(s->store, s->asset);
    free(s);
}

/* Sends an asset's bytes, and takes over the caller's reference to the asset. The bytes at this address never
 * change. */
static enum MHD_Result send_bytes(struct kd_request *request, struct kd_asset *asset)
{
    const struct kd_asset_about *about = kd_asset_about(asset);
    struct sending *s = malloc(sizeof *s);
    if (!s) {
        kd_asset_release(request->server->assets, asset);
        return kd_reply_no_memory(request);
    }
    *s = (struct sending) { request->server->assets, asset };
    kd_reply_file(request, KD_INLINE, "kerrd-asset-%.8s.%s", about->hash, end_of(about));
    return kd_reply_representation(
        request, &(struct kd_representation) { .type = type_of(about),
                                               .etag = request->etag,
                                               .hashed = true,
                                               .cache_control = "private, max-age=31536000, immutable",
                                               .size = about->size,
                                               .fd = -1,
                                               .read = read_bytes,
                                               .release = release,
                                               .cls = s });
}

/* State of a deletion. A worker deletes the files, so that they are gone when the request is answered. */
struct removing {
    struct kd_task task; /* must be first: callbacks cast its address to this struct */
    struct kd_asset *asset;
    bool was;
};

static enum kd_slice_result remove_work(struct kd_task *task, double until_ms)
{
    struct removing *r = (struct removing *)task;
    (void)until_ms;
    r->was = kd_asset_store_remove(task->request->server->assets, r->asset);
    return KD_SLICE_LAST;
}

static void remove_finish(struct kd_task *task)
{
    struct removing *r = (struct removing *)task;
    if (r->asset)
        kd_asset_release(task->request->server->assets, r->asset);
}

static const struct kd_task_kind REMOVAL = { "assets", sizeof(struct removing), remove_work, remove_finish };

static enum MHD_Result refuse_unknown(struct kd_request *request)
{
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_NOT_FOUND,
                                        .detail = "there is no asset with this SHA-256, or it was deleted" });
}

static enum MHD_Result deliver_removal(struct kd_request *request)
{
    const struct removing *r = (const struct removing *)request->task;
    if (r->task.status == KD_ECANCELLED)
        return kd_reply_cancelled(request);
    if (r->task.status) {
        struct kd_problem problem = kd_problem_from(&r->task.error);
        return kd_reply_problem(request, &problem);
    }
    return r->was ? kd_reply_send(request, MHD_HTTP_NO_CONTENT, kd_reply_static("", 0, KD_JSON_TYPE))
                  : refuse_unknown(request);
}

/* Begins a deletion, and takes over the caller's reference to the asset. */
static enum MHD_Result begin_removal(struct kd_request *request, struct kd_asset *asset)
{
    enum MHD_Result refused = MHD_NO;
    struct removing *r =
        request->connection ? kd_task_create(request, request->server->scheduler, &REMOVAL, &refused) : NULL;
    if (r) {
        r->asset = asset;
        return kd_task_submit(&r->task);
    }
    kd_asset_release(request->server->assets, asset);
    return request->connection ? refused : kd_reply_no_memory(request);
}

enum MHD_Result kd_handle_asset(struct kd_request *request)
{
    struct kd_asset_store *store = request->server->assets;
    if (request->task)
        return deliver_removal(request);
    struct kd_asset *asset = kd_asset_store_find(store, request->rest);
    if (!asset)
        return refuse_unknown(request);
    snprintf(request->etag, sizeof request->etag, "\"%s\"", kd_asset_about(asset)->hash);
    if (strcmp(request->method, "DELETE"))
        return send_bytes(request, asset);
    const bool may = kd_secret_equal(kd_asset_about(asset)->token, kd_token_of(request));
    if (may && kd_reply_matches(request, request->etag))
        return begin_removal(request, asset);
    kd_asset_release(store, asset);
    if (may)
        return kd_reply_unmatched(request);
    return kd_reply_problem(
        request, &(struct kd_problem) { .type = KD_PROBLEM_FORBIDDEN,
                                        .detail = "deleting an asset needs its token: Authorization: Bearer TOKEN" });
}

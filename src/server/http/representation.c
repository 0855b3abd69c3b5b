#include "server/http/representation.h"

#include "server/http/negotiate.h"
#include "server/http/range.h"
#include "server/http/reply.h"

#include <inttypes.h>
#include <nettle/base64.h>
#include <nettle/sha2.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PIECE ((size_t)256 << 10) /* maximum number of bytes that are read at once */

/* The bytes that are sent, and the status. */
struct part {
    unsigned status;
    uint64_t first, count;
};

/* State of a part that is read in pieces of PIECE bytes. */
struct reading {
    struct part part;
    MHD_ContentReaderCallback read;
    void (*release)(void *cls);
    void *cls;
};

static ssize_t read_part(void *cls, uint64_t position, char *to, size_t size)
{
    const struct reading *r = cls;
    const uint64_t left = r->part.count - position;
    return left ? r->read(r->cls, r->part.first + position, to, left < size ? (size_t)left : size)
                : MHD_CONTENT_READER_END_OF_STREAM;
}

static void release_part(void *cls)
{
    struct reading *r = cls;
    r->release(r->cls);
    free(r);
}

static void give_up(const struct kd_representation *r)
{
    if (r->fd >= 0)
        close(r->fd);
    else if (!r->data)
        r->release(r->cls);
}

static struct MHD_Response *read_from(const struct kd_representation *r, struct part part)
{
    struct reading *reading = malloc(sizeof *reading);
    if (!reading)
        return NULL;
    *reading = (struct reading) { part, r->read, r->release, r->cls };
    struct MHD_Response *response =
        MHD_create_response_from_callback(part.count, PIECE, read_part, reading, release_part);
    if (!response)
        free(reading);
    return response;
}

/* Makes the response, which takes over the source. Returns NULL when out of memory, after the source was released. */
static struct MHD_Response *respond(const struct kd_representation *r, struct part part)
{
    struct MHD_Response *response = r->fd >= 0 ? MHD_create_response_from_fd_at_offset64(part.count, r->fd, part.first)
                                    : r->data
                                        ? kd_reply_static((const char *)r->data + part.first, (size_t)part.count, NULL)
                                        : read_from(r, part);
    if (!response)
        give_up(r);
    return response;
}

static bool names(struct kd_request *request, const char *header, const char *etag)
{
    struct kd_buffer tags = kd_reply_header_list(request, header);
    const bool yes = kd_etag_listed((const char *)tags.data, etag);
    kd_buffer_finish(&tags);
    return yes;
}

/* True if If-Range matches the ETag, by strong comparison. If-Range with a date never matches, because the server
 * sends no Last-Modified (RFC 9110 13.1.5). */
static bool is_of(struct kd_request *request, const char *etag)
{
    const char *tag = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "If-Range");
    return !tag || !strcmp(tag, etag);
}

/* Evaluates the preconditions in the order of RFC 9110 13.2.2, except If-Match, which kd_reply_send evaluates
 * (reply.c). */
static struct part choose(struct kd_request *request, const struct kd_representation *r)
{
    struct part part = { MHD_HTTP_OK, 0, r->size };
    if (!kd_reply_matches(request, r->etag))
        return part;
    if (names(request, "If-None-Match", r->etag)) {
        part.status = MHD_HTTP_NOT_MODIFIED;
        return part;
    }
    if (strcmp(request->method, "GET") || !is_of(request, r->etag)) /* HEAD has no ranges (RFC 9110 14.2) */
        return part;
    struct kd_buffer range = kd_reply_header_list(request, "Range");
    const enum kd_byte_range what = kd_range_read((const char *)range.data, r->size, &part.first, &part.count);
    kd_buffer_finish(&range);
    part.status = what == KD_RANGE_PART     ? MHD_HTTP_PARTIAL_CONTENT
                  : what == KD_RANGE_BEYOND ? MHD_HTTP_RANGE_NOT_SATISFIABLE
                                            : MHD_HTTP_OK;
    return part;
}

static enum MHD_Result beyond(struct kd_request *request, const struct kd_representation *r)
{
    char size[40], detail[120];
    const char *range = MHD_lookup_connection_value(request->mhd, MHD_HEADER_KIND, "Range");
    snprintf(size, sizeof size, "bytes */%" PRIu64, r->size);
    snprintf(detail, sizeof detail, "Range is %.40s; for %" PRIu64 " bytes it must begin before their end", range,
             r->size);
    give_up(r);
    return kd_reply_problem(request,
                            &(struct kd_problem) { .type = KD_PROBLEM_RANGE, .content_range = size, .detail = detail });
}

/* Adds digests (RFC 9530), whether or not the request has Want-Content-Digest or Want-Repr-Digest. Repr-Digest is
 * that of all bytes. Content-Digest is added only if all bytes are sent. */
static void add_digests(struct MHD_Response *response, const struct kd_request *request,
                        const struct kd_representation *r, struct part part)
{
    static const char begin[] = "sha-256=:";
    char text[sizeof begin + BASE64_ENCODE_RAW_LENGTH(SHA256_DIGEST_SIZE) + 1];
    uint8_t digest[SHA256_DIGEST_SIZE];
    for (size_t i = 0; i < sizeof digest; i++)
        sscanf(r->etag + 1 + 2 * i, "%2hhx", &digest[i]);
    strcpy(text, begin);
    base64_encode_raw(text + strlen(begin), sizeof digest, digest);
    strcpy(text + sizeof text - 2, ":");
    MHD_add_response_header(response, "Repr-Digest", text);
    if (part.status == MHD_HTTP_OK && !request->head)
        MHD_add_response_header(response, "Content-Digest", text);
}

static void describe_part(struct MHD_Response *response, const struct kd_representation *r, struct part part)
{
    char range[80];
    MHD_add_response_header(response, "Accept-Ranges", "bytes");
    if (r->coding)
        MHD_add_response_header(response, "Content-Encoding", r->coding);
    if (part.status != MHD_HTTP_PARTIAL_CONTENT)
        return;
    snprintf(range, sizeof range, "bytes %" PRIu64 "-%" PRIu64 "/%" PRIu64, part.first, part.first + part.count - 1,
             r->size);
    MHD_add_response_header(response, "Content-Range", range);
}

enum MHD_Result kd_reply_representation(struct kd_request *request, const struct kd_representation *r)
{
    const struct part part = choose(request, r);
    if (part.status == MHD_HTTP_RANGE_NOT_SATISFIABLE)
        return beyond(request, r);
    struct MHD_Response *response = respond(r, part);
    if (!response)
        return kd_reply_no_memory(request);
    MHD_add_response_header(response, "Content-Type", r->type);
    MHD_add_response_header(response, "ETag", r->etag);
    MHD_add_response_header(response, "Cache-Control", r->cache_control ? r->cache_control : "private, no-cache");
    if (part.status != MHD_HTTP_NOT_MODIFIED)
        describe_part(response, r, part);
    if (part.status != MHD_HTTP_NOT_MODIFIED && r->hashed)
        add_digests(response, request, r, part);
    if (r->negotiated)
        MHD_add_response_header(response, "Vary", "Accept-Encoding");
    for (const char *const *field = r->fields; field && *field; field += 2)
        MHD_add_response_header(response, field[0], field[1]);
    request->reply_bytes = part.status == MHD_HTTP_NOT_MODIFIED ? 0 : (size_t)part.count;
    return kd_reply_send(request, part.status, response);
}

enum MHD_Result kd_reply_served(struct kd_request *request, const struct kd_served *file, const char *const *fields)
{
    struct kd_buffer encodings = kd_reply_header_list(request, "Accept-Encoding");
    const bool gzip = file->gzip.data && kd_accepts_coding((const char *)encodings.data, "gzip");
    const struct kd_served_form *form = gzip ? &file->gzip : &file->plain;
    const bool picture = !strncmp(file->type, "image/", strlen("image/"));
    kd_buffer_finish(&encodings);
    return kd_reply_representation(
        request, &(struct kd_representation) { .type = file->type,
                                               .etag = form->etag,
                                               .hashed = true,
                                               /* Pictures may be cached, because browsers may fetch the icon of a
                                                * page whenever the page's address changes. */
                                               .cache_control = picture ? "private, max-age=86400" : "no-cache",
                                               .coding = gzip ? "gzip" : NULL,
                                               .negotiated = true,
                                               .fields = fields,
                                               .size = form->size,
                                               .fd = -1,
                                               .data = form->data });
}

/* Sends bytes of a known length that have an ETag. The answer depends on the request's preconditions and its Range:
 * all bytes, some of the bytes, or the status 304 or 416 (RFC 9110 13.2.2). No other part of the server handles
 * ranges. HTTP thread only. */
#ifndef KD_SERVER_HTTP_REPRESENTATION_H
#define KD_SERVER_HTTP_REPRESENTATION_H

#include "server/http/request.h"
#include "server/http/served.h"

struct kd_representation {
    const char *type;
    const char *etag; /* strong ETag, with its quotes: changes whenever the bytes change */
    /* the ETag without its quotes is the SHA-256 of the bytes, so that it is also sent as a digest */
    bool hashed;
    const char *cache_control; /* NULL: "private, no-cache", so that caches revalidate each time */
    const char *coding;        /* Content-Encoding; NULL: none */
    bool negotiated;           /* Accept-Encoding selected the coding, so Vary is sent */
    const char *const *fields; /* further headers: name, value, name, ..., NULL; NULL: none */
    uint64_t size;
    /* Source of the bytes: the first of `fd`, `data` and `read` that is set. The source must stay valid and
     * unchanged until `release` is called. */
    int fd;                         /* a file, closed at the end; -1: none */
    const void *data;               /* bytes in memory; NULL: none */
    MHD_ContentReaderCallback read; /* returns the bytes from a position on; the positions only increase */
    void (*release)(void *cls);     /* called at the end in every case */
    void *cls;                      /* argument of read and release */
};

/* Sends the representation. Closes or releases its source in every case. */
enum MHD_Result kd_reply_representation(struct kd_request *request, const struct kd_representation *r);

/* Sends a file of the page or a cached document, compressed by gzip if the client accepts that. fields: as in
 * kd_representation. */
enum MHD_Result kd_reply_served(struct kd_request *request, const struct kd_served *file, const char *const *fields);

#endif

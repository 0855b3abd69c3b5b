/* Sends bytes of a known length that have an ETag. Depending on the request's preconditions and its Range, the
 * answer is all bytes, some of the bytes, or the status 304 or 416 (RFC 9110 13.2.2). Ranges are handled only here.
 * HTTP thread only. */
#ifndef KD_SERVER_HTTP_REPRESENTATION_H
#define KD_SERVER_HTTP_REPRESENTATION_H

#include "server/http/request.h"
#include "server/http/served.h"

struct kd_representation {
    const char *type;
    const char *etag; /* strong ETag, with its quotes; it changes whenever the bytes change */
    /* true if the ETag, without its quotes, is the SHA-256 of the bytes, so that it is also sent as a digest */
    bool hashed;
    const char *cache_control; /* NULL stands for "private, no-cache": caches revalidate each time */
    const char *coding;        /* Content-Encoding; NULL: none */
    bool negotiated;           /* true if Accept-Encoding has selected the coding, so that Vary is sent */
    const char *const *fields; /* more headers: name, value, name, ..., NULL; or NULL if there are none */
    uint64_t size;
    /* Source of the bytes: the first of `fd`, `data` and `read` that is set. It must stay valid and unchanged until
     * `release` is called. */
    int fd;                         /* a file, which is closed at the end; -1: none */
    const void *data;               /* bytes in memory; NULL: not in memory */
    MHD_ContentReaderCallback read; /* returns the bytes from a position on; positions only increase */
    void (*release)(void *cls);     /* called at the end, in every case */
    void *cls;                      /* argument for read and release */
};

/* Sends the representation. Its source is closed or released in every case. */
enum MHD_Result kd_reply_representation(struct kd_request *request, const struct kd_representation *r);

/* Sends a file of the page or a cached document, compressed by gzip if the client accepts that. fields: more
 * headers, as in struct kd_representation. */
enum MHD_Result kd_reply_served(struct kd_request *request, const struct kd_served *file, const char *const *fields);

#endif

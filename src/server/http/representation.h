/* Sends bytes of a known length that have an ETag: whole, a range of them, 304 or 416, as a request's preconditions
 * and its Range say (RFC 9110 13.2.2). Nothing else in the server knows of ranges. HTTP thread only. */
#ifndef KD_SERVER_HTTP_REPRESENTATION_H
#define KD_SERVER_HTTP_REPRESENTATION_H

#include "server/http/request.h"
#include "server/http/served.h"

struct kd_representation {
    const char *type;
    const char *etag;          /* strong, with its quotes: other bytes have another one */
    bool hashed;               /* the letters between these are the SHA-256 of the bytes: they are sent as digests */
    const char *cache_control; /* NULL: "private, no-cache", kept and asked for again each time */
    const char *coding;        /* Content-Encoding; NULL: none */
    bool negotiated;           /* it has a coding, or none, by Accept-Encoding */
    const char *const *fields; /* further headers: name, value, name, ..., NULL; NULL: none */
    uint64_t size;
    /* Where its bytes are. They stay as they are until `release`. */
    int fd;                         /* a file, which is given up; else -1 and */
    const void *data;               /* bytes that outlive the answer; else NULL and */
    MHD_ContentReaderCallback read; /* gives those from a position on, which only grows */
    void (*release)(void *cls);     /* called in the end, also on failure */
    void *cls;                      /* of both */
};

/* Sends it, and closes or releases what it reads from, whatever becomes of it. */
enum MHD_Result kd_reply_representation(struct kd_request *request, const struct kd_representation *r);

/* Sends a file of the page, or a document that is kept, as gzip where the client takes that. fields: as above. */
enum MHD_Result kd_reply_served(struct kd_request *request, const struct kd_served *file, const char *const *fields);

#endif

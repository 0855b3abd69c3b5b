/* The files of clients/web, which are compiled in (embed.py). index.html is the page; the other files are loaded by
 * the page from below /web/. */
#ifndef KD_SERVER_HTTP_SERVED_H
#define KD_SERVER_HTTP_SERVED_H

#include <stddef.h>

struct kd_served {
    const char *name, *type; /* path below clients/web; media type */
    struct kd_served_form {
        const char *etag; /* SHA-256 of the bytes, with its quotes */
        const unsigned char *data;
        size_t size;
    } plain, gzip; /* gzip.data NULL: the file is not compressed, because compression would not make it shorter */
};
extern const struct kd_served kd_page_files[];
extern const size_t kd_n_page_files;

#endif

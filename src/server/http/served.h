/* The files of clients/web, which are compiled in (embed.py). index.html is the page, which loads the other files
 * from below /web/. */
#ifndef KD_SERVER_HTTP_SERVED_H
#define KD_SERVER_HTTP_SERVED_H

#include <stddef.h>

struct kd_served {
    const char *name, *type; /* name: path below clients/web; type: media type */
    struct kd_served_form {
        const char *etag; /* the SHA-256 of the bytes, with the quotes of an ETag */
        const unsigned char *data;
        size_t size;
    } plain, gzip; /* gzip.data is NULL if compression would not make the file shorter */
};
extern const struct kd_served kd_page_files[];
extern const size_t kd_n_page_files;

#endif

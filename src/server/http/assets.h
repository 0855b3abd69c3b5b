/* The files of clients/web, compiled in (embed.py): index.html is the page, the others are what it loads
 * from below /web/. */
#ifndef KD_SERVER_HTTP_ASSETS_H
#define KD_SERVER_HTTP_ASSETS_H

#include <stddef.h>

struct kd_asset {
    const char *name, *type; /* path below clients/web; media type */
    struct kd_asset_form {
        const char *etag; /* of the bytes, with its quotes */
        const unsigned char *data;
        size_t size;
    } plain, gzip;
};
extern const struct kd_asset kd_assets[];
extern const size_t kd_n_assets;

#endif

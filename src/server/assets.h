/* The files of clients/web, compiled in (embed.py). */
#ifndef KD_SERVER_ASSETS_H
#define KD_SERVER_ASSETS_H

#include <stddef.h>

struct kd_asset {
    const char *path;
    const unsigned char *data;
    size_t size;
};
extern const struct kd_asset kd_assets[];
extern const size_t kd_n_assets;

#endif

/* Cache of the latest densities that were found for given fluxes (frame/normalise.h). Only the thread that owns the
 * renderer uses this cache. */
#ifndef KD_RENDER_DEVICE_NORMALISED_H
#define KD_RENDER_DEVICE_NORMALISED_H

#include <stdint.h>

enum { KD_NORMALISED = 16 };

/* hash: hash of the flux and of everything in the scene on which the flux depends. matter: hash of the same data
 * without the camera and the picture's shape. */
struct kd_normal {
    char hash[65], matter[65];
    double scale;
};
struct kd_normalised {
    struct kd_normal entries[KD_NORMALISED];
    uint32_t n; /* number of densities stored so far */
};

#endif

/* Cache of the densities found for given fluxes (frame/normalise.h), the most recent ones. The thread that has the
 * renderer. */
#ifndef KD_RENDER_DEVICE_NORMALISED_H
#define KD_RENDER_DEVICE_NORMALISED_H

#include <stdint.h>

enum { KD_NORMALISED = 16 };

/* The hash is that of all of the scene that the flux depends on, and of the flux; matter is the same without the
 * camera and the shape of the picture. */
struct kd_normal {
    char hash[65], matter[65];
    double scale;
};
struct kd_normalised {
    struct kd_normal kept[KD_NORMALISED];
    uint32_t n; /* so far */
};

#endif

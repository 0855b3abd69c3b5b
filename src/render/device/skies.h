/* The sky on the device: a panorama, which the transfer pass reads, and stars sorted by place. Panorama and stars are
 * made on the host when the sky has changed (kd_emitter_buffers_sky, render/emit/own.h). A panorama takes up to a
 * second, on a thread of its own (panoramas.h); stars take 30 ms. Render thread only. */
#ifndef KD_RENDER_DEVICE_SKIES_H
#define KD_RENDER_DEVICE_SKIES_H

#include "render/emit/own.h"
#include "scene/scene.h"

#include <stddef.h>

struct kd_sky_buffers {
    struct kd_vk_buffer *panorama; /* words of the panorama (render/sky/panorama.h); NULL: not made yet */
    /* direction and flux of each star, cell by cell, with the brightest star of a cell first; then the temperatures
     * of all stars */
    struct kd_vk_buffer *stars;
    uint32_t n; /* number of entries: a star may be in up to three fine cells, and in up to three coarse cells */
    struct kd_vk_buffer *cells; /* the indices in `stars` at which the cells of faces.h begin */
    struct kd_sky of;           /* the sky whose data the buffers have; valid if `there` is true */
    bool there;                 /* true if the buffers hold a sky */
};

#endif

/* The sky on the device: a panorama, which the transfer pass reads, and stars sorted by place. Both are made on the
 * host when the sky has changed (kd_own_sky, render/emit/own.h). A panorama takes up to a second, on a thread of its
 * own (panoramas.h), stars 30 ms. Render thread only. */
#ifndef KD_RENDER_DEVICE_SKIES_H
#define KD_RENDER_DEVICE_SKIES_H

#include "render/emit/own.h"
#include "scene/scene.h"

#include <stddef.h>

struct kd_sky_buffers {
    struct kd_vk_buffer *panorama; /* words, render/sky/panorama.h; NULL: never was any */
    struct kd_vk_buffer
        *stars; /* direction and flux of each, cell by cell, the brightest of a cell first; then all temperatures */
    uint32_t n; /* of them: a star has up to three places among fine cells, and as many among coarse ones */
    struct kd_vk_buffer *cells; /* places in that list where the cells of faces.h begin */
    struct kd_sky of;           /* what is in them, */
    bool there;                 /* if anything is */
};

#endif

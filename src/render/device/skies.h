/* A sky on the device: its panorama, and its stars sorted by their place. Render thread only. */
#ifndef KD_RENDER_DEVICE_SKIES_H
#define KD_RENDER_DEVICE_SKIES_H

#include "render/device/prepare.h"
#include "scene/scene.h"

#include <stddef.h>

struct kd_sky_buffers {
    struct kd_vk_buffer *panorama; /* words, render/sky/panorama.h; NULL: never was any */
    struct kd_vk_buffer *stars;    /* direction and flux of each, cell by cell, the brightest of a cell first; then all temperatures */
    uint32_t n;                    /* of them: a star has up to three places */
    struct kd_vk_buffer *cells;    /* places in that list where the cells of faces.h begin, and the end */
    struct kd_sky of;              /* what is in them, */
    bool there;                    /* if anything is */
};

/* The panorama is what the transfer pass reads. Made on the host when the sky is another than the one before: some tenths of a second for
 * a Milky Way that is made up, of whose seeds the renderer keeps the last one; 30 ms for stars. */
extern const struct kd_preparation kd_prepare_sky;

#endif

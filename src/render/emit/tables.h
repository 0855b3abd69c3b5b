/* Tables of the transfer kernel, computed in double: disk temperature against radius, colour against temperature. */
#ifndef KD_RENDER_EMIT_TABLES_H
#define KD_RENDER_EMIT_TABLES_H

#include "render/view/layout.h"
#include "scene/scene.h"

/* The storage buffer of transfer.comp. */
struct kd_transfer_data {
    union {
        struct kd_transfer_block block;
        float header[KD_TRANSFER_HEADER];
    };
    struct kd_spot_block spots[KD_SPOT_MAX];
    float disk[KD_DISK_TABLE];
    float colour[KD_COLOUR_TABLE][4];
    float plunge[KD_PLUNGE_TABLE][2];
};

/* Fill from a valid scene. About 20 ms: the colour table, which no scene changes, is kept by the caller between calls:
 * pass fill_colour = true the first time. */
void kd_tables_fill(struct kd_transfer_data *out, const struct kd_scene *scene, bool fill_colour);

/* Largest effective temperature of the disk in K, in the gas's own frame. */
double kd_tables_peak_temperature(const struct kd_scene *scene);

#endif

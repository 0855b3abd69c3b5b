/* A painter makes small pictures that nobody is in a hurry for, such as those of presets: beside the render queue,
 * one at a time, on a thread of the least weight with a device of its own.
 *
 * Its own device is what keeps it out of the way of live frames: software compiles a kernel when it is first used,
 * for seconds, and the queue of the device that does so stands meanwhile. The driver's threads have the painter's
 * weight, too, since the painter's thread starts them. The device is opened for the first picture and closed when
 * none was wanted for a while. One that fails is opened again for the picture, once.
 *
 * Pictures are kept in the folder where the device's driver keeps what it has compiled, one file a name, so that
 * each is painted once for a version and a device. */
#ifndef KD_SERVER_RENDER_PAINTER_H
#define KD_SERVER_RENDER_PAINTER_H

#include "base/buffer.h"
#include "render/render.h"

struct kd_painter;

#define KD_PAINTER_BYTES (768ull << 20) /* of memory for its pictures, at most */

/* One picture; the caller's, until done() is called. */
struct kd_painting {
    struct kd_scene scene;
    const char *name; /* of its file: letters, digits and - */
    const char *mark; /* says what it is a picture of; a file with another mark is painted anew */
    void (*done)(struct kd_painting *painting); /* on the painter's thread */
    void *user;
    /* the outcome; KD_ECANCELLED: kd_painter_cancel was called */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer png;
    bool painted;             /* and not found in its file */
    struct kd_painting *next; /* the painter's own */
};

/* params: of the device, which is opened later. device_name: as kd_renderer_device_name, as long as the painter.
 * kept_at: where files are kept, a path without the name; NULL: nowhere. The painter frees it, also where this
 * fails. */
enum kd_status kd_painter_create(const struct kd_renderer_params *params, const char *device_name, char *kept_at,
                                 struct kd_painter **out, struct kd_error *error);
/* Any thread. */
void kd_painter_paint(struct kd_painter *painter, struct kd_painting *painting);
/* Whether its device hangs: it paints no more, and the process should end. Any thread. */
bool kd_painter_hangs(struct kd_painter *painter);
/* From now on nothing is painted: whatever waits or comes is done with KD_ECANCELLED, what is under way as soon as
 * it can be stopped. Any thread. */
void kd_painter_cancel(struct kd_painter *painter);
/* Cancels first. Accepts NULL. */
void kd_painter_destroy(struct kd_painter *painter);

#endif

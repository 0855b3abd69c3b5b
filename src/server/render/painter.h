/* Renders small pictures of low priority, such as thumbnails of presets, outside the render queue: one at a time, on a
 * thread of lowest priority with a device of its own.
 *
 * A device of its own keeps it from delaying live frames: a software driver compiles a kernel at its first use, for
 * seconds, and the queue of that device waits meanwhile. The driver's threads inherit the painter's priority. The
 * device is opened for the first picture and closed when none has been asked for in a while. If it fails, it is opened
 * once more.
 *
 * Pictures are cached in the folder where the driver caches its compiled kernels, one file for each, so that each is
 * rendered once for a version and a device. */
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

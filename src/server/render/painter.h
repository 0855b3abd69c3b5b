/* Renders small pictures of low priority, such as thumbnails of presets, outside the render queue: one at a time, on a
 * thread of low priority with its own device.
 *
 * With its own device it does not delay live frames: a software driver compiles a kernel at its first use, which takes
 * seconds, and the queue of that device waits meanwhile. The driver's threads inherit the painter's priority. The
 * device is opened for the first picture and closed when none has been requested for a while. If it fails, it is opened
 * once more.
 *
 * Pictures are cached in the folder where the driver caches its compiled kernels, one file for each, so that each is
 * rendered once for a version and a device. */
#ifndef KD_SERVER_RENDER_PAINTER_H
#define KD_SERVER_RENDER_PAINTER_H

#include "base/buffer.h"
#include "render/render.h"

struct kd_painter;

#define KD_PAINTER_BYTES (768ull << 20) /* memory limit of its pictures */

/* One picture; owned by the caller, except until done() is called. */
struct kd_painting {
    struct kd_scene scene;
    const char *name;                           /* file name: letters, digits and - */
    const char *mark;                           /* identifies the content; a file with another mark is rendered again */
    void (*done)(struct kd_painting *painting); /* on the painter's thread */
    void *user;
    /* results; KD_ECANCELLED: kd_painter_cancel was called */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer png;
    bool painted;             /* rendered, not read from its file */
    struct kd_painting *next; /* private to the painter */
};

/* params: for the device, which is opened later. device_name: as kd_renderer_device_name; must outlive the painter.
 * kept_at: prefix of the files' paths; NULL: no files. The painter frees it, even if this fails. */
enum kd_status kd_painter_create(const struct kd_renderer_params *params, const char *device_name, char *kept_at,
                                 struct kd_painter **out, struct kd_error *error);
/* Any thread. */
void kd_painter_paint(struct kd_painter *painter, struct kd_painting *painting);
/* Whether its device hangs. It then renders no more, and the process should end. Any thread. */
bool kd_painter_hangs(struct kd_painter *painter);
/* Stops rendering: waiting and future pictures end with KD_ECANCELLED, the present one as soon as it can be
 * interrupted. Any thread. */
void kd_painter_cancel(struct kd_painter *painter);
/* Cancels first. Accepts NULL. */
void kd_painter_destroy(struct kd_painter *painter);

#endif

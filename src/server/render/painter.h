/* Renders small pictures of low priority, such as thumbnails of presets, outside the render queue. It renders one
 * picture at a time, on a thread of low priority with its own device.
 *
 * The painter has its own device so that it does not delay live frames: a software driver compiles a kernel at its
 * first use, which takes seconds, and other work on the same device would have to wait. The driver's threads inherit
 * the painter's priority. The device is opened for the first picture, and closed when no picture has been requested for
 * a while. If it fails, it is opened once more.
 *
 * Each picture is cached in a file of its own, in the folder where the driver caches its compiled kernels. So each
 * picture is rendered only once for each version of kerrd and each device. */
#ifndef KD_SERVER_RENDER_PAINTER_H
#define KD_SERVER_RENDER_PAINTER_H

#include "base/buffer.h"
#include "render/render.h"

struct kd_painter;

#define KD_PAINTER_BYTES (768ull << 20) /* limit of the painter's device memory */

/* One picture. The caller owns it, except between kd_painter_paint and done(). */
struct kd_painting {
    struct kd_scene scene;
    const char *name; /* file name: letters, digits and - */
    /* mark of the content; if the mark of the file differs, the picture is rendered again */
    const char *mark;
    void (*done)(struct kd_painting *painting); /* called on the painter's thread */
    void *user;
    /* Results. KD_ECANCELLED: kd_painter_cancel was called. */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer png;
    bool painted;             /* true: the picture was rendered; false: it was read from its file */
    struct kd_painting *next; /* private to the painter */
};

/* params: of the device, which is opened when it is needed. device_name: see kd_renderer_device_name; it must
 * outlive the painter. kept_at: prefix of the files' paths; NULL: no files. This function takes over kept_at, even
 * if it fails. */
enum kd_status kd_painter_create(const struct kd_renderer_params *params, const char *device_name, char *kept_at,
                                 struct kd_painter **out, struct kd_error *error);
/* Requests that a picture is rendered; done() is called at the end. Any thread. */
void kd_painter_paint(struct kd_painter *painter, struct kd_painting *painting);
/* True if the painter's device hangs. If it does, the painter renders nothing more, and the process should end. Any
 * thread. */
bool kd_painter_hangs(struct kd_painter *painter);
/* Stops rendering. Waiting and future pictures end with KD_ECANCELLED, and the present one as soon as it can be
 * interrupted. Any thread. */
void kd_painter_cancel(struct kd_painter *painter);
/* Calls kd_painter_cancel, then destroys the painter. Accepts NULL. */
void kd_painter_destroy(struct kd_painter *painter);

#endif

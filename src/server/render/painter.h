/* Renders small pictures with low priority, such as thumbnails of presets, outside the render queue. The painter
 * renders one picture at a time, on a thread of low priority with its own device.
 *
 * It has its own device so that it does not delay live frames: a software driver compiles a kernel when it is first
 * used, which takes seconds, and all other work on the same device would have to wait. The driver's threads inherit
 * the painter's priority. The device is opened for the first picture, and closed when no picture has been requested
 * for a while. If it fails, it is opened once more.
 *
 * Each picture is cached in its own file, in the folder in which the driver caches compiled kernels. It is therefore
 * rendered only once for each version of kerrd and each device. */
#ifndef KD_SERVER_RENDER_PAINTER_H
#define KD_SERVER_RENDER_PAINTER_H

#include "base/buffer.h"
#include "render/render.h"

struct kd_painter;

#define KD_PAINTER_BYTES (768ull << 20) /* maximum memory of the painter's device, in bytes */

/* A picture to render. The caller owns it, except between kd_painter_paint and done(). */
struct kd_painting {
    struct kd_scene scene;
    const char *name; /* name of the file, made of letters, digits and - */
    /* text that identifies the content; if the file has another text, the picture is rendered again */
    const char *mark;
    void (*done)(struct kd_painting *painting); /* called on the painter's thread */
    void *user;
    /* The following members are results. status is KD_ECANCELLED if kd_painter_cancel was called. */
    enum kd_status status;
    struct kd_error error;
    struct kd_buffer png;
    bool painted;             /* true if the picture was rendered, false if it was read from its file */
    struct kd_painting *next; /* private to the painter */
};

/* params: parameters of the device, which is opened only when it is needed. device_name: see
 * kd_renderer_device_name; it must outlive the painter. kept_at: prefix of the paths of the files; NULL: no files.
 * The function takes over kept_at, even if it fails. */
enum kd_status kd_painter_create(const struct kd_renderer_params *params, const char *device_name, char *kept_at,
                                 struct kd_painter **out, struct kd_error *error);
/* Puts a picture into the painter's queue. done() is called at the end. Any thread. */
void kd_painter_paint(struct kd_painter *painter, struct kd_painting *painting);
/* True if the painter's device hangs. The painter then renders nothing more, and the process should end. Any thread. */
bool kd_painter_hangs(struct kd_painter *painter);
/* Stops rendering. Waiting and later pictures end with KD_ECANCELLED at once, and the present picture as soon as it
 * can be interrupted. Any thread. */
void kd_painter_cancel(struct kd_painter *painter);
/* Calls kd_painter_cancel, then destroys the painter. Accepts NULL. */
void kd_painter_destroy(struct kd_painter *painter);

#endif
